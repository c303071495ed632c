#pragma once

// Colour spaces that metrics of perception work in. Linear RGB is that of sRGB (Rec.709 primaries, white
// D65), 1 = white.

#include "math/vec.h"

namespace vsgl::metrics {

// Linear light to the sRGB encoding (IEC 61966-2-1), 0..1 each.
double encode_srgb(double linear);

// CIE XYZ divided by that of white: white is (1, 1, 1).
Vec3 to_xyz(Vec3 linear_rgb);
Vec3 from_xyz(Vec3 xyz);

// [Andersson 2020, Sec. 4.1] YCxCz, a linear opponent space: (Y, Cx, Cz), white is (100, 0, 0).
Vec3 to_ycxcz(Vec3 linear_rgb);
Vec3 from_ycxcz(Vec3 ycxcz);

// CIE 1976 (L*, a*, b*) with white D65.
Vec3 to_lab(Vec3 linear_rgb);

// [Mantiuk 2021] PU21, with the parameters "banding + glare": luminance in cd/m^2 to steps that look
// alike, about 0..595; 100 cd/m^2 is 256. Domain: 0.005..10000; beyond it the nearest value.
double encode_pu21(double luminance);

}  // namespace vsgl::metrics
