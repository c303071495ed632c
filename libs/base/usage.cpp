#include "base/usage.h"

#include <algorithm>

#include "base/option_json.h"
#include "base/strict_json.h"

namespace vsgl::usage {
namespace {

// "1,2,3" from "[1,2,3]", as CLI11 prints lists.
std::string without_brackets(const std::string& text) {
  return text.starts_with("[") && text.ends_with("]") ? text.substr(1, text.size() - 2) : text;
}

// The type and checks of an option: "INT in [1 - 10]", "FLOAT >= 0", "{a,b}", "FILE".
std::string type_text(const CLI::Option& option) {
  const std::string type = without_brackets(option.get_type_name());
  const auto colon = type.find(':');
  if (colon == std::string::npos) return type;
  const std::string bound = type.substr(0, colon), checks = type.substr(colon + 1);
  if (checks == "NONNEGATIVE") return bound + " >= 0";
  if (checks == "POSITIVE") return bound + " > 0";
  const auto in = checks.find(" in ");
  return in == std::string::npos ? checks : bound + checks.substr(in);
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

Error count_error(const CLI::Option& option) {
  const std::string name = options::long_name(option);
  if (option.results().empty())
    return Error(ErrorCode::bad_value, name + ": needs a value: " + type_text(option));
  return Error(ErrorCode::bad_value, name + ": expected " + std::to_string(option.get_items_expected_max()) +
                                         " value(s), got " + std::to_string(option.results().size()));
}

Error value_error(const CLI::ParseError& error, const CLI::App& app) {
  const CLI::Option* option = mentioned_option(app, error.what());
  if (option == nullptr) return Error(ErrorCode::bad_value, error.what());
  const auto kind = options::kind_of(*option);
  const std::string name = options::long_name(*option);
  for (const std::string& text : option->results()) {
    if (!options::reads_as(kind, text)) {
      return Error(ErrorCode::bad_value,
                   name + ": expected " + options::describe(kind) + ", got \"" + text + "\"");
    }
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) return count_error(*option);
  const std::string given = CLI::detail::join(option->results(), " ");
  const std::string type = type_text(*option);
  if (kind == options::Kind::integer || kind == options::Kind::number) {
    return Error(ErrorCode::out_of_range, name + ": " + given + " is out of range: expected " + type);
  }
  if (type.starts_with("{"))
    return Error(ErrorCode::bad_value, name + ": \"" + given + "\" is not one of " + type);
  return Error(ErrorCode::bad_value, error.what());
}

// What CLI11 could not place, a misspelt flag before anything else; "" when nothing is left.
std::string left_over(const CLI::App& app) {
  const auto rest = app.remaining();
  const auto flag =
      std::find_if(rest.begin(), rest.end(), [](const std::string& text) { return text.starts_with("-"); });
  if (flag != rest.end()) return *flag;
  return rest.empty() ? "" : rest.front();
}

}  // namespace

// The description starts at this column, at least two spaces behind the option or on the next line.
std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  constexpr std::size_t column = 40;
  std::string line = "  " + make_option_name(option, is_positional) + make_option_opts(option);
  if (line.size() + 2 > column) {
    line += "\n" + std::string(column, ' ');
  } else {
    line.resize(column, ' ');
  }
  return line + make_option_desc(option) + "\n";
}

std::string HelpFormatter::make_option_name(const CLI::Option* option, bool is_positional) const {
  const std::string names = CLI::Formatter::make_option_name(option, is_positional);
  return CLI::detail::find_and_replace(names, ",", ", ");  // "-o, --output"
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (options::kind_of(*option) == options::Kind::flag) return "";
  std::string text = " " + type_text(*option);
  if (option->get_items_expected_max() > 1 && option->get_delimiter() == '\0') text += " ...";
  if (option->get_required()) text += " (required)";
  const std::string value = without_brackets(option->get_default_str());
  if (!value.empty()) text += " (default: " + value + ")";
  return text;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  std::vector<std::string> groups = app->get_groups();
  std::stable_partition(groups.begin(), groups.end(),
                        [](const std::string& group) { return group != kCommonGroup; });
  std::string text = make_description(app) + make_usage(app, name) + make_positionals(app);
  for (const std::string& group : groups) {
    const auto members = app->get_options(
        [&](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
    if (!members.empty()) text += make_group(group, false, members);
  }
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
    const bool is_unsigned = option->get_type_name().starts_with("UINT");
    for (const std::string& text : option->results()) {
      if (is_unsigned && text.starts_with("-")) {
        throw Error(ErrorCode::out_of_range,
                    options::long_name(*option) + ": " + text + " is out of range: expected at least 0");
      }
      if (!text.empty() && options::reads_as(kind, text)) continue;
      throw Error(ErrorCode::bad_value, options::long_name(*option) + ": expected " +
                                            (text.empty() ? "a value" : options::describe(kind)) +
                                            ", got \"" + text + "\"");
    }
  }
}

Error translate(const CLI::ParseError& error, const CLI::App& app) {
  const std::string message = error.what();
  const bool is_required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr ||
                           dynamic_cast<const CLI::RequiresError*>(&error) != nullptr;
  const std::string extra = left_over(app);
  if (extra.starts_with("-")) return Error(ErrorCode::unknown_option, unknown_flag(app, extra));
  if (!is_required && !extra.empty()) {
    return Error(ErrorCode::bad_value, "\"" + extra + "\": unexpected argument; see --help");
  }
  if (is_required) return Error(ErrorCode::missing_option, message + "; see --help");
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
    return Error(ErrorCode::conflicting_options, message + "; give only one of them");
  }
  if (dynamic_cast<const CLI::FileError*>(&error) != nullptr) {
    return Error(ErrorCode::bad_value, "--config: " + message);
  }
  return value_error(error, app);
}

}  // namespace vsgl::usage
