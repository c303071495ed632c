#include "artifact/proxies.h"

#include <limits>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/strict_json.h"

namespace vsgl {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "vsgltools/proxies/1";
constexpr double kLeastRadius = 1e-12, kMostMetres = 1e12;
constexpr int kMaxInstances = 1 << 30;

Json array_of(Vec3 v) {
  return {v.x, v.y, v.z};
}
Vec3 vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Json to_json(const Provenance& provenance) {
  Json inputs = Json::array();
  for (const auto& input : provenance.inputs)
    inputs.push_back({{"name", input.name}, {"sha256", input.sha256}});
  return {{"tool", provenance.tool},
          {"tool_version", provenance.tool_version},
          {"command", provenance.command_line},
          {"seed", provenance.seed},
          {"inputs", inputs}};
}

Json to_json(const ProxyObject& object) {
  Json spheres = Json::array();
  for (const ProxySphere& sphere : object.spheres)
    spheres.push_back({{"center", array_of(sphere.center)},
                       {"radius_m", sphere.radius},
                       {"albedo", array_of(sphere.albedo)}});
  return {{"name", object.name},
          {"instance", object.instance},
          {"sheet", object.sheet},
          {"volume_outside", object.errors.volume_outside},
          {"volume_missed", object.errors.volume_missed},
          {"surface_distance_rms_m", object.errors.surface_distance_rms},
          {"surface_distance_max_m", object.errors.surface_distance_max},
          {"spheres", spheres}};
}

ProxySphere read_sphere(const JsonValue& value) {
  ProxySphere sphere;
  sphere.center = vector_of(value.at("center").numbers<3>(-kMostMetres, kMostMetres));
  sphere.radius = value.at("radius_m").number(kLeastRadius, kMostMetres);
  sphere.albedo = vector_of(value.at("albedo").numbers<3>(0, 1));
  value.finish();
  return sphere;
}

ProxyObject read_object(const JsonValue& value) {
  ProxyObject object;
  object.name = value.at("name").string();
  object.instance = static_cast<int>(value.at("instance").integer(0, kMaxInstances));
  object.sheet = value.at("sheet").boolean();
  const auto error = [&](const char* key) { return value.at(key).number(0, kMostMetres); };
  object.errors = {error("volume_outside"), error("volume_missed"), error("surface_distance_rms_m"),
                   error("surface_distance_max_m")};
  for (const JsonValue& sphere : value.at("spheres").array()) object.spheres.push_back(read_sphere(sphere));
  value.finish();
  return object;
}

}  // namespace

std::vector<ProxySphere> Proxies::spheres() const {
  std::vector<ProxySphere> all;
  for (const ProxyObject& object : objects)
    all.insert(all.end(), object.spheres.begin(), object.spheres.end());
  return all;
}

void write(const std::filesystem::path& path, const Proxies& proxies, const Provenance& provenance) {
  Json objects = Json::array(), receivers = Json::array();
  for (const ProxyObject& object : proxies.objects) objects.push_back(to_json(object));
  for (const auto& [name, instance] : proxies.receivers)
    receivers.push_back({{"name", name}, {"instance", instance}});
  const Json document{{"$schema", kSchema},
                      {"provenance", to_json(provenance)},
                      {"anchor", array_of(proxies.anchor)},
                      {"scene_radius_m", proxies.scene_radius},
                      {"objects", objects},
                      {"receivers", receivers}};
  write_text(path, document.dump(1) + "\n");
}

Proxies read_proxies(const std::filesystem::path& path) {
  const JsonValue root = JsonValue::parse_file(path);
  if (const std::string schema = root.at("$schema").string(); schema != kSchema)
    throw Error(ErrorCode::wrong_schema, path.string() + ": is \"" + schema + "\", but \"" + kSchema +
                                             "\" is needed; write the file with proxy-fit of this release");
  root.find("provenance");
  Proxies proxies;
  proxies.anchor = vector_of(root.at("anchor").numbers<3>());
  proxies.scene_radius = root.at("scene_radius_m").number(kLeastRadius, kMostMetres);
  for (const JsonValue& object : root.at("objects").array()) proxies.objects.push_back(read_object(object));
  for (const JsonValue& receiver : root.at("receivers").array()) {
    proxies.receivers.push_back(
        {receiver.at("name").string(), static_cast<int>(receiver.at("instance").integer(0, kMaxInstances))});
    receiver.finish();
  }
  root.finish();
  return proxies;
}

}  // namespace vsgl
