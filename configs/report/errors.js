// Error maps: a plane of numbers, how its scale runs, and its colours.

// The value below which a share of the finite values lies; 0 when there is none.
function percentile(values, share) {
  const sorted = Float32Array.from(values.filter(Number.isFinite)).sort();
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;
}

// 1, 2 or 5 times a power of ten, not below x.
function roundUp(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [1, 2, 5, 10].find((step) => step * power >= x * 0.9999);
}

// |Ya - Yb| / (|Yb| + mean|Yb| / 100), as `compare --false-color` has it.
function relativeError(difference, reference) {
  const finite = reference.filter(Number.isFinite);
  const mean = finite.reduce((total, y) => total + Math.abs(y), 0) / Math.max(1, finite.length);
  const floor = mean > 0 ? 0.01 * mean : 1e-30;
  return difference.map((d, i) => Math.abs(d) / (Math.abs(reference[i]) + floor));
}

const logScale = (low, high) => ({
  place: (x) => (x > 0 ? Math.log(x / low) / Math.log(high / low) : 0),
  ticks: Array.from({length: Math.round(Math.log10(high / low)) + 1}, (_, i) => low * 10 ** i),
  colour: heatMap,
});
const unitScale = (limit) => ({place: (x) => x / limit, ticks: [0, 0.25, 0.5, 0.75, 1].map((t) => t * limit), colour: heatMap});
const signedScale = (limit) => ({place: (x) => 0.5 + 0.5 * x / limit, ticks: [-1, -0.5, 0, 0.5, 1].map((t) => t * limit), colour: signedMap});

const errorKinds = [
  {
    name: "relative error",
    make: (difference, reference) => ({values: relativeError(difference, reference), ...logScale(1e-4, 1)}),
  },
  {
    name: "absolute error",
    make: (difference) => {
      const values = difference.map(Math.abs);
      return {values, ...unitScale(roundUp(percentile(values, 0.99)))};
    },
  },
  {
    name: "signed difference A − B",
    make: (difference) => ({values: difference, ...signedScale(roundUp(percentile(difference.map(Math.abs), 0.99)))}),
  },
];

// A map that the report came with.
function givenMap(map, values) {
  const scale = {unit: () => unitScale(1), signed: () => signedScale(map.limit), log: () => logScale(1e-4, 1)}[map.scale]();
  return {name: map.name, values, ...scale};
}
