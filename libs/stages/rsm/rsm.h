#pragma once

#include <memory>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"
#include "scene/scene.h"

namespace vsgl {

// What a bent (interpolated or normal-mapped) normal does to the light that a surface sends on.
enum class NormalConvention {
  consistent,  // as in a path tracer: bends arrival and mirror direction, power scaled by kappa; light leaves
               // by the true normal
  paper,       // as the papers have it: takes the true normal's place in both lobes, power unchanged
};

inline constexpr int kMaxRsmSize = 4096;  // texels a side of a layer

struct RsmParams {
  int width = 512, height = 512;  // texels of each layer, 1..kMaxRsmSize; padded to a square power of two
  NormalConvention normals = NormalConvention::consistent;
};

// How the triangle that each texel sees is found: by drawing, or by rays on the CPU.
enum class VisibleBy {
  automatic,  // rays where the device is the CPU, else drawing
  raster,
  rays,
};

// Bakes a scene, which must outlive it, from camera and lights. The device must be able to draw, unless rays
// are traced. Throws mesh_invalid when an index points nowhere, bad_light for a degenerate light or two of
// one name, memory, device_limit.
class Baker {
 public:
  Baker(const scene::Scene& scene, gpu::Device& device, Report& report,
        VisibleBy visible = VisibleBy::raster);
  Baker(scene::Scene&& scene, gpu::Device& device, Report& report,
        VisibleBy visible = VisibleBy::raster) = delete;
  ~Baker();
  Baker(const Baker&) = delete;
  Baker& operator=(const Baker&) = delete;

  // Takes notice that the scene's meshes, materials or textures have changed: uploads those that differ.
  // Camera and lights are read whenever they are needed.
  void update();

  // What the scene's camera sees, one point per pixel, at the camera's resolution.
  GBuffer gbuffer();

  // [Dachsbacher 2005] One layer per light (six for a point light), with its pyramid of moments.
  // Throws out_of_range for a size outside 1..4096.
  Rsm rsm(const RsmParams& params);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline GBuffer bake_gbuffer(const scene::Scene& scene, gpu::Device& device, Report& report) {
  return Baker(scene, device, report).gbuffer();
}
inline Rsm bake_rsm(const scene::Scene& scene, const RsmParams& params, gpu::Device& device, Report& report) {
  return Baker(scene, device, report).rsm(params);
}

// The camera at another resolution: same vertical field of view, square pixels.
scene::Camera with_resolution(scene::Camera camera, int width, int height);

}  // namespace vsgl
