#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/vsgl.glsl"

void put(VsglIncoming v) { put(v.axis); put(v.sharpness); put(v.fluence); }
void put(DiskCone c) { put(c.solid_angle); put(c.sharpness); put(c.density); }

void call() {
  switch (FUNCTION) {
    case 0u: put(vsgl_product(take3(), take(), take(), take3(), take())); break;
    case 1u: put(vsgl_incoming(take3(), take(), take3(), take())); break;
    case 2u: put(disk_cone(take(), take())); break;
    case 3u: put(vsgl_incoming_disk(take3(), take(), take3(), take())); break;
  }
}
