#include "frame_report.h"

namespace vsgl::render {

using nlohmann::ordered_json;

void FrameReport::add(int number, const RenderedFrame& frame) {
  ordered_json rows = ordered_json::array();
  for (const StageRun& stage : frame.stages) {
    const ordered_json details = stage.report.to_json();
    double device_s = 0;
    for (const ordered_json& phase : details["phases"]) device_s += phase.value("device_s", 0.0);
    report_.time(stage.tool, stage.host_s);
    report_.device_time(stage.tool, device_s);
    rows.push_back({{"tool", stage.tool},
                    {"host_s", stage.host_s},
                    {"device_s", device_s},
                    {"phases", details["phases"]},
                    {"counts", details["counts"]}});
    warn(stage.report.warnings());
    for (const ordered_json& skipped : details["skipped"]) {
      const auto what = stage.tool + ": " + skipped["what"].get<std::string>(),
                 why = skipped["why"].get<std::string>();
      if (said_.insert(what + ": " + why).second) report_.skipped(what, why);
    }
  }
  frames_.push_back({{"frame", number}, {"pipelines_built", frame.pipelines_built}, {"stages", rows}});
}

void FrameReport::warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    if (said_.insert(warning).second) report_.warn(warning);
}

void FrameReport::finish(bool details) {
  report_.count("frames", details ? frames_ : ordered_json(frames_.size()));
}

}  // namespace vsgl::render
