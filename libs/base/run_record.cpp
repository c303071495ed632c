#include "base/run_record.h"

#include <algorithm>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/strict_json.h"

namespace vsgl {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kSchema = "vsgltools/run/1";

ordered_json to_json(const std::vector<RunRecord::File>& files) {
  ordered_json list = ordered_json::array();
  for (const auto& file : files) list.push_back({{"file", file.path.string()}, {"sha256", file.sha256}});
  return list;
}

std::vector<RunRecord::File> files_of(const JsonValue& list) {
  std::vector<RunRecord::File> files;
  for (const JsonValue& file : list.array())
    files.push_back({file.at("file").string(), file.at("sha256").string()});
  return files;
}

}  // namespace

bool RunRecord::starts_with_inputs(const std::vector<fs::path>& given, const fs::path& file) const {
  return given.size() <= inputs.size() &&
         std::equal(given.begin(), given.end(), inputs.begin(), [&](const fs::path& path, const File& input) {
           return path_in_record(path, file) == input.path;
         });
}

bool RunRecord::holds(const fs::path& file) const {
  const auto is_same = [&](const File& recorded) {
    const fs::path path = file.parent_path() / recorded.path;
    return fs::is_regular_file(path) && sha256_file(path) == recorded.sha256;
  };
  return std::all_of(inputs.begin(), inputs.end(), is_same) &&
         std::all_of(outputs.begin(), outputs.end(), is_same);
}

std::vector<fs::path> RunRecord::output_paths() const {
  std::vector<fs::path> paths;
  for (const File& output : outputs) paths.push_back(output.path);
  return paths;
}

fs::path path_in_record(const fs::path& path, const fs::path& file) {
  return fs::absolute(path).lexically_normal().lexically_relative(
      fs::absolute(file).lexically_normal().parent_path());
}

fs::path record_path(const fs::path& output) {
  return output.parent_path() / ("." + output.filename().string() + ".run.json");
}

std::optional<RunRecord> read_record(const fs::path& path) {
  if (!fs::is_regular_file(path)) return {};
  try {
    const JsonValue root = JsonValue::parse_file(path);
    if (root.at("$schema").string() != kSchema) return {};
    return RunRecord{.tool = root.at("tool").string(),
                     .program = root.at("program").string(),
                     .command_line = root.at("command_line").string(),
                     .status = static_cast<int>(root.at("status").integer(0, 127)),
                     .inputs = files_of(root.at("inputs")),
                     .outputs = files_of(root.at("outputs"))};
  } catch (const Error&) {
    return {};
  }
}

void write_record(const fs::path& path, const RunRecord& record) {
  const ordered_json root = {{"$schema", kSchema},
                             {"tool", record.tool},
                             {"program", record.program},
                             {"command_line", record.command_line},
                             {"status", record.status},
                             {"inputs", to_json(record.inputs)},
                             {"outputs", to_json(record.outputs)}};
  OutputSet files(true);
  write_text(files.add(path), root.dump(2) + "\n");
  files.commit();
}

}  // namespace vsgl
