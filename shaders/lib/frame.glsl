// Orthonormal frames.
#ifndef VSGL_LIB_FRAME_GLSL
#define VSGL_LIB_FRAME_GLSL

// Columns x, y, z = n, right-handed (Duff et al. 2017, Building an orthonormal basis, revisited).
// Deviation: the frame jumps at n.z = -0.61 instead of 0, where rounding would turn the frames of all surfaces along an axis.
mat3 frame_about(vec3 n) {
  float s = n.z < -0.61 ? -1.0 : 1.0;
  float a = -1.0 / (s + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

#endif
