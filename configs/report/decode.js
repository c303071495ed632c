// Image planes as the report stores them: halves in the order of their values, predicted from their neighbours, their
// high bytes before their low bytes, deflated, base64.

const halfValues = Float32Array.from({length: 65536}, (_, code) => {
  const bits = code & 0x8000 ? code & 0x7fff : ~code & 0xffff;
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, mantissa = bits & 1023;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (1 + mantissa / 1024) * 2 ** (exponent - 15) : mantissa * 2 ** -24);
});

async function inflate(blob) {
  const packed = Uint8Array.from(atob(document.getElementById(`blob-${blob}`).textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The codes of one plane: the median of left, above and left + above - diagonal, plus the residual.
function codesOf(bytes, start, width, height) {
  const count = width * height, codes = new Uint16Array(count);
  for (let i = 0; i < count; ++i) {
    const folded = bytes[start + i] << 8 | bytes[start + count + i];
    const residual = folded >> 1 ^ -(folded & 1);
    let predicted = 0x8000;
    if (i >= width && i % width) {
      const left = codes[i - 1], above = codes[i - width];
      predicted = clamp(left + above - codes[i - width - 1], Math.min(left, above), Math.max(left, above));
    } else if (i) {
      predicted = i < width ? codes[i - 1] : codes[i - width];
    }
    codes[i] = predicted + residual;
  }
  return codes;
}

// `channels` planes of floats.
async function decodePlanes({blob, exponent}, channels, width, height) {
  const bytes = await inflate(blob);
  const scale = 2 ** exponent;
  return Array.from({length: channels}, (_, c) =>
    Float32Array.from(codesOf(bytes, 2 * c * width * height, width, height), (code) => scale * halfValues[code]));
}
