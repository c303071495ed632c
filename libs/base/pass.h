#pragma once

namespace CLI {
class App;
}

namespace vsgl {

// One pass of progressive rendering, whose images are averaged: other sample points and smaller lights each
// time.
struct Pass {
  int number = 1;          // 1..max_passes
  double alpha = 2.0 / 3;  // 0..1: how slowly lights shrink, see radius2_scale()
};
inline constexpr int max_passes = 1'000'000;

// --pass and --pass-alpha of the tools that a pass runs. `pass` must outlive the app.
void add_pass_options(CLI::App& app, Pass& pass);
// Throws out_of_range.
void check_pass(const Pass& pass);

}  // namespace vsgl
