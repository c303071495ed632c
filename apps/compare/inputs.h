#pragma once

// What every mode of compare reads and writes.

#include <filesystem>
#include <string>

namespace vsgl::app {

struct Inputs {
  std::filesystem::path test, reference;
  std::filesystem::path output;  // JSON; empty: none
  std::filesystem::path html;    // page; empty: none
};

// Throws bad_value, naming the flag, unless all of `text` is a finite number.
double number_of(const std::string& flag, const std::string& text);

}  // namespace vsgl::app
