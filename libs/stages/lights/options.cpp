#include "stages/lights/options.h"

#include "base/methods.h"
#include "math/lobe.h"
#include "math/sampling.h"

namespace vsgl {

void add_options(CLI::App& app, LightsParams& params) {
  add_methods(app, lights_methods(), params.method, "how lights are made");
  app.add_option("--count", params.count, "number of samples")
      ->check(CLI::Range(1, static_cast<int>(interop::MAX_POINTS)));
  app.add_option("--kernel-scale", params.kernel_scale,
                 "K: a filter kernel holds K / count of the samples; larger is smoother")
      ->check(CLI::PositiveNumber);
  app.add_option("--kernel-solver", params.kernel_solver,
                 "fis-2016: newton, exact; bisection, 12 steps as the paper prints it")
      ->check(CLI::IsMember({"newton", "bisection"}));
  app.add_option(
         "--power", params.power,
         "fis-2016: conserved, powers add up to the RSM's; paper, as printed, without the common factor")
      ->check(CLI::IsMember({"conserved", "paper"}));
  app.add_option("--points", params.points,
                 "sample points: lattice of a searched generator, fibonacci, or random")
      ->check(CLI::IsMember(point_set_names()));
  app.add_option("--lobe-filter", params.lobe_filter,
                 "how a mean direction's length becomes a lobe's sharpness; none: the sampled texel's lobes")
      ->check(CLI::IsMember(lobe_filter_names()));
  app.add_option("--mutations", params.mutations,
                 "metropolis: of each chain, since the frame before (a first frame has 64)")
      ->check(CLI::Range(0, max_mutations));
  app.add_option("--large-step", params.large_step,
                 "metropolis: probability that a mutation goes anywhere, and not just a few texels")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--kmeans-iterations", params.kmeans_iterations,
                 "kmeans: how often centres move to the means of their clusters at most")
      ->check(CLI::Range(0, 20));
  app.add_option("--kmeans-normal-weight", params.kmeans_normal_weight,
                 "kmeans: weight of normals in squared distances over the RSM's side or the scene's radius")
      ->check(CLI::NonNegativeNumber);
  app.add_option(
         "--level", params.level,
         "tree: -1, all of it; else a plain list of this level's nodes (0: the root) and the leaves above")
      ->check(CLI::Range(-1, 64));
  app.add_option("--vsl-neighbours", params.vsl_neighbours,
                 "vsl: k, a light's radius is the distance to its k-th nearest light")
      ->check(CLI::Range(1, 1000));
  app.add_option("--vsl-radius-scale", params.vsl_radius_scale, "vsl: times that distance")
      ->check(CLI::PositiveNumber);
  app.add_option("--environment-size", params.environment_size,
                 "environment: rows of texels that the map is reduced to at most, a power of two")
      ->check(CLI::Range(8, 2048));
}

}  // namespace vsgl
