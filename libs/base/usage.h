#pragma once

// Help texts and usage errors of the tools, on top of CLI11. Internal to libs/base.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace vsgl::usage {

// The group of the options that every tool has; the help lists it last.
inline constexpr const char* kCommonGroup = "Common options";

// Help in the form `--count INT in [1 - 1048576] (default: 1024)`: help2man and the completion generator read
// it.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

// Throws unknown_option for the first argument that looks like a long flag and is none, with the nearest
// known flag. (CLI11 reports a missing required option first, which hides the misspelt one.)
void check_flags(const CLI::App& app, const std::vector<std::string>& arguments);
// Throws bad_value or out_of_range for values that CLI11 lets pass: NaN and infinity, empty paths, negative
// counts.
void check_values(const CLI::App& app);

// CLI11's parse error as a numbered one.
Error translate(const CLI::ParseError& error, const CLI::App& app);

}  // namespace vsgl::usage
