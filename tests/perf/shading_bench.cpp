// Light-pixel evaluations per second of the production shading kernel and of a native twin on the same data,
// in one run.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../unit/shading/box_scene.h"
#include "base/error.h"
#include "native_kernel.h"
#include "stages/shading/light_pack.h"
#include "stages/shading/shading.h"

namespace {

using vsgl::bench::NativeReceivers;
using vsgl::bench::NativeSums;

constexpr double kTolerance = 1e-3;  // of the image's peak, between the two

// The native kernel has the blended lobe; against it the others' images differ.
struct Case {
  const char* name;
  bool glossy;
  const char* lobe;
};
constexpr Case kCases[] = {
    {"diffuse", false, "blend"}, {"ggx", true, "blend"}, {"ggx-mixture", true, "mixture"}};

struct Options {
  int width = 640, height = 360, lights = 1024, repetitions = 7, threads = 0;
  bool narrow = false;
  std::string output;
};

vsgl::test::BoxOptions scene_of(const Options& options, const Case& c) {
  vsgl::test::BoxOptions scene;
  scene.width = options.width;
  scene.height = options.height;
  scene.lights = options.lights;
  scene.receiver_ndf = scene.emission_ndf = c.glossy ? vsgl::interop::NDF_GGX : vsgl::interop::NDF_NONE;
  return scene;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double device_seconds(const vsgl::Report& report) {
  const auto json = report.to_json();
  for (const auto& phase : json["phases"])
    if (phase["name"] == "shade" && phase.contains("device_s")) return phase["device_s"].get<double>();
  throw vsgl::Error(vsgl::ErrorCode::device_limit, "the device has no timestamps to measure the kernel by");
}

// Largest difference between the two images over the peak.
double difference(const vsgl::GBuffer& gbuffer, const vsgl::Indirect& image, const NativeSums& sums) {
  double peak = 0, worst = 0;
  for (std::size_t i = 0; i < image.diffuse.size(); ++i) {
    const auto at = [&](std::size_t k) { return static_cast<double>(sums.channels[k][i]); };
    const vsgl::Vec3 rd = vsgl::test::to_double(gbuffer.pixels[i].diffuse),
                     rs = vsgl::test::to_double(gbuffer.pixels[i].specular);
    const vsgl::Vec3 native = rd * vsgl::Vec3{at(0), at(1), at(2)} + rs * vsgl::Vec3{at(3), at(4), at(5)};
    vsgl::Vec3 device = vsgl::test::to_double(image.diffuse[i]);
    if (!image.specular.empty()) device += vsgl::test::to_double(image.specular[i]);
    peak = std::max(peak, length(device));
    worst = std::max(worst, length(device - native));
  }
  return worst / peak;
}

nlohmann::ordered_json measure(const Options& options, const Case& c, vsgl::gpu::Device& device) {
  const auto scene = scene_of(options, c);
  const vsgl::GBuffer gbuffer = vsgl::test::box_gbuffer(scene);
  const vsgl::Lights lights = vsgl::test::box_lights(scene);
  const NativeReceivers receivers = vsgl::bench::make_native_receivers(gbuffer);
  const auto packed = vsgl::pack_vsgl(lights);
  const vsgl::ShadingParams params{.light_model = "vsgl", .specular_lobe = c.lobe};
  const int bits = device.info().vector_bits;
  const auto native = bits == 512 ? vsgl::bench::width512::shade : vsgl::bench::width256::shade;
  const double evaluations = static_cast<double>(gbuffer.pixels.size()) * options.lights;

  vsgl::Indirect image;
  NativeSums sums;
  std::vector<double> device_times, native_times;
  for (int k = 0; k <= options.repetitions; ++k) {  // the first one warms up
    vsgl::Report report;
    image = vsgl::shade(gbuffer, lights, nullptr, params, device, report);
    const auto start = std::chrono::steady_clock::now();
    native(receivers, packed, c.glossy, static_cast<float>(params.cbr), sums);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (k == 0) continue;
    device_times.push_back(device_seconds(report));
    native_times.push_back(seconds);
  }
  const double on_device = evaluations / median(device_times) * 1e-6,
               in_native = evaluations / median(native_times) * 1e-6;
  return {{"case", c.name},
          {"vector_bits", bits},
          {"device_mega_evaluations_per_s", on_device},
          {"native_mega_evaluations_per_s", in_native},
          {"ratio", on_device / in_native},
          {"difference", difference(gbuffer, image, sums)}};
}

int run(const Options& options) {
  vsgl::gpu::Device device({.threads = options.threads, .compute_only = !options.narrow});
  nlohmann::ordered_json result{{"device", device.info().name},
                                {"pixels", options.width * options.height},
                                {"lights", options.lights},
                                {"kernels", nlohmann::ordered_json::array()}};
  std::printf("shading kernel on %s, method vsgl, %dx%d pixels, %d lights\n", device.info().name.c_str(),
              options.width, options.height, options.lights);
  std::printf("%-12s%14s%14s%8s%13s\n", "pixels", "device M/s", "native M/s", "ratio", "difference");
  bool agree = true;
  for (const Case& c : kCases) {
    const auto row = measure(options, c, device);
    std::printf("%-12s%14.1f%14.1f%8.2f%13.1e\n", c.name, row["device_mega_evaluations_per_s"].get<double>(),
                row["native_mega_evaluations_per_s"].get<double>(), row["ratio"].get<double>(),
                row["difference"].get<double>());
    const bool same_form = std::string(c.lobe) == "blend";
    agree = agree && (!same_form || row["difference"].get<double>() < kTolerance);
    result["kernels"].push_back(row);
  }
  if (!options.output.empty() && !(std::ofstream(options.output) << result.dump(2) << "\n"))
    throw vsgl::Error(vsgl::ErrorCode::write_failed, options.output + ": cannot be written");
  if (!agree)
    std::fprintf(stderr, "shading_bench: the two images differ by more than %g of the peak\n", kTolerance);
  return agree ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the shading kernel against native code");
  Options options;
  app.add_option("--width", options.width, "pixels")->check(CLI::Range(1, 4096));
  app.add_option("--height", options.height, "pixels")->check(CLI::Range(1, 4096));
  app.add_option("--lights", options.lights)->check(CLI::Range(1, 1 << 20));
  app.add_option("--repetitions", options.repetitions)->check(CLI::Range(1, 1000));
  app.add_option("--threads", options.threads, "of the device; native: OMP_NUM_THREADS")
      ->check(CLI::Range(0, 1024));
  app.add_flag("--narrow", options.narrow, "the device's default vector width");
  app.add_option("--output", options.output, "JSON file to write");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "shading_bench: %s\n", error.what());
    return 70;
  }
}
