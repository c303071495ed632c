#pragma once

// Layers of both files as linear colour.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/exr.h"

namespace vsgl::metrics {

using Colour = std::array<float, 3>;

// An RGB layer of both files, or a single FLOAT channel as grey. Pixels row by row from the top-left.
struct LayerPair {
  std::string name;
  int width = 0, height = 0;
  std::vector<Colour> test, reference;
};

// Rec.709 luminance.
double luminance_of(const Colour& colour);

// Level 0 of layer `name`; without a name `indirect`, or else the first RGB layer, or else the first FLOAT
// channel. Nothing when the files share no such layer of one size. Throws bad_value when `name` is given and
// not there.
std::optional<LayerPair> choose_layer(const ExrFile& test, const ExrFile& reference, const std::string& name);

// Level 0 of layer `name` (RGB, or a FLOAT channel as grey) of two parts of one size; nothing where a part
// lacks it.
std::optional<LayerPair> extract_layer(const ExrPart& test, const ExrPart& reference,
                                       const std::string& name);

// Level 0 of an RGB layer of one part, or of a FLOAT channel as grey; nothing when it is not there.
std::optional<std::vector<Colour>> colours_of(const ExrPart& part, const std::string& name);

// Takes the pixels that are not finite on both sides out of the picture: they become black on both sides.
// Returns which those are (1) and which are not (0).
std::vector<char> blacken_non_finite(LayerPair& layer);

// Exposure in stops that brings the 95th percentile of the reference's positive luminances to 0.8; 0 when
// there is none.
double automatic_exposure(const LayerPair& layer);

}  // namespace vsgl::metrics
