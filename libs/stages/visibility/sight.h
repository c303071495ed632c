#pragma once

// Which pixels see which nodes of a light tree.

#include <cstdint>
#include <span>
#include <vector>

#include "artifact/artifact.h"
#include "trace/tracer.h"

namespace vsgl::visibility {

struct Pair {
  std::uint32_t node;   // row of the lights
  std::uint32_t pixel;  // of the G-buffer, no background
};
inline constexpr std::size_t kMaxPairs = trace::PointPacket::kLanes;

// Bit i: of the i-th pair.
struct Seen {
  std::uint32_t facing = 0;   // a point of the node and the pixel are above each other's horizon
  std::uint32_t visible = 0;  // and nothing is in between
};

// A node is seen by the surface point that represents it; where that point and the pixel do not face each
// other, but other points of the node and the pixel might, by one that represents a descendant.
class Sight {
 public:
  // `normals`: of the lights' representative points. All must outlive the object.
  Sight(const GBuffer& gbuffer, const Lights& tree, std::span<const interop::vec3> normals);
  virtual ~Sight() = default;
  Sight(const Sight&) = delete;
  Sight& operator=(const Sight&) = delete;

  // Of up to kMaxPairs pairs. Both may be called from many threads.
  virtual Seen see(std::span<const Pair> pairs) const = 0;
  virtual std::uint32_t facing(std::span<const Pair> pairs) const;
  // What a look at a pair is called in reports.
  virtual const char* name() const = 0;

 protected:
  struct Point {
    interop::vec3 position, normal;
    std::uint32_t children;
    float extent;  // points of the node are that near, m
    float spread;  // cosines to normals of the node differ by less; 0: flat
    bool lit;
  };
  // The point that the pixel may see; null: none faces it.
  const Point* facing_point(Pair pair) const;
  const interop::Surface& pixel(Pair pair) const { return gbuffer_.pixels[pair.pixel]; }

 private:
  const GBuffer& gbuffer_;
  std::vector<Point> points_;
};

}  // namespace vsgl::visibility
