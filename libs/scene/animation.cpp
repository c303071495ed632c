#include "scene/animation.h"

#include <algorithm>
#include <cmath>
#include <regex>

#include "base/error.h"

namespace vsgl::scene {
namespace {

using Json = nlohmann::ordered_json;

constexpr int max_frames = 10000;

[[noreturn]] void out_of_range(const JsonValue& value, const std::string& what) {
  throw Error(ErrorCode::json_out_of_range, value.where() + ": " + what);
}

bool can_be_animated(const std::string& target) {
  static const std::regex pattern(
      "/camera/(position|target|up|vertical_fov_deg)"
      "|/lights/(0|[1-9]\\d{0,5})/(position|direction|target|up|radiant_intensity_w_sr|irradiance_w_m2"
      "|inner_cone_deg|outer_cone_deg)"
      "|/meshes/(0|[1-9]\\d{0,5})/transform(/(0|[1-9]\\d{0,5}))?/"
      "(translation|rotation_deg|quaternion|scale)");
  return std::regex_match(target, pattern);
}

bool is_quaternion(const std::string& target) {
  return target.ends_with("/quaternion");
}
// Directions of lights, and ups.
bool is_direction(const std::string& target) {
  return target.ends_with("/direction") || target.ends_with("/up");
}

std::vector<double> numbers_of(const Json& value) {
  return value.is_array() ? value.get<std::vector<double>>() : std::vector<double>{value.get<double>()};
}

std::vector<double> unit(std::vector<double> v) {
  double square = 0;
  for (const double x : v) square += x * x;
  for (double& x : v) x /= std::sqrt(square);
  return v;
}

double cosine_of(const std::vector<double>& a, const std::vector<double>& b) {
  double cosine = 0;
  for (std::size_t i = 0; i < a.size(); ++i) cosine += a[i] * b[i];
  return cosine;
}

std::vector<double> mix(const std::vector<double>& a, double wa, const std::vector<double>& b, double wb) {
  std::vector<double> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = wa * a[i] + wb * b[i];
  return out;
}

// [Shoemake 1985] spherical linear interpolation of unit vectors at constant angular speed.
// The angle comes from atan2, which keeps its digits near 0 where acos loses them.
std::vector<double> slerp(const std::vector<double>& a, const std::vector<double>& b, double t) {
  const std::vector<double> sum = mix(a, 1, b, 1), difference = mix(b, 1, a, -1);
  const double half_angle =
      std::atan2(std::sqrt(cosine_of(difference, difference)), std::sqrt(cosine_of(sum, sum)));
  const double angle = 2 * half_angle, sine = std::sin(angle);
  if (!(sine > 1e-12)) return mix(a, 1 - t, b, t);  // the same direction
  return mix(a, std::sin((1 - t) * angle) / sine, b, std::sin(t * angle) / sine);
}

// Quaternions q and -q are one rotation: the nearer one is taken.
std::vector<double> nearer(const std::vector<double>& a, std::vector<double> b) {
  if (cosine_of(a, b) < 0)
    for (double& x : b) x = -x;
  return b;
}

// What interpolation along a great circle needs: no zero vector, no two opposite directions.
void check_directions(const JsonValue& value, const Json* before, bool opposites_are_equal) {
  const auto current = numbers_of(value.raw());
  if (!(cosine_of(current, current) > 1e-18)) out_of_range(value, "a vector of length 0 has no direction");
  if (before == nullptr || opposites_are_equal) return;
  if (cosine_of(unit(numbers_of(*before)), unit(current)) < -1 + 1e-9)
    out_of_range(value, "opposite to the key before, so that there is no shortest way; add a key between");
}

// A number, or as many numbers as `like` has. Whether the scene takes them is for its reader to say.
void check_shape(const JsonValue& value, const Json& like) {
  if (!like.is_array()) {
    value.number();
    return;
  }
  for (const JsonValue& component : value.array(like.size(), like.size())) component.number();
}

}  // namespace

Animation::Animation(const JsonValue& document) : document_(document.raw()), file_(document.origin()) {
  const auto animation = document.find("animation");
  if (!animation) return;
  document_.erase("animation");
  animated_ = true;
  frame_rate_hz_ = animation->at("frame_rate_hz").number(0.001, 100000);
  frames_ = static_cast<int>(animation->at("frames").integer(1, max_frames));
  for (const JsonValue& object : animation->at("tracks").array()) {
    Track track = read_track(object);
    for (const Track& other : tracks_)
      if (other.target == track.target) out_of_range(object, "another track has this target already");
    tracks_.push_back(std::move(track));
  }
  animation->finish();
}

Animation::Track Animation::read_track(const JsonValue& object) const {
  Track track;
  const JsonValue target = object.at("target");
  track.target = target.string();
  if (!can_be_animated(track.target))
    out_of_range(target,
                 "\"" + track.target +
                     "\" cannot be animated; name a number or vector of the camera, of a light or of a "
                     "mesh's transform, as \"/lights/0/position\"");
  if (!document_.contains(Json::json_pointer(track.target)))
    out_of_range(target,
                 "the scene has no value at \"" + track.target + "\"; add it to what the track moves");
  track.interpolation = read_interpolation(object, track.target);
  track.keys = read_keys(object, track);
  object.finish();
  return track;
}

Animation::Interpolation Animation::read_interpolation(const JsonValue& object,
                                                       const std::string& target) const {
  const auto value = object.find("interpolation");
  if (value && value->choice({"linear", "step"}) == "step") return Interpolation::step;
  return is_quaternion(target) || is_direction(target) ? Interpolation::sphere : Interpolation::linear;
}

std::vector<Animation::Key> Animation::read_keys(const JsonValue& object, const Track& track) const {
  std::vector<Key> keys;
  for (const JsonValue& entry : object.at("keys").array(1)) {
    const JsonValue frame = entry.at("frame"), value = entry.at("value");
    const Json* before = keys.empty() ? nullptr : &keys.back().value;
    const int number = static_cast<int>(frame.integer(0, frames_ - 1));
    if (before && number <= keys.back().frame)
      out_of_range(frame,
                   "frames of keys must increase; the key before is at " + std::to_string(keys.back().frame));
    check_shape(value, before ? *before : value.raw());
    if (track.interpolation == Interpolation::sphere)
      check_directions(value, before, is_quaternion(track.target));
    entry.finish();
    keys.push_back({number, value.raw()});
  }
  return keys;
}

bool Animation::moves_meshes() const {
  return std::any_of(tracks_.begin(), tracks_.end(),
                     [](const Track& track) { return track.target.starts_with("/meshes/"); });
}

Json Animation::value_at(const Track& track, int frame) {
  const auto next = std::upper_bound(track.keys.begin(), track.keys.end(), frame,
                                     [](int wanted, const Key& key) { return wanted < key.frame; });
  if (next == track.keys.begin()) return next->value;
  const Key& key = *std::prev(next);
  if (next == track.keys.end() || key.frame == frame || track.interpolation == Interpolation::step)
    return key.value;
  const double t = static_cast<double>(frame - key.frame) / (next->frame - key.frame);
  const auto from = numbers_of(key.value), to = numbers_of(next->value);
  if (track.interpolation == Interpolation::sphere) {
    const auto start = unit(from), end = unit(to);
    return slerp(start, is_quaternion(track.target) ? nearer(start, end) : end, t);
  }
  const auto between = mix(from, 1 - t, to, t);
  return key.value.is_array() ? Json(between) : Json(between.front());
}

JsonValue Animation::at(int frame) const {
  if (!animated_) return JsonValue::of(document_, file_);
  Json document = document_;
  for (const Track& track : tracks_) document.at(Json::json_pointer(track.target)) = value_at(track, frame);
  return JsonValue::of(std::move(document), file_ + " at frame " + std::to_string(frame));
}

}  // namespace vsgl::scene
