#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/strict_json.h"

namespace vsgl::scene {

// The animation of a scene JSON: tracks that replace single values of the document, each named by a JSON
// pointer. The document of a frame is a plain scene without animation, so that a frame that lies on a key of
// every track is bit for bit the static scene with the keys' values.
class Animation {
 public:
  // Reads "animation" of the document; where there is none, the document is its only frame 0. Throws json_*,
  // naming the place in the file.
  explicit Animation(const JsonValue& document);

  int frames() const { return frames_; }
  double frame_rate_hz() const { return frame_rate_hz_; }
  bool moves_meshes() const;
  // The document at a frame, 0..frames() - 1. A track holds its first value before its first key and its last
  // value behind its last one.
  JsonValue at(int frame) const;

 private:
  using Json = nlohmann::ordered_json;
  enum class Interpolation { step, linear, sphere };  // sphere: along great circles
  struct Key {
    int frame;
    Json value;
  };
  struct Track {
    std::string target;  // JSON pointer
    Interpolation interpolation;
    std::vector<Key> keys;  // frames increase
  };

  Track read_track(const JsonValue& object) const;
  Interpolation read_interpolation(const JsonValue& object, const std::string& target) const;
  std::vector<Key> read_keys(const JsonValue& object, const Track& track) const;
  static Json value_at(const Track& track, int frame);

  Json document_;  // without the animation
  std::string file_;
  bool animated_ = false;
  int frames_ = 1;
  double frame_rate_hz_ = 30;
  std::vector<Track> tracks_;
};

}  // namespace vsgl::scene
