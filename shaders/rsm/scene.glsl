// Access to a scene on the device by address.
#ifndef VSGL_RSM_SCENE_GLSL
#define VSGL_RSM_SCENE_GLSL

#include "interop/geometry.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vertices { Vertex at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Triangles { Triangle at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Materials { Material at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Textures { Texture at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer BakeBlock { Bake bake; };

layout(push_constant, scalar) uniform Push { BakePush push; };

#define BAKE BakeBlock(push.bake_at).bake

Triangle scene_triangle(uint index) {
  return Triangles(BAKE.geometry.triangles_at).at[index];
}

Vertex scene_vertex(uint index) {
  return Vertices(BAKE.geometry.vertices_at).at[index];
}

Material scene_material(uint instance) {
  return Materials(BAKE.geometry.materials_at).at[Words(BAKE.geometry.instance_materials_at).at[instance]];
}

Texture scene_texture(int index) {
  return Textures(BAKE.geometry.textures_at).at[index];
}

#endif
