#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vsgl {

// A JSON value with its place (file and JSON pointer), read strictly: wrong types, values out of range,
// missing and unknown keys are errors E3010..E3014 that name file, pointer, what was expected and, for a key,
// the nearest known name.
class JsonValue {
 public:
  // Parses a file. Throws file_not_found, json_syntax (with line and column).
  static JsonValue parse_file(const std::filesystem::path& path);
  // Parses text; `origin` stands for the file name in messages.
  static JsonValue parse_text(const std::string& text, const std::string& origin);
  // A document that is made, not read.
  static JsonValue of(nlohmann::ordered_json document, const std::string& origin);

  double number(double minimum = -std::numeric_limits<double>::max(),
                double maximum = std::numeric_limits<double>::max()) const;
  std::int64_t integer(std::int64_t minimum, std::int64_t maximum) const;
  bool boolean() const;
  std::string string() const;
  // One of `choices`; the message lists them.
  std::string choice(const std::vector<std::string>& choices) const;
  std::vector<JsonValue> array(std::size_t minimum_length = 0,
                               std::size_t maximum_length = std::numeric_limits<std::size_t>::max()) const;
  // An array of exactly N numbers in the range.
  template <std::size_t N>
  std::array<double, N> numbers(double minimum = -std::numeric_limits<double>::max(),
                                double maximum = std::numeric_limits<double>::max()) const {
    std::array<double, N> out;
    const auto items = array(N, N);
    for (std::size_t i = 0; i < N; ++i) out[i] = items[i].number(minimum, maximum);
    return out;
  }

  // The member, which must exist / nothing where it is absent. Both mark the key as known.
  JsonValue at(const std::string& key) const;
  std::optional<JsonValue> find(const std::string& key) const;
  // Names of all members, in file order (for maps whose keys are the user's own names).
  std::vector<std::string> keys() const;
  // Throws json_unknown_key if the object has a member that neither at() nor find() asked for.
  void finish() const;

  // "scene.json: /lights/0/cone_deg"
  std::string where() const;
  const std::string& origin() const { return file_; }
  const nlohmann::ordered_json& raw() const { return *value_; }

 private:
  JsonValue(std::shared_ptr<const nlohmann::ordered_json> root, const nlohmann::ordered_json* value,
            std::string file, std::string pointer);
  std::shared_ptr<const nlohmann::ordered_json> root_;
  const nlohmann::ordered_json* value_;
  std::string file_, pointer_;
  std::shared_ptr<std::set<std::string>> known_;
};

// The candidate with the least edit distance to `word`, or "" when none is near.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace vsgl
