#include <cmath>
#include <cstring>
#include <future>
#include <numbers>

#include "scene/scene_sequence.h"
#include "scene_fixture.h"

namespace vsgl::test {
namespace {

using scene::Scene;
using scene::SceneSequence;

constexpr double degree = std::numbers::pi / 180;

class Animation : public ::testing::Test {
 protected:
  Animation() { folder.write_json("mesh.gltf", triangle_gltf(folder)); }

  // The basic scene, anchored at the origin, with a transform to move.
  static Json still() {
    Json out = SceneFolder::basic();
    out["anchor"] = {0, 0, 0};
    out["meshes"][0]["transform"] = {{"translation", {0, 0, 0}}, {"quaternion", {0, 0, 0, 1}}, {"scale", 1}};
    return out;
  }
  static Json key(int frame, const Json& value) { return {{"frame", frame}, {"value", value}}; }
  static Json track(const std::string& target, const std::vector<Json>& keys,
                    const std::string& interpolation = "linear") {
    return {{"target", target}, {"interpolation", interpolation}, {"keys", keys}};
  }
  static Json moving(const std::vector<Json>& tracks, int frames = 5) {
    Json out = still();
    out["animation"] = {{"frame_rate_hz", 24}, {"frames", frames}, {"tracks", tracks}};
    return out;
  }
  SceneSequence load(const Json& scene) const {
    return SceneSequence(folder.write_json("scene.json", scene));
  }
  void expect_bad(ErrorCode code, const Json& scene, std::vector<std::string> fragments) {
    SCOPED_TRACE(scene.dump());
    fragments.push_back("scene.json");
    expect_error(code, fragments, [&] { load(scene); });
  }
  void expect_bad_track(ErrorCode code, const Json& bad, const std::vector<std::string>& fragments) {
    expect_bad(code, moving({bad}), fragments);
  }
  SceneFolder folder;
};

void expect_equal(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.anchor, b.anchor);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.camera.position, b.camera.position);
  EXPECT_EQ(a.camera.forward, b.camera.forward);
  EXPECT_EQ(a.camera.up, b.camera.up);
  EXPECT_EQ(a.camera.tan_y, b.camera.tan_y);
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].position, b.lights[i].position);
    EXPECT_EQ(a.lights[i].forward, b.lights[i].forward);
    EXPECT_EQ(a.lights[i].intensity, b.lights[i].intensity);
    EXPECT_EQ(a.lights[i].cos_outer, b.lights[i].cos_outer);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].indices, b.instances[i].indices);
    ASSERT_EQ(a.instances[i].vertices.size(), b.instances[i].vertices.size());
    EXPECT_EQ(std::memcmp(a.instances[i].vertices.data(), b.instances[i].vertices.data(),
                          a.instances[i].vertices.size() * sizeof(scene::Vertex)),
              0);
  }
}

TEST_F(Animation, LinearTracksAreStraight) {
  const auto sequence =
      load(moving({track("/camera/position", {key(1, {0, 0, 5}), key(3, {2, 0, 6})}),
                   track("/camera/vertical_fov_deg", {key(0, 40), key(4, 80)}),
                   track("/lights/0/radiant_intensity_w_sr", {key(0, {10, 20, 30}), key(4, {30, 20, 10})})}));
  EXPECT_EQ(sequence.frames(), 5);
  EXPECT_EQ(sequence.frame_rate_hz(), 24);
  const Vec3 positions[] = {{0, 0, 5}, {0, 0, 5}, {1, 0, 5.5}, {2, 0, 6}, {2, 0, 6}};  // held at both ends
  for (int frame = 0; frame < 5; ++frame) {
    const Scene scene = sequence.at(frame);
    expect_near(scene.camera.position, positions[frame], 1e-15);
    EXPECT_NEAR(scene.camera.tan_y, std::tan((40 + 10 * frame) / 2.0 * degree), 1e-15);
    expect_near(scene.lights[0].intensity, {10.0 + 5 * frame, 20, 30.0 - 5 * frame}, 1e-14);
  }
}

TEST_F(Animation, StepHoldsTheKeyBefore) {
  const auto sequence = load(moving(
      {track("/lights/0/position", {key(0, {0, 5, 0}), key(2, {1, 5, 0}), key(4, {2, 5, 0})}, "step")}));
  for (int frame = 0; frame < 5; ++frame)
    EXPECT_EQ(sequence.at(frame).lights[0].position, (Vec3{static_cast<double>(frame / 2), 5, 0}));
}

TEST_F(Animation, RotationsTurnAtConstantSpeed) {
  const double s = std::sin(45 * degree), c = std::cos(45 * degree);
  // A quarter turn about z, once with the nearer and once with the farther of the two equal quaternions.
  for (const double sign : {1.0, -1.0}) {
    const auto sequence = load(moving({track("/meshes/0/transform/quaternion",
                                             {key(0, {0, 0, 0, 2}), key(4, {0, 0, sign * s, sign * c})})}));
    for (int frame = 0; frame < 5; ++frame) {
      const double angle = 22.5 * frame * degree;
      const Scene scene = sequence.at(frame);
      expect_near(position(scene.instances[0], 1), {std::cos(angle), std::sin(angle), 0}, 1e-7);
    }
  }
}

TEST_F(Animation, DirectionsFollowGreatCircles) {
  Json scene = moving({});
  scene["lights"][0].erase("target");
  scene["lights"][0]["direction"] = {0, -1, 0};
  scene["lights"][0]["up"] = {0, 0, -1};
  scene["animation"]["tracks"] =
      Json::array({track("/lights/0/direction", {key(0, {0, -3, 0}), key(4, {7, 0, 0})})});
  const auto sequence = load(scene);
  for (int frame = 0; frame < 5; ++frame) {
    const double angle = 22.5 * frame * degree;
    expect_near(sequence.at(frame).lights[0].forward, {std::sin(angle), -std::cos(angle), 0}, 1e-15);
  }
}

TEST_F(Animation, KeysAreTheStaticScene) {
  Json scene = moving({});
  scene["lights"][0].erase("target");
  scene["lights"][0]["direction"] = {0.1, -1, 0.3};
  const Json direction{-0.3, -1.7, 0.1}, position{0.1, 0.7, 4.9}, quaternion{0.1, 0.7, 0.3, 0.2};
  scene["animation"]["tracks"] = {
      track("/lights/0/direction", {key(0, {0.1, -1, 0.3}), key(3, direction), key(4, {1, -1, 0})}),
      track("/camera/position", {key(0, {0, 0, 5}), key(3, position)}),
      track("/meshes/0/transform/quaternion", {key(3, quaternion), key(4, {0, 0, 0, 1})})};
  Json still = scene;
  still.erase("animation");
  still["lights"][0]["direction"] = direction;
  still["camera"]["position"] = position;
  still["meshes"][0]["transform"]["quaternion"] = quaternion;
  const Scene frame = load(scene).at(3);
  Scene expected = scene::load_scene(folder.write_json("still.json", still));
  EXPECT_NEAR(frame.radius, expected.radius, 1e-6);  // of all frames
  expected.radius = frame.radius;
  expect_equal(frame, expected);
  expect_equal(scene::load_scene(folder / "scene.json", 3), frame);
}

TEST_F(Animation, AnchorAndRadiusHoldAllFrames) {
  Json scene = moving({track("/meshes/1/transform/translation", {key(0, {0, 0, 0}), key(4, {100, 0, 0})})});
  scene.erase("anchor");
  scene["meshes"].push_back(Json(scene["meshes"][0]));
  const auto sequence = load(scene);
  const Scene first = sequence.at(0);
  EXPECT_NEAR(first.anchor.x, 50, 4);
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    const Scene now = sequence.at(frame);
    EXPECT_EQ(now.anchor, first.anchor);
    EXPECT_EQ(now.radius, first.radius);
    for (const auto& instance : now.instances)
      for (std::size_t i = 0; i < instance.vertices.size(); ++i)
        EXPECT_LE(length(position(instance, i)), now.radius * (1 + 1e-6));
    // Only what moves has moved.
    EXPECT_EQ(position(now.instances[0], 0), position(first.instances[0], 0));
    expect_near(position(now.instances[1], 0) - position(first.instances[1], 0), {25.0 * frame, 0, 0}, 1e-5);
  }
}

TEST_F(Animation, WithoutItThereIsFrame0) {
  const auto sequence = load(still());
  EXPECT_EQ(sequence.frames(), 1);
  expect_equal(sequence.at(0), scene::load_scene(folder / "scene.json"));
  for (const int frame : {-1, 1})
    expect_error(ErrorCode::out_of_range, {"scene.json", "no frame " + std::to_string(frame), "0 to 0"},
                 [&] { sequence.at(frame); });
  expect_error(ErrorCode::out_of_range, {"scene.json", "no frame 5", "0 to 4"},
               [&] { load(moving({})).at(5); });
}

TEST_F(Animation, ThreadsSeeTheSameFrames) {
  const auto sequence =
      load(moving({track("/meshes/0/transform/quaternion", {key(0, {0, 0, 0, 1}), key(4, {0, 1, 0, 1})}),
                   track("/camera/position", {key(0, {0, 0, 5}), key(4, {2, 0, 6})})}));
  std::vector<std::future<Scene>> frames;
  for (int i = 0; i < 20; ++i)
    frames.push_back(std::async(std::launch::async, [&sequence, i] { return sequence.at(i % 5); }));
  for (int i = 0; i < 20; ++i) expect_equal(frames[i].get(), sequence.at(i % 5));
}

TEST_F(Animation, RefusesBadTracks) {
  const std::vector<Json> two{key(0, {0, 0, 5}), key(1, {0, 0, 6})};
  for (const char* target :
       {"/camera/positoin", "/materials/paint/alpha", "camera/position", "", "/lights/x/up",
        "/lights/01/position", "/meshes/0/transform/matrix", "/lights/9999999/position"})
    expect_bad_track(ErrorCode::json_out_of_range, track(target, two),
                     {"/animation/tracks/0/target", "cannot be animated"});
  for (const char* target :
       {"/lights/1/position", "/camera/up", "/meshes/0/transform/0/translation", "/lights/0/direction"})
    expect_bad_track(ErrorCode::json_out_of_range, track(target, two),
                     {"/animation/tracks/0/target", "no value at"});
  const auto position = [](const std::vector<Json>& keys) { return track("/camera/position", keys); };
  expect_bad_track(ErrorCode::json_out_of_range, position({key(1, {0, 0, 5}), key(1, {0, 0, 6})}),
                   {"/animation/tracks/0/keys/1/frame", "increase"});
  expect_bad_track(ErrorCode::json_out_of_range, position({key(5, {0, 0, 5})}),
                   {"/animation/tracks/0/keys/0/frame", "from 0 to 4"});
  expect_bad_track(ErrorCode::json_wrong_type, position({key(0, {0, 0, 5}), key(1, 3)}),
                   {"/animation/tracks/0/keys/1/value"});
  expect_bad_track(ErrorCode::json_out_of_range, position({key(0, {0, 0, 5}), key(1, {0, 5})}),
                   {"/animation/tracks/0/keys/1/value"});
  expect_bad_track(ErrorCode::json_wrong_type, position({key(0, {0, 0, "5"})}),
                   {"/animation/tracks/0/keys/0/value/2"});
  expect_bad_track(ErrorCode::json_out_of_range, position({}), {"/animation/tracks/0/keys"});
  expect_bad_track(ErrorCode::json_out_of_range, track("/camera/position", two, "cubic"),
                   {"/animation/tracks/0/interpolation"});
  Json unknown = position(two);
  unknown["key"] = 1;
  expect_bad_track(ErrorCode::json_unknown_key, unknown, {"/animation/tracks/0/key"});
  unknown = position(two);
  unknown["keys"][0]["time"] = 1;
  expect_bad_track(ErrorCode::json_unknown_key, unknown, {"/animation/tracks/0/keys/0/time"});
  expect_bad(ErrorCode::json_out_of_range, moving({position(two), position(two)}),
             {"/animation/tracks/1", "another track"});
  expect_bad_track(ErrorCode::json_out_of_range,
                   track("/meshes/0/transform/quaternion", {key(0, {0, 0, 0, 0})}),
                   {"keys/0/value", "length 0"});
}

TEST_F(Animation, RefusesBadFrames) {
  Json up = moving({});
  up["camera"]["up"] = {0, 1, 0};
  up["animation"]["tracks"] = Json::array({track("/camera/up", {key(0, {0, 1, 0}), key(4, {0, -2, 0})})});
  expect_bad(ErrorCode::json_out_of_range, up, {"/animation/tracks/0/keys/1/value", "opposite"});
  // What only the scene's reader finds, at the frame where it happens.
  expect_bad(ErrorCode::bad_camera,
             moving({track("/camera/position", {key(0, {0, 0, 5}), key(4, {0, 0, -5})})}),
             {"scene.json at frame 2: /camera"});
  expect_bad(ErrorCode::json_out_of_range,
             moving({track("/camera/vertical_fov_deg", {key(0, 40), key(2, 200), key(4, 40)})}),
             {"at frame 2: /camera/vertical_fov_deg"});
  expect_bad(ErrorCode::json_wrong_type, moving({track("/camera/vertical_fov_deg", {key(0, {1, 2, 3})})}),
             {"at frame 0: /camera/vertical_fov_deg"});
  // Faults of the file itself are not about a frame.
  Json broken = moving({});
  broken["camera"]["vertical_fov_deg"] = 200;
  try {
    load(broken);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("frame"), std::string::npos) << error.what();
  }
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, Json>>{{"frames", 0}, {"frames", 10001}, {"frame_rate_hz", 0}}) {
    Json scene = moving({});
    scene["animation"][name] = value;
    expect_bad(ErrorCode::json_out_of_range, scene, {"/animation/" + name});
    scene["animation"].erase(name);
    expect_bad(ErrorCode::json_missing_key, scene, {"/animation", name});
  }
}

}  // namespace
}  // namespace vsgl::test
