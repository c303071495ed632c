// Interpolation of visibility between the samples of a tile.

#include "stages/visibility/tile_grid.h"

#include <gtest/gtest.h>

#include <random>

#include "lit_room.h"

namespace vsgl::visibility {
namespace {

using namespace vsgl::test;

// A floor seen from above, a pixel every centimetre.
GBuffer floor_pixels(int width, int height) {
  std::vector<interop::Surface> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) pixels.push_back(pixel_at({0.01 * x, 0.01 * y, 0}, {0, 0, 1}));
  return gbuffer_of(std::move(pixels), width);
}

void hide(interop::Surface& pixel) {
  pixel.id = interop::NO_INSTANCE;
}

TEST(TileGrid, InterpolatesLinearlyOnAPlane) {
  const GBuffer gbuffer = floor_pixels(16, 16);
  const TileGrid grid(gbuffer, 0, tile_samples(gbuffer, 0));
  EXPECT_EQ(grid.surfaces().count(), 256u);
  EXPECT_TRUE(grid.unmatched().none());
  EXPECT_EQ(grid.interpolate(0xFFFF), grid.surfaces());
  EXPECT_TRUE(grid.interpolate(0).none());
  // Columns 0 and 5 see: half-way to column 10 visibility passes 1/2.
  const TileMask left = grid.interpolate(0x3333);
  for (std::uint32_t bit = 0; bit < 256; ++bit) EXPECT_EQ(left.test(bit), bit % 16 <= 7) << bit;
  // Only sample (10, 5): pixels where the product of the tents reaches 1/2.
  const TileMask one = grid.interpolate(1U << 6);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const double tent =
          std::max(1 - std::abs(x - 10) / 5.0, 0.0) * std::max(1 - std::abs(y - 5) / 5.0, 0.0);
      EXPECT_EQ(one.test(static_cast<std::uint32_t>(16 * y + x)), tent >= 0.5) << x << " " << y;
    }
}

TEST(TileGrid, SamplesKeepTheirOwnBits) {
  const GBuffer gbuffer = floor_pixels(16, 16);
  const TileGrid grid(gbuffer, 0, tile_samples(gbuffer, 0));
  std::mt19937 random(7);
  for (int k = 0; k < 50; ++k) {
    const auto bits = static_cast<std::uint32_t>(random() & 0xFFFF);
    const TileMask mask = grid.interpolate(bits);
    for (std::uint32_t s = 0; s < 16; ++s)
      EXPECT_EQ(mask.test(16 * 5 * (s / 4) + 5 * (s % 4)), (bits >> s & 1U) != 0) << bits << " " << s;
  }
}

// 21 x 19 pixels: tile 1 has 5 columns, tile 2 three rows, tile 3 both.
TEST(TileGrid, TilesAtTheEdgesHandleTheirPixels) {
  const GBuffer gbuffer = floor_pixels(21, 19);
  std::vector<int> handled(gbuffer.pixels.size());
  for (int tile = 0; tile < 4; ++tile) {
    const TileGrid grid(gbuffer, tile, tile_samples(gbuffer, tile));
    EXPECT_TRUE(grid.unmatched().none()) << tile;
    EXPECT_EQ(grid.interpolate(0xFFFF), grid.surfaces()) << tile;
    for (std::uint32_t bit = 0; bit < 256; ++bit)
      if (grid.surfaces().test(bit)) ++handled[grid.pixel(bit)];
  }
  EXPECT_EQ(handled, std::vector<int>(gbuffer.pixels.size(), 1));
}

TEST(TileGrid, BackgroundHasNoSurface) {
  GBuffer gbuffer = floor_pixels(16, 16);
  for (std::size_t i = 0; i < 128; ++i) hide(gbuffer.pixels[i]);
  const TileGrid grid(gbuffer, 0, tile_samples(gbuffer, 0));
  EXPECT_EQ(grid.surfaces().count(), 128u);
  EXPECT_FALSE(grid.surfaces().test(127));
  EXPECT_EQ(grid.interpolate(0xFFFF) | grid.unmatched(), grid.surfaces());
}

// Neither what stands in front nor what is turned away continues the floor; what tilts by ten degrees does.
TEST(TileGrid, OtherSurfacesAreUnmatched) {
  GBuffer gbuffer = floor_pixels(16, 16);
  gbuffer.pixels[16 * 2 + 2].position.z = 0.2F;
  gbuffer.pixels[16 * 2 + 3].normal = {1, 0, 0};
  gbuffer.pixels[16 * 7 + 8].normal = narrow({0, std::sin(0.17), std::cos(0.17)});
  const TileGrid grid(gbuffer, 0, tile_samples(gbuffer, 0));
  EXPECT_EQ(grid.unmatched().count(), 2u);
  EXPECT_TRUE(grid.unmatched().test(16 * 2 + 2));
  EXPECT_TRUE(grid.unmatched().test(16 * 2 + 3));
  EXPECT_FALSE(grid.interpolate(0xFFFF).test(16 * 2 + 2));
}

// Along an edge between two planes pixels take the bits of their own side.
TEST(TileGrid, DoesNotInterpolateAcrossAnEdge) {
  GBuffer gbuffer = floor_pixels(16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 8; x < 16; ++x)
      gbuffer.pixels[static_cast<std::size_t>(16 * y + x)] =
          pixel_at({0.08, 0.01 * y, 0.01 * (x - 8)}, {-1, 0, 0});
  const TileGrid grid(gbuffer, 0, tile_samples(gbuffer, 0));
  const TileMask wall = grid.interpolate(0xCCCC);  // columns 10 and 15
  EXPECT_TRUE(grid.unmatched().none());
  for (std::uint32_t bit = 0; bit < 256; ++bit) EXPECT_EQ(wall.test(bit), bit % 16 >= 8) << bit;
}

}  // namespace
}  // namespace vsgl::visibility
