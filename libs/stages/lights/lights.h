#pragma once

// Generation of virtual lights: an RSM's texels are clustered, or sampled by a density and filtered over
// kernels about the samples. docs/sampling.md states the formulas.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "base/pass.h"
#include "base/report.h"
#include "gpu/device.h"
#include "scene/environment.h"
#include "scene/scene.h"

namespace vsgl {

inline constexpr int max_mutations = 100000;  // of a chain, a frame

struct LightsParams {
  std::string method = "tree";  // one of lights_methods()
  int count = 1024;             // samples, 1..1048576
  double kernel_scale = 1;  // K > 0: kernels hold K / count of the samples; power is not affected in fis-2016
  std::string kernel_solver = "newton";  // fis-2016: newton (exact) | bisection (12 steps, as printed)
  std::string power = "conserved";       // fis-2016: conserved (adds up to the RSM's) | paper (as printed)
  std::string points = "lattice";        // lattice | fibonacci | random
  std::string lobe_filter = "banerjee";  // one of lobe_filter_names(): how lobes are averaged
  int kmeans_iterations = 0;        // kmeans: of Lloyd's algorithm at most, 0..20
  double kmeans_normal_weight = 0;  // kmeans: of normals in the squared distance, >= 0
  int level = -1;  // tree: -1, all of it; 0..64, a list of that level's nodes and of the leaves above it
  int environment_size = 512;  // environment: rows of texels at most, a power of two, 8..2048
  int vsl_neighbours = 10;      // vsl: k >= 1; a light reaches as far as its k-th nearest
  double vsl_radius_scale = 1;  // vsl: times that distance, above 0
  int mutations = 1;  // metropolis: of each chain, from frame to frame, 0..100000
  double large_step = 1;             // metropolis: probability that a mutation goes anywhere, 0..1
  const Chains* previous = nullptr;  // metropolis: what the frame before left; none: chains begin anew
  std::uint64_t seed = 0;
  Pass pass{};  // of methods that sample anew in each pass
};

// Lights of `rsm` sampled by `pdf`. Density and device may be null where the method does not need them (see
// LightsMethod); the method's source is an RSM. Samples without power give no light; the others keep the samples' order. The same inputs
// give the same bytes for any number of threads. Throws bad_value, out_of_range, missing_option (no density),
// wrong_size when the density is of another RSM, device_limit.
Lights generate_lights(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                       Report& report);

// Lights of an environment, sampled in proportion to the luminance that arrives from its texels; `params` names
// the method "environment". Powers add up to the map's radiance integrated over all directions. Throws
// bad_value, out_of_range, device_limit.
Lights generate_environment_lights(const scene::Environment& environment, const LightsParams& params,
                                   gpu::Device& device, Report& report);

// [Tokuyoshi 2014s, A] The scene's sphere lights, one SG each as seen from anywhere: Gaussian footprints of
// variance radius^2 / 4 per axis, the second moment of the disk that a sphere shows, which send power
// 4 pi^2 radius^2 radiance evenly in all directions; `params` names the method "sphere-lights". No surface
// belongs to them, so that `shade` takes them with light model vsgl alone. Throws bad_value, out_of_range,
// bad_light (the scene has none).
Lights generate_sphere_lights(const scene::Scene& scene, const LightsParams& params, Report& report);

// What lights.json holds (configs/schema/lights.schema.json): parameters, statistics and, with `dump`, the
// lights.
nlohmann::ordered_json describe(const Lights& lights, const Rsm& rsm, const LightsParams& params, bool dump);
nlohmann::ordered_json describe(const Lights& lights, const scene::Environment& environment,
                                const LightsParams& params, bool dump);

// What a method makes: a list, or a tree with its levels (see Lights), and the chains that sampled it.
struct LightSet {
  std::vector<interop::Light> lights;
  std::vector<std::uint32_t> levels;
  Chains chains = {};
};

// What lights are made of. Each has a function of its own.
enum class LightsSource { rsm, environment, sphere_lights };

// A way to generate lights. `run` may assume checked parameters and, where it needs a density, one that is
// positive somewhere; lights without power may be among a list.
struct LightsMethod {
  std::string name;
  std::string summary;  // one line, for --list-methods
  bool needs_pdf = true, needs_device = true;
  LightSet (*run)(const Rsm&, const Pdf*, const LightsParams&, gpu::Device*, Report&) = nullptr;
  bool has_passes = false;      // samples anew, for smaller lights, in each pass of progressive rendering
  LightsSource source = LightsSource::rsm;  // of others `run` is null
};
const std::vector<LightsMethod>& lights_methods();
// The row of that name. Throws bad_value, listing those that are there.
const LightsMethod& lights_method(const std::string& name);

}  // namespace vsgl
