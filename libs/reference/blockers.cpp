#include "reference/blockers.h"

#include "math/interop_vec.h"
#include "sh/proxy_sphere.h"
#include "trace/tracer.h"

namespace vsgl::reference {
namespace {

class MeshBlockers : public Blockers {
 public:
  explicit MeshBlockers(const scene::Scene& scene) : tracer_(scene), lift_(trace::kLift * scene.radius) {}

  class MeshView : public View {
   public:
    MeshView(const MeshBlockers& blockers, Vec3 start) : blockers_(blockers), start_(start) {}

    std::optional<BlockerPoint> first(Vec3 direction) const override {
      const auto hit = blockers_.tracer_.intersect(start_, direction);
      if (!hit) return std::nullopt;
      const interop::Surface surface = blockers_.tracer_.surface(*hit, -direction);
      return BlockerPoint{to_double(surface.position), to_double(surface.normal),
                          to_double(surface.shading_normal), to_double(surface.diffuse)};
    }

   private:
    const MeshBlockers& blockers_;
    Vec3 start_;
  };

  std::unique_ptr<View> from(Vec3 position, Vec3 normal, Vec3) const override {
    return std::make_unique<MeshView>(*this, position + lift_ * normal);
  }
  bool hides(const BlockerPoint& from, Vec3 direction) const override {
    return tracer_.occluded_to_infinity(from.position, from.normal, direction);
  }

 private:
  trace::Tracer tracer_;
  double lift_;
};

// Distance along the unit direction to a sphere about `center`; below 0: it is missed or behind, or holds the
// start.
double distance_to(const sh::SeenSphere& sphere, Vec3 direction) {
  const double along = dot(sphere.center, direction);
  const double off2 = dot(sphere.center, sphere.center) - along * along,
               radius2 = sphere.radius * sphere.radius;
  return off2 < radius2 ? along - std::sqrt(radius2 - off2) : -1;
}

class SphereBlockers : public Blockers {
 public:
  explicit SphereBlockers(std::vector<ProxySphere> spheres) : spheres_(std::move(spheres)) {}

  class SphereView : public View {
   public:
    SphereView(const std::vector<ProxySphere>& spheres, Vec3 position, Vec3 normal)
        : spheres_(spheres), position_(position) {
      for (const ProxySphere& sphere : spheres)
        seen_.push_back(sh::above_plane({sphere.center - position, sphere.radius}, normal));
    }

    std::optional<BlockerPoint> first(Vec3 direction) const override {
      std::size_t nearest = seen_.size();
      double least = 0;
      for (std::size_t i = 0; i < seen_.size(); ++i) {
        if (seen_[i].radius <= 0) continue;
        const double distance = distance_to(seen_[i], direction);
        if (distance < 0 || (nearest < seen_.size() && distance >= least)) continue;
        least = distance, nearest = i;
      }
      if (nearest == seen_.size()) return std::nullopt;
      const Vec3 normal = normalise(least * direction - seen_[nearest].center);
      return BlockerPoint{position_ + least * direction, normal, normal, spheres_[nearest].albedo, nearest};
    }

   private:
    const std::vector<ProxySphere>& spheres_;
    Vec3 position_;
    std::vector<sh::SeenSphere> seen_;
  };

  std::unique_ptr<View> from(Vec3 position, Vec3, Vec3 shading_normal) const override {
    return std::make_unique<SphereView>(spheres_, position, shading_normal);
  }
  // By all other spheres, which may hold the point.
  bool hides(const BlockerPoint& from, Vec3 direction) const override {
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      if (i == from.blocker) continue;
      const sh::SeenSphere sphere{spheres_[i].center - from.position, spheres_[i].radius};
      if (length(sphere.center) < sphere.radius || distance_to(sphere, direction) > 0) return true;
    }
    return false;
  }

 private:
  std::vector<ProxySphere> spheres_;
};

}  // namespace

std::unique_ptr<Blockers> mesh_blockers(const scene::Scene& scene) {
  return std::make_unique<MeshBlockers>(scene);
}

std::unique_ptr<Blockers> sphere_blockers(std::vector<ProxySphere> spheres) {
  return std::make_unique<SphereBlockers>(std::move(spheres));
}

}  // namespace vsgl::reference
