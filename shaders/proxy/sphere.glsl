// A proxy as a receiver sees it.
#ifndef VSGL_PROXY_SPHERE_GLSL
#define VSGL_PROXY_SPHERE_GLSL

// [Ren 2006, Section 5] replacement rules for self-shadowing. In: the centre relative to the receiver, and the radius; out: those of
// the sphere above the tangent plane that takes its place. Returns false where there is none.
bool sphere_above_plane(vec3 normal, inout vec3 center, inout float radius) {
  const float height = dot(center, normal);
  if (height + radius <= 0.0) return false;
  if (height <= 0.0 && dot(center, center) < radius * radius) return false;
  if (abs(height) >= radius) return true;
  // The sphere inscribed between the plane and the top of the one that it cuts; below half, it shrinks towards the circle of the cut.
  const vec3 foot = center - height * normal;
  float inscribed = 0.5 * (radius + height);
  if (height <= 0.0) {
    const float circle = sqrt(max(radius * radius - height * height, 0.0));
    inscribed *= clamp((length(foot) - circle) / max(circle, 1e-20), 0.0, 1.0);
  }
  radius = inscribed;
  center = foot + inscribed * normal;
  return inscribed > 0.0;
}

// [Sloan 2007, Section 4.1] share of a proxy that counts at the rim of its sphere of influence.
// Deviation: smoothly over a quarter of the least sine, in place of four entries of the table.
float influence(float sine, float least) { return smoothstep(least, 1.25 * least, sine); }

#endif
