#pragma once

#include "stages/visibility/sight.h"

namespace vsgl::visibility {

// Normals of the surface points that represent the lights.
std::vector<interop::vec3> representative_normals(const Lights& lights, const trace::Tracer& tracer);

// Exact, but that one point stands for a node: a ray a pair that faces each other.
class RaySight final : public Sight {
 public:
  RaySight(const GBuffer& gbuffer, const Lights& tree, std::span<const interop::vec3> normals,
           const trace::Tracer& tracer)
      : Sight(gbuffer, tree, normals), tracer_(tracer) {}
  Seen see(std::span<const Pair> pairs) const override;
  const char* name() const override { return "rays"; }

 private:
  const trace::Tracer& tracer_;
};

}  // namespace vsgl::visibility
