#pragma once

// Headers of artifacts: schema, provenance, and the checks that every reader makes.

#include <filesystem>
#include <string>
#include <vector>

#include "base/provenance.h"
#include "image/exr.h"
#include "math/vec.h"

namespace vsgl::artifact {

inline constexpr int kSchemaVersion = 1;

// A part whose header holds schema, version and provenance; `kind` is "gbuffer", "rsm", ...
ExrPart make_part(const std::string& name, const std::string& kind, const Provenance& provenance);

// Writes the parts; messages name `path`.
void write_parts(const std::filesystem::path& path, std::vector<ExrPart> parts);

// Reads an artifact. Throws wrong_schema unless each part is of one of those kinds, all of the same, and of
// version 1.
ExrFile read_artifact(const std::filesystem::path& path, const std::vector<std::string>& kinds);
inline ExrFile read_artifact(const std::filesystem::path& path, const std::string& kind) {
  return read_artifact(path, std::vector{kind});
}
// The kind of a file that read_artifact() gave.
std::string kind_of(const ExrFile& file);

// The only part of a file that has one. Throws missing_part when there are several.
const ExrPart& only_part(const ExrFile& file);

// Attributes with their ranges. Each throws missing_attribute or invalid_data.
int int_in(const ExrFile& file, const ExrPart& part, const std::string& name, int minimum, int maximum);
double double_in(const ExrFile& file, const ExrPart& part, const std::string& name, double minimum,
                 double maximum);
Vec3 finite_vec3(const ExrFile& file, const ExrPart& part, const std::string& name);
Vec3 unit_vec3(const ExrFile& file, const ExrPart& part, const std::string& name);  // within 1e-3

}  // namespace vsgl::artifact
