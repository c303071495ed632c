// The mathematics of shaders/kernels/fused.glsl, vsgl.glsl and emission.glsl in plain C++ for the compiler's
// vectoriser, with the exponentials of the C library's vector mathematics. Built once per vector width, as
// VSGL_NATIVE_WIDTH.

#include "native_kernel.h"

#include <algorithm>
#include <cmath>

#include "interop/model.h"

// The vectoriser sees only what is inlined.
#define VSGL_INLINE [[gnu::always_inline]] inline

namespace vsgl::bench::VSGL_NATIVE_WIDTH {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kSharpnessMin = 1e-3f, kSharpnessMax = 1099511627776.0f;

struct V3 {
  float x, y, z;
};
VSGL_INLINE V3 operator+(V3 a, V3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
VSGL_INLINE V3 operator-(V3 a, V3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
VSGL_INLINE V3 operator*(float s, V3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
VSGL_INLINE float dot(V3 a, V3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
VSGL_INLINE V3 v3(interop::vec3 v) {
  return {v.x, v.y, v.z};
}
VSGL_INLINE float clamp(float x, float low, float high) {
  return std::min(std::max(x, low), high);
}

VSGL_INLINE float eighth_power(float p) {
  const float p2 = p * p, p4 = p2 * p2;
  return p4 * p4;
}
VSGL_INLINE float fast_erfc(float x) {
  const float y = std::min(x, 4.0f);
  return eighth_power(
      1 + y * (-0.141047396f +
               y * (-0.0695034639f + y * (-0.00282007664f + y * (0.00803070935f - y * 0.00107486658f)))));
}
VSGL_INLINE float ramp_foot(float x) {
  const float y = std::min(x, 4.0f);
  return eighth_power(
      0.853688407f +
      y * (-0.189140413f +
           y * (-0.0398918388f + y * (0.00261670626f + y * (0.00437063948f - y * 0.000656774906f)))));
}

struct Width {
  float t, inverse;
};
VSGL_INLINE Width ramp_width(float l, float inverse_l) {
  const float m = std::min(l, 1e5f);
  const float numerator = m * ((m + 2.7360831611f) * m + 17.0212977817f);
  const float denominator = ((2 * m + 8.0201653458f) * m + 30.4383125262f) * m + 152.1757925448f;
  const float inverse = 1 / (numerator * denominator);
  const float t = std::sqrt(l * numerator * (numerator * inverse));
  return {t, t * denominator * (denominator * inverse) * inverse_l};
}
VSGL_INLINE float cosine_integral_2pi(float c, float decay, float phi, float inverse_l, Width width) {
  const float up = 1 - phi, low = decay * (phi - decay);
  const float f = std::max(c, 0.0f) + (ramp_foot(width.t * std::abs(c)) - ramp_foot(width.t)) * width.inverse;
  return (low + (up - low) * std::max(f, 0.0f)) * inverse_l;
}

struct Incoming {
  V3 axis;
  float sharpness, inverse_sharpness, amplitude, decay, phi;
};
VSGL_INLINE Incoming incoming_light(V3 u, float d2, float variance, float inverse_variance, V3 axis,
                                    float sharpness) {
  const float b = variance * sharpness;
  const V3 m = d2 * u - b * axis;
  const float q = std::sqrt(dot(m, m)) + 1e-18f, total = q + b + d2, inverse = 1 / (q * total);
  const V3 turn = u + axis;
  Incoming in;
  in.axis = (total * inverse) * m;
  in.sharpness = clamp(q * inverse_variance, kSharpnessMin, kSharpnessMax);
  in.inverse_sharpness = std::min(variance * (total * inverse), 1 / kSharpnessMin);
  in.amplitude = std::exp(-sharpness * d2 * (q * inverse) * dot(turn, turn)) * inverse_variance;
  const float decayed = std::expm1(-in.sharpness);  // faster here than the shader's polynomial
  in.decay = 1 + decayed;
  in.phi = -decayed * in.inverse_sharpness;
  return in;
}

// One pixel; see NativeReceivers.
struct Pixel {
  V3 position, normal, tangent, bitangent, luminance_diffuse, luminance_specular;
  float sin_view, cos_view, alpha2, across, mirror_tangent, mirror_normal, slope_view;
};

VSGL_INLINE float slope_cosine(float alpha2, float c) {
  return std::sqrt(c * c + alpha2 * std::max(1 - c * c, 0.0f));
}

struct Horizon {
  float visible, cosine;
};
VSGL_INLINE Horizon horizon_of(const Pixel& r, V3 light, float sharpness) {
  const V3 p = V3{r.mirror_tangent, 0, r.mirror_normal} + sharpness * light;
  const float l = std::max(std::sqrt(dot(p, p)), 0.05f), inverse = 1 / l, c = clamp(p.z * inverse, -1, 1);
  const float root = std::exp(-0.5f * std::min(l, 80.0f)), decay = root * root, phi = (1 - decay) * inverse;
  const Width width = ramp_width(l, inverse);
  const float balance =
      1 + root * (0.503259515f + root * (0.521286246f + root * (-1.24027186f + root * 0.541653410f)));
  const float half_mass = 0.5f * balance * (1 - fast_erfc(width.t * std::abs(c)));
  const float visible = clamp(0.5f + (c < 0 ? -half_mass : half_mass), 0, 1);
  const float cosine =
      cosine_integral_2pi(c, decay, phi, inverse, width) / std::max(phi * (1 + decay) * visible, 1e-30f);
  return {visible, clamp(cosine, 1e-4f, 1)};
}

VSGL_INLINE V3 local(const Pixel& r, V3 w) {
  return {dot(w, r.tangent), dot(w, r.bitangent), dot(w, r.normal)};
}

VSGL_INLINE float specular_ggx(const Pixel& r, const Incoming& in) {
  const V3 light = local(r, in.axis);
  const Horizon horizon = horizon_of(r, light, in.sharpness);
  const float spread = (1 - r.alpha2 + 1e-20f) * std::min(in.inverse_sharpness, 1e4f),
              c2 = r.cos_view * r.cos_view;
  const float top_par = 2 + spread, bottom_par = 2 * r.alpha2 + spread;
  const float top_perp = 2 * c2 + spread, bottom_perp = 2 * r.alpha2 * c2 + spread;
  const V3 h = V3{r.sin_view, 0, r.cos_view} + light;
  const float hh = std::max(dot(h, h), 1e-8f), bottom = bottom_par * bottom_perp;
  const float form =
      h.x * h.x * top_par * bottom_perp + h.y * h.y * top_perp * bottom_par + h.z * h.z * bottom;
  const float inverse_form = 1 / std::max(form, bottom * hh);
  const float density =
      (hh * hh) * (bottom * inverse_form) * (std::sqrt(top_par * top_perp * bottom) * inverse_form);
  const float slope = std::sqrt(r.sin_view * r.sin_view * bottom_par / top_par + c2);
  const float z = horizon.cosine, masking = z * (r.cos_view + r.slope_view);
  const float masking_below = r.slope_view * z + slope_cosine(r.alpha2, z) * r.cos_view;
  const float w = 0.3f * r.across * in.inverse_sharpness, sum = r.cos_view + slope;
  return horizon.visible * density * masking * (w * sum + 2 * slope) /
         (masking_below * (4 * kPi * (1 + w) * slope * sum));
}

VSGL_INLINE float exact_ggx(float alpha2, float cos_view, float slope_view, float cos_light, float numerator,
                            float sin2, float cos2) {
  const float c = std::max(cos_light, 0.0f), hh = std::max(sin2 + cos2, 1e-8f);
  const float q = std::max(sin2 + alpha2 * cos2, alpha2 * hh);
  const float below = 2 * kPi * q * q * (slope_view * c + slope_cosine(alpha2, c) * cos_view);
  return c > 0 ? alpha2 * hh * hh * numerator / below : 0.0f;
}

// (from the diffuse, from the specular emission lobe) to the diffuse and specular receiver lobes.
struct Transfer {
  float dd = 0, ds = 0, sd = 0, ss = 0;
};

template <bool Glossy>
VSGL_INLINE Transfer exact_transfer(const Pixel& r, const interop::ShadingLight& light, V3 u, float density) {
  const V3 w = -1.0f * u, n = v3(light.shading_normal);
  const float seen = std::max(dot(v3(light.normal), w), 0.0f), diffuse = density * seen / kPi;
  const float cosine = std::max(dot(r.normal, u), 0.0f) / kPi;
  Transfer t;
  t.dd = diffuse * cosine;
  if constexpr (Glossy) {
    const float alpha2 = light.alpha * light.alpha;
    V3 h = v3(light.incident) + w;
    const float hn = dot(h, n);
    const V3 across = h - hn * n;
    const float specular =
        density * exact_ggx(alpha2, light.cos_incident, slope_cosine(alpha2, light.cos_incident), dot(n, w),
                            seen, dot(across, across), hn * hn);
    const V3 l = local(r, u);
    h = V3{r.sin_view, 0, r.cos_view} + l;
    const float answer =
        exact_ggx(r.alpha2, r.cos_view, r.slope_view, l.z, l.z, h.x * h.x + h.y * h.y, h.z * h.z);
    t.ds = specular * cosine;
    t.sd = diffuse * answer;
    t.ss = specular * answer;
  }
  return t;
}

struct Received {
  float diffuse = 0, specular = 0;
};

template <bool Glossy>
VSGL_INLINE Received receive(const Pixel& r, const Incoming& in, float scale) {
  const Width width = ramp_width(in.sharpness, in.inverse_sharpness);
  Received out;
  out.diffuse = scale * in.amplitude / kPi *
                cosine_integral_2pi(dot(in.axis, r.normal), in.decay, in.phi, in.inverse_sharpness, width);
  if constexpr (Glossy) out.specular = scale * in.amplitude * in.phi * (1 + in.decay) * specular_ggx(r, in);
  return out;
}

struct Sums {
  V3 diffuse, specular;
  float cancelled;
};

template <bool Glossy>
VSGL_INLINE Sums add_light(const Pixel& r, const interop::ShadingLight& light, float cancel_scale) {
  const V3 v = v3(light.position) - r.position;
  const float d2 = dot(v, v), inverse_variance = 1 / light.variance;
  const V3 u = (1 / std::sqrt(std::max(d2, 1e-36f))) * v;
  const float ratio = cancel_scale * (std::max(r.across, interop::LAMBDA_DIFFUSE) + light.bandwidth) *
                      light.variance / std::max(d2, 1e-18f);
  const float x = clamp(2 - ratio, 0, 1), cancelled = x * x * (3 - 2 * x), kept = 1 - cancelled;
  const Received d = receive<Glossy>(r,
                                     incoming_light(u, d2, light.variance, inverse_variance,
                                                    v3(light.diffuse_axis), light.diffuse_sharpness),
                                     kept * light.diffuse_scale);
  Received s;
  if constexpr (Glossy)
    s = receive<Glossy>(r,
                        incoming_light(u, d2, light.variance, inverse_variance, v3(light.specular_axis),
                                       light.specular_sharpness),
                        kept * light.specular_scale);
  const Transfer exact = exact_transfer<Glossy>(r, light, u, cancelled / std::max(d2, light.variance));
  const V3 pd = v3(light.power_diffuse), ps = v3(light.power_specular);
  Sums sums{};
  sums.diffuse = (d.diffuse + exact.dd) * pd;
  sums.cancelled = dot(r.luminance_diffuse, exact.dd * pd + exact.ds * ps);
  if constexpr (Glossy) {
    sums.diffuse = sums.diffuse + (s.diffuse + exact.ds) * ps;
    sums.specular = (d.specular + exact.sd) * pd + (s.specular + exact.ss) * ps;
    sums.cancelled += dot(r.luminance_specular, exact.sd * pd + exact.ss * ps);
  }
  return sums;
}

using Components = std::array<const float*, 3>;
Components pointers(const std::array<std::vector<float>, 3>& from, std::size_t first) {
  return {from[0].data() + first, from[1].data() + first, from[2].data() + first};
}

template <bool Glossy>
void shade_chunk(const NativeReceivers& receivers, std::size_t first,
                 const std::vector<interop::ShadingLight>& lights, float cancel_scale, NativeSums& out) {
  constexpr int n = NativeReceivers::kChunk;
  alignas(64) float sums[7][n] = {};
  const Components position = pointers(receivers.position, first), normal = pointers(receivers.normal, first),
                   tangent = pointers(receivers.tangent, first),
                   bitangent = pointers(receivers.bitangent, first),
                   luminance_d = pointers(receivers.luminance_diffuse, first),
                   luminance_s = pointers(receivers.luminance_specular, first);
  const float *sin_view = receivers.sin_view.data() + first, *cos_view = receivers.cos_view.data() + first,
              *alpha2 = receivers.alpha2.data() + first, *across = receivers.across.data() + first,
              *mirror_tangent = receivers.mirror_tangent.data() + first,
              *mirror_normal = receivers.mirror_normal.data() + first,
              *slope_view = receivers.slope_view.data() + first;
  for (const interop::ShadingLight& stored : lights) {
    const interop::ShadingLight light = stored;
#pragma omp simd
    for (int j = 0; j < n; ++j) {
      const Pixel pixel{{position[0][j], position[1][j], position[2][j]},
                        {normal[0][j], normal[1][j], normal[2][j]},
                        {tangent[0][j], tangent[1][j], tangent[2][j]},
                        {bitangent[0][j], bitangent[1][j], bitangent[2][j]},
                        {luminance_d[0][j], luminance_d[1][j], luminance_d[2][j]},
                        {luminance_s[0][j], luminance_s[1][j], luminance_s[2][j]},
                        sin_view[j],
                        cos_view[j],
                        alpha2[j],
                        across[j],
                        mirror_tangent[j],
                        mirror_normal[j],
                        slope_view[j]};
      const Sums part = add_light<Glossy>(pixel, light, cancel_scale);
      sums[0][j] += part.diffuse.x;
      sums[1][j] += part.diffuse.y;
      sums[2][j] += part.diffuse.z;
      if constexpr (Glossy) {
        sums[3][j] += part.specular.x;
        sums[4][j] += part.specular.y;
        sums[5][j] += part.specular.z;
      }
      sums[6][j] += part.cancelled;
    }
  }
  for (std::size_t k = 0; k < 7; ++k)
    std::copy(sums[k], sums[k] + n, out.channels[k].begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

void shade(const NativeReceivers& receivers, const std::vector<interop::ShadingLight>& lights, bool glossy,
           float threshold, NativeSums& out) {
  const std::size_t padded = receivers.sin_view.size();
  for (auto& channel : out.channels) channel.resize(padded);
  const float cancel_scale = 2 / threshold;
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t first = 0; first < padded; first += NativeReceivers::kChunk) {
    if (glossy)
      shade_chunk<true>(receivers, first, lights, cancel_scale, out);
    else
      shade_chunk<false>(receivers, first, lights, cancel_scale, out);
  }
}

}  // namespace vsgl::bench::VSGL_NATIVE_WIDTH
