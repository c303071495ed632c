// Small pieces of the page: elements, number texts, the legend, the pixel readout, the statistics.

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

// `digits` significant digits, without an exponent where that is short.
function numberText(x, digits = 4) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "NaN" : x > 0 ? "∞" : "-∞";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const text = size >= 1e-4 && size < 1e6 ? x.toPrecision(digits) : x.toExponential(digits - 2);
  return (text.includes("e+") && size < 1e6 ? String(Math.round(x)) : text);
}

const percentText = (x) => (Number.isFinite(x) ? `${numberText(100 * x, 3)} %` : numberText(x));

// Buttons of which one is chosen. `names` are shown in order; `choose(index)` is called.
function makeTabs(container, names, choose) {
  const buttons = names.map((name, index) => {
    const button = element("button", {type: "button", role: "radio", title: name}, name);
    button.addEventListener("click", () => choose(index));
    return button;
  });
  container.replaceChildren(...buttons);
  container.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const next = (buttons.indexOf(document.activeElement) + step + buttons.length) % buttons.length;
    buttons[next].focus();
    choose(next);
  });
  return (chosen) => buttons.forEach((button, index) => {
    button.setAttribute("aria-checked", index === chosen);
    button.tabIndex = index === chosen ? 0 : -1;
  });
}

function fillSelect(select, names, change) {
  select.replaceChildren(...names.map((name, index) => element("option", {value: index}, name)));
  select.addEventListener("change", () => change(Number(select.value)));
}

// The colours of an error map, with their values.
function drawLegend(legend, error) {
  const bar = legend.querySelector("canvas");
  bar.width = 256;
  const context = bar.getContext("2d");
  for (let x = 0; x < 256; ++x) {
    context.fillStyle = `rgb(${error.colour(x / 255).join()})`;
    context.fillRect(x, 0, 1, 1);
  }
  const texts = error.ticks.map((tick) => String(Number(tick.toPrecision(2))));
  bar.setAttribute("aria-label", `${error.name}: colours from ${texts[0]} to ${texts.at(-1)}`);
  legend.querySelector(".legend-name").textContent = error.name;
  legend.querySelector(".legend-ticks").replaceChildren(...error.ticks.map((tick, i) => {
    const mark = element("span", {}, texts[i]);
    mark.style.left = `${100 * error.place(tick)}%`;
    return mark;
  }));
}

// `rows`: [name, class, values of the channels, colour of the swatch or null].
function drawReadout(readout, place, rows) {
  const cells = rows.map(([name, kind, values, swatch]) => {
    const chip = element("i", {class: "swatch"});
    if (swatch) chip.style.background = `rgb(${swatch.join()})`;
    return element("span", {class: `value ${kind}`}, element("b", {}, name), ...(swatch ? [chip] : []),
                   ...values.map((value) => element("span", {class: "figure"}, value)));
  });
  readout.replaceChildren(element("span", {class: "place"}, place), ...cells);
}

// Figures of the shown pair, from the stored pixels.
function drawStatistics(container, names, a, b, error) {
  const mean = (values) => {
    const finite = values.filter(Number.isFinite);
    return finite.reduce((total, x) => total + x, 0) / Math.max(1, finite.length);
  };
  const largest = (values) => percentile(values, 1);
  const row = (name, ...cells) => element("tr", {}, element("th", {scope: "row"}, name),
                                          ...cells.map((cell) => element("td", {class: "number", colspan: 3 - cells.length}, cell)));
  const table = element("table", {},
    element("caption", {}, "Luminance of this layer"),
    element("thead", {}, element("tr", {}, element("td"), element("th", {scope: "col", class: "number a"}, names[0]),
                                          element("th", {scope: "col", class: "number b"}, names[1]))),
    element("tbody", {},
      row("mean", numberText(mean(a)), numberText(mean(b))),
      row("median", numberText(percentile(a, 0.5)), numberText(percentile(b, 0.5))),
      row("95 %", numberText(percentile(a, 0.95)), numberText(percentile(b, 0.95))),
      row("largest", numberText(largest(a)), numberText(largest(b)))),
    element("tbody", {},
      row("mean A / mean B", numberText(mean(a) / mean(b))),
      row("relative error: mean", percentText(mean(error))),
      row("95 %", percentText(percentile(error, 0.95))),
      row("99 %", percentText(percentile(error, 0.99)))));
  container.replaceChildren(table);
}
