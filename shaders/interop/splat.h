// What the splatting of surface points into imperfect shadow maps exchanges between host and device.
#ifndef VSGL_INTEROP_SPLAT_H
#define VSGL_INTEROP_SPLAT_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// A disk on a surface that stands for a piece of geometry.
struct SplatPoint {
  vec3 position;  // m, relative to the anchor
  float radius;   // of the disk, m; 0: a hole (alpha cut-out), casts nothing
  vec3 normal;    // geometric, unit, either side
  float padding;
};
VSGL_CHECK_SIZE(SplatPoint, 32)

// The shadow map of one light: a hemisphere seen from just above the emitting surface.
struct SplatView {
  vec3 origin;          // m, relative to the anchor
  float near_distance;  // nothing nearer than this is an occluder, m
  vec3 axis;            // unit, middle of the hemisphere
  float own_radius;     // points nearer than this that lie in the emitting surface's plane belong to it, m
  vec3 surface;         // the point of that plane below `origin`, m
  uint first_point;     // the light's points start here in the pool, and wrap around; of cells: its place among
                        // CELLS_PER_POINT
};
VSGL_CHECK_SIZE(SplatView, 48)

// A triangle as cells: outer_side^2 congruent blocks of inner_side^2 cells.
struct CellTriangle {
  vec3 a, b, c;  // m, relative to the anchor
  float radius;  // of a cell's disk, which stands for CELLS_PER_POINT cells of this triangle, m
  vec2 uv_a, uv_b, uv_c;
  uint outer_side, inner_side;
  uint mask;                     // first word of the cut-out's bits
  uint mask_width, mask_height;  // texels; 0: no cut-out
};
VSGL_CHECK_SIZE(CellTriangle, 84)

// Push constants of all visibility shaders. One view's tile lies at view * tile * tile of its batch.
struct SplatPush {
  uint tile;        // texels a side, a power of two
  uint view_count;  // of this batch
  uint points_per_view;
  uint pool_size;
  float disk_radius;  // rho of the point set, m
  float splat_scale;  // radius of a splatted disk, in those of its point
  uint level;         // of the pull-push pyramid: the finer of the two levels at work
};
VSGL_CHECK_SIZE(SplatPush, 28)

// Further push constants where points come from cells.
struct CellPush {
  uint triangle_count, cell_count;
  uvec2 seed;
};
VSGL_CHECK_SIZE(CellPush, 16)

VSGL_CONST uint CELLS_PER_POINT = 1024u;  // 32^2: that many lights get points of their own
VSGL_CONST int SPLAT_MAX_WIDTH = 15;      // texels a side
VSGL_CONST uint PULL_PUSH_LEVELS = 3u;    // above level 0: holes up to 2^3 texels wide are closed
VSGL_CONST float PULL_PUSH_NEAR = 0.05f;  // depths that differ by less than this fraction are one surface

VSGL_INTEROP_END
#endif
