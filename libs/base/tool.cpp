#include "base/tool.h"

#include <omp.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "base/frame_name.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/option_json.h"
#include "base/usage.h"

namespace vsgl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "/proc/self/exe";

// stdout carries results only, so losing some of it is an error.
void print_stdout(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written)
    throw Error(ErrorCode::write_failed,
                std::string("standard output: writing failed: ") + std::strerror(errno));
}

// The phases, figures and omissions of a report, for people.
std::string table(const nlohmann::ordered_json& report) {
  std::string text;
  char line[128];
  for (const auto& phase : report["phases"]) {
    const auto name = phase["name"].get<std::string>();
    std::snprintf(line, sizeof line, "%-28s %9.3f s", name.c_str(), phase["host_s"].get<double>());
    text += line;
    if (phase.contains("device_s")) {
      std::snprintf(line, sizeof line, "  (device %.3f s)", phase["device_s"].get<double>());
      text += line;
    }
    text += "\n";
  }
  for (const auto& [name, value] : report["counts"].items()) {
    std::snprintf(line, sizeof line, "%-28s ", name.c_str());
    text += line + (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
  }
  for (const auto& skipped : report["skipped"]) {
    text += "skipped " + skipped["what"].get<std::string>() + ": " + skipped["why"].get<std::string>() + "\n";
  }
  return text;
}

// One argument of a command line, quoted where a shell needs it.
std::string quoted(const std::string& text) {
  const bool plain = text.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                         "_-+=.,:/@%") == std::string::npos;
  if (plain && !text.empty()) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// The arguments that stand for an option's value, behind its name.
std::string arguments(const CLI::Option& option, const nlohmann::ordered_json& value) {
  if (!value.is_array()) return quoted(value.is_string() ? value.get<std::string>() : value.dump());
  const char separator = option.get_delimiter() == '\0' ? ' ' : option.get_delimiter();
  std::string text;
  for (const auto& item : value) {
    if (!text.empty()) text += separator;
    text += quoted(item.is_string() ? item.get<std::string>() : item.dump());
  }
  return text;
}

void report_error(const std::string& tool, ErrorCode code, const std::string& message) {
  std::fprintf(stderr, "%s: error E%d: %s\n", tool.c_str(), static_cast<int>(code), message.c_str());
}

}  // namespace

Tool::Tool(std::string name, std::string summary) : name_(std::move(name)), app_(std::move(summary), name_) {
  app_.option_defaults()->always_capture_default();
  app_.formatter(std::make_shared<usage::HelpFormatter>());
  app_.config_formatter(std::make_shared<options::JsonConfig>(app_, paths_));
  add_common_options();
}

void Tool::add_common_options() {
  app_.option_defaults()->group(usage::kCommonGroup);
  app_.set_help_flag("-h,--help", "print this text and exit");
  app_.set_version_flag("--version", name_ + " (vsgltools) " VSGL_VERSION, "print the version and exit");
  CLI::Option* config = app_.set_config("--config", "", "JSON file of options; flags override it");
  config->type_name("FILE");
  CLI::Option* device =
      app_.add_option("--device", common_.device, "Vulkan device: auto, cpu, gpu or part of a device's name");
  CLI::Option* threads = app_.add_option("--threads", common_.threads, "worker threads; 0: one per core");
  threads->check(CLI::Range(0, 1024));
  app_.add_option("--seed", common_.seed, "seed of everything random");
  CLI::Option* json = app_.add_flag("--json", common_.json, "print the result as one JSON object");
  CLI::Option* dry_run =
      app_.add_flag("--dry-run", common_.dry_run, "print the resolved configuration as JSON and exit");
  dry_run->configurable(false);
  CLI::Option* overwrite =
      app_.add_flag("--overwrite", common_.overwrite, "replace outputs that are there already");
  CLI::Option* if_changed = app_.add_flag(
      "--if-changed", common_.if_changed,
      "do nothing where the outputs are there and this program made them of the same inputs and options");
  CLI::Option* progress = app_.add_option("--progress", common_.progress, "progress bars on a terminal");
  progress->check(CLI::IsMember({"auto", "never"}));
  CLI::Option* quiet = app_.add_flag("-q,--quiet", common_.quiet, "print errors only");
  CLI::Option* verbose = app_.add_flag("-v,--verbose", common_.verbose, "print more; -vv: even more");
  quiet->excludes(verbose);
  app_.add_flag("--no-skip", common_.no_skip, "compute even what the inputs do not need");
  app_.option_defaults()->group("Options");
  neutral_ = {app_.get_help_ptr(),
              app_.get_version_ptr(),
              config,
              device,
              threads,
              json,
              dry_run,
              overwrite,
              if_changed,
              progress,
              quiet,
              verbose};
}

CLI::Option* Tool::add_path(const std::string& flags, fs::path& path, const std::string& help) {
  CLI::Option* option = app_.add_option_function<std::string>(
      flags, [&path](const std::string& text) { path = text; }, help);
  option->type_name("FILE")->default_str(path.string());
  paths_.insert(option);
  return option;
}

CLI::Option* Tool::input(const std::string& flags, fs::path& path, const std::string& help) {
  CLI::Option* option = add_path(flags, path, help);
  inputs_.emplace_back(option, &path);
  return option;
}

CLI::Option* Tool::output(const std::string& flags, fs::path& path, const std::string& help) {
  CLI::Option* option = add_path(flags, path, help);
  outputs_.emplace_back(option, &path);
  neutral_.insert(option);
  return option;
}

CLI::Option* Tool::output_folder(const std::string& flags, fs::path& path, const std::string& help) {
  CLI::Option* option = add_path(flags, path, help)->type_name("FOLDER");
  neutral_.insert(option);
  return option;
}

CLI::Option* Tool::state(const std::string& flags, fs::path& path, const std::string& help) {
  CLI::Option* option = add_path(flags, path, help);
  neutral_.insert(option);
  return option;
}

void Tool::depends_on(const fs::path& path) {
  dependencies_.push_back(path);
}

bool Tool::parse(int argc, char** argv) {
  try {
    usage::check_flags(app_, {argv + 1, argv + argc});
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print_stdout(app_.help());
    return false;
  } catch (const CLI::CallForVersion& version) {
    print_stdout(std::string(version.what()) + "\n");
    return false;
  } catch (const CLI::ParseError& error) {
    throw usage::translate(error, app_);
  }
  usage::check_values(app_);
  check_conflicts();
  common_.config = app_.get_config_ptr()->as<std::string>();
  if (common_.dry_run) print_stdout(app_.config_to_str(true) + "\n");
  return !common_.dry_run;
}

// Each output is its own file and none of the inputs.
void Tool::check_conflicts() const {
  const auto resolve = [](const fs::path& path) {
    std::error_code ignored;
    const fs::path real = fs::weakly_canonical(path, ignored);
    return ignored ? path : real;
  };
  std::vector<std::pair<fs::path, std::string>> taken;
  for (const auto& [option, path] : inputs_) {
    if (!path->empty()) taken.emplace_back(resolve(*path), options::long_name(*option));
  }
  for (const auto& [option, path] : outputs_) {
    if (path->empty()) continue;
    for (const auto& [other, name] : taken) {
      if (other != resolve(*path)) continue;
      throw Error(ErrorCode::conflicting_options, options::long_name(*option) + ": " + path->string() +
                                                      " is also given as " + name +
                                                      "; choose another output");
    }
    taken.emplace_back(resolve(*path), options::long_name(*option));
  }
}

void Tool::check_inputs() const {
  for (const auto& [option, path] : inputs_) {
    std::error_code ignored;
    if (path->empty() || names_frames(*path) || fs::exists(*path, ignored)) continue;
    throw Error(ErrorCode::file_not_found,
                path->string() + ": no such file (" + options::long_name(*option) + ")");
  }
}

void Tool::check_outputs() const {
  for (const auto& [option, path] : outputs_) {
    if (!path->empty()) OutputSet::check(*path, common_.overwrite);
  }
}

std::string Tool::command_line() const {
  return command_line_without(neutral_);
}

std::string Tool::command_line_with_outputs() const {
  std::set<const CLI::Option*> left_out = neutral_;
  std::erase_if(left_out, [](const auto* option) { return option->get_group() != usage::kCommonGroup; });
  return command_line_without(left_out);
}

std::string Tool::command_line_without(const std::set<const CLI::Option*>& left_out) const {
  std::string line = name_;
  for (const CLI::Option* option : app_.get_options()) {
    nlohmann::ordered_json value = options::value_of(*option);
    if (left_out.contains(option) || value.is_null() || value == options::default_of(*option)) continue;
    if (paths_.contains(option)) value = fs::path(value.get<std::string>()).filename().string();
    const std::string name = options::long_name(*option);
    if (name.starts_with("-")) line += " " + name;
    if (!value.is_boolean()) line += " " + arguments(*option, value);
  }
  return line;
}

std::vector<fs::path> Tool::input_files() const {
  std::vector<fs::path> files;
  for (const auto& [option, path] : inputs_) {
    if (!path->empty() && !names_frames(*path)) files.push_back(*path);
  }
  files.insert(files.end(), dependencies_.begin(), dependencies_.end());
  return files;
}

Provenance Tool::provenance() const {
  if (hashed_.empty()) {
    for (const fs::path& file : input_files())
      hashed_.push_back({file.filename().string(), sha256_file(file)});
  }
  return {.tool = name_,
          .tool_version = VSGL_VERSION,
          .command_line = command_line(),
          .seed = common_.seed,
          .inputs = hashed_};
}

void Tool::print_result(const Report& report, const std::vector<fs::path>& outputs) const {
  using Json = nlohmann::ordered_json;
  if (common_.json) {
    Json names = Json::array();
    for (const fs::path& path : outputs) names.push_back(path.filename().string());
    Json result = {
        {"$schema", "vsgltools/result/1"}, {"tool", name_}, {"version", VSGL_VERSION}, {"outputs", names}};
    result.update(report.to_json());
    print_stdout(result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  } else if (!common_.quiet) {
    print_stdout(table(report.to_json()));
  }
}

Exit Tool::work(const std::function<Exit(Report&, OutputSet&)>& body) {
  check_inputs();
  Report report;
  if (const auto earlier = common_.if_changed ? earlier_run() : std::nullopt) {
    report.skipped(name_, "unchanged: the outputs are there, from the same inputs and options");
    print_result(report, earlier->output_paths());
    return static_cast<Exit>(earlier->status);
  }
  check_outputs();
  if (common_.threads > 0) omp_set_num_threads(common_.threads);
  set_log(name_, common_.quiet ? -1 : common_.verbose);
  set_progress(common_.progress == "auto" && !common_.quiet);
  OutputSet outputs(common_.overwrite);
  const Exit status = body(report, outputs);
  outputs.commit();
  if (common_.if_changed) remember_run(outputs, status);
  for (const std::string& warning : report.warnings()) log_warning(warning);
  print_result(report, outputs.targets());
  return status;
}

fs::path Tool::record_file() const {
  for (const auto& [option, path] : outputs_) {
    if (!path->empty()) return record_path(*path);
  }
  return {};
}

std::optional<RunRecord> Tool::earlier_run() const {
  const fs::path file = record_file();
  const bool sequences = std::any_of(inputs_.begin(), inputs_.end(),
                                     [](const PathOption& input) { return names_frames(*input.second); });
  if (file.empty() || sequences) return {};
  const auto record = read_record(file);
  const bool same = record && record->tool == name_ && record->program == sha256_file(kProgram) &&
                    record->command_line == command_line_with_outputs() &&
                    record->starts_with_inputs(input_files(), file) && record->holds(file);
  return same ? record : std::nullopt;
}

void Tool::remember_run(const OutputSet& outputs, Exit status) const {
  const fs::path file = record_file();
  if (file.empty() || outputs.targets().empty()) return;
  RunRecord record{.tool = name_,
                   .program = sha256_file(kProgram),
                   .command_line = command_line_with_outputs(),
                   .status = static_cast<int>(status)};
  const std::vector<fs::path> inputs = input_files();
  const std::vector<Provenance::Input> hashes = provenance().inputs;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    record.inputs.push_back({path_in_record(inputs[i], file), hashes[i].sha256});
  for (const fs::path& output : outputs.targets())
    record.outputs.push_back({path_in_record(output, file), sha256_file(output)});
  write_record(file, record);
}

int Tool::run(int argc, char** argv, const std::function<Exit(Report&, OutputSet&)>& body) {
  signal(SIGPIPE, SIG_IGN);  // a closed pipe shows as a failed write, which is reported
  OutputSet::remove_on_signals();
  try {
    return static_cast<int>(parse(argc, argv) ? work(body) : Exit::ok);
  } catch (const Error& error) {
    report_error(name_, error.code(), error.what());
    return static_cast<int>(error.exit());
  } catch (const std::bad_alloc&) {
    report_error(name_, ErrorCode::memory, "not enough memory; use smaller sizes");
    return static_cast<int>(Exit::io);
  } catch (const std::exception& error) {
    report_error(name_, ErrorCode::internal, std::string(error.what()) + "; this is a bug in the tool");
    return static_cast<int>(Exit::internal);
  }
}

}  // namespace vsgl
