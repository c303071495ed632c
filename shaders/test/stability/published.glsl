// Formulas as the papers print them, or as one would write them down: what the shader library does not do, to show why.
#include "lib/reflected_lobe.glsl"
#include "lib/vsgl.glsl"

// [Walter 2007, Eq. (33)] by the cosine alone.
float published_ggx_d(float alpha2, float cos2) {
  float q = cos2 * (alpha2 - 1.0) + 1.0;
  return alpha2 / (PI * q * q);
}

// [Walter 2007, Eq. (30)] by the cosine alone.
float published_phong_d(float alpha2, float cos2) {
  return pow(cos2, 1.0 / alpha2 - 1.0) / (PI * alpha2);
}

// [Wang 2009]
float published_sg(vec3 w, vec3 axis, float sharpness) { return exp(sharpness * (dot(w, axis) - 1.0)); }
float factored_sg(vec3 w, vec3 axis, float sharpness) { return exp(sharpness * dot(w, axis)) * exp(-sharpness); }
float published_sg_integral(float sharpness) { return 2.0 * PI / sharpness * (1.0 - exp(-2.0 * sharpness)); }

// (sharpness, exponent) of the product.
vec2 published_product(vec3 axis1, float sharpness1, vec3 axis2, float sharpness2) {
  float sharpness = length(sharpness1 * axis1 + sharpness2 * axis2);
  return vec2(sharpness, sharpness - sharpness1 - sharpness2);
}

// [Tokuyoshi 2014, Sec. 3.2] Solid angle of a disk.
float published_solid_angle(float d, float radius2) { return 2.0 * PI * (1.0 - d / sqrt(d * d + radius2)); }

// Sharpness from the length of the mean direction alone.
float published_sharpness(vec3 mean) {
  float r = length(mean);
  return r * (3.0 - r * r) / (1.0 - r * r);
}

// [Tokuyoshi 2016, Eqs. (11)-(12)] Fluence of a VSGL of unit amplitude.
float published_fluence(vec3 v, float variance, vec3 emission_axis, float emission_sharpness) {
  float d = length(v);
  float footprint = d * d / variance;
  vec2 product = published_product(v / d, footprint, -emission_axis, emission_sharpness);
  return exp(product.y) / (2.0 * PI * variance) * published_sg_integral(product.x);
}

// [Tokuyoshi 2016, Eq. (1)]
float published_kernel_level(float p, float texels, float share) { return 0.5 * log2(share * texels / p); }

// [Tokuyoshi 2024] Filtered density of normals and its normalising cosine, by the roughness in projected space a^2 / (1 - a^2).
SpecularFilter published_filter(SpecularReceiver r, vec3 light, float sharpness) {
  float projected = r.alpha2 / (1.0 - r.alpha2);
  float par = projected + 0.5 / sharpness;
  float perp = projected + 0.5 / (sharpness * r.cos_view * r.cos_view);
  vec2 m = vec2(par / (1.0 + par), perp / (1.0 + perp));
  vec3 h = normalize(vec3(r.sin_view, 0.0, r.cos_view) + light);
  float q = h.x * h.x / m.x + h.y * h.y / m.y + h.z * h.z;
  return SpecularFilter(1.0 / (PI * sqrt(m.x * m.y) * q * q), sqrt(r.sin_view * r.sin_view * m.x + r.cos_view * r.cos_view));
}

// [Xu 2013; Tokuyoshi 2014s] Exponent of a product of anisotropic SGs: the least eigenvalue of the symmetric matrix
// diag(eta, 0) + nu (I - light light^T), from its characteristic polynomial.
float published_asg_exponent(vec3 light, vec2 eta, float nu) {
  vec3 diagonal = vec3(eta, 0.0) + nu * (1.0 - light * light);
  vec3 off = -nu * vec3(light.y * light.z, light.x * light.z, light.x * light.y);  // yz, xz, xy
  float mean = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
  vec3 centred = diagonal - mean;
  float p = sqrt((dot(centred, centred) + 2.0 * dot(off, off)) / 6.0);
  vec3 b = centred / p, o = off / p;
  float determinant = b.x * (b.y * b.z - o.x * o.x) - o.z * (o.z * b.z - o.x * o.y) + o.y * (o.z * o.x - b.y * o.y);
  float angle = acos(clamp(0.5 * determinant, -1.0, 1.0)) / 3.0;
  return mean + 2.0 * p * cos(angle + 2.0 * PI / 3.0);
}

// [Tokuyoshi 2024] Mean of the clamped cosine, without the series and with the polynomials as they stand.
float published_cosine_mean(float c, float l) {
  float e = exp(-l);
  float p = (1.0 - e) / l;
  float up = (1.0 - p) / l, low = e * (p - e) / l;
  float t = l * sqrt(((l + 2.7360831611) * l + 17.0212977817) / (2.0 * (((l + 4.0100826729) * l + 15.2191562631) * l + 76.0878962724)));
  float f = 0.5 * (c * erfc(-t * c) + erfc(t)) - exp(-t * t * c * c) * (exp(t * t * (c * c - 1.0)) - 1.0) / (3.5449077018 * t);
  return (low + (up - low) * clamp(f, 0.0, 1.0)) * l / (1.0 - exp(-2.0 * l));
}

// [Tokuyoshi 2022] The clamped cosine as a constant times the difference of an SG and 1, each integrated over the hemisphere.
float published_cosine_difference(float c, float l) {
  const float COSINE_SHARPNESS = 8.456087e-4, COSINE_SCALE = 1182.24673;
  vec3 axis = vec3(sqrt(max(1.0 - c * c, 0.0)), 0.0, c);
  SgProduct product = sg_product(vec3(0.0, 0.0, 1.0), COSINE_SHARPNESS, axis, l);
  float ratio = exp(product.exponent + COSINE_SHARPNESS) * (sg_integral(product.sharpness) / sg_integral(l));
  return COSINE_SCALE * (ratio * vmf_hemisphere(product.axis.z, product.sharpness) - vmf_hemisphere(c, l));
}

// [Tokuyoshi 2016, C.2] The cosine at the light's axis.
float pulled_out_cosine(float c) { return max(c, 0.0); }

// [Tokuyoshi 2016, A.1] Lambert's lobe as an SG of sharpness 2.2925 and of the cosine's integral.
float sg_cosine_mean(float c, float l) {
  const float LAMBERT = 2.2925;
  float s = sqrt(max(1.0 - c * c, 0.0));
  SgProduct product = sg_product(vec3(0.0, 0.0, 1.0), LAMBERT, vec3(s, 0.0, c), l);
  return PI / sg_integral(LAMBERT) * exp(product.exponent) * (sg_integral(product.sharpness) / sg_integral(l));
}
