// Mouse, pen and fingers on the stage: the divider, panning, zooming, the inspected pixel.

const DIVIDER_REACH = 14;  // CSS pixels

class StagePointer {
  constructor(viewer) {
    this.viewer = viewer;
    this.pointers = new Map();  // those that are down
    this.dragging = null;       // "divider" or "pan"
    const area = viewer.find(".stage");
    area.addEventListener("pointerdown", (event) => this.down(event));
    area.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) area.addEventListener(end, (event) => this.up(event));
    area.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    area.addEventListener("dblclick", () => viewer.stage.fit());
    this.area = area;
  }

  place(event) {
    const box = this.area.getBoundingClientRect();
    return [event.clientX - box.left - this.area.clientLeft, event.clientY - box.top - this.area.clientTop];
  }

  down(event) {
    if (event.button !== 0) return;
    const {viewer} = this, [x, y] = this.place(event);
    this.area.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [x, y]);
    if (event.target.tagName === "CANVAS") event.target.focus({preventScroll: true});
    const near = Math.abs(x - viewer.state.divider * this.area.clientWidth) <= DIVIDER_REACH;
    this.dragging = viewer.state.view === SPLIT && near ? "divider" : "pan";
    this.area.classList.toggle("panning", this.dragging === "pan");
    this.inspect(x, y);
  }

  move(event) {
    const [x, y] = this.place(event), {viewer} = this;
    const before = this.pointers.get(event.pointerId);
    if (!before) return this.inspect(x, y);
    const distance = this.spread();
    this.pointers.set(event.pointerId, [x, y]);
    if (this.pointers.size === 2) {
      const [p, q] = this.pointers.values();
      viewer.stage.zoomTo(viewer.stage.zoom * this.spread() / Math.max(1, distance), (p[0] + q[0]) / 2, (p[1] + q[1]) / 2);
    } else if (this.dragging === "divider") {
      viewer.moveDivider(x / this.area.clientWidth);
    } else {
      viewer.stage.pan(x - before[0], y - before[1]);
    }
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    this.area.classList.remove("panning");
  }

  // Distance of two fingers.
  spread() {
    if (this.pointers.size !== 2) return 1;
    const [p, q] = this.pointers.values();
    return Math.hypot(p[0] - q[0], p[1] - q[1]);
  }

  inspect(x, y) {
    const pixel = this.viewer.stage.pixelAt(x, y);
    if (pixel && String(pixel) !== String(this.viewer.pixel)) this.viewer.inspect(pixel);
  }

  // The wheel scrolls the page until the image has been clicked.
  wheel(event) {
    const hint = this.viewer.find(".hint");
    if (!event.ctrlKey && !this.area.contains(document.activeElement)) {
      hint.hidden = false;
      clearTimeout(this.hintTimer);
      this.hintTimer = setTimeout(() => { hint.hidden = true; }, 1500);
      return;
    }
    event.preventDefault();
    hint.hidden = true;
    const [x, y] = this.place(event);
    this.viewer.stage.zoomTo(this.viewer.stage.zoom * Math.exp(-0.002 * event.deltaY * (event.deltaMode === 1 ? 20 : 1)), x, y);
    this.inspect(x, y);
  }
}
