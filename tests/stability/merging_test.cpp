// The hazards of merging: variances of clusters far from the origin, deficits of sharp lobes, kernels where
// the density is 0.

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "../unit/lights/densities.h"
#include "hazard.h"
#include "math/kernel_size.h"
#include "math/lobe.h"
#include "math/moments.h"
#include "pyramid/kernels.h"

namespace vsgl::test {
namespace {

constexpr std::size_t words = 26;  // of interop::Moments
constexpr int points = 64 * 64;

struct Point {
  double weight;
  Vec3 position;
};

// A disk of `radius` in a tilted plane about `centre`, evenly covered, of random weights.
std::vector<Point> disk(Vec3 centre, double radius) {
  std::mt19937 engine(5);
  const Vec3 z = normalise(Vec3{0.3, 0.4, 1}), x = normalise(cross(Vec3{0, 1, 0}, z)), y = cross(z, x);
  std::vector<Point> all;
  for (int i = 0; i < points; ++i) {
    const double r = radius * std::sqrt((i + 0.5) / points), angle = 2.39996323 * i;
    all.push_back({0.2 + static_cast<double>(engine()) / 4294967296.0,
                   centre + r * std::cos(angle) * x + r * std::sin(angle) * y});
  }
  return all;
}

double exact_variance(const std::vector<Point>& all) {
  const auto merged = merge_mean_spread(
      all.size(), [&](std::size_t k) { return all[k].weight; },
      [&](std::size_t k) { return all[k].position; }, [](std::size_t) { return 0.0; });
  return merged.spread;
}

// Averages four rows at a time until each cluster of `points` is one row, by a function of the device that
// takes four and gives `values`, of which the first `kept` are the next row.
template <class Call>
std::vector<float> reduce(std::vector<Row> rows, std::size_t values, std::size_t kept, Call call) {
  std::vector<float> results;
  for (int left = points; left > 1; left /= 4) {
    std::vector<Row> fours;
    for (std::size_t i = 0; i < rows.size(); i += 4) {
      Row& four = fours.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) four.insert(four.end(), rows[i + k].begin(), rows[i + k].end());
    }
    results = call(fours);
    rows.clear();
    for (std::size_t i = 0; i < results.size(); i += values)
      rows.emplace_back(results.begin() + static_cast<long>(i),
                        results.begin() + static_cast<long>(i + kept));
  }
  return results;
}

std::vector<float> merge_on_device(gpu::Device& device, const std::vector<Row>& rows, bool rough) {
  return reduce(rows, words, words, [&](const std::vector<Row>& fours) {
    return call_library(device, "moments", "moments_merge", fours, words, rough);
  });
}

Row moments_row(double weight, Vec3 position) {
  Row row(words, 0.0f);
  const double values[] = {weight, position.x, position.y, position.z};
  for (std::size_t k = 0; k < 4; ++k) row[9 + k] = static_cast<float>(values[k]);
  return row;
}

// Relative errors of the variance of a disk of `radius` at `distance` from the origin.
struct VarianceErrors {
  double anchored, rough, merged, raw;  // raw: mean square less the squared mean
};
VarianceErrors variance_errors(gpu::Device& device, double radius, double distance) {
  const Vec3 centre = distance * normalise(Vec3{1, -0.7, 0.4}), anchor = centre + Vec3{3 * radius, 0, 0};
  const std::vector<Point> all = disk(centre, radius);
  const double exact = exact_variance(all);
  std::vector<Row> anchored, world, raw;
  for (const Point& p : all) {
    anchored.push_back(moments_row(p.weight, p.position - anchor));
    world.push_back(moments_row(p.weight, p.position));
    const Row& m = world.back();
    raw.push_back({m[9], m[10], m[11], m[12], m[10] * m[10] + m[11] * m[11] + m[12] * m[12]});
  }
  const auto error = [&](float value) {
    return std::isfinite(value) ? std::abs(double{value} / exact - 1) : 1e30;
  };
  const auto merged = [&](const std::vector<Row>& rows, bool rough) {
    return error(merge_on_device(device, rows, rough)[13]);
  };
  const std::vector<float> squares = reduce(raw, 6, 5, [&](const std::vector<Row>& fours) {
    return call_before(device, before_raw_moments, fours, 6);
  });
  return {merged(anchored, false), merged(anchored, true), merged(world, false), error(squares[5])};
}

TEST(HazardB, VarianceFarFromTheOrigin) {
  gpu::Device device = make_test_device();
  std::printf("| radius | distance | anchor and merge | merge alone | raw moments |\n");
  for (const double radius : {1e-3, 0.1, 1.0})
    for (const double distance : {1.0, 100.0, 1e4, 1e6}) {
      const VarianceErrors errors = variance_errors(device, radius, distance);
      std::printf("| %g | %g | %.1e | %.1e | %.1e |\n", radius, distance, errors.anchored, errors.merged,
                  errors.raw);
      EXPECT_LE(errors.anchored, 1e-5);
      EXPECT_LE(errors.rough, 1e-5);
      if (distance > 50 * radius) {
        EXPECT_GT(errors.raw, 1e-4) << "the raw moments would do";
      }
    }
}

// Of a trilinear look-up, the spread of the taps' means is most of the spread.
TEST(HazardB, InterpolatedVarianceLosesTheMeans) {
  gpu::Device device = make_test_device();
  Row row;
  double spread = 0, weight = 0;
  std::vector<Point> taps;
  for (int k = 0; k < 8; ++k) {
    const double share = 0.05 + 0.02 * k;
    const Vec3 mean{double(k % 2), double(k / 2 % 2), 0.1 * double(k / 4)};
    Row tap = moments_row(1, mean);
    tap[13] = 0.2f;
    row.push_back(static_cast<float>(share));
    row.insert(row.end(), tap.begin(), tap.end());
    taps.push_back({double{static_cast<float>(share)}, mean});
    spread += share * 0.2;
    weight += share;
  }
  const double inner = double{0.2f}, exact = exact_variance(taps) + inner;
  const float value = call_library(device, "moments", "moments_finish", {row}, words)[13];
  EXPECT_NEAR(double{value} / exact, 1, 1e-5);
  EXPECT_GT(std::abs(spread / weight / exact - 1), 0.5) << "interpolating the variances alone would do";
}

// 4096 lobes of sharpness 1e8, spread over 1e-4.
TEST(HazardE, DeficitOfManySharpLobes) {
  gpu::Device device = make_test_device();
  const double sharpness = 1e8;
  std::vector<Row> lobes;
  std::vector<DoubleMoments> exact;
  for (const Point& p : disk(normalise(Vec3{0.36, -0.48, 0.8}), 1e-4)) {
    const Vec3 axis = normalise(p.position);
    Row row = direction(axis);
    row.push_back(static_cast<float>(sharpness));
    lobes.push_back(row);
    DoubleMoments& m = exact.emplace_back();
    const LobeMoments encoded = lobe_encode(axis, sharpness);
    m.power_specular = {1, 1, 1};
    m.specular_mean = encoded.mean;
    m.specular_deficit = encoded.deficit;
  }
  const std::vector<float> encoded = call_library(device, "lobe", "lobe_encode", lobes, 4);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    Row row(words, 0.0f);
    for (std::size_t k = 6; k < 9; ++k) row[k] = 1;  // power
    for (std::size_t k = 0; k < 4; ++k) row[18 + k] = encoded[4 * i + k];
    rows.push_back(row);
  }
  const std::vector<float> merged = merge_on_device(device, rows, false);
  const Row moments(merged.begin() + 18, merged.begin() + 22);
  const DoubleMoments m = merge_moments(exact, std::vector<double>(exact.size(), 1.0 / points));
  const double expected = lobe_decode({m.specular_mean, m.specular_deficit}).sharpness;
  const double now = double{call_library(device, "lobe", "lobe_decode", {moments}, 4)[3]};
  const double before = double{call_before(device, before_sharpness, {moments}, 1)[0]};
  std::printf("| E: 4096 lobes of sharpness 1e8 | 1e-5 | %.1e | %.1e |\n", std::abs(now / expected - 1),
              std::abs(before / expected - 1));
  EXPECT_NEAR(now / expected, 1, 1e-5);
  EXPECT_FALSE(std::abs(before / expected - 1) < 0.1) << "the length alone would do";
}

// Where the density is 0 at the sample: its kernel by the density there has the size of the whole map.
TEST(HazardI, KernelWhereTheDensityIsZero) {
  gpu::Device device = make_test_device();
  constexpr int size = 16;
  const std::vector<LibraryFile> files = sampling_files();
  const LibraryFile& file =
      *std::find_if(files.begin(), files.end(), [](const LibraryFile& f) { return f.name == "kernel_size"; });
  const std::vector<float> sparse(file.appendix.begin() + static_cast<long>(file.appendix.size() / 2),
                                  file.appendix.end());
  const DensityPyramid density{size, sparse};
  constexpr double texels = 2 * size * size, share = 0.01;
  std::vector<Row> rows, before_rows;
  std::vector<double> exact;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      if (density.at(0, i, j) > 0) continue;
      const double x = (i + 0.5) / size, y = (j + 0.5) / size;
      rows.push_back({word(1), static_cast<float>(x), static_cast<float>(y), static_cast<float>(share)});
      before_rows.push_back({0, static_cast<float>(texels), static_cast<float>(share)});
      exact.push_back(kernel_level_bisection(density, x, y, texels, share, 45));
    }
  ASSERT_GT(rows.size(), 100u);
  const std::vector<float> now = call_library(device, "kernel_size", "kernel_level_newton", rows, 1);
  const std::vector<float> before = call_before(device, before_kernel_level, before_rows, 1);
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // The smallest root: bisection may find a later one, so the equation decides where they differ.
    const double level = double{now[i]};
    const double held = std::exp2(2 * level) / texels *
                        density_trilinear(density, level, double{rows[i][1]}, double{rows[i][2]});
    EXPECT_LE(level, exact[i] + 1e-3);
    worst = std::max(worst, std::abs(held / share - 1));
    EXPECT_FALSE(std::isfinite(before[i]));
  }
  std::printf("| I: share of a kernel in the dark | 1e-3 | %.1e | inf |\n", worst);
  EXPECT_LE(worst, 1e-3);
}

// More samples than texels: every kernel is a texel, and the power of a texel goes to several lights.
TEST(HazardI, MoreSamplesThanTexels) {
  gpu::Device device = make_test_device();
  Report report;
  const TestDensity density = sparse_density(16);
  const DensityPyramid layers[] = {density.view()};
  KernelParams params;
  params.count = 1024;
  double now = 0, before = 0;
  for (const interop::Kernel& k : draw_kernels(layers, params, device, report)) {
    const double p =
        density_trilinear(density.view(), double{k.level}, double{k.centre.x}, double{k.centre.y});
    now += double{k.power_scale} * p;
    before += std::exp2(2 * double{k.level}) * p;  // [Tokuyoshi 2016, B.3] 4^l / M times the texel's mean
  }
  std::printf("| I: power of 1024 samples of 256 texels | 1e-2 | %.1e | %.1e |\n", std::abs(now / 256 - 1),
              std::abs(before / 256 - 1));
  EXPECT_NEAR(now / 256, 1, 0.01);
  EXPECT_GT(before / 256, 2);
}

}  // namespace
}  // namespace vsgl::test
