#pragma once

#include <functional>
#include <memory>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "interop/splat.h"
#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// Which points each light's map is splatted from.
class PointSource {
 public:
  virtual ~PointSource() = default;
  virtual double disk_radius() const = 0;  // of points that stand for equal shares of the scene's area, m
  virtual std::uint32_t first_point(std::size_t light) const = 0;  // of its SplatView
  // Records the splats of a batch of views into their maps, which are clear.
  virtual void splat(gpu::Commands& commands, gpu::Buffer& views, gpu::Buffer& maps,
                     const interop::SplatPush& push) = 0;
};

// Shadow maps of all lights, their holes closed by pull-push where the parameters say so. `make_points` is
// called only where there are lights.
ShadowMaps render_maps(const Lights& lights, const VisibilityParams& params, gpu::Device& device,
                       const std::function<std::unique_ptr<PointSource>()>& make_points, Report& report);

}  // namespace vsgl::visibility
