#pragma once

// Exact visibility and intersection on the CPU, by Embree.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "interop/surface.h"
#include "math/vec.h"
#include "scene/scene.h"

namespace vsgl::trace {

// Lift of a ray's ends off their surfaces, as a fraction of the scene's radius R. Single-precision positions
// and intersections err by up to about 3e-7 R, so this clears a surface at any angle; only gaps and walls
// thinner than it go wrong.
inline constexpr double kLift = 1e-5;
// Surfaces nearer to a light source than this fraction of R cast no shadow: those in front of rsm-bake's near
// plane.
inline constexpr double kNear = 1e-4;

// Where a ray meets the scene.
struct Hit {
  std::uint32_t instance = 0, triangle = 0;  // of the scene, and of the instance's index list
  double b = 0, c = 0;  // barycentric coordinates of the triangle's second and third corner
  double distance = 0;  // m, along the unit direction
};

// A point of a surface and the surface's geometric normal there.
struct SurfacePoint {
  Vec3 position, normal;
};

// 16 surface points in single precision, a lane each; normals unit.
struct alignas(64) PointPacket {
  static constexpr std::size_t kLanes = 16;
  using Lanes = std::array<float, kLanes>;
  Lanes x{}, y{}, z{}, normal_x{}, normal_y{}, normal_z{};

  void set(std::size_t lane, interop::vec3 position, interop::vec3 normal) {
    x[lane] = position.x, y[lane] = position.y, z[lane] = position.z;
    normal_x[lane] = normal.x, normal_y[lane] = normal.y, normal_z[lane] = normal.z;
  }
};

// A scene (which must outlive it) prepared for rays. Positions in metres relative to the scene's anchor.
// Everything const may be called from many threads at once, and answers the same on any number of them.
// Alpha cut-outs let rays through.
class Tracer {
 public:
  // Throws mesh_invalid when an index points nowhere or there is nothing to trace, memory.
  explicit Tracer(const scene::Scene& scene);
  explicit Tracer(scene::Scene&& scene) = delete;
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // The nearest surface from `origin` along the unit `direction`, further than `nearest` away. `self`: the
  // hit whose triangle the ray starts on, which it cannot meet again.
  std::optional<Hit> intersect(Vec3 origin, Vec3 direction, double nearest = 0,
                               const Hit* self = nullptr) const;

  // Whether anything lies strictly between two surface points. Both ends are lifted off their surfaces along
  // their geometric normals, on the side of the other end, by kLift times the scene's radius.
  // A point that is no surface (a light source) has the normal 0; nothing occludes within kNear of it.
  bool occluded(Vec3 a, Vec3 normal_a, Vec3 b, Vec3 normal_b) const;
  // The same for one point and up to 32 others at once, in bit i for the i-th; about twice as fast.
  std::uint32_t occluded(const SurfacePoint& a, std::span<const SurfacePoint> others) const;
  // The same for the pairs of points in those lanes of two packets whose bits are set in `active`, in single
  // precision throughout; fastest where rays start or end near one another. Bit i for lane i.
  std::uint32_t occluded(const PointPacket& a, const PointPacket& b, std::uint32_t active) const;
  // Whether anything lies on the ray from `a` to infinity along the unit `direction`.
  bool occluded_to_infinity(Vec3 a, Vec3 normal_a, Vec3 direction) const;

  // The surface at a hit, as rsm-bake resolves it, with its normals on the side of `towards` (unit, towards
  // the viewer). Textures at full resolution.
  interop::Surface surface(const Hit& hit, Vec3 towards) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsgl::trace
