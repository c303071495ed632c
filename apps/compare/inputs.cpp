#include "inputs.h"

#include <cmath>
#include <stdexcept>

#include "base/error.h"

namespace vsgl::app {

double number_of(const std::string& flag, const std::string& text) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::logic_error&) {
    // Falls through to the same message.
  }
  throw Error(ErrorCode::bad_value, flag + ": '" + text + "' is not a number");
}

}  // namespace vsgl::app
