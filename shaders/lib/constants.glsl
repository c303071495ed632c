// Constants of the shader library.
#ifndef VSGL_LIB_CONSTANTS_GLSL
#define VSGL_LIB_CONSTANTS_GLSL

const float PI = 3.14159265358979;
// Largest lobe sharpness that is ever formed: 2^40. Directions held in float32 resolve lobes up to about 1e10.
const float SHARPNESS_MAX = 1099511627776.0;

#endif
