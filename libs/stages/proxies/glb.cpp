#include "scene/procedural/glb.h"

#include "scene/procedural/shapes.h"
#include "stages/proxies/proxies.h"

namespace vsgl {

// One ball a material, shown once for each sphere.
std::string proxies_glb(const Proxies& proxies) {
  scene::Model model;
  for (const ProxyObject& object : proxies.objects)
    for (const auto& [center, radius, albedo] : object.spheres) {
      const std::string name = object.name + " " + std::to_string(model.nodes.size());
      const int material = model.add_material({name, albedo, {}});
      const auto mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back(scene::ball(name, material, {}, 1, 8));
      const Vec3 c = center;
      model.nodes.push_back(
          {name, mesh, {{{radius, 0, 0, c.x}, {0, radius, 0, c.y}, {0, 0, radius, c.z}, {0, 0, 0, 1}}}});
    }
  const double distance = 3 * proxies.scene_radius;
  model.camera = {{0, distance / 3, distance}, {}, 40};
  model.light = {{distance, distance, distance}, {}, 40};
  model.light_intensity_w_sr = distance * distance;
  return scene::write_glb(model, proxies.anchor, 1);
}

}  // namespace vsgl
