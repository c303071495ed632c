#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vsgl {

// What a run tells its user: times per phase, counts, what was skipped and why, warnings. Printed as the
// tool's one JSON object under --json, as a short table otherwise. Filled from one thread.
class Report {
 public:
  // Adds `seconds` to the phase's time; phases keep the order in which they first appear.
  void time(const std::string& phase, double seconds);
  // Device time of a phase, where the device has timestamps.
  void device_time(const std::string& phase, double seconds);
  // A figure of the result, e.g. count("lights", 1024).
  void count(const std::string& name, nlohmann::ordered_json value);
  // Something that was not computed because the inputs do not need it.
  void skipped(const std::string& what, const std::string& why);
  void warn(const std::string& message);

  const std::vector<std::string>& warnings() const { return warnings_; }
  nlohmann::ordered_json to_json() const;

 private:
  struct Phase {
    std::string name;
    double host_s = 0;
    double device_s = 0;
    bool on_device = false;
  };
  Phase& phase(const std::string& name);
  std::vector<Phase> phases_;
  nlohmann::ordered_json counts_ = nlohmann::ordered_json::object();
  std::vector<std::pair<std::string, std::string>> skipped_;
  std::vector<std::string> warnings_;
};

// Adds the wall time of its scope to a phase.
class PhaseTimer {
 public:
  PhaseTimer(Report& report, std::string phase)
      : report_(report), phase_(std::move(phase)), start_(std::chrono::steady_clock::now()) {}
  ~PhaseTimer() {
    report_.time(phase_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  Report& report_;
  std::string phase_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace vsgl
