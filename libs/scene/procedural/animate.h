#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/procedural.h"
#include "scene/procedural/model.h"

namespace vsgl::scene {

// Adds to the JSON of a generated scene the motion that the options ask for, and what it moves: there and
// back, 64 frames each way, the first frame as in the scene at rest. Returns the files that it takes besides.
//   light: turns by 0.25 degrees a frame
//   camera: moves sideways by one pixel a frame, at the distance of what it looks at
//   object: a cube crosses the light's cone; a figure's parts swing, once to and fro in 128 frames
std::vector<GeneratedFile> animate(nlohmann::ordered_json& scene, const Model& model,
                                   const GenerateOptions& options, const std::string& stem);

}  // namespace vsgl::scene
