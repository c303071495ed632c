#include "stages/visibility/options.h"

#include "base/methods.h"

namespace vsgl {

void add_options(CLI::App& app, VisibilityParams& params) {
  add_methods(app, visibility_methods(), params.method, "how visibility is found out");
  app.add_option("--points", params.points_per_light, "shadow maps: surface points a light")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--tile", params.tile, "shadow maps: texels a side of a map, a power of two")
      ->check(CLI::Range(8, 512));
  app.add_option("--splat-scale", params.splat_scale,
                 "shadow maps: radius of a splatted disk, in radii of the disk that a point stands for")
      ->check(CLI::Range(0.0, 4.0));
  app.add_flag_callback(
      "--no-pull-push", [&params] { params.pull_push = false; },
      "shadow maps: leave the holes between splats open");
  app.add_option("--error", params.error, "of a tree: RMSE over the mean of the image that the cut may cause")
      ->check(CLI::Range(1e-5, 1.0));
  app.add_option("--level", params.level,
                 "maps: level of the tree whose nodes get a map; -1: that with about 1024 nodes")
      ->check(CLI::Range(-1, 32));
  app.add_option("--rays", params.rays, "ratio: rays a pixel")->check(CLI::Range(1, 64));
  app.add_flag("--exact", params.exact, "rays: one for each node of a tile's cut and pixel");
}

}  // namespace vsgl
