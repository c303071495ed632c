#include "base/report.h"

#include <algorithm>

namespace vsgl {

Report::Phase& Report::phase(const std::string& name) {
  const auto found =
      std::find_if(phases_.begin(), phases_.end(), [&](const Phase& p) { return p.name == name; });
  if (found != phases_.end()) return *found;
  phases_.push_back({.name = name});
  return phases_.back();
}

void Report::time(const std::string& name, double seconds) {
  phase(name).host_s += seconds;
}

void Report::device_time(const std::string& name, double seconds) {
  Phase& p = phase(name);
  p.device_s += seconds;
  p.on_device = true;
}

void Report::count(const std::string& name, nlohmann::ordered_json value) {
  counts_[name] = std::move(value);
}

void Report::skipped(const std::string& what, const std::string& why) {
  skipped_.emplace_back(what, why);
}

void Report::warn(const std::string& message) {
  warnings_.push_back(message);
}

nlohmann::ordered_json Report::to_json() const {
  using nlohmann::ordered_json;
  ordered_json phases = ordered_json::array();
  for (const Phase& p : phases_) {
    ordered_json row = {{"name", p.name}, {"host_s", p.host_s}};
    if (p.on_device) row["device_s"] = p.device_s;
    phases.push_back(row);
  }
  ordered_json skipped = ordered_json::array();
  for (const auto& [what, why] : skipped_) skipped.push_back({{"what", what}, {"why", why}});
  return {{"phases", phases}, {"counts", counts_}, {"skipped", skipped}, {"warnings", warnings_}};
}

}  // namespace vsgl
