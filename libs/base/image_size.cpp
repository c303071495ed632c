#include "base/image_size.h"

#include <charconv>
#include <string_view>

#include "base/error.h"

namespace vsgl {

ImageSize read_image_size(const std::string& flag, const std::string& text, int limit) {
  const auto side = [&](std::string_view digits) {
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool too_large = error == std::errc::result_out_of_range;
    if ((error != std::errc() && !too_large) || end != digits.data() + digits.size())
      throw Error(ErrorCode::bad_value, flag + ": \"" + text + "\" is no size; give WIDTHxHEIGHT, as 640x360");
    if (too_large || value < 1 || value > limit)
      throw Error(ErrorCode::out_of_range,
                  flag + ": " + text + ": sides must be from 1 to " + std::to_string(limit));
    return value;
  };
  const std::string_view view = text;
  const std::size_t x = view.find('x');
  if (x == std::string_view::npos) {
    const int both = side(view);
    return {both, both};
  }
  return {side(view.substr(0, x)), side(view.substr(x + 1))};
}

}  // namespace vsgl
