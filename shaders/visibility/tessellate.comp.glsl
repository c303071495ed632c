// [Barak 2013] splats points that subdividing the triangles yields on the fly: one workgroup a light.
// Deviation: there a cell's point goes to one map drawn at random; here each light looks up which cells are its own,
// one of every CELLS_PER_POINT consecutive ones, so that nothing is stored and no order of writing matters.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/splat.h"
#include "lib/frame.glsl"
#include "lib/hash.glsl"
#include "lib/octahedral.glsl"
#include "lib/subdivision.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SplatPush push; CellPush cells; };
layout(binding = 2, scalar) readonly buffer Starts { uint starts[]; };  // first cell of each triangle
layout(binding = 3, scalar) readonly buffer Triangles { CellTriangle triangles[]; };
layout(binding = 4, scalar) readonly buffer Masks { uint masks[]; };  // a bit a texel, row by row: 1 = opaque
#include "visibility/splat.glsl"

// The triangle that holds the cell.
uint triangle_of(uint cell) {
  uint first = 0u, count = cells.triangle_count;
  while (count > 1u) {
    uint half_count = count / 2u;
    if (starts[first + half_count] <= cell) {
      first += half_count;
      count -= half_count;
    } else {
      count = half_count;
    }
  }
  return first;
}

// Nearest texel, repeated.
bool is_hole(CellTriangle triangle, vec3 weight) {
  if (triangle.mask_width == 0u) return false;
  vec2 uv = weight.x * triangle.uv_a + weight.y * triangle.uv_b + weight.z * triangle.uv_c;
  vec2 size = vec2(triangle.mask_width, triangle.mask_height);
  uvec2 texel = min(uvec2(fract(uv) * size), uvec2(size) - 1u);
  uint bit = texel.y * triangle.mask_width + texel.x;
  return (masks[triangle.mask + bit / 32u] >> (bit % 32u) & 1u) == 0u;
}

// The centroid of a cell. Blocks of inner_side^2 cells are congruent pieces of the triangle themselves.
SplatPoint point_of(uint cell) {
  uint index = triangle_of(cell);
  CellTriangle triangle = triangles[index];
  uint inside = cell - starts[index], block_cells = triangle.inner_side * triangle.inner_side;
  vec3 in_block = subdivision_point(triangle.inner_side, inside % block_cells, vec2(1.0 / 3.0));
  vec3 weight = subdivision_point(triangle.outer_side, inside / block_cells, in_block.yz);
  vec3 position = weight.x * triangle.a + weight.y * triangle.b + weight.z * triangle.c;
  float radius = is_hole(triangle, weight) ? 0.0 : triangle.radius;
  vec3 normal = normalize(cross(triangle.b - triangle.a, triangle.c - triangle.a));
  return SplatPoint(position, radius, normal, 0.0);
}

void main() {
  uint index = gl_WorkGroupID.x;
  SplatView view = views[index];
  mat3 frame = frame_about(view.axis);
  for (uint t = gl_LocalInvocationID.x; t < push.points_per_view; t += gl_WorkGroupSize.x) {
    uint place = (view.first_point + pcg3d(uvec3(t, cells.seed)).x) % CELLS_PER_POINT;
    uint cell = t * CELLS_PER_POINT + place;
    if (cell < cells.cell_count) splat_point(index * push.tile * push.tile, view, frame, point_of(cell));
  }
}
