#pragma once

#include "interop/surface.h"
#include "trace/texel.h"
#include "trace/tracer.h"

namespace vsgl::trace {

// Points of triangles with their materials and normals: the twin of shaders/rsm/surface.comp.glsl.
class SurfaceResolver {
 public:
  // The scene must outlive it. Throws mesh_invalid when an index points nowhere, texture_unreadable.
  explicit SurfaceResolver(const scene::Scene& scene);

  interop::Surface surface(const Hit& hit, Vec3 towards) const;
  // Whether the material is cut out there.
  bool is_hole(const Hit& hit) const;
  // Whether it may be cut out anywhere.
  bool has_holes(const scene::Instance& instance) const;

 private:
  Vec3 shading_normal(const scene::Material& material, Vec3 normal, Vec3 tangent, double handedness, double u,
                      double v) const;
  void set_reflectance(interop::Surface& s, const scene::Material& material, double u, double v) const;

  const scene::Scene& scene_;
  TextureSampler textures_;
};

}  // namespace vsgl::trace
