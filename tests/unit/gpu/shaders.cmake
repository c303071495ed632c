vsgl_shaders(unit_gpu test/affine.comp.glsl test/gather.comp.glsl test/layers.vert.glsl test/layers.frag.glsl)
