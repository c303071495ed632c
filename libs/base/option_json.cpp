#include "base/option_json.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "base/usage.h"

namespace vsgl::options {
namespace {

using Json = nlohmann::ordered_json;

// "kernel-scale", as CLI11 looks options of files up.
std::string bare_name(const CLI::Option& option) {
  const std::string name = long_name(option);
  return name.substr(name.find_first_not_of('-'));
}

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
  std::string key = bare_name(option);
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

namespace {

// The value as CLI11 takes it.
std::vector<std::string> arguments(const CLI::Option& option, const JsonValue& value) {
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
    arguments.push_back(argument(item));
  }
  return arguments;
}

// The members of an object that differ from the defaults of the options that they name.
std::vector<CLI::ConfigItem> members(const CLI::App& app, const JsonValue& object) {
  std::vector<CLI::ConfigItem> given;
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_configurable()) continue;
    const auto value = object.find(key_of(*option));
    if (!value || (!value->raw().is_null() && value->raw() == default_of(*option))) continue;
    CLI::ConfigItem item;
    item.name = bare_name(*option);
    item.inputs = arguments(*option, *value);
    given.push_back(item);
  }
  object.finish();
  return given;
}

// Whatever is wrong with a configuration is a usage error.
Error usage_error(const Error& error) {
  const bool unknown = error.code() == ErrorCode::json_unknown_key;
  return Error(unknown ? ErrorCode::unknown_option : ErrorCode::bad_value, error.what());
}

// An error of CLI11's parsing, or of an option's own, at the member that it is about.
Error located(const Error& error, const CLI::App& app, const JsonValue& object) {
  const std::string message = error.what();
  for (const CLI::Option* option : app.get_options()) {
    const std::string flag = long_name(*option) + ": ";
    if (message.starts_with(flag))
      return Error(error.code(), object.where() + "/" + key_of(*option) + ": " + message.substr(flag.size()));
  }
  return Error(error.code(), object.where() + ": " + message);
}

// Hands CLI11 the members of an object in place of a file.
class Members : public CLI::Config {
 public:
  explicit Members(std::vector<CLI::ConfigItem> given) : items_(std::move(given)) {}
  std::string to_config(const CLI::App*, bool, bool, std::string) const override { return ""; }
  std::vector<CLI::ConfigItem> from_config(std::istream&) const override { return items_; }

 private:
  std::vector<CLI::ConfigItem> items_;
};

}  // namespace

std::vector<CLI::ConfigItem> JsonConfig::from_config(std::istream& stream) const {
  const std::filesystem::path file = app_.get_config_ptr()->as<std::string>();
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto is_path = [this](const CLI::ConfigItem& item) {
    return std::any_of(paths_.begin(), paths_.end(),
                       [&](const CLI::Option* option) { return bare_name(*option) == item.name; });
  };
  try {
    auto given = members(app_, JsonValue::parse_text(text, file.string()));
    for (CLI::ConfigItem& item : given) {
      if (!is_path(item)) continue;
      for (std::string& path : item.inputs) path = (file.parent_path() / path).lexically_normal().string();
    }
    return given;
  } catch (const Error& error) {
    throw usage_error(error);
  }
}

void read_object(CLI::App& app, const JsonValue& object) {
  try {
    app.config_formatter(std::make_shared<Members>(members(app, object)));
  } catch (const Error& error) {
    throw usage_error(error);
  }
  try {
    std::istringstream nothing;
    app.parse_from_stream(nothing);
    usage::check_values(app);
  } catch (const CLI::ParseError& error) {
    throw located(usage::translate(error, app), app, object);
  } catch (const Error& error) {
    throw located(error, app, object);
  }
}

}  // namespace vsgl::options
