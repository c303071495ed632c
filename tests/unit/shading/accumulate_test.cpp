#include "stages/shading/accumulate.h"

#include <gtest/gtest.h>

#include "../expect_error.h"

namespace vsgl {
namespace {

Indirect image(float value) {
  Indirect out;
  out.width = 2;
  out.height = 1;
  out.diffuse = {{value, 2 * value, 0}, {1, 1, 1}};
  out.cancellation = {value / 8, 1};
  return out;
}

TEST(Accumulate, IsTheMeanOfAllPasses) {
  Indirect mean = image(1);
  float sum = 1;
  for (int pass = 2; pass <= 5; ++pass) {
    mean = accumulate(mean, image(static_cast<float>(pass * pass)), pass);
    sum += static_cast<float>(pass * pass);
  }
  EXPECT_EQ(mean.passes, 5);
  EXPECT_FLOAT_EQ(mean.diffuse[0].x, sum / 5);
  EXPECT_FLOAT_EQ(mean.diffuse[0].y, 2 * sum / 5);
  EXPECT_EQ(mean.diffuse[0].z, 0);
  EXPECT_EQ(mean.diffuse[1].x, 1);  // what is the same in all passes stays, bit by bit
  EXPECT_FLOAT_EQ(mean.cancellation[0], sum / 40);
}

TEST(Accumulate, WantsThePassesInTheirOrder) {
  test::expect_error(ErrorCode::bad_value, {"mean of 1 passes", "pass 3"},
                     [] { accumulate(image(1), image(2), 3); });
  test::expect_error(ErrorCode::bad_value, {"pass 1"}, [] { accumulate(image(1), image(2), 1); });
}

TEST(Accumulate, WantsImagesOfTheSameSizeAndLayers) {
  Indirect wide = image(1), direct = image(1);
  wide.width = 1;
  wide.height = 2;
  test::expect_error(ErrorCode::wrong_size, {"accumulate"}, [&] { accumulate(image(1), wide, 2); });
  direct.direct = direct.diffuse;
  test::expect_error(ErrorCode::invalid_data, {"accumulate", "direct"},
                     [&] { accumulate(image(1), direct, 2); });
}

}  // namespace
}  // namespace vsgl
