#pragma once

#include <string>
#include <vector>

namespace vsgl::gpu {

// Environment variables set for the length of a scope: how Mesa's drivers take their settings.
class ScopedEnvironment {
 public:
  ScopedEnvironment() = default;
  ~ScopedEnvironment();
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;

  void set(const std::string& name, const std::string& value);

 private:
  struct Saved {
    std::string name, value;
    bool was_set;
  };
  std::vector<Saved> saved_;
};

// lavapipe's worker threads: LP_NUM_THREADS, unless `threads` is 0.
void set_lavapipe_threads(ScopedEnvironment& environment, int threads);

// Makes lavapipe 512 bits wide, with a shader cache of its own (Mesa's cache ignores the width). Leaves
// everything as it is where the CPU lacks AVX-512 or the user has chosen a width.
void set_lavapipe_wide(ScopedEnvironment& environment);

}  // namespace vsgl::gpu
