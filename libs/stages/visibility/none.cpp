#include "stages/visibility/none.h"

#include "stages/visibility/cut_visibility.h"
#include "stages/visibility/sight.h"

namespace vsgl::visibility {
namespace {

// Every pixel sees every node.
class OpenSight final : public Sight {
 public:
  using Sight::Sight;
  Seen see(std::span<const Pair> pairs) const override { return {all(pairs), all(pairs)}; }
  std::uint32_t facing(std::span<const Pair> pairs) const override { return all(pairs); }
  const char* name() const override { return "looks"; }

 private:
  static std::uint32_t all(std::span<const Pair> pairs) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << pairs.size()) - 1);
  }
};

}  // namespace

Visibility build_none(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device*,
                      Report& report) {
  const Lights& lights = inputs.lights;
  report.skipped("visibility", "everything is seen");
  if (!lights.is_tree()) return Unshadowed{static_cast<int>(lights.lights.size()), inputs.scene.anchor};
  const std::vector<interop::vec3> normals(lights.lights.size());  // never looked at
  const OpenSight sight(*inputs.gbuffer, lights, normals);
  return find_cut_visibility(*inputs.gbuffer, lights, inputs.cut, sight, params, report);
}

}  // namespace vsgl::visibility
