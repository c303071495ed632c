// The stage: draws pictures side by side or split, zoomed and panned together. Lengths are CSS pixels.
//
// A region {source, left, top, width, height, from, to, values} shows the picture `source`, its view's centre in the middle of
// the rectangle, but only between the abscissas `from` and `to`; `values(i)` are the texts of a pixel.

const ZOOM_STEPS = {least: 0.02, most: 256};
const GRID_FROM = 10;     // CSS pixels an image pixel from which the grid is drawn
const VALUES_FROM = 56;   // likewise its values

class Stage {
  // `regions(width, height)`: what to show on a stage of that size; `changed()`: after each change of the view.
  constructor(canvas, width, height, regions, changed) {
    Object.assign(this, {canvas, imageWidth: width, imageHeight: height, regions, changed});
    this.context = canvas.getContext("2d", {alpha: false});
    this.fitted = true;
    this.zoom = 1;
    this.centre = [width / 2, height / 2];  // image point in the middle of each region
    this.background = "#2a2a2a";
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  get width() { return this.canvas.parentElement.clientWidth; }
  get height() { return this.canvas.parentElement.clientHeight; }
  get density() { return this.canvas.width / Math.max(1, this.width); }

  resize() {
    const density = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(this.width * density));
    this.canvas.height = Math.max(1, Math.round(this.height * density));
    if (this.fitted) this.fit();
    else this.update();
  }

  get first() { return this.regions(this.width, this.height)[0] ?? {left: 0, top: 0, width: this.width, height: this.height}; }

  fit() {
    this.fitted = true;
    this.zoom = Math.min(this.first.width / this.imageWidth, this.first.height / this.imageHeight);
    this.centre = [this.imageWidth / 2, this.imageHeight / 2];
    this.update();
  }

  // Zooms so that the image point under (x, y) stays there.
  zoomTo(zoom, x = this.first.width / 2, y = this.first.height / 2) {
    const before = this.imagePoint(x, y);
    this.zoom = clamp(zoom, ZOOM_STEPS.least, ZOOM_STEPS.most);
    const after = this.imagePoint(x, y);
    this.fitted = false;
    this.centre = this.centre.map((value, axis) => value + before[axis] - after[axis]);
    this.update();
  }

  pan(dx, dy) {
    this.fitted = false;
    this.centre = [clamp(this.centre[0] - dx / this.zoom, 0, this.imageWidth),
                   clamp(this.centre[1] - dy / this.zoom, 0, this.imageHeight)];
    this.update();
  }

  show(pixel) {
    this.fitted = false;
    this.zoom = Math.max(this.zoom, 24);
    this.centre = pixel.map((value) => value + 0.5);
    this.update();
  }

  imagePoint(x, y) {
    const inside = ({from, to, top, height}) => x >= from && x < to && y >= top && y < top + height;
    const {left, top, width, height} = this.regions(this.width, this.height).find(inside) ?? this.first;
    return [this.centre[0] + (x - left - width / 2) / this.zoom, this.centre[1] + (y - top - height / 2) / this.zoom];
  }

  // [x, y] of the pixel there, or null beside the image.
  pixelAt(x, y) {
    const pixel = this.imagePoint(x, y).map(Math.floor);
    const inside = pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < this.imageWidth && pixel[1] < this.imageHeight;
    return inside ? pixel : null;
  }

  update() {
    this.draw();
    this.changed();
  }

  draw() {
    const {context, density} = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = this.background;
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    for (const region of this.regions(this.width, this.height)) {
      context.save();
      context.setTransform(density, 0, 0, density, 0, 0);
      context.beginPath();
      context.rect(region.from, region.top, region.to - region.from, region.height);
      context.clip();
      this.drawRegion(region);
      context.restore();
    }
  }

  drawRegion(region) {
    const {context, zoom} = this;
    const left = region.left + region.width / 2 - this.centre[0] * zoom, top = region.top + region.height / 2 - this.centre[1] * zoom;
    context.imageSmoothingEnabled = zoom * this.density < 1;
    context.imageSmoothingQuality = "high";
    context.drawImage(region.source, left, top, this.imageWidth * zoom, this.imageHeight * zoom);
    if (zoom >= GRID_FROM) this.drawGrid(left, top);
    if (zoom >= GRID_FROM && this.marked) this.drawMark(left, top);
    if (zoom >= VALUES_FROM) this.drawValues(left, top, region);
  }

  drawGrid(left, top) {
    const {context, zoom} = this;
    context.beginPath();
    for (let i = 0; i <= this.imageWidth; ++i) {
      context.moveTo(left + i * zoom, top);
      context.lineTo(left + i * zoom, top + this.imageHeight * zoom);
    }
    for (let j = 0; j <= this.imageHeight; ++j) {
      context.moveTo(left, top + j * zoom);
      context.lineTo(left + this.imageWidth * zoom, top + j * zoom);
    }
    context.strokeStyle = "rgba(128, 128, 128, 0.45)";
    context.lineWidth = 1 / this.density;
    context.stroke();
  }

  // The inspected pixel's outline.
  drawMark(left, top) {
    const {context, zoom} = this, [x, y] = this.marked;
    for (const [style, width] of [["#000", 3], ["#fff", 1.5]]) {
      context.strokeStyle = style;
      context.lineWidth = width;
      context.strokeRect(left + x * zoom, top + y * zoom, zoom, zoom);
    }
  }

  // The values of each visible pixel, written into it.
  drawValues(left, top, {from, to, top: upper, height, values}) {
    const {context, zoom} = this;
    const range = (start, low, high, limit) => [Math.max(0, Math.floor((low - start) / zoom)), Math.min(limit, Math.ceil((high - start) / zoom))];
    const [i0, i1] = range(left, from, to, this.imageWidth), [j0, j1] = range(top, upper, upper + height, this.imageHeight);
    context.font = `${Math.min(14, zoom / 6)}px ui-monospace, monospace`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = "rgba(0, 0, 0, 0.75)";
    context.fillStyle = "#fff";
    for (let j = j0; j < j1; ++j) {
      for (let i = i0; i < i1; ++i) {
        const lines = values(j * this.imageWidth + i);
        lines.forEach((line, row) => {
          const y = top + (j + 0.5 + (row - (lines.length - 1) / 2) * 0.24) * zoom;
          context.strokeText(line, left + (i + 0.5) * zoom, y);
          context.fillText(line, left + (i + 0.5) * zoom, y);
        });
      }
    }
  }
}
