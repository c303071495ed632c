#pragma once

#include "math/sg.h"

// Light that a VSGL (Gaussian footprint, SG emission) sends to a point, in double precision: the twin of
// shaders/lib/vsgl.glsl.

namespace vsgl {

// Normalised SG of incoming radiance (axis points to the light) and its integral over the sphere: times the
// radiant-intensity amplitude Phi / sg_integral(emission sharpness), W/sr, `fluence` (1/m^2) becomes W/m^2.
struct VsglIncoming {
  Vec3 axis;
  double sharpness = 0;
  double fluence = 0;
};

// [Tokuyoshi 2016, Eqs. (11)-(12)] v: from the receiver to the light's mean position, m; variance: per axis,
// m^2.
VsglIncoming vsgl_incoming(Vec3 v, double variance, Vec3 emission_axis, double emission_sharpness);

// The uniform disk of radius r, r^2 = 2 E|y - mean|^2 = 4 variance, seen head on from distance d.
struct DiskCone {
  double solid_angle = 0;  // sr
  double sharpness = 0;    // of the SG of amplitude 2 that stands for the cone
  double density = 0;      // solid_angle / (pi r^2), 1/m^2
};
DiskCone disk_cone(double d, double radius2);

// [Tokuyoshi 2014, Sec. 3.2] the same with the light as a disk.
VsglIncoming vsgl_incoming_disk(Vec3 v, double variance, Vec3 emission_axis, double emission_sharpness);

// Both forms: the emission lobe times the footprint's SG of sharpness d2 / variance about `u`, unit, towards
// the light.
VsglIncoming vsgl_product(Vec3 u, double d2, double variance, Vec3 emission_axis, double emission_sharpness);

}  // namespace vsgl
