// Orthonormal frames.
#ifndef VSGL_LIB_FRAME_GLSL
#define VSGL_LIB_FRAME_GLSL

// Columns x, y, z = n, right-handed. Branch-free and continuous but for n.z = 0 (Duff et al. 2017, Building an orthonormal
// basis, revisited).
mat3 frame_about(vec3 n) {
  float s = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (s + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

#endif
