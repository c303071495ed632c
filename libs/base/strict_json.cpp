#include "base/strict_json.h"

#include <algorithm>
#include <cmath>

#include "base/atomic_file.h"
#include "base/error.h"

namespace vsgl {
namespace {

using Json = nlohmann::ordered_json;

std::string type_of(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  if (value.is_string()) return "a string";
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_null()) return "null";
  return value.dump();
}

// Bounds as the messages print them: "0", "0.001", "1e+30".
std::string print(double value) {
  return Json(value == std::floor(value) && std::abs(value) < 1e15 ? Json(static_cast<std::int64_t>(value))
                                                                   : Json(value))
      .dump();
}

std::string range_text(double minimum, double maximum) {
  constexpr double limit = std::numeric_limits<double>::max();
  if (minimum <= -limit && maximum >= limit) return "a finite number";
  if (maximum >= limit) return "at least " + print(minimum);
  if (minimum <= -limit) return "at most " + print(maximum);
  return "from " + print(minimum) + " to " + print(maximum);
}

// A member name as a token of a JSON pointer (RFC 6901).
std::string pointer_token(const std::string& key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

// nlohmann keeps the last of two equal keys silently; this refuses them while parsing.
class DuplicateKeys {
 public:
  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key && !keys_.back().insert(parsed.get<std::string>()).second) {
      duplicate = parsed.get<std::string>();
    }
    return true;
  }
  std::optional<std::string> duplicate;

 private:
  std::vector<std::set<std::string>> keys_;
};

// "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without the library's own label.
std::string plain_message(const Json::exception& error) {
  const std::string text = error.what();
  const auto end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t cost = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

[[noreturn]] void fail(ErrorCode code, const JsonValue& value, const std::string& message) {
  throw Error(code, value.where() + ": " + message);
}

}  // namespace

JsonValue::JsonValue(std::shared_ptr<const Json> root, const Json* value, std::string file,
                     std::string pointer)
    : root_(std::move(root)),
      value_(value),
      file_(std::move(file)),
      pointer_(std::move(pointer)),
      known_(std::make_shared<std::set<std::string>>()) {}

JsonValue JsonValue::parse_file(const std::filesystem::path& path) {
  return parse_text(read_text(path), path.string());
}

JsonValue JsonValue::parse_text(const std::string& text, const std::string& origin) {
  DuplicateKeys check;
  try {
    auto root = std::make_shared<const Json>(Json::parse(text, std::ref(check)));
    if (check.duplicate) {
      throw Error(ErrorCode::json_syntax,
                  origin + ": the key \"" + *check.duplicate + "\" appears twice in one object");
    }
    return JsonValue(root, root.get(), origin, "");
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::json_syntax, origin + ": " + plain_message(error));
  }
}

JsonValue JsonValue::of(Json document, const std::string& origin) {
  auto root = std::make_shared<const Json>(std::move(document));
  return JsonValue(root, root.get(), origin, "");
}

std::string JsonValue::where() const {
  return file_ + ": " + (pointer_.empty() ? "/" : pointer_);
}

double JsonValue::number(double minimum, double maximum) const {
  if (!value_->is_number())
    fail(ErrorCode::json_wrong_type, *this, "expected a number, got " + type_of(*value_));
  const double number = value_->get<double>();
  if (!(number >= minimum && number <= maximum)) {
    fail(ErrorCode::json_out_of_range, *this,
         value_->dump() + " is outside the range: " + range_text(minimum, maximum));
  }
  return number;
}

std::int64_t JsonValue::integer(std::int64_t minimum, std::int64_t maximum) const {
  if (!value_->is_number_integer()) {
    fail(ErrorCode::json_wrong_type, *this, "expected an integer, got " + type_of(*value_));
  }
  const bool huge =
      value_->is_number_unsigned() &&
      value_->get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const auto number = huge ? std::numeric_limits<std::int64_t>::max() : value_->get<std::int64_t>();
  if (huge || number < minimum || number > maximum) {
    fail(ErrorCode::json_out_of_range, *this,
         value_->dump() + " is outside the range: from " + std::to_string(minimum) + " to " +
             std::to_string(maximum));
  }
  return number;
}

bool JsonValue::boolean() const {
  if (!value_->is_boolean()) {
    fail(ErrorCode::json_wrong_type, *this, "expected true or false, got " + type_of(*value_));
  }
  return value_->get<bool>();
}

std::string JsonValue::string() const {
  if (!value_->is_string())
    fail(ErrorCode::json_wrong_type, *this, "expected a string, got " + type_of(*value_));
  return value_->get<std::string>();
}

std::string JsonValue::choice(const std::vector<std::string>& choices) const {
  const std::string text = string();
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return text;
  std::string list;
  for (const auto& c : choices) list += (list.empty() ? "" : ", ") + c;
  fail(ErrorCode::json_out_of_range, *this, "\"" + text + "\" is not one of: " + list);
}

std::vector<JsonValue> JsonValue::array(std::size_t minimum_length, std::size_t maximum_length) const {
  if (!value_->is_array())
    fail(ErrorCode::json_wrong_type, *this, "expected an array, got " + type_of(*value_));
  const std::size_t size = value_->size();
  if (size < minimum_length || size > maximum_length) {
    std::string wanted = std::to_string(minimum_length);
    if (maximum_length == std::numeric_limits<std::size_t>::max()) {
      wanted = "at least " + wanted;
    } else if (maximum_length != minimum_length) {
      wanted += " to " + std::to_string(maximum_length);
    }
    fail(ErrorCode::json_out_of_range, *this,
         "expected " + wanted + " elements, got " + std::to_string(size));
  }
  std::vector<JsonValue> items;
  for (std::size_t i = 0; i < size; ++i) {
    items.push_back(JsonValue(root_, &(*value_)[i], file_, pointer_ + "/" + std::to_string(i)));
  }
  return items;
}

JsonValue JsonValue::at(const std::string& key) const {
  const auto member = find(key);
  if (!member) fail(ErrorCode::json_missing_key, *this, "the key \"" + key + "\" is missing");
  return *member;
}

std::optional<JsonValue> JsonValue::find(const std::string& key) const {
  if (!value_->is_object())
    fail(ErrorCode::json_wrong_type, *this, "expected an object, got " + type_of(*value_));
  known_->insert(key);
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return JsonValue(root_, &*member, file_, pointer_ + "/" + pointer_token(key));
}

std::vector<std::string> JsonValue::keys() const {
  if (!value_->is_object())
    fail(ErrorCode::json_wrong_type, *this, "expected an object, got " + type_of(*value_));
  std::vector<std::string> names;
  for (const auto& [name, member] : value_->items()) names.push_back(name);
  return names;
}

void JsonValue::finish() const {
  for (const std::string& key : keys()) {
    if (known_->contains(key)) continue;
    const std::string near = nearest_name(key, {known_->begin(), known_->end()});
    throw Error(ErrorCode::json_unknown_key, file_ + ": " + pointer_ + "/" + pointer_token(key) +
                                                 ": no such key" +
                                                 (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  }
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance =
      std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;  // a third of the letters may be wrong
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace vsgl
