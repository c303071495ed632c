#include "cluster/borders.h"

#include <algorithm>
#include <limits>

#include "cluster/continuity.h"

namespace vsgl {
namespace {

constexpr int kTile = static_cast<int>(interop::TILE), kSpacing = 4, kLast = kTile / kSpacing;
// Tiles whose light differs by more, in errors that the cut aims at, differ for other reasons.
constexpr double kLargestDifference = 1.5;
// Light reflected by narrower lobes changes faster than the ring's pixels follow.
constexpr float kSharpAlpha = 0.1F;
static_assert(Cut::kRing == kTileSamples && Cut::kRing == 4 * static_cast<std::size_t>(kLast));

// A place of the ring, in spacings: 0..kLast.
struct Place {
  int x, y;
};
constexpr std::array<Place, Cut::kRing> kPlaces = [] {
  std::array<Place, Cut::kRing> out{};
  std::size_t k = 0;
  for (int y = 0; y <= kLast; ++y)
    for (int x = 0; x <= kLast; x += y % kLast == 0 ? 1 : kLast) out[k++] = {x, y};
  return out;
}();

constexpr std::size_t index_of(Place place) {
  if (place.y == 0) return static_cast<std::size_t>(place.x);
  if (place.y == kLast) return Cut::kRing - 1 - static_cast<std::size_t>(kLast - place.x);
  return static_cast<std::size_t>(kLast + 2 * place.y - 1 + place.x / kLast);
}
static_assert([] {
  for (std::size_t k = 0; k < kPlaces.size(); ++k)
    if (index_of(kPlaces[k]) != k) return false;
  return true;
}());

// The nearest coordinate in an image of that size.
int within(int coordinate, int size) {
  return std::min(coordinate, size - 1);
}

// Steps to the tiles that share a coordinate of the ring: from `least` to `most`.
constexpr int least_step(int place) {
  return place == 0 ? -1 : 0;
}
constexpr int most_step(int place) {
  return place == kLast ? 1 : 0;
}

// Weighted mean of the tiles that share a pixel of the ring; 0 where there is one alone, or they are not to
// be brought together.
class Meeting {
 public:
  void add(const TileRing& ring, std::size_t k) {
    if ((ring.present >> k & 1U) == 0) return;
    const double weight = static_cast<double>(ring.entries) * static_cast<double>(ring.entries);
    sum_ += weight * static_cast<double>(ring.light[k]);
    weights_ += weight;
    ++tiles_;
    least_ = std::min(least_, ring.light[k]);
    most_ = std::max(most_, ring.light[k]);
  }
  float mean(double error) const {
    const double largest = (1 + kLargestDifference * error) * static_cast<double>(least_);
    const bool alike = tiles_ > 1 && least_ > 0 && static_cast<double>(most_) <= largest;
    return alike ? static_cast<float>(sum_ / weights_) : 0;
  }

 private:
  int tiles_ = 0;
  double sum_ = 0, weights_ = 0;
  float least_ = std::numeric_limits<float>::max(), most_ = 0;
};

float gain_of(const Cut& cut, std::span<const TileRing> rings, int column, int row, std::size_t k) {
  const Place place = kPlaces[k];
  Meeting meeting;
  for (int y = std::max(row + least_step(place.y), 0);
       y <= std::min(row + most_step(place.y), cut.rows() - 1); ++y)
    for (int x = std::max(column + least_step(place.x), 0);
         x <= std::min(column + most_step(place.x), cut.columns() - 1); ++x)
      meeting.add(rings[static_cast<std::size_t>(y * cut.columns() + x)],
                  index_of({place.x - kLast * (x - column), place.y - kLast * (y - row)}));
  const float mean = meeting.mean(cut.error);
  return mean > 0 ? mean / rings[static_cast<std::size_t>(row * cut.columns() + column)].light[k] : 1;
}

float mix(float a, float b, float t) {
  return a + t * (b - a);
}

bool is_sharp(const interop::Surface& s) {
  return s.ndf != interop::NDF_NONE && s.alpha < kSharpAlpha &&
         std::max({s.specular.x, s.specular.y, s.specular.z}) > 0;
}

}  // namespace

TileSamples ring_samples(const GBuffer& gbuffer, int tile) {
  const int columns = (gbuffer.width + kTile - 1) / kTile, left = tile % columns * kTile,
            top = tile / columns * kTile;
  const auto surface = [&](int x, int y) -> const interop::Surface& {
    return gbuffer.pixels[static_cast<std::size_t>(y * gbuffer.width + x)];
  };
  TileSamples out;
  for (std::size_t k = 0; k < kPlaces.size(); ++k) {
    const int x = within(left + kSpacing * kPlaces[k].x, gbuffer.width),
              y = within(top + kSpacing * kPlaces[k].y, gbuffer.height);
    const interop::Surface &own = surface(std::min(x, left + kTile - 1), std::min(y, top + kTile - 1)),
                           &there = surface(x, y);
    if (own.id == interop::NO_INSTANCE || there.id == interop::NO_INSTANCE) continue;
    if (continuity(own, there) < kContinues || is_sharp(there)) continue;
    out.pixel[k] = static_cast<std::uint32_t>(y * gbuffer.width + x);
    out.present |= 1U << k;
  }
  return out;
}

void set_gains(Cut& cut, std::span<const TileRing> rings) {
  for (int row = 0; row < cut.rows(); ++row)
    for (int column = 0; column < cut.columns(); ++column) {
      const auto tile = static_cast<std::size_t>(row * cut.columns() + column);
      for (std::size_t k = 0; k < Cut::kRing; ++k)
        cut.tiles[tile].gain[k] = rings[tile].present >> k & 1U ? gain_of(cut, rings, column, row, k) : 1;
    }
}

float gain_at(const GBuffer& gbuffer, const Cut& cut, std::uint32_t pixel) {
  const int width = gbuffer.width, x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
  const int left = x / kTile * kTile, top = y / kTile * kTile;
  const Cut::Tile& tile = cut.tiles[static_cast<std::size_t>(y / kTile * cut.columns() + x / kTile)];
  const interop::Surface& surface = gbuffer.pixels[pixel];
  // What is added to 1 at a place of the ring.
  const auto at = [&](int i, int j) {
    const float gain = tile.gain[index_of({i, j})];
    if (gain == 1) return 0.0F;
    const int there_x = within(left + kSpacing * i, width),
              there_y = within(top + kSpacing * j, gbuffer.height);
    const interop::Surface& there = gbuffer.pixels[static_cast<std::size_t>(there_y * width + there_x)];
    return continuity(surface, there) < kContinues ? 0 : gain - 1;
  };
  const int i = (x - left) / kSpacing, j = (y - top) / kSpacing;
  const float along_x = static_cast<float>(x % kSpacing) / kSpacing,
              along_y = static_cast<float>(y % kSpacing) / kSpacing, u = static_cast<float>(x - left) / kTile,
              v = static_cast<float>(y - top) / kTile;
  const auto row = [&](int side) { return mix(at(i, side), at(i + 1, side), along_x); };
  const auto column = [&](int side) { return mix(at(side, j), at(side, j + 1), along_y); };
  const auto corners = [&](int side) { return mix(at(0, side), at(kLast, side), u); };
  return 1 + mix(column(0), column(kLast), u) + mix(row(0), row(kLast), v) -
         mix(corners(0), corners(kLast), v);
}

}  // namespace vsgl
