#pragma once

// What a viewer of the page shows: layers of EXR files as colour or grey.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/exr.h"
#include "report/planes.h"

namespace vsgl::report {

struct Layer {
  std::string name;                 // "indirect", "key: flux" in a file of several parts, "depth.Z"
  std::vector<PlaneValues> planes;  // 3 (linear colour, or the components of a vector) or 1 (grey)
};

// One image of a viewer.
struct Picture {
  std::string label;
  std::string file;  // name without folder
  int width = 0, height = 0;
  std::vector<Layer> layers;
  std::vector<std::pair<std::string, std::string>> origin;  // tool, command, seed, inputs: from the header
};

// A channel in false colours.
struct ErrorMap {
  enum class Scale { unit, signed_, log };
  std::string name;
  std::string layer;  // of which it shows the error; empty: of all
  Scale scale = Scale::unit;
  double limit = 3;  // of signed_: the value at the ends of its scale
  int width = 0, height = 0;
  PlaneValues values;
};

// Names of all layers of level 0, in the order in which a viewer should offer them: `indirect` first, then
// RGB layers, vectors (.X .Y .Z) and single FLOAT channels, each by name.
std::vector<std::string> layer_names(const ExrFile& file);
bool is_colour_layer(const ExrFile& file, const std::string& name);
// The size of a layer's part; nothing when the file has no such layer.
std::optional<std::pair<int, int>> layer_size(const ExrFile& file, const std::string& name);
// The layer; an empty one (no planes) when the file has none of that name.
Layer extract_layer(const ExrFile& file, const std::string& name);

// The layers that all files have in one size; of several sizes that of the first layer. `selection`: only
// those that it names, by layer ("normal") or channel ("normal.X"); empty: the colour layers, or all where
// there are none.
std::vector<std::string> shared_layers(const std::vector<const ExrFile*>& files,
                                       const std::vector<std::string>& selection = {});

// Throws wrong_size unless the layers have one size, missing_channel naming file and layers where one is
// absent.
Picture make_picture(const ExrFile& file, const std::string& label, const std::vector<std::string>& layers);

// vsgl.* of the first part that has them.
std::vector<std::pair<std::string, std::string>> origin_of(const ExrFile& file);

// Stops that bring the 95th percentile of the positive luminances to 0.8; 0 when there is none.
double automatic_exposure(const Layer& layer);

}  // namespace vsgl::report
