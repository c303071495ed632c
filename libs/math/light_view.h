#pragma once

#include "interop/geometry.h"
#include "math/light_source.h"

namespace vsgl {

// A light as the shaders see it, over width x height texels. near_far and samples, which only baking needs,
// are left 0. Throws internal for an unknown type.
interop::View light_view(const LightSource& light, int width, int height);

}  // namespace vsgl
