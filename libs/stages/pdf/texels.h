#pragma once

#include <functional>

#include "stages/pdf/pdf.h"

namespace vsgl {

// Calls `value` for the finest moments of every texel.
TexelValues for_each_texel(const Rsm& rsm, const std::function<double(const interop::Moments&)>& value);

}  // namespace vsgl
