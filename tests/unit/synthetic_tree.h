#pragma once

// Light trees of RSMs.

#include "stages/lights/lights.h"

namespace vsgl::test {

inline Lights tree_of(const Rsm& rsm, const LightsParams& params = {}) {
  Report report;
  return generate_lights(rsm, nullptr, params, nullptr, report);
}

}  // namespace vsgl::test
