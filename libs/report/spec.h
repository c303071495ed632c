#pragma once

// A document described by a JSON file (vsgltools/report/1, configs/schema/report.schema.json).

#include <filesystem>
#include <vector>

#include "report/document.h"

namespace vsgl::report {

struct DescribedDocument {
  Document document;                         // without made_by
  std::vector<std::filesystem::path> files;  // all that the description names, each once, in its order
};

// Throws what reading JSON, EXR and CSV files throws; wrong_size and missing_channel for images that do not
// belong together; wrong_schema for JSON of another kind.
DescribedDocument read_document(const std::filesystem::path& path);

}  // namespace vsgl::report
