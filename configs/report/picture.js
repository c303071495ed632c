// The images of one viewer, decoded when first needed. Image 0 is the reference; the others are stored as differences
// from it, so that small errors are exact to three digits.

class ImageSet {
  constructor(description) {
    Object.assign(this, description);  // width, height, exposure, tone, images, layers, maps
    this.decoded = new Map();
  }

  cached(key, make) {
    if (!this.decoded.has(key)) this.decoded.set(key, make());
    return this.decoded.get(key);
  }

  // {name, channels, values: planes of each image, differences: planes of each image less the reference}.
  layer(index) {
    return this.cached(`layer ${index}`, async () => {
      const {name, channels, planes, exposure} = this.layers[index];
      const stored = await Promise.all(planes.map((plane) => decodePlanes(plane, channels, this.width, this.height)));
      const values = stored.map((image, k) => image.map((plane, c) => (k ? sum(stored[0][c], plane) : plane)));
      return {name, channels, exposure, values, differences: [stored[0].map((plane) => new Float32Array(plane.length)), ...stored.slice(1)]};
    });
  }

  map(index) {
    return this.cached(`map ${index}`, async () => (await decodePlanes(this.maps[index], 1, this.width, this.height))[0]);
  }
}

// Where the reference is not finite, what is stored is the test itself.
function sum(reference, difference) {
  return reference.map((b, i) => (Number.isFinite(b) ? b + difference[i] : difference[i]));
}

const isFinitePixel = (planes, i) => planes.every((plane) => Number.isFinite(plane[i]));

function countNonFinite(planes) {
  let count = 0;
  for (let i = 0; i < planes[0].length; ++i) count += isFinitePixel(planes, i) ? 0 : 1;
  return count;
}

// Luminance of colour planes, the value of grey ones; NaN where a channel is not finite.
function luminancePlane(planes) {
  const [r, g, b] = planes;
  return r.map((x, i) => (isFinitePixel(planes, i) ? (g ? luminance(x, g[i], b[i]) : x) : NaN));
}

// Luminance of A - B, by the stored differences.
function differencePlane(layer, a, b) {
  const valid = (i) => isFinitePixel(layer.values[a], i) && isFinitePixel(layer.values[b], i) && isFinitePixel(layer.values[0], i);
  const planes = layer.differences[a].map((plane, c) => plane.map((x, i) => (valid(i) ? x - layer.differences[b][c][i]
                                                                                        : layer.values[a][c][i] - layer.values[b][c][i])));
  return luminancePlane(planes);
}
