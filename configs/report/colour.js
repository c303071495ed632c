"use strict";

// Colours: tone mapping, the sRGB transfer function, false colours.

const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

// Rec. 709 luminance of linear colour.
const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

const srgbOf = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055);

// 8-bit sRGB of linear 0..1, by a table fine enough for 0.2 of a step where the curve is steepest.
const SRGB_STEPS = 16384;
const srgbTable = Uint8ClampedArray.from({length: SRGB_STEPS + 1}, (_, i) => 255 * srgbOf(i / SRGB_STEPS));
const srgb8 = (x) => srgbTable[Math.round(clamp(x, 0, 1) * SRGB_STEPS)];

// Each turns exposed linear colour, in place, into what the screen shows as linear 0..1.
const toneCurves = {
  linear: () => {},
  // [Reinhard 2002, Eq. (3)] x / (1 + x) of the luminance.
  reinhard: (rgb) => {
    const scale = 1 / (1 + Math.max(0, luminance(rgb[0], rgb[1], rgb[2])));
    for (let c = 0; c < 3; ++c) rgb[c] *= scale;
  },
  // [Narkowicz 2016] A rational fit to the ACES filmic curve, channel by channel.
  aces: (rgb) => {
    for (let c = 0; c < 3; ++c) {
      const x = Math.max(0, rgb[c]);
      rgb[c] = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    }
  },
};

const MAGENTA = [255, 0, 255];

// [Ottosson 2020] Oklab to 8-bit sRGB.
function oklab8(lightness, a, b) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3;
  return [srgb8(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb8(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb8(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)];
}

// A colour map from Oklab points at even distances, as a function of 0..1.
function colourMap(points) {
  const steps = 1023;
  const table = Array.from({length: steps + 1}, (_, i) => {
    const place = i / steps * (points.length - 1);
    const k = Math.min(points.length - 2, Math.floor(place));
    return oklab8(...[0, 1, 2].map((c) => points[k][c] + (place - k) * (points[k + 1][c] - points[k][c])));
  });
  return (t) => table[Math.round(clamp(t, 0, 1) * steps)];
}

// The map of `compare --false-color`: lightness rises evenly from black-blue over purple and orange to pale yellow.
const heatMap = colourMap([[0.16, 0.005, -0.030], [0.36, 0.055, -0.118], [0.56, 0.187, -0.033], [0.76, 0.100, 0.105],
                           [0.96, -0.026, 0.097]]);
// Blue below, dark grey at zero, orange above; lightness tells the magnitude on both sides.
const signedMap = colourMap([[0.93, -0.050, -0.050], [0.72, -0.060, -0.120], [0.48, -0.030, -0.130], [0.22, 0, 0],
                             [0.50, 0.110, 0.080], [0.73, 0.080, 0.125], [0.93, 0.010, 0.090]]);

// {canvas, pixels}, a picture whose pixels are `colourOf(i, rgb)`: true, and 8-bit colour in rgb; or false: not finite.
function paint(width, height, colourOf) {
  const canvas = Object.assign(document.createElement("canvas"), {width, height});
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  const rgb = [0, 0, 0];
  for (let i = 0; i < width * height; ++i) {
    image.data.set(colourOf(i, rgb) ? rgb : MAGENTA, 4 * i);
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
  return {canvas, pixels: image.data};
}

// Planes of linear colour (or grey) as a picture.
function paintPicture({width, height}, planes, exposure, tone) {
  const [red, green, blue] = planes.length === 3 ? planes : [planes[0], planes[0], planes[0]];
  const scale = 2 ** exposure, curve = toneCurves[tone], colour = [0, 0, 0];
  return paint(width, height, (i, rgb) => {
    if (!Number.isFinite(red[i] + green[i] + blue[i])) return false;
    colour[0] = scale * red[i];
    colour[1] = scale * green[i];
    colour[2] = scale * blue[i];
    curve(colour);
    for (let c = 0; c < 3; ++c) rgb[c] = srgb8(colour[c]);
    return true;
  });
}

// An error map (errors.js) as a picture.
function paintError({width, height}, error) {
  return paint(width, height, (i, rgb) => {
    if (!Number.isFinite(error.values[i])) return false;
    const colour = error.colour(error.place(error.values[i]));
    for (let c = 0; c < 3; ++c) rgb[c] = colour[c];
    return true;
  });
}
