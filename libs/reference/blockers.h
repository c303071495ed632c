#pragma once

// What hides the environment from receivers, and reflects it.

#include <memory>
#include <optional>
#include <vector>

#include "artifact/proxies.h"
#include "scene/scene.h"

namespace vsgl::reference {

struct BlockerPoint {
  Vec3 position, normal;  // geometric, outwards
  Vec3 shading_normal, albedo;
  std::size_t blocker = 0;  // which sphere
};

class Blockers {
 public:
  virtual ~Blockers() = default;

  // As one receiver sees them.
  class View {
   public:
    virtual ~View() = default;
    // The first one along the unit direction.
    virtual std::optional<BlockerPoint> first(Vec3 direction) const = 0;
  };
  virtual std::unique_ptr<View> from(Vec3 position, Vec3 normal, Vec3 shading_normal) const = 0;
  // Whether any blocker lies along the unit direction from a point of one.
  virtual bool hides(const BlockerPoint& from, Vec3 direction) const = 0;
};

// The scene must outlive them.
std::unique_ptr<Blockers> mesh_blockers(const scene::Scene& scene);
std::unique_ptr<Blockers> sphere_blockers(std::vector<ProxySphere> spheres);

}  // namespace vsgl::reference
