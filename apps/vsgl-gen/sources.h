#pragma once

#include <nlohmann/json.hpp>

#include "options.h"

namespace vsgl::vsgl_gen {

struct Generated {
  Lights lights;
  nlohmann::ordered_json info;  // for --info; of sphere lights there is none
};

// Reads what lights are made of, and makes them. The device may be null where the method needs none.
Generated from_rsm(const Arguments& a, gpu::Device* device, Report& report);
Generated from_environment(const Arguments& a, gpu::Device& device, Report& report);
// Takes the files that the scene refers to into the provenance.
Generated from_sphere_lights(Tool& tool, const Arguments& a, Report& report);

}  // namespace vsgl::vsgl_gen
