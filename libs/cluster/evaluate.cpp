#include "cluster/evaluate.h"

#include "cluster/lane_math.h"
#include "interop/model.h"

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define VSGL_VECTOR_CLONES [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#else
#define VSGL_VECTOR_CLONES
#endif

namespace vsgl {
namespace {

using namespace lane;
using interop::Cluster;

constexpr float kPi = 3.14159265f;

struct Receiver {
  V3 position, normal, diffuse, specular, tangent, bitangent;
  float sin_view, cos_view, alpha2, across, mirror_tangent, mirror_normal, slope_view, view_lambda, phong,
      gaussian;
};
VSGL_LANE V3 at(const Lanes3& lanes, std::size_t i) {
  return {lanes[0][i], lanes[1][i], lanes[2][i]};
}
VSGL_LANE Receiver at(const SampleReceivers& r, std::size_t i) {
  return {at(r.position, i), at(r.normal, i),    at(r.diffuse, i),    at(r.specular, i),
          at(r.tangent, i),  at(r.bitangent, i), r.sin_view[i],       r.cos_view[i],
          r.alpha2[i],       r.across[i],        r.mirror_tangent[i], r.mirror_normal[i],
          r.slope_view[i],   r.view_lambda[i],   r.phong[i],          r.gaussian[i]};
}
VSGL_LANE V3 v3(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

// ---- Densities of normals, 1/sr, by the squared tangential and normal components of the half vector h,
// |h|^2 = hh.

VSGL_LANE float gaussian_density(float phong, float alpha2, float sin2, float cos2) {
  // [Walter 2007, Eqs. (25), (30)]
  const float c2 = most(cos2, 1e-8f), inverse = 1 / alpha2;
  const float beckmann = exp_minus(sin2 * inverse / c2) * inverse / (c2 * c2);
  const float power = exp_minus((inverse - 1) * minus_log_of_rest(clamp(sin2, 0, 0.999999f))) * inverse;
  return (phong > 0 ? power : beckmann) * (1 / kPi);
}

// ---- Emission, W/sr per watt

enum class Emission { none, ggx, gaussian };

// fvpl_specular() of math/fvpl.h: the BRDF of the cluster's specular texels towards -u, their lobe widened by
// the spread of the cluster and its angle from here, times the cosine `seen`.
template <Emission E>
VSGL_LANE float specular_emission(const Cluster& c, V3 u, float lobe_variance, float seen) {
  const V3 n = v3(c.shading_normal), h = v3(c.incident) - u;
  const float alpha2 = least(c.alpha2 + lobe_variance, 1);
  const float hh = most(dot(h, h), 1e-12f), hn = dot(h, n);
  const float cosine = (1 - c.facet_turn) * most(-dot(u, n), 0) + c.facet_turn * 0.5f * std::sqrt(hh);
  const float z = most(cosine, 1e-4f);
  const V3 t = h - hn * n;
  float scaled;
  if constexpr (E == Emission::ggx) {
    const float surface = c.masking_alpha2, spread = most(alpha2 - surface, 0);
    const float b = surface + std::sqrt(2 * spread * (surface + 2 * spread));
    const float q = most(dot(t, t) + b * hn * hn, least(b, 1) * hh), sharp = hh / q;
    const float masking = (2 * c.incident_masking - 1) * z + ggx_slope(surface, z);
    scaled = 2 * sharp * sharp * (surface + 2 * b * (b - surface) * hn * hn / q) / masking;
  } else {
    const float phong = c.ndf == interop::NDF_PHONG ? 1 : 0;
    const float density = gaussian_density(phong, alpha2, dot(t, t) / hh, hn * hn / hh);
    scaled = density / (z * (c.incident_masking + beckmann_lambda(c.masking_alpha2, z)));
  }
  return cosine > 0 ? seen * scaled : 0.0f;
}

// ---- Reflection

enum class Reflection { diffuse, ggx, any };

// BRDF times cosine of light from u, 1/sr. [Walter 2007, Eqs. (20), (33)]
VSGL_LANE float point_ggx(const Receiver& r, V3 u, float cosine) {
  const V3 h = {r.sin_view + dot(u, r.tangent), dot(u, r.bitangent), r.cos_view + cosine};
  const float c = most(cosine, 0), sin2 = h.x * h.x + h.y * h.y, cos2 = h.z * h.z;
  const float hh = most(sin2 + cos2, 1e-8f), q = most(sin2 + r.alpha2 * cos2, r.alpha2 * hh);
  const float masking = r.slope_view * c + ggx_slope(r.alpha2, c) * r.cos_view;
  return r.alpha2 * hh * hh * c / (2 * kPi * q * q * masking);
}
VSGL_LANE float point_gaussian(const Receiver& r, V3 u, float cosine) {
  const V3 h = {r.sin_view + dot(u, r.tangent), dot(u, r.bitangent), r.cos_view + cosine};
  const float sin2 = h.x * h.x + h.y * h.y, hh = most(sin2 + h.z * h.z, 1e-8f);
  const float masking = 1 + r.view_lambda + beckmann_lambda(r.alpha2, cosine);
  const float density = gaussian_density(r.phong, r.alpha2, sin2 / hh, h.z * h.z / hh);
  return cosine > 0 ? density / (4 * r.cos_view * masking) : 0.0f;
}
template <Reflection R>
VSGL_LANE float point_reflection(const Receiver& r, V3 u, float cosine) {
  const float ggx = point_ggx(r, u, cosine);
  if constexpr (R == Reflection::ggx) return ggx;
  return r.gaussian > 0 ? point_gaussian(r, u, cosine) : ggx;
}

// How much of the product of the light and BRDF lobes is above the horizon, and the mean cosine of that.
struct Horizon {
  float visible, cosine;
};
VSGL_LANE Horizon horizon_of(const Receiver& r, V3 light, float sharpness) {
  const V3 p = V3{r.mirror_tangent, 0, r.mirror_normal} + sharpness * light;
  const float l2 = most(dot(p, p), 1e-12f), length = std::sqrt(l2), c = clamp(p.z / length, -1, 1);
  const Lobe lobe = lobe_of(most(length, 0.05f));
  const float root = exp_minus(0.5f * least(length, 80.0f));
  const float balance =
      1 + root * (0.503259515f + root * (0.521286246f + root * (-1.24027186f + root * 0.541653410f)));
  const float half_mass = 0.5f * balance * (1 - fast_erfc(lobe.ramp * std::abs(c)));
  const float visible = clamp(0.5f + (c < 0 ? -half_mass : half_mass), 0, 1);
  const float cosine = cosine_integral_2pi(lobe, c) / most(mass_2pi(lobe) * visible, 1e-20f);
  return {visible, clamp(cosine, 1e-4f, 1)};
}

// GGX's density at the half vector after filtering by the light, and the cosine that normalises it
// [Tokuyoshi 2024].
struct Filtered {
  float density, slope_cosine;
};
VSGL_LANE Filtered filtered_ggx(const Receiver& r, V3 h, float hh, float inverse_sharpness) {
  const float spread = (1 - r.alpha2) * inverse_sharpness, c2 = r.cos_view * r.cos_view;
  const float par = (2 * r.alpha2 + spread) / (2 + spread);
  const float perp = (2 * r.alpha2 * c2 + spread) / (2 * c2 + spread);
  const float q = most((h.x * h.x / par + h.y * h.y / perp + h.z * h.z) / hh, 1);
  return {1 / (kPi * std::sqrt(par * perp) * q * q), std::sqrt(r.sin_view * r.sin_view * par + c2)};
}

// Mean of BRDF times cosine under the normalised SG about u: specular_vmf_blend() of math/specular_lobe.h,
// cheaper than the lobe that shades, and good enough for decisions.
template <Reflection R>
VSGL_LANE float extended_reflection(const Receiver& r, V3 u, float cosine, const Lobe& lobe) {
  const V3 light = {dot(u, r.tangent), dot(u, r.bitangent), cosine};
  const V3 h = V3{r.sin_view, 0, r.cos_view} + light;
  const float hh = most(dot(h, h), 1e-8f);
  const Horizon horizon = horizon_of(r, light, lobe.sharpness);
  const Filtered filtered = filtered_ggx(r, h, hh, lobe.inverse);
  const float z = horizon.cosine, slope = filtered.slope_cosine;
  // (1 + Lambda(view)) / (1 + Lambda(view) + Lambda(z)) of GGX over common denominators.
  const float masking =
      z * (r.cos_view + r.slope_view) / (r.slope_view * z + ggx_slope(r.alpha2, z) * r.cos_view);
  const float w = 1 / (1 + 0.3f * r.across * lobe.inverse);
  const float scale = 0.25f * (1 - w) / slope + 0.5f * w / (r.cos_view + slope);
  const float ggx = horizon.visible * masking * filtered.density * scale;
  if constexpr (R == Reflection::ggx) return ggx;

  const float beckmann_masking = 1 / (1 + r.view_lambda + beckmann_lambda(r.alpha2, z));
  const float broad = (1 + r.view_lambda) * filtered.density / slope;
  const float spread = 0.5f * least(lobe.inverse, 1);
  const float par = r.alpha2 + spread, perp = r.alpha2 + spread / (r.cos_view * r.cos_view);
  const float decay = exp_minus((h.x * h.x / par + h.y * h.y / perp) / hh);
  const float narrow = decay / (kPi * r.cos_view * std::sqrt(par * perp));
  const float blend = clamp(0.25f * lobe.sharpness - 1, 0, 1);
  const float extended = 0.25f * horizon.visible * beckmann_masking * (broad + blend * (narrow - broad));
  const float sharpness = clamp(1.25f - 12.5f * r.across * lobe.inverse, 0, 1);
  const float sharp = point_gaussian(r, u, cosine);
  return r.gaussian > 0 ? extended + sharpness * (sharp - extended) : ggx;
}

// fvpl_plane() of math/fvpl.h for a flat cluster, times `cosine`; `normals`: cosine between both normals.
VSGL_LANE float on_plane(float cosine, float seen, float normals, float inverse_sharpness, float blurred) {
  const float bend =
      least(inverse_sharpness, 0.25f) * (cosine * (4 + blurred - 12 * seen * seen) - 4 * normals * seen);
  return cosine * (1 + bend / most(cosine + std::abs(bend), 1e-20f));
}

// ---- Clusters

// How a cluster looks from the samples: a point with parallel normals, or extended; curved: with the spread
// of its normals.
enum class Form { point, flat, curved };

struct Light {
  float value, bound;
};

template <Form F, Emission E, Reflection R>
VSGL_LANE Light light_at(const Cluster& c, const Lobe& normals, float normal_spread, const Receiver& r) {
  const V3 v = v3(c.position) - r.position;
  const float d2 = most(dot(v, v), 1e-24f), inverse_d = 1 / std::sqrt(d2), inverse_d2 = inverse_d * inverse_d;
  const V3 u = inverse_d * v;
  const float leaving = -dot(u, v3(c.normal)), arriving = dot(u, r.normal);

  float cosine = most(leaving, 0);
  if constexpr (F == Form::curved) cosine = cosine_integral_2pi(normals, leaving) / mass_2pi(normals);
  const float emitted_diffuse = cosine, shade = dot(r.diffuse, v3(c.diffuse));
  float emitted_specular = 0;
  if constexpr (E != Emission::none)
    emitted_specular = specular_emission<E>(c, u, 0.5f * inverse_d2 / c.inverse_variance, cosine);

  float receive_diffuse, receive_specular = 0;
  if constexpr (F == Form::point) {
    receive_diffuse = inverse_d2 * on_plane(most(arriving, 0), cosine, dot(v3(c.normal), r.normal),
                                            inverse_d2 / c.inverse_variance, 0);
    if constexpr (R != Reflection::diffuse)
      receive_specular = inverse_d2 * point_reflection<R>(r, u, arriving);
  } else {
    const Lobe footprint = lobe_of(d2 * c.inverse_variance);
    const float mass = mass_2pi(footprint);
    float mean = cosine_integral_2pi(footprint, arriving) / mass;
    if constexpr (F == Form::flat)
      mean = on_plane(mean, cosine, dot(v3(c.normal), r.normal), footprint.inverse, 1);
    receive_diffuse = c.inverse_variance * mass * mean;
    if constexpr (R != Reflection::diffuse)
      receive_specular = c.inverse_variance * mass * extended_reflection<R>(r, u, arriving, footprint);
  }

  Light out;
  out.value = emitted_diffuse * shade * receive_diffuse;
  if constexpr (E != Emission::none)
    out.value += emitted_specular * dot(r.diffuse, v3(c.specular)) * receive_diffuse;
  if constexpr (R != Reflection::diffuse)
    out.value += emitted_diffuse * dot(r.specular, v3(c.diffuse)) * receive_specular;
  if constexpr (E != Emission::none && R != Reflection::diffuse)
    out.value += emitted_specular * dot(r.specular, v3(c.specular)) * receive_specular;

  const float turn = least(c.reach * inverse_d, 1);
  out.bound = shade * clamp(leaving + turn + normal_spread, 0, 1) * clamp(arriving + turn, 0, 1) *
              least(inverse_d2, c.inverse_variance);
  return out;
}

template <Form F, Emission E, Reflection R>
VSGL_LANE void evaluate_all(const Cluster& cluster, const SampleReceivers& r, ClusterLight& __restrict out) {
  const Cluster c = cluster;
  const bool flat = c.normal_sharpness > interop::CLUSTER_FLAT;
  const Lobe normals = lobe_of(flat ? 1.0f : c.normal_sharpness);
  const float normal_spread = flat ? 0.0f : 2 / std::sqrt(normals.sharpness);
#pragma GCC ivdep
  for (std::size_t i = 0; i < kTileSamples; ++i) {
    const Light light = light_at<F, E, R>(c, normals, normal_spread, at(r, i));
    out.value.lane[i] = light.value;
    out.bound.lane[i] = light.bound;
  }
}

template <Form F, Emission E>
VSGL_LANE void choose_reflection(const Cluster& c, const SampleReceivers& r, ClusterLight& out) {
  if (!r.has_specular) return evaluate_all<F, E, Reflection::diffuse>(c, r, out);
  if (!r.has_gaussian) return evaluate_all<F, E, Reflection::ggx>(c, r, out);
  evaluate_all<F, E, Reflection::any>(c, r, out);
}

template <Form F>
VSGL_LANE void choose_emission(const Cluster& c, const SampleReceivers& r, ClusterLight& out) {
  if (c.ndf == interop::NDF_NONE) return choose_reflection<F, Emission::none>(c, r, out);
  if (c.ndf == interop::NDF_GGX) return choose_reflection<F, Emission::ggx>(c, r, out);
  choose_reflection<F, Emission::gaussian>(c, r, out);
}

// Whether all samples are so far away that the cluster lights them like a point, also in their specular
// lobes.
VSGL_LANE bool is_point(const Cluster& c, const SampleReceivers& r) {
  float nearest = 1e30f;
  for (std::size_t i = 0; i < kTileSamples; ++i) {
    const V3 v = v3(c.position) - at(r.position, i);
    nearest = least(nearest, dot(v, v) * c.inverse_variance - most(interop::CLUSTER_POINT, 5 * r.across[i]));
  }
  return nearest > 0;
}

// ---- Glints

// GGX's density, times pi, at the slope nearest to its peak that a turn of either direction by `turn`
// reaches. h is the sum of the directions to both sides (squared length hh, normal component hn, tangential
// one t): it moves by as much as either of them does.
VSGL_LANE float turned_density(float alpha2, float hh, float hn, float t, float turn) {
  const float near = most(t - turn, 0), q = most(near * near + alpha2 * hn * hn, alpha2 * hh);
  return alpha2 * hh * hh / (q * q);
}
// Share of a footprint that directions within a lobe cover: of solid angle 2 pi alpha^2 |h|, in 2 pi /
// sharpness.
VSGL_LANE float covered_share(float alpha2, float hh, float sharpness) {
  return least(alpha2 * std::sqrt(hh) * sharpness, 1);
}

VSGL_LANE float glint_at(const Cluster& c, float reach, float least_share, const Receiver& r) {
  const V3 v = v3(c.position) - r.position;
  const float d2 = most(dot(v, v), 1e-24f), inverse_d = 1 / std::sqrt(d2),
              sharpness = d2 * c.inverse_variance;
  const V3 u = inverse_d * v, n = v3(c.shading_normal);
  const float turn = least((c.reach + reach) * inverse_d, 1), alpha2 = c.masking_alpha2;

  const V3 h = v3(c.incident) - u;
  const float hh = most(dot(h, h), 1e-8f), hn = dot(h, n);
  const V3 t = h - hn * n;
  const float leaving = clamp(turn - dot(u, v3(c.normal)), 0, 1), z = clamp(turn - dot(u, n), 1e-4f, 1);
  const float emission_masking = (2 * c.incident_masking - 1) * z + ggx_slope(alpha2, z);
  const float peak = turned_density(alpha2, hh, hn, std::sqrt(dot(t, t)), turn);
  const float emitted = 2 * leaving * peak / emission_masking;

  const float arriving = dot(u, r.normal), cosine = clamp(arriving + turn, 0, 1);
  const V3 g = {r.sin_view + dot(u, r.tangent), dot(u, r.bitangent), r.cos_view + arriving};
  const float gg = most(dot(g, g), 1e-8f);
  const float masking = r.slope_view * cosine + ggx_slope(r.alpha2, cosine) * r.cos_view;
  const float reflected = cosine / (2 * kPi * masking) *
                          turned_density(r.alpha2, gg, g.z, std::sqrt(g.x * g.x + g.y * g.y), turn);

  const float emitting = most(covered_share(alpha2, hh, sharpness), least_share);
  const float meeting = least(emitting, most(covered_share(r.alpha2, gg, sharpness), least_share));
  return least(inverse_d * inverse_d, c.inverse_variance) * emitted *
         (emitting * cosine * dot(r.diffuse, v3(c.specular)) +
          meeting * reflected * dot(r.specular, v3(c.specular)));
}

}  // namespace

VSGL_VECTOR_CLONES
void evaluate_glint(const Cluster& cluster, const SampleReceivers& receivers, const Lanes& reach,
                    float least_share, Lanes& light) {
  const Cluster c = cluster;
  const float scale = c.ndf == interop::NDF_GGX ? 1 : 1 / kPi;  // c.specular of GGX is over pi
#pragma GCC ivdep
  for (std::size_t i = 0; i < kTileSamples; ++i)
    light.lane[i] = scale * glint_at(c, reach.lane[i], least_share, at(receivers, i));
}

VSGL_VECTOR_CLONES
void evaluate(const Cluster& cluster, const SampleReceivers& receivers, ClusterLight& light) {
  if (cluster.normal_sharpness <= interop::CLUSTER_FLAT)
    choose_emission<Form::curved>(cluster, receivers, light);
  else if (is_point(cluster, receivers))
    choose_emission<Form::point>(cluster, receivers, light);
  else
    choose_emission<Form::flat>(cluster, receivers, light);
}

}  // namespace vsgl
