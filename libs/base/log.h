#pragma once

#include <string>

namespace vsgl {

// Messages to stderr, prefixed with the tool's name. Levels: -1 (-q: errors only), 0, 1 (-v), 2 (-vv).
void set_log(const std::string& tool, int level);
void log_warning(const std::string& message);
void log_info(const std::string& message);   // shown from level 1
void log_debug(const std::string& message);  // shown from level 2

// A progress bar on stderr, drawn only when stderr is a terminal and --progress is auto. step() may be called
// often.
void set_progress(bool enabled);
class Progress {
 public:
  Progress(std::string label, std::size_t total);
  ~Progress();
  void step(std::size_t done);

 private:
  std::string label_;
  std::size_t total_;
  int shown_ = -1;
};

}  // namespace vsgl
