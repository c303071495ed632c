// Spheres fitted to meshes, and their file.

#include "stages/proxies/proxies.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "../expect_error.h"
#include "base/atomic_file.h"
#include "scene/procedural.h"
#include "scene/procedural/shapes.h"
#include "stages/proxies/polish.h"
#include "stages/proxies/sphere_set.h"
#include "stages/proxies/voxels.h"

namespace vsgl {
namespace {

using namespace proxies;
using test::expect_error;
using test::TemporaryFolder;
using Json = nlohmann::ordered_json;

constexpr double pi = std::numbers::pi;

Triangles triangles_of(const scene::ModelMesh& mesh) {
  Triangles out{{}, mesh.indices};
  for (const auto& p : mesh.positions)
    out.positions.push_back(
        {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
  return out;
}
Triangles ball_mesh(Vec3 center, double radius) {
  return triangles_of(scene::ball("ball", 0, center, radius));
}
Triangles box_mesh(Vec3 low, Vec3 high) {
  scene::Shapes shapes("box", 0);
  shapes.box(low, high);
  return triangles_of(shapes.take());
}
double volume_of(const Voxels& voxels) {
  return static_cast<double>(voxels.inside_count()) * std::pow(voxels.side, 3);
}

TEST(Voxels, HoldTheVolume) {
  EXPECT_NEAR(volume_of(voxelise(ball_mesh({1, 2, 3}, 0.5), 48)) / (4 * pi / 3 * 0.125), 1, 0.01);
  EXPECT_NEAR(volume_of(voxelise(box_mesh({0, 0, 0}, {1, 2, 4}), 48)) / 8, 1, 1e-9);
}

TEST(Voxels, AreAsManyInAnyBox) {
  for (const Vec3 extent : {Vec3{1, 1, 1}, {1, 2, 4}, {3, 0.2, 1}}) {
    const Voxels voxels = voxelise(box_mesh({0, 0, 0}, extent), 24);
    EXPECT_NEAR(static_cast<double>(voxels.of_box) / (24 * 24 * 24), 1, 0.1);
  }
  EXPECT_EQ(voxelise(box_mesh({0, 0, 0}, {0.001, 1, 0.001}), 24).of_box, 256u);
}

TEST(Voxels, AHoleDoesNotEmptyThem) {
  Triangles box = box_mesh({0, 0, 0}, {1, 1, 1});
  box.indices.erase(box.indices.begin(), box.indices.begin() + 3);
  EXPECT_NEAR(volume_of(voxelise(box, 32)), 1, 0.01);
}

TEST(Voxels, DistancesAreThoseOfBruteForce) {
  const Voxels voxels = voxelise(box_mesh({0, 0, 0}, {1, 0.5, 0.7}), 10);
  const std::vector<float> found = squared_distances(voxels);
  for (int z = 0; z < voxels.nz; ++z)
    for (int y = 0; y < voxels.ny; ++y)
      for (int x = 0; x < voxels.nx; ++x) {
        double least = 1e9;
        for (int k = 0; k < voxels.nz; ++k)
          for (int j = 0; j < voxels.ny; ++j)
            for (int i = 0; i < voxels.nx; ++i)
              if (voxels.inside[voxels.index(i, j, k)] == 0)
                least = std::min<double>(least, (x - i) * (x - i) + (y - j) * (y - j) + (z - k) * (z - k));
        EXPECT_EQ(found[voxels.index(x, y, z)], least) << x << " " << y << " " << z;
      }
}

TEST(Spheres, OfABallIsItself) {
  const SphereSet set = fit_spheres(ball_mesh({1, 2, 3}, 0.5), 16, 0.97, 0);
  ASSERT_EQ(set.spheres.size(), 1u);
  EXPECT_NEAR(set.spheres[0].radius, 0.5, 0.005);
  EXPECT_LE(length(set.spheres[0].center - Vec3{1, 2, 3}), 0.005);
  EXPECT_FALSE(set.sheet);
}

// Shares of a mesh's volume, by points at random all about mesh and spheres.
struct Misfit {
  double outside = 0, missed = 0;
};
template <class Inside>
Misfit misfit_at_random(const SphereSet& set, double extent, Inside inside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-extent, extent);
  double volume = 0;
  Misfit out;
  for (int n = 0; n < 400000; ++n) {
    const Vec3 p{uniform(random), uniform(random), uniform(random)};
    const bool of_mesh = inside(p), of_spheres = signed_distance(set.spheres, p) < 0;
    volume += of_mesh;
    out.outside += of_spheres && !of_mesh;
    out.missed += of_mesh && !of_spheres;
  }
  return {out.outside / volume, out.missed / volume};
}

// The union has the box's volume, and what is stated of its misfit is so wherever it lies.
TEST(Spheres, OfABox) {
  const Triangles box = box_mesh({-1, -0.5, -0.25}, {1, 0.5, 0.25});
  double last = 1;
  for (const std::size_t count : {1u, 4u, 16u}) {
    const SphereSet set = fit_spheres(box, static_cast<int>(count), 1, 0);
    EXPECT_EQ(set.spheres.size(), count);
    EXPECT_NEAR(set.volume_outside, set.volume_missed, 0.002) << count;
    const Misfit found = misfit_at_random(
        set, 1.2, [](Vec3 p) { return std::abs(p.x) < 1 && std::abs(p.y) < 0.5 && std::abs(p.z) < 0.25; });
    EXPECT_NEAR(set.volume_outside, found.outside, 0.01) << count;
    EXPECT_NEAR(set.volume_missed, found.missed, 0.01) << count;
    EXPECT_LT(set.volume_outside, last) << count;
    last = set.volume_outside;
  }
  EXPECT_LT(last, 0.09);
}

using Surface = std::function<scene::Shapes::Point(double s, double t)>;
Triangles surface_mesh(const Surface& at) {
  scene::Shapes shapes("surface", 0);
  shapes.surface(48, 24, at);
  return triangles_of(shapes.take());
}

// Balls of their cells' volumes miss a tenth of either.
TEST(Spheres, OfRoundShapesMissLittle) {
  const Triangles ring = surface_mesh([](double s, double t) {
    const double r = 0.4 - 0.15 * std::cos(2 * pi * t);
    return scene::Shapes::Point{
        {r * std::sin(2 * pi * s), 0.15 * std::sin(2 * pi * t), r * std::cos(2 * pi * s)}, {}};
  });
  const Triangles limb = surface_mesh([](double s, double t) {
    const double r = 0.2 * std::sqrt(std::sin(pi * t));
    return scene::Shapes::Point{{r * std::sin(2 * pi * s), -0.5 * std::cos(pi * t), r * std::cos(2 * pi * s)},
                                {}};
  });
  const SphereSet of_ring = fit_spheres(ring, 16, 1, 0), of_limb = fit_spheres(limb, 6, 1, 0);
  EXPECT_LE(of_ring.volume_missed, 0.05);
  EXPECT_LE(of_limb.volume_missed, 0.04);
}

double sum_of_volumes(const SphereSet& set) {
  double sum = 0;
  for (const Sphere& sphere : set.spheres) sum += 4 * pi / 3 * std::pow(sphere.radius, 3);
  return sum;
}

// The less overlaps are allowed, the less of the box is covered twice, and the less well.
TEST(Spheres, OverlapAtACost) {
  const Triangles box = box_mesh({-1, -0.5, -0.25}, {1, 0.5, 0.25});
  const SphereSet free = fit_spheres(box, 8, 1, 0), half = fit_spheres(box, 8, 1, 0.5),
                  full = fit_spheres(box, 8, 1, 1);
  EXPECT_LT(sum_of_volumes(half), 0.95 * sum_of_volumes(free));
  EXPECT_LT(sum_of_volumes(full), sum_of_volumes(half));
  EXPECT_LT(free.volume_missed, half.volume_missed);
  EXPECT_LT(half.volume_missed, full.volume_missed);
}

TEST(Polish, FindsTheBall) {
  const Vec3 center{1, 2, 3};
  const Voxels voxels = voxelise(ball_mesh(center, 0.5), 32);
  std::vector<Sphere> spheres{{center + Vec3{0.1, -0.05, 0.15}, 0.35}};
  polish(voxels, 0, spheres);
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_LE(length(spheres[0].center - center), voxels.side);
  EXPECT_NEAR(spheres[0].radius, 0.5, voxels.side);
}

TEST(Polish, DropsWhatOthersHold) {
  const Voxels voxels = voxelise(ball_mesh({}, 0.5), 32);
  std::vector<Sphere> spheres{{{}, 0.5}, {{}, 0.5}, {{0.1, 0, 0}, 0.2}};
  polish(voxels, 0, spheres);
  EXPECT_EQ(spheres.size(), 1u);
}

TEST(Spheres, OfASheetLieBehindIt) {
  scene::Shapes shapes("sheet", 0);
  shapes.grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 4, 4);
  const SphereSet set = fit_spheres(triangles_of(shapes.take()), 9, 0.97, 0);
  ASSERT_EQ(set.spheres.size(), 9u);
  EXPECT_TRUE(set.sheet);
  double area = 0;
  for (const Sphere& sphere : set.spheres) {
    EXPECT_NEAR(sphere.center.y, -sphere.radius, 1e-9);
    area += pi * sphere.radius * sphere.radius;
  }
  EXPECT_NEAR(area, 4, 1e-9);
}

TEST(Spheres, OfNothing) {
  EXPECT_TRUE(fit_spheres({}, 16, 0.97, 0).spheres.empty());
  EXPECT_TRUE(fit_spheres({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2}}, 16, 0.97, 0).spheres.empty());
}

// A generated scene on disk, read as a sequence.
class ProxyFit : public testing::Test {
 protected:
  scene::SceneSequence sequence(const std::string& name, const scene::GenerateOptions& options = {}) {
    for (const auto& file : scene::generate_scene(name, options, folder_ / "", "scene").files)
      std::ofstream(folder_ / file.name, std::ios::binary) << file.bytes;
    return scene::SceneSequence(folder_ / "scene.json");
  }
  Proxies fit(const scene::SceneSequence& from, int frame = 0, const ProxyParams& params = {}) {
    Report report;
    return fit_proxies(from, frame, params, report);
  }
  TemporaryFolder folder_;
};

TEST_F(ProxyFit, KeepsFloorsOut) {
  const Proxies found = fit(sequence("sky"));
  ASSERT_EQ(found.receivers.size(), 1u);
  EXPECT_EQ(found.receivers[0].name, "ground");
  ASSERT_EQ(found.objects.size(), 4u);
  EXPECT_EQ(found.objects[1].spheres.size(), 1u);
  for (const ProxyObject& object : found.objects)
    for (const ProxySphere& sphere : object.spheres) {
      const Vec3 expected = object.name == "block" ? Vec3{0.6, 0.15, 0.1} : Vec3{};
      EXPECT_LE(length(sphere.albedo - expected), 1e-6) << object.name;
    }
}

// Spheres keep to their mesh while it moves.
TEST_F(ProxyFit, MovesSpheresWithTheirInstance) {
  scene::GenerateOptions options;
  options.animate = "object";
  options.frames = 8;
  const auto frames = sequence("sky", options);
  const ProxyParams few{.count = 4};
  const Proxies first = fit(frames, 0, few), later = fit(frames, 5, few);
  const auto origins_first = frames.origins(0), origins_later = frames.origins(5);
  ASSERT_EQ(first.objects.size(), later.objects.size());
  bool moved = false;
  for (std::size_t i = 0; i < first.objects.size(); ++i) {
    const auto instance = static_cast<std::size_t>(first.objects[i].instance);
    const Vec3 way =
        origins_later[instance].transform.point({}) - origins_first[instance].transform.point({});
    moved |= length(way) > 0;
    ASSERT_EQ(first.objects[i].spheres.size(), later.objects[i].spheres.size());
    for (std::size_t k = 0; k < first.objects[i].spheres.size(); ++k) {
      const ProxySphere &a = first.objects[i].spheres[k], &b = later.objects[i].spheres[k];
      EXPECT_LE(length(b.center - a.center - way), 1e-9);
      EXPECT_NEAR(a.radius, b.radius, 1e-12);
    }
  }
  EXPECT_TRUE(moved);
}

TEST_F(ProxyFit, AnyNumberOfThreadsGivesTheSame) {
  const auto scene = sequence("sky");
  const auto bytes = [&](int threads) {
    omp_set_num_threads(threads);
    write(folder_ / "p.json", fit(scene, 0, {.count = 4}), {});
    return read_text(folder_ / "p.json");
  };
  const int threads = omp_get_max_threads();
  EXPECT_EQ(bytes(1), bytes(3));
  omp_set_num_threads(threads);
}

TEST_F(ProxyFit, ReadsWhatItWrites) {
  const Proxies made = fit(sequence("sky"), 0, {.count = 3, .receivers = {"ball1"}});
  write(folder_ / "p.json", made, {"proxy-fit", "0.1.0", "proxy-fit scene.json", 0, {{"scene.json", "ab"}}});
  const Proxies read = read_proxies(folder_ / "p.json");
  EXPECT_EQ(read.anchor, made.anchor);
  ASSERT_EQ(read.receivers.size(), 2u);
  EXPECT_EQ(read.receivers[1].name, "ball1");
  ASSERT_EQ(read.objects.size(), made.objects.size());
  for (std::size_t i = 0; i < made.objects.size(); ++i) {
    EXPECT_EQ(read.objects[i].name, made.objects[i].name);
    EXPECT_EQ(read.objects[i].instance, made.objects[i].instance);
    EXPECT_EQ(read.objects[i].errors.surface_distance_rms, made.objects[i].errors.surface_distance_rms);
    ASSERT_EQ(read.objects[i].spheres.size(), made.objects[i].spheres.size());
    for (std::size_t k = 0; k < made.objects[i].spheres.size(); ++k) {
      EXPECT_EQ(read.objects[i].spheres[k].center, made.objects[i].spheres[k].center);
      EXPECT_EQ(read.objects[i].spheres[k].radius, made.objects[i].spheres[k].radius);
      EXPECT_EQ(read.objects[i].spheres[k].albedo, made.objects[i].spheres[k].albedo);
    }
  }
}

// A node for each sphere: a unit ball, made as large as it and put where it is.
TEST_F(ProxyFit, ShowsSpheresAsGltf) {
  const Proxies made = fit(sequence("sky"), 0, {.count = 3});
  const std::string glb = proxies_glb(made);
  ASSERT_EQ(glb.substr(0, 4), "glTF");
  std::uint32_t size = 0;
  std::memcpy(&size, &glb[12], sizeof size);
  const Json model = Json::parse(glb.substr(20, size));
  std::vector<Json> shown;
  for (const Json& node : model["nodes"])
    if (node.contains("mesh")) shown.push_back(node);
  const std::vector<ProxySphere> spheres = made.spheres();
  ASSERT_EQ(shown.size(), spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto matrix = shown[i]["matrix"].get<std::vector<double>>();
    for (const int diagonal : {0, 5, 10}) EXPECT_EQ(matrix[diagonal], spheres[i].radius);
    EXPECT_EQ((Vec3{matrix[12], matrix[13], matrix[14]}), spheres[i].center);
    const Json& mesh = model["meshes"][shown[i]["mesh"].get<std::size_t>()];
    const Json& material = model["materials"][mesh["primitives"][0]["material"].get<std::size_t>()];
    const auto colour = material["pbrMetallicRoughness"]["baseColorFactor"].get<std::vector<double>>();
    EXPECT_LE(length(Vec3{colour[0], colour[1], colour[2]} - spheres[i].albedo), 1e-6);
  }
}

TEST_F(ProxyFit, BadParametersAreErrors) {
  const auto scene = sequence("sky");
  expect_error(ErrorCode::out_of_range, {"count: 0"}, [&] { fit(scene, 0, {.count = 0}); });
  expect_error(ErrorCode::out_of_range, {"cover"}, [&] { fit(scene, 0, {.cover = 2}); });
  expect_error(ErrorCode::out_of_range, {"overlap_cost"}, [&] { fit(scene, 0, {.overlap_cost = 2}); });
  expect_error(ErrorCode::bad_value, {"no node \"moon\""}, [&] { fit(scene, 0, {.receivers = {"moon"}}); });
  expect_error(ErrorCode::out_of_range, {"no frame 1"}, [&] { fit(scene, 1); });
}

}  // namespace
}  // namespace vsgl
