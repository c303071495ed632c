#include "base/usage.h"

#include <algorithm>

#include "base/option_json.h"
#include "base/strict_json.h"

namespace vsgl::usage {
namespace {

// The type and checks of an option: "INT in [1 - 10]", "{a,b}", "FILE".
std::string type_text(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto colon = type.find(':');
  if (colon == std::string::npos) return type;
  const std::string checks = type.substr(colon + 1);
  if (checks.front() == '{') return checks;
  const auto in = checks.find(" in ");
  return in == std::string::npos ? checks : type.substr(0, colon) + checks.substr(in);
}

std::string unknown_flag(const CLI::App& app, const std::string& flag) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string near = nearest_name(flag, names);
  return flag + ": no such option; " + (near.empty() ? "see --help" : "did you mean " + near + "?");
}

// The option that a CLI11 message is about; nullptr when it names none.
const CLI::Option* mentioned_option(const CLI::App& app, const std::string& message) {
  const CLI::Option* best = nullptr;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const auto found = message.find(name);
    const bool whole = found != std::string::npos && (found == 0 || message[found - 1] == ' ') &&
                       (found + name.size() == message.size() || message[found + name.size()] == ':' ||
                        message[found + name.size()] == ' ' || message[found + name.size()] == ',');
    if (whole && (best == nullptr || name.size() > best->get_name().size())) best = option;
  }
  return best;
}

Error value_error(const CLI::ParseError& error, const CLI::App& app) {
  const std::string message = error.what();
  const CLI::Option* option = mentioned_option(app, message);
  if (option == nullptr) return Error(ErrorCode::bad_value, message);
  const auto kind = options::kind_of(*option);
  const std::string name = options::long_name(*option);
  for (const std::string& text : option->results()) {
    if (!options::reads_as(kind, text)) {
      return Error(ErrorCode::bad_value,
                   name + ": expected " + options::describe(kind) + ", got \"" + text + "\"");
    }
  }
  const std::string given = CLI::detail::join(option->results(), " ");
  const std::string type = type_text(*option);
  const bool numeric = kind == options::Kind::integer || kind == options::Kind::number;
  if (numeric && dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) {
    return Error(ErrorCode::out_of_range, name + ": " + given + " is out of range: expected " + type);
  }
  if (!type.empty() && type.front() == '{') {
    return Error(ErrorCode::bad_value, name + ": \"" + given + "\" is not one of " + type);
  }
  return Error(ErrorCode::bad_value, message);
}

}  // namespace

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (options::kind_of(*option) == options::Kind::flag) return "";
  std::string text = " " + type_text(*option);
  if (option->get_items_expected_max() > 1 && option->get_delimiter() == '\0') text += " ...";
  if (option->get_required()) text += " (required)";
  if (!option->get_default_str().empty()) text += " (default: " + option->get_default_str() + ")";
  return text;
}

void check_flags(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--")) continue;
    const std::string flag = argument.substr(0, argument.find('='));
    if (app.get_option_no_throw(flag) == nullptr)
      throw Error(ErrorCode::unknown_option, unknown_flag(app, flag));
  }
}

void check_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const auto kind = options::kind_of(*option);
    if (kind == options::Kind::flag) continue;
    for (const std::string& text : option->results()) {
      if (!text.empty() && options::reads_as(kind, text)) continue;
      throw Error(ErrorCode::bad_value, options::long_name(*option) + ": expected " +
                                            (text.empty() ? "a value" : options::describe(kind)) +
                                            ", got \"" + text + "\"");
    }
  }
}

Error translate(const CLI::ParseError& error, const CLI::App& app) {
  const std::string message = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::string extra = app.remaining().empty() ? message : app.remaining().front();
    if (extra.starts_with("-")) return Error(ErrorCode::unknown_option, unknown_flag(app, extra));
    return Error(ErrorCode::bad_value, "\"" + extra + "\": unexpected argument; see --help");
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr ||
      dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
    return Error(ErrorCode::missing_option, message + "; see --help");
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
    return Error(ErrorCode::conflicting_options, message + "; give only one of them");
  }
  if (dynamic_cast<const CLI::FileError*>(&error) != nullptr) {
    return Error(ErrorCode::bad_value, "--config: " + message);
  }
  return value_error(error, app);
}

}  // namespace vsgl::usage
