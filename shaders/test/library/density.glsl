// Two layers of a 16x16 mean pyramid, which lie behind the arguments.
#include "lib/taps.glsl"

const int SIZE = 16;
const int TOP = 4;
const uint LAYERS = 2u;

float density_at(uint layer, int level, ivec2 texel) {
  uint begin = rows * argument_stride + layer * (pyramid_offset(SIZE, TOP) + 1u) + pyramid_offset(SIZE, level);
  return arguments[begin + uint(texel.y * (SIZE >> level) + texel.x)];
}
