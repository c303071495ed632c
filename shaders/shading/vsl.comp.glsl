#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// [Hasan 2009; Tokuyoshi 2014, Eq. (2)] Virtual spherical lights: L = P / (pi r^2) times the integral of f_x f_y cos cos over the
// directions of the light's cone, both BRDFs as if they met at the light's centre, with the visibility of that centre.

#include "lib/hash.glsl"
#include "lib/vsl.glsl"
#include "shading/emission.glsl"
#include "shading/shadow.glsl"

// The cone, and how many directions each technique draws.
struct Plan {
  vec3 axis;
  float height;       // 1 - cos of the half angle
  uvec3 counts;       // cone, receiver's BRDF, light's BRDF
  uvec2 rotation;     // of the points, modulo 1
};

// Probability of the specular lobe: its share of the reflected luminance.
float specular_share(uint ndf, float diffuse, float specular) {
  return ndf == NDF_NONE || specular <= 0.0 ? 0.0 : specular / (diffuse + specular);
}

Scatterer scatterer_of(Receiver r) {
  vec3 view = r.lobe.sin_view * r.lobe.tangent + r.lobe.cos_view * r.lobe.normal;
  float diffuse = dot(r.luminance_diffuse, vec3(1.0)), specular = dot(r.luminance_specular, vec3(1.0));
  return Scatterer(normalize(view), r.normal, r.normal, r.lobe.alpha2, specular_share(r.lobe.ndf, diffuse, specular), r.lobe.ndf);
}

Scatterer scatterer_of(ShadingLight light) {
  const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);
  float share = specular_share(light.ndf, dot(LUMINANCE, light.power_diffuse), dot(LUMINANCE, light.power_specular));
  return Scatterer(light.incident, light.normal, light.shading_normal, light.alpha * light.alpha, share, light.ndf);
}

// Lambert's law alone is drawn from only where nothing else is: the cone serves it as well.
uint count_of(uint technique, uint count, float specular) {
  bool wanted = (push.vsl.techniques & technique) != 0 && (specular > 0.0 || (push.vsl.techniques & VSL_CONE) == 0);
  return wanted ? count : 0;
}

Plan plan(Receiver r, ShadingLight light, float receiver_specular, float light_specular) {
  vec3 v = light.position - r.position;
  float d2 = dot(v, v), radius2 = 4.0 * light.variance;
  Plan p;
  p.axis = d2 > 1e-36 ? v * inversesqrt(d2) : -light.normal;
  p.height = push.vsl.sphere != 0 ? sphere_cone_height(d2, radius2) : disk_cone_height(d2, radius2);
  float right_angles = 2.0 * asin(sqrt(0.5 * p.height)) / (0.5 * PI);
  uint count = clamp(uint(ceil(float(push.vsl.samples) * right_angles)), 1u, push.vsl.samples);
  p.counts = uvec3(count_of(VSL_CONE, count, 1.0), count_of(VSL_RECEIVER, count, receiver_specular),
                   count_of(VSL_LIGHT, count, light_specular));
  uvec3 hash = pcg3d(floatBitsToUint(r.position));
  p.rotation = pcg3d(uvec3(hash.x, hash.y ^ light.index, hash.z ^ push.vsl.seed)).xy;
  return p;
}

// [Veach 1995] One-sample terms f / sum(n p) of all three techniques: the balance heuristic. Directions outside the cone count as 0.
void add_light(Receiver r, ShadingLight light, inout Sums sums) {
  float lit = visibility(r, light.index);
  if (lit <= 0.0) return;
  Scatterer at_receiver = scatterer_of(r), at_light = scatterer_of(light);
  Plan p = plan(r, light, at_receiver.specular, at_light.specular);
  float uniform_density = 1.0 / (2.0 * PI * p.height);
  uint total = p.counts.x + p.counts.y + p.counts.z;
  Transfer sum = Transfer(vec2(0.0), vec2(0.0));
  for (uint k = 0; k < total; ++k) {
    vec2 u = point_of_bits(p.rotation + r2_bits(k));
    vec3 w;
    if (k < p.counts.x) w = cone_direction(p.axis, p.height, u);
    else if (k < p.counts.x + p.counts.y) w = scatter_direction(at_receiver, u);
    else w = -scatter_direction(at_light, u);
    vec3 off = w - p.axis;
    if (k >= p.counts.x && (dot(off, off) > 2.0 * p.height || w == vec3(0.0))) continue;
    float density = float(p.counts.x) * uniform_density;
    if (p.counts.y > 0) density += float(p.counts.y) * scatter_pdf(at_receiver, w);
    if (p.counts.z > 0) density += float(p.counts.z) * scatter_pdf(at_light, -w);
    if (density <= 0.0) continue;
    Transfer t = exact_transfer(r, light, w, 1.0 / density);
    sum.diffuse += t.diffuse;
    sum.specular += t.specular;
  }
  float scale = lit / (PI * 4.0 * light.variance);
  add(sums, light, Transfer(scale * sum.diffuse, scale * sum.specular));
}

#include "shading/loop.glsl"
