#pragma once

#include "interop/interop.h"
#include "math/vec.h"

namespace vsgl {

// Between double precision and what shaders and artifacts hold.
inline interop::vec3 to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vec3 to_double(interop::vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace vsgl
