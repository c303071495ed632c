#pragma once

// Layers of radiance in a file: what `indirect` and `reference` share. Private to this library.

#include <span>

#include "artifact/artifact.h"
#include "artifact/fields.h"

namespace vsgl::artifact {

// Adds a layer to a level; an empty one is left out.
template <typename T>
void put_layer(ExrLevel& level, std::span<const Field> field, const std::vector<T>& pixels) {
  if (!pixels.empty())
    level.channels.merge(pack(field, Structs(std::span(pixels)), level.width, level.height, false).channels);
}

// Reads a layer. Throws missing_channel and what unpack() throws.
template <typename T>
void get_layer(const ExrFile& file, const ExrPart& part, std::span<const Field> field,
               std::vector<T>& pixels) {
  pixels.resize(static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
  unpack(field, Structs(std::span(pixels)), file, part, 0, part.width(), part.height(), false);
}
// The same where the file may lack the layer: then `pixels` stays empty.
template <typename T>
void get_layer_if_there(const ExrFile& file, const ExrPart& part, std::span<const Field> field,
                        std::vector<T>& pixels) {
  const std::string first = std::string(field[0].layer) + "." + field[0].components[0];
  if (has_channel(part, first)) get_layer(file, part, field, pixels);
}

// A level with `indirect` (the sum), `diffuse`, `specular` and `direct`, as far as they were computed. Throws
// internal when diffuse and specular layers differ in size.
ExrLevel pack_radiance(const Indirect& radiance);
// Size and layers. Throws missing_channel when there is no layer, or when layers lack their sum.
Indirect unpack_radiance(const ExrFile& file, const ExrPart& part);

}  // namespace vsgl::artifact
