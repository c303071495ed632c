#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "reference/estimator.h"

namespace vsgl::reference {

// Running means of the passes of an image, and their spread.
class Accumulator {
 public:
  Accumulator(int width, int height) : width_(width), height_(height), pixels_(size()) {}

  // [Welford 1962] One more pass of a pixel; each pixel once per pass. `passes`: with this one.
  void add(std::size_t pixel, const Estimate& estimate, int passes);

  Vec3 diffuse(std::size_t pixel) const;
  Vec3 specular(std::size_t pixel) const;
  // Variance of the mean of diffuse + specular over `passes` >= 2 passes.
  Vec3 variance(std::size_t pixel, int passes) const;
  // sqrt(mean variance) / mean, over `pixels` and channels; 0 for black images.
  double relative_error(const std::vector<std::uint32_t>& pixels, int passes) const;

  std::size_t size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

  // The state after `passes` passes as an EXR whose UINT channels hold the halves of the numbers. `key`
  // stands for the inputs. Throws write_failed.
  void save(const std::filesystem::path& path, const std::string& key, int passes) const;
  // Number of passes of the state at `path`, which becomes this one's; nothing when there is no such file.
  // Throws exr_unreadable, wrong_schema, wrong_size, and invalid_data when it is of another key.
  std::optional<int> load(const std::filesystem::path& path, const std::string& key);

 private:
  // Means of diffuse and specular radiance, and squared deviations of their sum, RGB each.
  using State = std::array<double, 9>;

  int width_, height_;
  std::vector<State> pixels_;
};

}  // namespace vsgl::reference
