// Lets one header define structs for C++ and GLSL. GLSL files that include any interop header say
//   #extension GL_EXT_scalar_block_layout : require
//   #extension GL_GOOGLE_include_directive : require
// and declare their blocks `layout(scalar, ...)`: then both sides agree on every offset.
#ifndef VSGL_INTEROP_INTEROP_H
#define VSGL_INTEROP_INTEROP_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
namespace vsgl::interop {
using uint = std::uint32_t;
struct vec2 {
  float x = 0, y = 0;
};
struct vec3 {
  float x = 0, y = 0, z = 0;
};
struct vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};
struct uvec2 {
  uint x = 0, y = 0;
};
struct mat4 {
  float column[4][4] = {};  // column-major, as GLSL
};
}  // namespace vsgl::interop
#define VSGL_INTEROP_BEGIN namespace vsgl::interop {
#define VSGL_INTEROP_END }
#define VSGL_CONST inline constexpr
#define VSGL_CHECK_SIZE(type, bytes) \
  static_assert(sizeof(type) == (bytes), #type " must have the same layout in GLSL");
#else
#define VSGL_INTEROP_BEGIN
#define VSGL_INTEROP_END
#define VSGL_CONST const
#define VSGL_CHECK_SIZE(type, bytes)
#endif

#endif
