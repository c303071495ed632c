#include "base/option_json.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/error.h"

namespace vsgl::options {
namespace {

using Json = nlohmann::ordered_json;

bool is_list(const CLI::Option& option) {
  return option.get_items_expected_max() > 1;
}

Json scalar(Kind kind, const std::string& text) {
  if (kind == Kind::text || !reads_as(kind, text)) return text;
  if (kind == Kind::number) return std::strtod(text.c_str(), nullptr);
  if (text.front() == '-') return std::strtoll(text.c_str(), nullptr, 0);
  return std::strtoull(text.c_str(), nullptr, 0);
}

// "[1,2,3]", as CLI11 prints the default of a list, or "1,2,3".
std::vector<std::string> split_default(std::string text) {
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
  return CLI::detail::split(text, ',');
}

Json flag_value(const CLI::Option& option) {
  if (option.get_multi_option_policy() != CLI::MultiOptionPolicy::TakeAll) {
    return option.count() > 0 && CLI::detail::to_flag_value(option.results().back()) > 0;
  }
  std::int64_t count = 0;
  for (const std::string& text : option.results()) count += CLI::detail::to_flag_value(text);
  return count;
}

Json to_json(const CLI::Option& option, const std::vector<std::string>& values) {
  const Kind kind = kind_of(option);
  if (!is_list(option)) return values.empty() || values.back().empty() ? Json() : scalar(kind, values.back());
  Json list = Json::array();
  for (const std::string& text : values) {
    if (!text.empty()) list.push_back(scalar(kind, text));
  }
  return list.empty() ? Json() : list;
}

bool matches(Kind kind, bool repeatable, const Json& value) {
  switch (kind) {
    case Kind::flag:
      return repeatable ? value.is_number_unsigned() : value.is_boolean();
    case Kind::integer:
      return value.is_number_integer();
    case Kind::number:
      return value.is_number();
    case Kind::text:
      return value.is_string();
  }
  return false;
}

std::string argument(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

Kind kind_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return Kind::flag;
  std::string type = option.get_type_name();
  if (!type.empty() && type.front() == '[') type.erase(0, 1);  // "[FLOAT,FLOAT,FLOAT]" of a tuple
  for (const auto& [prefix, kind] : {std::pair("INT", Kind::integer), std::pair("UINT", Kind::integer),
                                     std::pair("FLOAT", Kind::number)}) {
    if (type.starts_with(prefix)) return kind;
  }
  return Kind::text;
}

std::string long_name(const CLI::Option& option) {
  const auto& names = option.get_lnames();
  return names.empty() ? option.get_name() : "--" + names.front();
}

std::string key_of(const CLI::Option& option) {
  std::string key = long_name(option);
  key.erase(0, key.find_first_not_of('-'));
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

Json value_of(const CLI::Option& option) {
  if (kind_of(option) == Kind::flag) return flag_value(option);
  return option.count() > 0 ? to_json(option, option.results()) : default_of(option);
}

Json default_of(const CLI::Option& option) {
  if (kind_of(option) == Kind::flag) {
    return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll ? Json(0) : Json(false);
  }
  const std::string text = option.get_default_str();
  return to_json(option, is_list(option) ? split_default(text) : std::vector{text});
}

bool reads_as(Kind kind, const std::string& text) {
  if (kind == Kind::text || kind == Kind::flag) return true;
  if (text.empty() || std::isspace(static_cast<unsigned char>(text.front()))) return false;
  char* end = nullptr;
  if (kind == Kind::number) {
    const double value = std::strtod(text.c_str(), &end);
    return *end == '\0' && std::isfinite(value);
  }
  errno = 0;
  if (text.front() == '-') {
    std::strtoll(text.c_str(), &end, 0);
  } else {
    std::strtoull(text.c_str(), &end, 0);
  }
  return end != text.c_str() && *end == '\0' && errno == 0;
}

std::string describe(Kind kind) {
  switch (kind) {
    case Kind::flag:
      return "true or false";
    case Kind::integer:
      return "an integer";
    case Kind::number:
      return "a finite number";
    case Kind::text:
      return "a string";
  }
  return "";
}

std::string JsonConfig::to_config(const CLI::App* app, bool, bool, std::string) const {
  Json resolved = Json::object();
  for (const CLI::Option* option : app->get_options()) {
    if (!option->get_configurable()) continue;
    Json value = value_of(*option);
    if (value.is_null()) continue;
    if (paths_.contains(option))
      value = std::filesystem::absolute(value.get<std::string>()).lexically_normal().string();
    resolved[key_of(*option)] = value;
  }
  return resolved.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> JsonConfig::arguments(const CLI::Option& option, const JsonValue& value) const {
  const Kind kind = kind_of(option);
  const bool repeatable = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  const Json elements = is_list(option) ? value.raw() : Json::array({value.raw()});
  const std::string wanted = kind == Kind::flag && repeatable ? "a count" : describe(kind);
  std::vector<std::string> arguments;
  if (!elements.is_array())
    throw Error(ErrorCode::bad_value, value.where() + ": expected an array, got " + elements.dump());
  for (const Json& item : elements) {
    if (!matches(kind, repeatable, item)) {
      throw Error(ErrorCode::bad_value, value.where() + ": expected " + wanted + ", got " + item.dump());
    }
    std::string text = argument(item);
    if (paths_.contains(&option)) {
      const std::filesystem::path folder =
          std::filesystem::path(app_.get_config_ptr()->as<std::string>()).parent_path();
      text = (folder / text).lexically_normal().string();
    }
    arguments.push_back(text);
  }
  return arguments;
}

std::vector<CLI::ConfigItem> JsonConfig::from_config(std::istream& stream) const {
  const std::string file = app_.get_config_ptr()->as<std::string>();
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  try {
    const JsonValue root = JsonValue::parse_text(text, file);
    std::vector<CLI::ConfigItem> given;
    for (const CLI::Option* option : app_.get_options()) {
      if (!option->get_configurable()) continue;
      const auto value = root.find(key_of(*option));
      if (!value || (!value->raw().is_null() && value->raw() == default_of(*option))) continue;
      CLI::ConfigItem item;
      item.name = long_name(*option);
      item.name.erase(0, item.name.find_first_not_of('-'));
      item.inputs = arguments(*option, *value);
      given.push_back(item);
    }
    root.finish();
    return given;
  } catch (const Error& error) {  // whatever is wrong with a configuration is a usage error
    if (error.code() == ErrorCode::json_unknown_key) throw Error(ErrorCode::unknown_option, error.what());
    throw Error(ErrorCode::bad_value, error.what());
  }
}

}  // namespace vsgl::options
