#include "scene/procedural/animate.h"

#include <cmath>
#include <numbers>

#include "scene/scene_spec.h"

namespace vsgl::scene {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180;
constexpr double frame_rate_hz = 60;  // so that the band of 5 to 20 Hz, where flicker is seen best, is there
constexpr int frames_each_way = 64;

Json array_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

// A view's axes, upright as the .glb has them.
struct Axes {
  Vec3 right, up, forward;
  explicit Axes(const ModelView& view) {
    const Vec3 towards = view.target - view.position;
    const bool vertical = std::abs(towards.y) > 0.999 * length(towards);
    make_frame(towards, vertical ? Vec3{0, 0, -1} : Vec3{0, 1, 0}, right, up, forward);
  }
};

// The track whose value at the frame f is value(g), g = 0, 1, .. 64, 63, .. 0, 1, .., where the way between
// two turning points is what interpolation makes of it.
template <class Value>
Json track(const std::string& target, int frames, Value value) {
  Json keys = Json::array();
  const auto add = [&](int frame) {
    const int phase = frame % (2 * frames_each_way);
    const int there_and_back = phase <= frames_each_way ? phase : 2 * frames_each_way - phase;
    keys.push_back({{"frame", frame}, {"value", array_of(value(there_and_back))}});
  };
  for (int frame = 0; frame < frames - 1; frame += frames_each_way) add(frame);
  add(frames - 1);
  return {{"target", target}, {"keys", keys}};
}

class Animator {
 public:
  Animator(Json& scene, const Model& model, const GenerateOptions& options)
      : scene_(scene), model_(model), options_(options), frames_(options.frames.value_or(frames_each_way)) {}

  void light() {
    const ModelView& light = model_.light;
    const Axes axes(light);
    const double intensity = model_.light_intensity_w_sr * options_.scale * options_.scale;
    scene_["lights"] = Json::array({{{"name", "light"},
                                     {"type", "spot"},
                                     {"position", array_of(world(light.position))},
                                     {"direction", array_of(axes.forward)},
                                     {"radiant_intensity_w_sr", intensity},
                                     {"inner_cone_deg", model_.light_inner_deg},
                                     {"outer_cone_deg", light.fov_deg}}});
    move({track("/lights/0/direction", frames_, [&](int g) {
      const double angle = 0.25 * g * degree;
      return g == 0 ? axes.forward : std::cos(angle) * axes.forward + std::sin(angle) * axes.right;
    })});
  }

  void camera() {
    const ModelView& camera = model_.camera;
    const double half_height =
        std::tan(camera.fov_deg / 2 * degree) * length(camera.target - camera.position);
    const Vec3 step = Axes(camera).right * (2 * half_height / options_.height.value_or(model_.height));
    scene_["camera"] = {{"position", array_of(world(camera.position))},
                        {"target", array_of(world(camera.target))},
                        {"vertical_fov_deg", camera.fov_deg}};
    const auto moved = [&](Vec3 point) { return [=, this](int g) { return world(point + g * step); }; };
    move({track("/camera/position", frames_, moved(camera.position)),
          track("/camera/target", frames_, moved(camera.target))});
  }

  // The cube's half side is a quarter of the cone's radius where it crosses, near enough to the light to be
  // above all that stands on the floor.
  GeneratedFile object(const std::string& stem) {
    const ModelView& light = model_.light;
    const Vec3 centre = light.position + 0.3 * (light.target - light.position);
    const double radius = length(centre - light.position) * std::tan(light.fov_deg * degree);
    const Vec3 right = Axes(light).right;
    const auto at = [&](int g) { return centre + right * (radius * (2.0 * g / frames_each_way - 1)); };
    const std::string file = stem + "-object.obj";
    scene_["materials"]["object"] = {{"diffuse", 0.7}, {"specular", 0}};
    scene_["meshes"].push_back(
        {{"file", file},
         {"transform", Json::array({{{"translation", array_of(options_.offset)}, {"scale", options_.scale}},
                                    {{"translation", array_of(at(0))}, {"scale", radius / 4}}})},
         {"material", "object"}});
    const std::string index = std::to_string(scene_["meshes"].size() - 1);
    move({track("/meshes/" + index + "/transform/1/translation", frames_, at)});
    return {file, cube};
  }

  // A key every fourth frame.
  void figure() {
    std::vector<Json> tracks;
    for (std::size_t i = 0; i < model_.parts.size(); ++i)
      for (std::size_t k = 0; k < model_.parts[i].joints.size(); ++k) {
        const ModelJoint& joint = model_.parts[i].joints[k];
        if (joint.swing_deg == 0) continue;
        const auto at = [&](int frame) {
          const int cycle = 2 * frames_each_way;
          const double turns = joint.phase + static_cast<double>(frame % cycle) / cycle;
          return joint.rotation_deg + Vec3{joint.swing_deg * std::sin(2 * std::numbers::pi * turns), 0, 0};
        };
        Json keys = Json::array();
        const auto add = [&](int frame) {
          keys.push_back({{"frame", frame}, {"value", array_of(at(frame))}});
        };
        for (int frame = 0; frame < frames_ - 1; frame += 4) add(frame);
        add(frames_ - 1);
        // The scene's own transform and mesh come first.
        tracks.push_back({{"target", "/meshes/" + std::to_string(i + 1) + "/transform/" +
                                         std::to_string(k + 1) + "/rotation_deg"},
                          {"keys", keys}});
      }
    move(tracks);
  }

 private:
  static constexpr const char* cube =
      "# a cube from -1 to 1, its faces counter-clockwise from outside\n"
      "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

  Vec3 world(Vec3 point) const { return options_.scale * point + options_.offset; }

  void move(const std::vector<Json>& tracks) {
    scene_["animation"] = {{"frame_rate_hz", frame_rate_hz}, {"frames", frames_}, {"tracks", tracks}};
  }

  Json& scene_;
  const Model& model_;
  const GenerateOptions& options_;
  int frames_;
};

}  // namespace

std::vector<GeneratedFile> animate(Json& scene, const Model& model, const GenerateOptions& options,
                                   const std::string& stem) {
  Animator animator(scene, model, options);
  if (options.animate == "light") animator.light();
  if (options.animate == "camera") animator.camera();
  if (options.animate == "object" && !model.parts.empty())
    animator.figure();
  else if (options.animate == "object")
    return {animator.object(stem)};
  return {};
}

}  // namespace vsgl::scene
