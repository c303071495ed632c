// One viewer: its state, its controls, and what follows from a change of either.

const VIEWS = ["split", "A", "B", "side by side", "error"];
const [SPLIT, ONLY_A, ONLY_B, SIDE, ERROR] = VIEWS.keys();
const narrowWindow = window.matchMedia("(max-width: 640px)");

class Viewer {
  constructor(root, set) {
    this.root = root;
    this.set = set;
    this.state = {layer: 0, view: SPLIT, a: 1, b: 0, error: 0, exposure: set.exposure, tone: set.tone, divider: 0.5, flipped: false};
    this.pixel = null;
    this.find = (selector) => root.querySelector(selector);
    this.buildControls();
    this.showShape();
    this.stage = new Stage(this.find(".stage canvas"), set.width, set.height, (width, height) => this.regions(width, height), () => this.showView());
    this.pointer = new StagePointer(this);
    root.addEventListener("keydown", (event) => this.keyDown(event));
    root.addEventListener("keyup", ({key}) => key === " " && this.state.flipped && this.change({flipped: false}));
    narrowWindow.addEventListener("change", () => this.showShape());
    root.addEventListener("focusout", ({relatedTarget}) => {
      if (this.state.flipped && !root.contains(relatedTarget)) this.change({flipped: false});
    });
  }

  // ---- controls ----

  buildControls() {
    const {set} = this;
    this.root.classList.toggle("many", set.images.length > 2);
    this.showLayerTab = makeTabs(this.find(".layers"), set.layers.map(({name}) => name), (layer) => this.change({layer}));
    this.find(".layers").hidden = set.layers.length < 2;
    this.showViewTab = makeTabs(this.find(".views"), VIEWS, (view) => this.change({view}));
    const labels = set.images.map(({label}) => label);
    fillSelect(this.find(".choose-a"), labels, (a) => this.change({a}));
    fillSelect(this.find(".choose-b"), labels, (b) => this.change({b}));
    this.find(".choose-error").addEventListener("change", ({target}) => this.change({error: Number(target.value)}));
    this.find(".choose-tone").addEventListener("change", ({target}) => this.change({tone: target.value}));
    const range = this.find(".exposure-range"), number = this.find(".exposure-number");
    range.min = Math.floor(set.exposure) - 10;
    range.max = Math.floor(set.exposure) + 11;
    range.addEventListener("input", () => this.change({exposure: Number(range.value)}));
    number.addEventListener("input", () => number.value && number.checkValidity() && this.change({exposure: Number(number.value)}));
    number.addEventListener("change", () => this.showControls());
    this.press(".exposure-auto", () => this.automaticExposure());
    this.press(".zoom-in", () => this.stage.zoomTo(this.stage.zoom * 1.5));
    this.press(".zoom-out", () => this.stage.zoomTo(this.stage.zoom / 1.5));
    this.press(".zoom-fit", () => this.stage.fit());
    this.press(".zoom-one", () => this.stage.zoomTo(1 / this.stage.density));
    const flip = this.find(".flip");
    flip.addEventListener("pointerdown", () => this.change({flipped: true}));
    for (const end of ["pointerup", "pointerleave", "pointercancel"]) flip.addEventListener(end, () => this.change({flipped: false}));
  }

  press(selector, action) {
    this.find(selector).addEventListener("click", action);
  }

  automaticExposure() {
    this.change({exposure: Number(this.set.layers[this.state.layer].exposure.toFixed(1))});
  }

  // Names of the error maps that exist between A and B: computed ones, then those that came with the report.
  errorChoices() {
    const given = this.set.maps.map((map, index) => ({...map, index})).filter(({image, layer}) =>
      image === this.state.a && this.state.b === 0 && (!layer || layer === this.set.layers[this.state.layer].name));
    return [...errorKinds, ...given];
  }

  // ---- state ----

  async change(changes) {
    const before = this.state;
    this.state = {...before, ...changes};
    this.state.error = Math.min(this.state.error, this.errorChoices().length - 1);
    this.showControls();
    const differ = (...keys) => keys.some((key) => this.state[key] !== before[key]);
    const pair = !this.layer || differ("layer", "a", "b");
    if (pair || differ("error")) await this.loadPair();
    if (pair || differ("exposure", "tone")) this.paintPictures();
    if (differ("view")) this.showShape();
    if (differ("view") && this.stage.fitted) this.stage.fit();
    else this.stage.update();
  }

  // Decodes what the state names, and all that follows from the pair but not from exposure and tone.
  async loadPair() {
    const {state, set} = this;
    const wanted = this.wanted = {};  // a later call overtakes this one
    const layer = await set.layer(state.layer);
    const choice = this.errorChoices()[state.error];
    const given = choice.make ? null : await set.map(choice.index);
    if (this.wanted !== wanted) return;
    this.layer = layer;
    this.luminances = [state.a, state.b].map((image) => luminancePlane(layer.values[image]));
    const difference = differencePlane(layer, state.a, state.b);
    this.relative = relativeError(difference, this.luminances[1]);
    this.difference = difference;
    this.error = given ? givenMap(choice, given) : {name: choice.name, ...choice.make(difference, this.luminances[1])};
    this.errorPicture = paintError(set, this.error);
    this.paintPictures();
    this.showPanels();
  }

  paintPictures() {
    if (!this.layer) return;
    const {a, b, exposure, tone} = this.state;
    this.pictures = [a, b].map((image) => paintPicture(this.set, this.layer.values[image], exposure, tone));
  }

  // ---- what the stage shows ----

  sides() {
    const values = (image) => (i) => this.layer.values[image].map((plane) => numberText(plane[i], 3));
    const {a, b, flipped} = this.state;
    const sides = [
      {key: "a", letter: "A", name: this.set.images[a].label, source: this.pictures[0].canvas, values: values(a)},
      {key: "b", letter: "B", name: this.set.images[b].label, source: this.pictures[1].canvas, values: values(b)},
    ];
    return flipped ? sides.reverse() : sides;
  }

  regions(width, height) {
    if (!this.pictures) return [];
    const [a, b] = this.sides();
    const error = {key: "error", letter: "", name: this.error.name, source: this.errorPicture.canvas, values: (i) => [numberText(this.error.values[i], 3)]};
    const whole = (side) => ({...side, left: 0, top: 0, width, height, from: 0, to: width});
    const middle = Math.round(this.state.divider * width);
    switch (this.state.view) {
      case SPLIT: return [{...whole(a), to: middle}, {...whole(b), from: middle}];
      case ONLY_A: return [whole(a)];
      case ONLY_B: return [whole(b)];
      case ERROR: return [whole(error)];
      default: return [a, b, error].map((side, i) => this.third(side, i, width, height));
    }
  }

  // The i-th of three in a row, or in a column where the window is narrow.
  third(side, i, width, height) {
    const length = this.stacked ? height : width;
    const start = Math.round(i * length / 3), end = Math.round((i + 1) * length / 3) - (i < 2 ? 2 : 0);
    return this.stacked ? {...side, left: 0, top: start, width, height: end - start, from: 0, to: width}
                        : {...side, left: start, top: 0, width: end - start, height, from: start, to: end};
  }

  // The stage takes the shape of what it shows.
  showShape() {
    const {width, height} = this.set, side = this.state.view === SIDE;
    this.stacked = narrowWindow.matches;
    const shape = side ? (this.stacked ? [width, 3 * height] : [3 * width, height]) : [width, height];
    this.find(".stage").style.setProperty("--shape", shape.join(" / "));
  }

  // ---- what the page says about it ----

  showControls() {
    const {state} = this;
    this.showLayerTab(state.layer);
    this.showViewTab(state.view);
    this.find(".choose-a").value = state.a;
    this.find(".choose-b").value = state.b;
    this.find(".choose-tone").value = state.tone;
    this.find(".exposure-range").value = state.exposure;
    const number = this.find(".exposure-number");
    if (document.activeElement !== number || Number(number.value) !== state.exposure) number.value = Number(state.exposure.toFixed(2));
    const choices = this.errorChoices().map(({name}) => name), select = this.find(".choose-error");
    if (choices.join("\n") !== this.shownChoices) {
      select.replaceChildren(...choices.map((name, index) => element("option", {value: index}, name)));
      this.shownChoices = choices.join("\n");
    }
    select.value = state.error;
  }

  // After each change of zoom, place, divider or view.
  showView() {
    if (!this.stage) return;
    const {stage, state, root} = this;
    this.find(".zoom-text").textContent = `${numberText(100 * stage.zoom * stage.density, 3)} %`;
    const divider = this.find(".divider");
    divider.hidden = state.view !== SPLIT || !this.pictures;
    divider.style.left = `${100 * state.divider}%`;
    divider.setAttribute("aria-valuenow", Math.round(100 * state.divider));
    divider.setAttribute("aria-valuetext", `A left of ${Math.round(100 * state.divider)} %, B right of it`);
    this.find(".legend").hidden = state.view !== ERROR && state.view !== SIDE;
    const canvas = stage.canvas;
    canvas.style.touchAction = stage.fitted ? "pan-y" : "none";
    canvas.setAttribute("aria-label", `${VIEWS[state.view]} of ${this.set.images[state.a].label} (A) and ${this.set.images[state.b].label} (B), layer ${this.set.layers[state.layer].name}`);
    this.showBadges();
    this.showReadout();
    Object.assign(root.dataset, {zoom: stage.zoom, centreX: stage.centre[0], centreY: stage.centre[1]});
  }

  showBadges() {
    const {width, height} = this.stage;
    this.find(".badges").replaceChildren(...this.regions(width, height).map(({key, letter, name, from, to, top}, i, all) => {
      const badge = element("span", {class: `badge ${key}`}, ...(letter ? [element("b", {}, letter)] : []), element("span", {}, name));
      const right = this.state.view === SPLIT && i === all.length - 1;
      badge.style[right ? "right" : "left"] = `${right ? 8 : from + 8}px`;
      badge.style.top = `${top + 8}px`;
      badge.style.maxWidth = `${Math.max(0, to - from - 16)}px`;
      badge.hidden = to - from < 48;
      return badge;
    }));
  }

  showPanels() {
    const {state, set, layer} = this;
    const names = ["A", "B"];
    drawLegend(this.find(".legend"), this.error);
    drawValueHistogram(this.find(".histogram.values"), names, ...this.luminances);
    drawErrorHistogram(this.find(".histogram.errors"), this.relative);
    drawStatistics(this.find(".statistics"), names, ...this.luminances, this.relative);
    const counts = [state.a, state.b].map((image) => countNonFinite(layer.values[image]));
    const note = this.find(".non-finite");
    note.hidden = counts[0] + counts[1] === 0;
    note.replaceChildren(element("i", {class: "swatch"}), `Pixels that are not finite (magenta): ${counts[0]} in A, ${counts[1]} in B`);
    this.find(".waiting").hidden = true;
    this.root.dataset.ready = `${state.layer} ${state.a} ${state.b} ${state.error}`;
  }

  showReadout() {
    if (!this.layer) return;
    const {a, b, exposure, tone} = this.state;
    if (!this.pixel) return drawReadout(this.find(".readout"), "Point at a pixel to read its values.", []);
    const [x, y] = this.pixel, i = y * this.set.width + x;
    const texts = (planes) => planes.map((plane) => numberText(plane[i], 3));  // what half floats can tell
    const shown = (side) => [...this.pictures[side].pixels.slice(4 * i, 4 * i + 3)];
    const rows = [
      ["A", "a", texts(this.layer.values[a]), shown(0)],
      ["B", "b", texts(this.layer.values[b]), shown(1)],
      ["A − B", "difference", [numberText(this.difference[i], 3)], null],
      ["relative", "relative", [percentText(this.relative[i])], null],
    ];
    if (this.errorChoices()[this.state.error].index !== undefined) rows.push([this.error.name, "map", [numberText(this.error.values[i], 3)], null]);
    drawReadout(this.find(".readout"), `x ${x}  y ${y}`, rows);
  }

  // ---- keys ----

  moveDivider(share) {
    this.state.divider = clamp(share, 0, 1);
    this.stage.update();
  }

  inspect(pixel) {
    this.pixel = this.stage.marked = pixel;
    this.stage.draw();
    this.showReadout();
  }

  movePixel(dx, dy) {
    const [x, y] = this.pixel ?? this.stage.centre.map(Math.floor);
    this.inspect([clamp(x + dx, 0, this.set.width - 1), clamp(y + dy, 0, this.set.height - 1)]);
  }

  showPixel(x, y) {
    this.inspect([clamp(x, 0, this.set.width - 1), clamp(y, 0, this.set.height - 1)]);
    this.stage.show(this.pixel);
    this.root.scrollIntoView({block: "nearest"});
  }

  keyDown(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, input:not([type=range]), summary")) return;
    const held = event.target.matches("button, input") && [" ", "Enter", "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"].includes(event.key);
    const action = held ? null : this.actionOf(event);
    if (!action) return;
    event.preventDefault();
    action();
  }

  actionOf({key, shiftKey, repeat}) {
    const {state, stage, set} = this;
    const next = (name, count, step = 1) => () => this.change({[name]: (state[name] + step + count) % count});
    const tones = Object.keys(toneCurves);
    const arrow = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[key];
    if (arrow) {
      const divides = state.view === SPLIT && !shiftKey && arrow[0];
      return divides ? () => this.moveDivider(state.divider - 0.02 * arrow[0]) : () => stage.pan(40 * arrow[0], 40 * arrow[1]);
    }
    if (key >= "1" && key <= "5") return () => this.change({view: Number(key) - 1});
    return {
      " ": () => repeat || this.change({flipped: true}),
      "+": () => this.change({exposure: state.exposure + 0.5}),
      "=": () => this.change({exposure: state.exposure + 0.5}),
      "-": () => this.change({exposure: state.exposure - 0.5}),
      "0": () => this.automaticExposure(),
      "w": () => this.movePixel(0, -1), "s": () => this.movePixel(0, 1), "a": () => this.movePixel(-1, 0), "d": () => this.movePixel(1, 0),
      "z": () => stage.zoomTo(stage.zoom * 1.5), "x": () => stage.zoomTo(stage.zoom / 1.5),
      "f": () => stage.fit(), "g": () => stage.zoomTo(1 / stage.density),
      "l": next("layer", set.layers.length), "e": next("error", this.errorChoices().length),
      "t": () => this.change({tone: tones[(tones.indexOf(state.tone) + 1) % tones.length]}),
      "[": next("a", set.images.length, -1), "]": next("a", set.images.length),
    }[key.toLowerCase()];
  }
}
