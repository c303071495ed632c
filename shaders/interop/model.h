// Numbers that C++ and GLSL must agree on: reflection models and limits.
#ifndef VSGL_INTEROP_MODEL_H
#define VSGL_INTEROP_MODEL_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// Normal distribution of a specular lobe, as stored in the channel `ndf.I`. NDF_NONE: no specular lobe.
VSGL_CONST uint NDF_NONE = 0u;
VSGL_CONST uint NDF_GGX = 1u;
VSGL_CONST uint NDF_BECKMANN = 2u;
VSGL_CONST uint NDF_PHONG = 3u;

// `id.I` of a pixel or texel that sees nothing.
VSGL_CONST uint NO_INSTANCE = 0xFFFFFFFFu;

// Sharpness of the spherical Gaussian that stands for a Lambert lobe: least-squares fit of the normalised vMF
// to cos/pi (Tokuyoshi 2016, A.1 rounds it to 2), and its encoding by the Banerjee pair.
VSGL_CONST float LAMBDA_DIFFUSE = 2.2925f;
VSGL_CONST float ALPHA_MIN = 1e-3f;

VSGL_INTEROP_END
#endif
