#include "stages/shading/interleave.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/interop_vec.h"

namespace vsgl {
namespace {

using interop::ShadingSums;
using interop::Surface;

constexpr std::size_t kMaxSubsets = 64;

constexpr float kSmoothestAlpha = 0.25f;  // sharper lobes differ too much from pixel to pixel
constexpr double kPlaneDistance = 0.01;   // of the depth: where a neighbour's weight is 1/2
constexpr double kLeastSimilarity = 0.1;
constexpr float kAlphaDifference = 0.05f;

bool shares(const Surface& s) {
  return s.id != interop::NO_INSTANCE && (receiver_ndf(s) == interop::NDF_NONE || s.alpha >= kSmoothestAlpha);
}

// x^(2^times).
double squared(double x, int times) {
  for (int i = 0; i < times; ++i) x *= x;
  return x;
}

// How well the light at `other` stands for that at `s`, 0..1: 0 where the surfaces reflect differently.
double similarity(const Surface& s, const Surface& other) {
  const std::uint32_t ndf = receiver_ndf(s);
  if (!shares(other) || receiver_ndf(other) != ndf) return 0;
  if (ndf != interop::NDF_NONE && std::abs(s.alpha - other.alpha) > kAlphaDifference) return 0;
  const Vec3 n = to_double(s.normal);
  const double agreement = std::max(dot(n, to_double(other.normal)), 0.0);
  const double bumps = std::max(dot(to_double(s.shading_normal), to_double(other.shading_normal)), 0.0);
  const double distance = std::abs(dot(n, to_double(other.position) - to_double(s.position)));
  const double reach = std::max(kPlaneDistance * static_cast<double>(s.depth), 1e-30);
  const double weight = squared(agreement, 5) * squared(bumps, 3) / (1 + distance / reach);
  return weight >= kLeastSimilarity ? weight : 0;
}

// Which subset of the lights pixel (x, y) sums: Bayer's ordered-dither matrix of `side`, a power of two,
// whose successive numbers lie far apart.
std::size_t bayer(std::size_t x, std::size_t y, std::size_t side) {
  constexpr std::array<std::size_t, 4> smallest = {0, 2, 3, 1};
  std::size_t number = 0;
  for (; side > 1; side /= 2, x /= 2, y /= 2) number = 4 * number + smallest[y % 2 * 2 + x % 2];
  return number;
}

// Weighted mean of sums.
struct Mean {
  double weight = 0, aside = 0;
  Vec3 diffuse, specular;

  void add(const ShadingSums& s, double w) {
    weight += w;
    aside += w * static_cast<double>(s.aside);
    diffuse += w * to_double(s.diffuse);
    specular += w * to_double(s.specular);
  }
};

class Interleave {
 public:
  Interleave(const GBuffer& gbuffer, const std::vector<ReceiverList>& receivers,
             const std::vector<LightList>& lights, int side, DevicePass& pass, Report& report)
      : gbuffer_(gbuffer),
        receivers_(receivers),
        lights_(lights),
        side_(side),
        subsets_(static_cast<std::size_t>(side * side)),
        pass_(pass),
        report_(report) {}

  std::vector<ShadingSums> run() {
    std::vector<ShadingSums> own(gbuffer_.pixels.size());
    for (std::size_t subset = 0; subset < subsets_; ++subset)
      sum(subset_of(subset), own,
          [&](std::uint32_t pixel) { return shares(gbuffer_.pixels[pixel]) && subset_at(pixel) == subset; });
    const std::size_t all =
        sum(lights_, own, [&](std::uint32_t pixel) { return !shares(gbuffer_.pixels[pixel]); });
    std::vector<std::uint64_t> missing(own.size());
    std::vector<ShadingSums> image = gather(own, missing);
    std::size_t recomputed = 0;
    for (std::size_t subset = 0; subset < subsets_; ++subset)
      recomputed += sum(subset_of(subset), image,
                        [&](std::uint32_t pixel) { return (missing[pixel] >> subset & 1) != 0; });
    report_.count("pixels_all_lights", all);
    report_.count("subsets_recomputed", recomputed);
    report_.count("evaluations", evaluations_);
    return image;
  }

 private:
  std::size_t subset_at(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(gbuffer_.width);
    return bayer(pixel % width, pixel / width, static_cast<std::size_t>(side_));
  }

  // Every subsets_-th light.
  std::vector<LightList> subset_of(std::size_t subset) const {
    std::vector<LightList> out;
    for (const LightList& list : lights_) {
      LightList part{list.ndf, {}};
      for (const std::uint32_t light : list.lights)
        if (light % subsets_ == subset) part.lights.push_back(light);
      if (!part.lights.empty()) out.push_back(std::move(part));
    }
    return out;
  }

  // Adds the sums over `lights` to those pixels of `image` that are `chosen`; returns how many these are.
  template <class Chosen>
  std::size_t sum(const std::vector<LightList>& lights, std::vector<ShadingSums>& image, Chosen chosen) {
    std::size_t pixels = 0, per_pixel = 0;
    for (const LightList& list : lights) per_pixel += list.lights.size();
    for (const ReceiverList& list : receivers_) {
      const ReceiverList part = select(list, chosen);
      if (part.pixels.empty()) continue;
      pixels += part.pixels.size();
      add(pass_.run(part, lights, report_), part, image);
    }
    evaluations_ += pixels * per_pixel;
    return pixels;
  }

  // The sums of all lights from those that each pixel has of its own subset; those of the pixels that do not
  // share stay. Bit k of `missing`: no similar pixel has subset k.
  std::vector<ShadingSums> gather(const std::vector<ShadingSums>& own,
                                  std::vector<std::uint64_t>& missing) const {
    std::vector<ShadingSums> image(own.size());
#pragma omp parallel for schedule(dynamic, 8)
    for (int y = 0; y < gbuffer_.height; ++y)
      for (int x = 0; x < gbuffer_.width; ++x) {
        const auto pixel = static_cast<std::size_t>(y * gbuffer_.width + x);
        image[pixel] = shares(gbuffer_.pixels[pixel]) ? gather_at(x, y, own, missing[pixel]) : own[pixel];
      }
    return image;
  }

  // [Segovia 2006] joint bilateral filter. Its tent gives every subset the same weight on a plane.
  // Deviation: normalised for each subset on its own, so that a pixel near an edge misses no light.
  ShadingSums gather_at(int x, int y, const std::vector<ShadingSums>& own, std::uint64_t& missing) const {
    const Surface& centre = gbuffer_.pixels[static_cast<std::size_t>(y * gbuffer_.width + x)];
    std::array<Mean, kMaxSubsets> means;
    for (int v = std::max(y - side_ + 1, 0); v < std::min(y + side_, gbuffer_.height); ++v)
      for (int u = std::max(x - side_ + 1, 0); u < std::min(x + side_, gbuffer_.width); ++u) {
        const auto pixel = static_cast<std::size_t>(v * gbuffer_.width + u);
        const double weight = similarity(centre, gbuffer_.pixels[pixel]);
        const int tent = (side_ - std::abs(u - x)) * (side_ - std::abs(v - y));
        if (weight > 0) means[subset_at(pixel)].add(own[pixel], weight * tent);
      }
    Mean total;
    for (std::size_t k = 0; k < subsets_; ++k) {
      const Mean& m = means[k];
      if (m.weight == 0) {
        missing |= std::uint64_t{1} << k;
        continue;
      }
      total.aside += m.aside / m.weight;
      total.diffuse += m.diffuse / m.weight;
      total.specular += m.specular / m.weight;
    }
    return {to_float(total.diffuse), static_cast<float>(total.aside), to_float(total.specular), 0};
  }

  const GBuffer& gbuffer_;
  const std::vector<ReceiverList>& receivers_;
  const std::vector<LightList>& lights_;
  int side_;
  std::size_t subsets_;
  DevicePass& pass_;
  Report& report_;
  std::size_t evaluations_ = 0;
};

}  // namespace

std::vector<ShadingSums> run_interleaved(const GBuffer& gbuffer, const std::vector<ReceiverList>& receivers,
                                         const std::vector<LightList>& lights, int side, DevicePass& pass,
                                         Report& report) {
  return Interleave(gbuffer, receivers, lights, side, pass, report).run();
}

}  // namespace vsgl
