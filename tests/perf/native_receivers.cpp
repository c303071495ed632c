#include "math/specular_lobe.h"
#include "native_kernel.h"

namespace vsgl::bench {
namespace {

Vec3 to_double(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

void push(std::array<std::vector<float>, 3>& to, Vec3 v) {
  to[0].push_back(static_cast<float>(v.x));
  to[1].push_back(static_cast<float>(v.y));
  to[2].push_back(static_cast<float>(v.z));
}

void push(std::vector<float>& to, double value) {
  to.push_back(static_cast<float>(value));
}

}  // namespace

NativeReceivers make_native_receivers(const GBuffer& gbuffer) {
  constexpr Vec3 kLuminance{0.2126, 0.7152, 0.0722};
  NativeReceivers out;
  out.count = gbuffer.pixels.size();
  const std::size_t padded =
      (out.count + NativeReceivers::kChunk - 1) / NativeReceivers::kChunk * NativeReceivers::kChunk;
  for (std::size_t i = 0; i < padded; ++i) {
    const interop::Surface& s = gbuffer.pixels[std::min(i, out.count - 1)];
    const Vec3 position = to_double(s.position), normal = to_double(s.shading_normal);
    const SpecularReceiver r = specular_receiver(interop::NDF_GGX, static_cast<double>(s.alpha), normal,
                                                 normalise(gbuffer.camera - position));
    push(out.position, position);
    push(out.normal, normal);
    push(out.tangent, r.tangent);
    push(out.bitangent, r.bitangent);
    push(out.luminance_diffuse, kLuminance * to_double(s.diffuse));
    push(out.luminance_specular, kLuminance * to_double(s.specular));
    push(out.sin_view, r.sin_view);
    push(out.cos_view, r.cos_view);
    push(out.alpha2, r.alpha2);
    push(out.across, s.ndf == interop::NDF_NONE ? 0 : r.across);
    push(out.mirror_tangent, r.mirror.x);
    push(out.mirror_normal, r.mirror.z);
    push(out.slope_view, ggx_slope_cosine(r.alpha2, r.cos_view));
  }
  return out;
}

}  // namespace vsgl::bench
