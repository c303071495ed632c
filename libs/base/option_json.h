#pragma once

// Options as JSON: the form that --config reads, --dry-run prints, and that parts of larger files have.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/strict_json.h"

namespace vsgl::options {

enum class Kind { flag, integer, number, text };

// From the type of the variable that the option is bound to.
Kind kind_of(const CLI::Option& option);
// "--kernel-scale", or "scene" for a positional.
std::string long_name(const CLI::Option& option);
// "kernel_scale".
std::string key_of(const CLI::Option& option);

// What was given, or else the default; null when there is neither. Numbers as numbers, flags as true or false
// (repeatable ones as their count), lists as arrays.
nlohmann::ordered_json value_of(const CLI::Option& option);
nlohmann::ordered_json default_of(const CLI::Option& option);

// True when `text` reads as an option value of that kind (a number must be finite).
bool reads_as(Kind kind, const std::string& text);
// "an integer", for messages.
std::string describe(Kind kind);

// The reader and writer of --config files, for CLI::App::config_formatter(). Keys are key_of() of the
// options; values equal to the default count as not given; relative paths of `paths` options are taken
// relative to the file's folder.
class JsonConfig : public CLI::Config {
 public:
  JsonConfig(const CLI::App& app, const std::set<const CLI::Option*>& paths) : app_(app), paths_(paths) {}

  // The resolved configuration: every option that may stand in a file and has a value, in declaration order.
  std::string to_config(const CLI::App* app, bool, bool, std::string) const override;
  // Throws unknown_option or bad_value, naming file, JSON pointer and the nearest known key.
  std::vector<CLI::ConfigItem> from_config(std::istream& stream) const override;

 private:
  const CLI::App& app_;
  const std::set<const CLI::Option*>& paths_;
};

// Sets the options of `app` that are members of a JSON object, as --config would; the others keep their
// defaults. Throws unknown_option, bad_value or out_of_range, naming file, JSON pointer and the nearest known
// key.
void read_object(CLI::App& app, const JsonValue& object);

}  // namespace vsgl::options
