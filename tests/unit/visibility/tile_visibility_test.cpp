// Masks of a tile's entries, against closed forms of who sees what.

#include "stages/visibility/tile_visibility.h"

#include <gtest/gtest.h>

#include <functional>

#include "lit_room.h"

namespace vsgl::visibility {
namespace {

using namespace vsgl::test;

// Pixels see a node where a predicate on their positions holds.
class Predicate final : public Sight {
 public:
  using Sees = std::function<bool(std::uint32_t node, Vec3 position)>;
  Predicate(const GBuffer& gbuffer, const Lights& tree, std::span<const interop::vec3> normals, Sees sees)
      : Sight(gbuffer, tree, normals), sees_(std::move(sees)) {}
  Seen see(std::span<const Pair> pairs) const override {
    Seen seen{facing(pairs), 0};
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (sees_(pairs[i].node, widen(pixel(pairs[i]).position))) seen.visible |= 1U << i;
    seen.visible &= seen.facing;
    return seen;
  }
  const char* name() const override { return "looks"; }

 private:
  Sees sees_;
};

// Three tiles by two of ceiling, lit by one node from the floor.
struct Ceiling {
  static constexpr int width = 44, height = 27;
  GBuffer gbuffer;
  Lights tree;
  std::vector<interop::vec3> normals;

  Ceiling() {
    std::vector<interop::Surface> pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) pixels.push_back(pixel_at({0.01 * x, 0.01 * y, 2}, {0, 0, -1}));
    gbuffer = gbuffer_of(std::move(pixels), width);
    tree = make_tree(room(), {make_light({0, 0, 0}, {0, 0, 1})});
    normals = {{0, 0, 1}};
  }

  TileVisibility find(int tile, Predicate::Sees sees, float share, const Detail& detail = {}) const {
    const Predicate sight(gbuffer, tree, normals, std::move(sees));
    const TileSamples samples = tile_samples(gbuffer, tile);
    TileCut cut;
    cut.entries.push_back({0, see_from_samples(sight, 0, samples).visible, share});
    return find_tile_visibility(TileGrid(gbuffer, tile, samples), samples, cut, sight, detail);
  }
  // The one node's bit of every pixel.
  std::vector<bool> image(const Predicate::Sees& sees, float share, const Detail& detail = {}) const {
    std::vector<bool> out(gbuffer.pixels.size());
    for (int tile = 0; tile < 6; ++tile) {
      const TileVisibility found = find(tile, sees, share, detail);
      const TileGrid grid(gbuffer, tile, tile_samples(gbuffer, tile));
      for (std::uint32_t bit = 0; bit < 256 && !found.masks.empty(); ++bit)
        if (grid.surfaces().test(bit)) out[grid.pixel(bit)] = found.masks[0].test(bit);
    }
    return out;
  }
};

// An oblique shadow boundary through all tiles.
bool beyond_line(std::uint32_t, Vec3 p) {
  return p.x + 0.6 * p.y > 0.27;
}
double pixels_from_line(Vec3 p) {
  return std::abs(p.x + 0.6 * p.y - 0.27) / std::hypot(1, 0.6) / 0.01;
}

TEST(TileVisibility, NodesThatMatterAreExactAcrossTiles) {
  const Ceiling ceiling;
  for (const Detail& detail : {Detail{}, Detail{.exact = true}}) {
    const auto bits = ceiling.image(beyond_line, 0.01F, detail);
    for (std::size_t i = 0; i < bits.size(); ++i)
      ASSERT_EQ(bits[i], beyond_line(0, widen(ceiling.gbuffer.pixels[i].position))) << i;
  }
}

// Bits of faint nodes are wrong near the shadow's boundary only: within the diagonal of a cell. Columns and
// rows where tiles meet are no worse than others: there are samples on both sides.
TEST(TileVisibility, FaintNodesAreInterpolatedWithoutSeams) {
  const Ceiling ceiling;
  const auto bits = ceiling.image(beyond_line, 0.001F);
  int wrong = 0, wrong_at_border = 0, at_border = 0;
  for (int y = 0; y < Ceiling::height; ++y)
    for (int x = 0; x < Ceiling::width; ++x) {
      const auto i = static_cast<std::size_t>(y * Ceiling::width + x);
      const Vec3 position = widen(ceiling.gbuffer.pixels[i].position);
      const bool is_wrong = bits[i] != beyond_line(0, position);
      const bool border = x % 16 == 0 || x % 16 == 15 || y % 16 == 0 || y % 16 == 15;
      EXPECT_LT(is_wrong ? pixels_from_line(position) : 0, 5 * std::sqrt(2.0)) << x << " " << y;
      wrong += is_wrong;
      wrong_at_border += is_wrong && border;
      at_border += border;
    }
  EXPECT_GT(wrong, 0);  // or it would not have been interpolated
  EXPECT_LT(wrong, 0.03 * static_cast<double>(bits.size()));
  EXPECT_LE(static_cast<double>(wrong_at_border) / at_border, 1.2 * wrong / static_cast<double>(bits.size()));
}

TEST(TileVisibility, AgreementNeedsNoLooks) {
  const Ceiling ceiling;
  const auto all = ceiling.find(
      0, [](auto, Vec3) { return true; }, 1);
  ASSERT_EQ(all.masks.size(), 1u);
  EXPECT_EQ(all.masks[0].count(), 256u);
  EXPECT_EQ(all.looks, 0u);
  const auto none = ceiling.find(
      0, [](auto, Vec3) { return false; }, 1);
  EXPECT_TRUE(none.nodes.empty());
  EXPECT_EQ(none.dropped, 1u);
  EXPECT_EQ(none.looks, 0u);
  // The boundary crosses two cells, one and two of the three rows of cells.
  EXPECT_EQ(ceiling.find(1, beyond_line, 1).looks, 5u * (5 + 6) + 5u * 5 + 6u * (5 + 5));
  EXPECT_EQ(ceiling.find(0, [](auto, Vec3) { return true; }, 1, {.exact = true}).looks, 256u);
}

// Two pixels that hang far below the ceiling: no sample speaks for them.
TEST(TileVisibility, UnmatchedPixelsLookForThemselves) {
  Ceiling ceiling;
  ceiling.gbuffer.pixels[3 * Ceiling::width + 3].position.z = 1;
  ceiling.gbuffer.pixels[3 * Ceiling::width + 4].position.z = 1.2F;
  const auto low = ceiling.find(
      0, [](auto, Vec3 p) { return p.z < 1.1; }, 1e-4F);
  ASSERT_EQ(low.nodes.size(), 1u);  // no sample sees it, one pixel does
  EXPECT_EQ(low.masks[0].count(), 1u);
  EXPECT_TRUE(low.masks[0].test(3 * 16 + 3));
  EXPECT_EQ(low.unmatched, 2u);
  EXPECT_EQ(low.looks, 2u);
  const auto high = ceiling.find(
      0, [](auto, Vec3 p) { return p.z > 1.1; }, 1e-4F);
  EXPECT_EQ(high.masks[0].count(), 255u);
  EXPECT_FALSE(high.masks[0].test(3 * 16 + 3));
}

// Samples behind the node's horizon have no say.
TEST(TileVisibility, OnlySamplesThatFaceTheNodeMustAgree) {
  Ceiling ceiling;
  for (std::size_t i = 0; i < ceiling.gbuffer.pixels.size(); ++i)
    if (i % Ceiling::width < 8) ceiling.gbuffer.pixels[i].position.z = -1;
  const auto found = ceiling.find(
      0, [](auto, Vec3 p) { return p.z > 0; }, 0.003F);
  ASSERT_EQ(found.nodes.size(), 1u);
  EXPECT_EQ(found.looks, 0u);
  EXPECT_EQ(found.mixed, 0u);
}

}  // namespace
}  // namespace vsgl::visibility
