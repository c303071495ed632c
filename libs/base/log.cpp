#include "base/log.h"

#include <unistd.h>

#include <cstdio>

namespace vsgl {
namespace {

std::string log_tool = "vsgltools";
int log_level = 0;
bool progress_enabled = false;

// One write per line, so that lines of several threads do not mix.
void print_line(const std::string& kind, const std::string& message) {
  const std::string line = log_tool + ": " + kind + message + "\n";
  std::fputs(line.c_str(), stderr);
}

}  // namespace

void set_log(const std::string& tool, int level) {
  log_tool = tool;
  log_level = level;
}

void log_warning(const std::string& message) {
  if (log_level >= 0) print_line("warning: ", message);
}

void log_info(const std::string& message) {
  if (log_level >= 1) print_line("", message);
}

void log_debug(const std::string& message) {
  if (log_level >= 2) print_line("debug: ", message);
}

void set_progress(bool enabled) {
  progress_enabled = enabled && isatty(STDERR_FILENO) != 0;
}

Progress::Progress(std::string label, std::size_t total) : label_(std::move(label)), total_(total) {}

Progress::~Progress() {
  if (shown_ >= 0) std::fputs("\r\033[K", stderr);  // wipes the bar
}

void Progress::step(std::size_t done) {
  if (!progress_enabled || total_ == 0) return;
  const int percent = static_cast<int>(100.0 * static_cast<double>(done) / static_cast<double>(total_));
  if (percent == shown_) return;
  shown_ = percent;
  const std::string bar(static_cast<std::size_t>(percent) * 30 / 100, '=');
  std::fprintf(stderr, "\r%s [%-30s] %3d%%", label_.c_str(), bar.c_str(), percent);
}

}  // namespace vsgl
