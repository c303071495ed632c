#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace vsgl::scene {

struct Mesh;

// What an instance of a scene was made of.
struct InstanceOrigin {
  const Mesh* mesh;  // in its own coordinates; lives as long as the sequence
  Mat4 transform;    // to those of the scene, relative to its anchor
};

// The frames of an animated scene; a scene without animation has the frame 0 only. Mesh files and textures
// are read once. Anchor and radius are the same for all frames, so that their artifacts can be compared: the
// radius is that of a sphere about the anchor that holds all vertices of all frames.
class SceneSequence {
 public:
  // Reads the scene JSON, checks it at every frame, and reads everything that it refers to. Throws what
  // load_scene() throws; a message about a frame names it.
  explicit SceneSequence(const std::filesystem::path& json_path);
  ~SceneSequence();
  SceneSequence(SceneSequence&&) noexcept;
  SceneSequence& operator=(SceneSequence&&) noexcept;

  int frames() const;
  double frame_rate_hz() const;  // 30 without animation
  // Throws out_of_range unless 0 <= frame < frames(), and mesh_invalid, bad_camera, bad_light. Any number of
  // threads may call it at once.
  Scene at(int frame) const;
  // Of each instance of at(frame), in their order.
  std::vector<InstanceOrigin> origins(int frame) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vsgl::scene
