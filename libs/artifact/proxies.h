#pragma once

// Spheres that stand for a scene's geometry: what proxy-fit writes and proxy-gi reads, as JSON
// (configs/schema/proxies.schema.json).

#include <filesystem>
#include <string>
#include <vector>

#include "base/provenance.h"
#include "math/vec.h"

namespace vsgl {

struct ProxySphere {
  Vec3 center;        // m, relative to the anchor
  double radius = 0;  // m, > 0
  Vec3 albedo;        // mean diffuse reflectance of the surface that it stands for, 0..1
};

// How well an object's spheres fit it.
struct ProxyErrors {
  double volume_outside = 0;        // of the spheres, over the object's volume; 0 for sheets
  double volume_missed = 0;         // of the object outside all spheres, over its volume; 0 for sheets
  double surface_distance_rms = 0;  // from the object's surface to that of the spheres' union, m
  double surface_distance_max = 0;
};

struct ProxyObject {
  std::string name;
  int instance = 0;    // of the scene: the `id.I` of the G-buffer
  bool sheet = false;  // an open surface: its spheres touch it from behind
  ProxyErrors errors;
  std::vector<ProxySphere> spheres;
};

// An instance that only receives light: large and flat, as a floor.
struct ProxyReceiverOnly {
  std::string name;
  int instance = 0;
};

struct Proxies {
  Vec3 anchor;              // world, m
  double scene_radius = 1;  // m
  std::vector<ProxyObject> objects;
  std::vector<ProxyReceiverOnly> receivers;

  // The spheres of all objects, in order.
  std::vector<ProxySphere> spheres() const;
};

void write(const std::filesystem::path& path, const Proxies& proxies, const Provenance& provenance);
// Throws file_not_found, json_*, wrong_schema.
Proxies read_proxies(const std::filesystem::path& path);

}  // namespace vsgl
