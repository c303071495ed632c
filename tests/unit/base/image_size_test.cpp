#include "base/image_size.h"

#include "folder_test.h"

namespace vsgl {
namespace {

TEST(ImageSize, ReadsSquaresAndRectangles) {
  const ImageSize square = read_image_size("--size", "512", 4096),
                  rectangle = read_image_size("--size", "640x360", 4096);
  EXPECT_EQ(square.width, 512);
  EXPECT_EQ(square.height, 512);
  EXPECT_EQ(rectangle.width, 640);
  EXPECT_EQ(rectangle.height, 360);
}

TEST(ImageSize, RefusesOtherText) {
  for (const char* text : {"", "x", "8x", "x8", "8x8x8", "8 x 8", "8.5", "large"})
    test::expect_error(ErrorCode::bad_value, "--size", [&] { read_image_size("--size", text, 4096); });
}

TEST(ImageSize, RefusesSidesOutsideTheRange) {
  for (const char* text : {"0", "-1", "0x8", "8x4097", "99999999999999999999"})
    test::expect_error(ErrorCode::out_of_range, "1 to 4096", [&] { read_image_size("--size", text, 4096); });
}

}  // namespace
}  // namespace vsgl
