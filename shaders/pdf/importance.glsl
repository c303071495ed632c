// Sums importance over lit texels. A kernel defines, before including this file, SOURCE and TEXEL, the structs of its sources and
// of what it keeps of a texel; after it
//   TEXEL make_texel(Reflector r)
//   float importance(TEXEL texel, SOURCE source)   luminance of the light that reaches the image from the texel by the source
// and includes pdf/loop.glsl.
#ifndef VSGL_PDF_IMPORTANCE_GLSL
#define VSGL_PDF_IMPORTANCE_GLSL

#include "interop/importance.h"
#include "lib/specular_lobe.glsl"

layout(local_size_x = IMPORTANCE_GROUP) in;

layout(constant_id = IMPORTANCE_TEXEL_NDF_ID) const uint TEXEL_NDF = IMPORTANCE_NDF_ANY;
layout(constant_id = IMPORTANCE_SOURCE_NDF_ID) const uint SOURCE_NDF = IMPORTANCE_NDF_ANY;

layout(scalar, binding = 0) readonly buffer Texels { Reflector texels[]; };
layout(scalar, binding = 1) uniform Sources { SOURCE sources[IMPORTANCE_BLOCK]; };
layout(scalar, binding = 2) buffer Sums { float sums[]; };
layout(scalar, push_constant) uniform Push { ImportancePush push; };

#endif
