// Histograms as SVG: logarithmic values across, counts on a logarithmic scale upwards.

const HISTOGRAM = {width: 480, height: 190, left: 40, right: 8, top: 10, bottom: 26, bins: 80};

function svgElement(tag, attributes, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

// Counts of log10(values) over low..high, what lies beyond in the outermost bins; and how many are not positive.
function countLogarithms(values, low, high) {
  const bins = new Uint32Array(HISTOGRAM.bins);
  let dark = 0;
  for (const x of values) {
    if (!Number.isFinite(x)) continue;
    if (x > 0) ++bins[clamp(Math.floor((Math.log10(x) - low) / (high - low) * HISTOGRAM.bins), 0, HISTOGRAM.bins - 1)];
    else ++dark;
  }
  return {bins, dark};
}

class HistogramPlot {
  constructor(low, high, largest) {
    const {width, height, left, right, top, bottom} = HISTOGRAM;
    this.low = low;
    this.high = high;
    this.decades = Math.max(1, Math.ceil(Math.log10(Math.max(2, largest))));
    this.svg = svgElement("svg", {viewBox: `0 0 ${width} ${height}`, role: "img"});
    this.x = (logarithm) => left + (width - left - right) * clamp((logarithm - low) / (high - low), 0, 1);
    this.y = (count) => height - bottom - (height - top - bottom) * (count > 0 ? (Math.log10(count) + 0.3) / (this.decades + 0.3) : 0);
    this.drawAxes();
  }

  drawAxes() {
    const {width, height, right, left, bottom} = HISTOGRAM;
    for (let d = 0; d <= this.decades; d += this.decades > 4 ? 2 : 1) {
      const y = this.y(10 ** d);
      this.line("grid", left, y, width - right, y);
      this.text(left - 5, y + 4, "end", d < 4 ? String(10 ** d) : `${10 ** (d - 3)}k`);
    }
    const step = Math.ceil((this.high - this.low) / 7);
    for (let d = Math.ceil(this.low); d <= this.high; d += step) {
      this.line("grid", this.x(d), HISTOGRAM.top, this.x(d), height - bottom);
      this.text(this.x(d), height - bottom + 16, "middle", Math.abs(d) < 4 ? String(Number((10 ** d).toPrecision(1))) : `1e${d}`);
    }
  }

  line(kind, x1, y1, x2, y2) {
    this.svg.append(svgElement("line", {class: kind, x1, y1, x2, y2}));
  }
  text(x, y, anchor, content, kind = "tick") {
    this.svg.append(svgElement("text", {class: kind, x, y, "text-anchor": anchor}, content));
  }

  // One outline for all bins.
  outline(bins, kind) {
    const at = (i) => this.x(this.low + (this.high - this.low) * i / bins.length).toFixed(1);
    const bottom = HISTOGRAM.height - HISTOGRAM.bottom;
    const steps = Array.from(bins, (count, i) => `H${at(i)}V${this.y(count).toFixed(1)}H${at(i + 1)}`);
    this.svg.append(svgElement("path", {class: kind, d: `M${at(0)},${bottom}${steps.join("")}V${bottom}Z`}));
  }

  // A bar for each bin, filled with `colourOf(value)`.
  bars(bins, colourOf) {
    const bottom = HISTOGRAM.height - HISTOGRAM.bottom;
    bins.forEach((count, i) => {
      if (!count) return;
      const from = this.low + (this.high - this.low) * i / bins.length, to = from + (this.high - this.low) / bins.length;
      const y = this.y(count);
      this.svg.append(svgElement("rect", {class: "bar", x: this.x(from), y, width: this.x(to) - this.x(from) + 0.3, height: bottom - y,
                                          fill: `rgb(${colourOf(10 ** ((from + to) / 2)).join()})`}));
    });
  }

  mark(value, name, row) {
    if (!(value > 0)) return;
    const x = this.x(Math.log10(value));
    this.line("mark", x, HISTOGRAM.top, x, HISTOGRAM.height - HISTOGRAM.bottom);
    this.text(x - 3, HISTOGRAM.top + 9 + 11 * row, "end", name, "mark-name");
  }
}

// The range of decades that holds the positive values, at most ten below the largest.
function decadesOf(...planes) {
  let low = Infinity, high = -Infinity;
  for (const plane of planes) {
    for (const x of plane) {
      if (!(x > 0) || !Number.isFinite(x)) continue;
      low = Math.min(low, x);
      high = Math.max(high, x);
    }
  }
  if (high < low) return [-1, 1];
  const top = Math.ceil(Math.log10(high) + 1e-9);
  return [Math.max(Math.floor(Math.log10(low)), top - 10), top];
}

function showHistogram(figure, plot, label, caption) {
  plot.svg.setAttribute("aria-label", label);
  figure.querySelector("svg")?.remove();
  figure.append(plot.svg);
  figure.querySelector("figcaption").replaceChildren(...caption);
}

function drawValueHistogram(figure, names, a, b) {
  const [low, high] = decadesOf(a, b);
  const [countsA, countsB] = [a, b].map((plane) => countLogarithms(plane, low, high));
  const plot = new HistogramPlot(low, high, Math.max(...countsA.bins, ...countsB.bins));
  plot.outline(countsB.bins, "area-b");
  plot.outline(countsA.bins, "line-a");
  const dark = (name, {dark}) => (dark ? [`; ${dark} of ${name} at 0 or below`] : []);
  showHistogram(figure, plot, `Histogram of the luminances of ${names.join(" and ")}`,
                ["Luminance, pixels: ", element("b", {class: "a"}, "A"), " line, ", element("b", {class: "b"}, "B"), " filled",
                 ...dark("A", countsA), ...dark("B", countsB)]);
}

function drawErrorHistogram(figure, error) {
  const low = -6, high = 1;
  const counts = countLogarithms(error, low, high);
  const plot = new HistogramPlot(low, high, Math.max(...counts.bins));
  const {place} = logScale(1e-4, 1);
  plot.bars(counts.bins, (value) => heatMap(place(value)));
  [[0.5, "median"], [0.95, "95 %"], [0.99, "99 %"]].forEach(([share, name], row) => plot.mark(percentile(error, share), name, row));
  showHistogram(figure, plot, "Histogram of the relative errors",
                ["Relative error, pixels", ...(counts.dark ? [`; ${counts.dark} without error`] : [])]);
}
