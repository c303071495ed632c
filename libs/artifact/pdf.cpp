#include <cmath>
#include <span>

#include "artifact/artifact.h"
#include "artifact/fields.h"
#include "artifact/header.h"
#include "base/error.h"

namespace vsgl {

using namespace artifact;

namespace {

constexpr Field kDensity[] = {{"pdf", "V", 0, Range::non_negative}};

template <typename T>  // float or const float
std::span<T> level_of(T* pyramid, int size, int level) {
  const auto side = static_cast<std::size_t>(size >> level);
  return {pyramid + pyramid_offset(size, level), side * side};
}

// The density's mean over the texels of all layers is 1, or 0 where nothing emits.
void check_mean(const ExrFile& file, const Pdf& pdf) {
  double sum = 0;
  for (const Pdf::Layer& layer : pdf.layers)
    for (float p : level_of(layer.pyramid.data(), pdf.size, 0)) sum += double(p);
  const double mean = sum / (static_cast<double>(pdf.layers.size()) * pdf.size * pdf.size);
  if (sum != 0 && std::abs(mean - 1) > 1e-3)
    throw Error(ErrorCode::invalid_data, file.path + ": the density's mean is " + std::to_string(mean) +
                                             " instead of 1; write the file again with pdf-build");
}

Pdf::Layer read_layer(const ExrFile& file, const ExrPart& part, int size) {
  Pdf::Layer layer{part.name, std::vector<float>(pyramid_texels(size))};
  for (int l = 0; l < pyramid_levels(size); ++l)
    unpack(kDensity, Structs(level_of(layer.pyramid.data(), size, l)), file, part,
           static_cast<std::size_t>(l), size >> l, size >> l, false);
  return layer;
}

}  // namespace

void write(const std::filesystem::path& path, const Pdf& pdf, const Provenance& provenance) {
  std::vector<ExrPart> parts;
  for (const Pdf::Layer& layer : pdf.layers) {
    if (layer.pyramid.size() != pyramid_texels(pdf.size))
      throw Error(ErrorCode::internal, "write(Pdf): incomplete pyramid of '" + layer.name + "'");
    ExrPart part = make_part(layer.name, "pdf", provenance);
    part.attributes["pdf.method"] = pdf.method;
    part.mipmap = true;
    for (int l = 0; l < pyramid_levels(pdf.size); ++l)
      part.levels.push_back(pack(kDensity, Structs(level_of(layer.pyramid.data(), pdf.size, l)),
                                 pdf.size >> l, pdf.size >> l, false));
    parts.push_back(std::move(part));
  }
  write_parts(path, std::move(parts));
}

Pdf read_pdf(const std::filesystem::path& path) {
  const ExrFile file = read_artifact(path, "pdf");
  const ExrPart& first = file.parts.front();
  Pdf out;
  out.size = first.width();
  if (!is_power_of_two(out.size) || out.size != first.height())
    throw Error(ErrorCode::wrong_size,
                file.path + ": the density has " + std::to_string(first.width()) + "x" +
                    std::to_string(first.height()) +
                    " texels, but a square of a power of two is needed; write it again with pdf-build");
  out.method = string_attribute(file, first, "pdf.method");
  for (const ExrPart& part : file.parts) out.layers.push_back(read_layer(file, part, out.size));
  check_mean(file, out);
  return out;
}

}  // namespace vsgl
