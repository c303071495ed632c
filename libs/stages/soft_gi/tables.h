#pragma once

#include <vector>

#include "interop/proxy.h"
#include "stages/soft_gi/soft_gi.h"

namespace vsgl::soft_gi {

// PROXY_TABLE entries. Even in 1 - cos(half angle), to which logarithms are nearly
// proportional: linear interpolation errs by 0.7% at most.
std::vector<interop::ProxyEntry> proxy_table();
// PROXY_FITS factors of HYB.
std::vector<interop::ProxyFit> exponential_fits();

}  // namespace vsgl::soft_gi
