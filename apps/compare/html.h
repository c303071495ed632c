#pragma once

// --html: one self-contained page with the figures, the images and their maps.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/tool.h"
#include "image/exr.h"
#include "report/picture.h"
#include "stages/metrics/layer_metrics.h"

namespace vsgl::app {

// A viewer of the page: what is judged, and by what.
struct HtmlImages {
  std::string title;
  struct Test {
    const ExrFile* file = nullptr;
    std::string label = {};  // empty: the file's name
  };
  std::vector<Test> tests;
  const ExrFile* reference = nullptr;
  std::vector<report::ErrorMap> maps;  // of the first test
};

// FLIP and, with a variance on either side, z-scores of `layer`; an empty name chooses as --layer does.
std::vector<report::ErrorMap> html_maps(const ExrFile& test, const ExrFile& reference,
                                        const std::string& layer, const metrics::LayerOptions& options);

void declare_html(Tool& tool, std::filesystem::path& file);

// `result`: what --output writes; its failures come first on the page, its tables after the images.
// `channels`: as
// --channels, what the viewers show. Images that share no layer are left out, which is reported as skipped.
void write_html(const Tool& tool, const std::filesystem::path& file, const nlohmann::ordered_json& result,
                bool passed, const std::vector<HtmlImages>& images, const std::vector<std::string>& channels,
                Report& report, OutputSet& outputs);

}  // namespace vsgl::app
