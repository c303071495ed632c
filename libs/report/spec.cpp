#include "report/spec.h"

#include <algorithm>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/strict_json.h"
#include "report/tables.h"

namespace vsgl::report {
namespace {

namespace fs = std::filesystem;

// What compare -o writes.
const std::vector<std::string> kResultSchemas = {"vsgltools/compare/1", "vsgltools/flicker/1",
                                                 "vsgltools/decomposition/1"};

std::string line(const JsonValue& value) {
  std::string text = value.string();
  if (text.empty()) throw Error(ErrorCode::json_out_of_range, value.where() + ": must not be empty");
  return text;
}

std::string line_or(const JsonValue& object, const std::string& key, const std::string& otherwise) {
  const auto member = object.find(key);
  return member ? line(*member) : otherwise;
}

JsonValue parse_with_schema(const fs::path& path, const std::vector<std::string>& schemas) {
  const JsonValue root = JsonValue::parse_file(path);
  const std::string found = root.at("$schema").string();
  if (std::find(schemas.begin(), schemas.end(), found) == schemas.end())
    throw Error(ErrorCode::wrong_schema,
                root.where() + ": $schema is \"" + found + "\", must be \"" + schemas.front() + "\"");
  return root;
}

// Reads sections and blocks; remembers which files they name.
class Reader {
 public:
  explicit Reader(fs::path folder) : folder_(std::move(folder)) {}

  Section section(const JsonValue& value, int level);
  std::vector<fs::path> files() const { return files_; }

 private:
  fs::path file(const JsonValue& value);
  std::vector<Block> blocks(const JsonValue& value);
  Block table(const JsonValue& value);
  Block figure(const JsonValue& value);
  Block fragment(const JsonValue& value);
  // A viewer, and the tables of the results that its tests name.
  std::vector<Block> images(const JsonValue& value);
  ErrorMap map(const JsonValue& value, const Picture& reference);
  std::vector<Table> metrics(const JsonValue& test, const std::string& label);

  fs::path folder_;
  std::vector<fs::path> files_;
};

fs::path Reader::file(const JsonValue& value) {
  const fs::path path = folder_ / line(value);
  if (std::find(files_.begin(), files_.end(), path) == files_.end()) files_.push_back(path);
  return path;
}

Table inline_table(const JsonValue& value) {
  Table table;
  for (const JsonValue& column : value.at("columns").array(1)) table.columns.push_back(line(column));
  for (const JsonValue& row : value.at("rows").array()) {
    auto& cells = table.rows.emplace_back();
    for (const JsonValue& cell : row.array(table.columns.size(), table.columns.size())) {
      if (cell.raw().is_structured())
        throw Error(ErrorCode::json_wrong_type,
                    cell.where() + ": expected text, a number, true, false or null");
      cells.push_back(cell.raw());
    }
  }
  return table;
}

// The value that an RFC 6901 pointer names.
JsonValue pointed_at(JsonValue value, const JsonValue& pointer) {
  try {
    nlohmann::ordered_json::json_pointer(pointer.string());
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorCode::json_out_of_range, pointer.where() + ": is no JSON pointer, as /channels");
  }
  std::string rest = pointer.string();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('/', 1), rest.size());
    const std::string key = nlohmann::ordered_json::json_pointer(rest.substr(0, end)).back();
    if (value.raw().is_array()) {
      const auto items = value.array();
      const auto index = static_cast<std::size_t>(std::strtoull(key.c_str(), nullptr, 10));
      if (key != std::to_string(index) || index >= items.size())
        throw Error(ErrorCode::json_out_of_range,
                    value.where() + ": has no element " + key + ", which " + pointer.where() + " asks for");
      value = items[index];
    } else {
      value = value.at(key);
    }
    rest.erase(0, end);
  }
  return value;
}

Block Reader::table(const JsonValue& value) {
  const auto csv = value.find("csv"), json = value.find("json"), columns = value.find("columns");
  if ((csv ? 1 : 0) + (json ? 1 : 0) + (columns ? 1 : 0) != 1)
    throw Error(ErrorCode::json_missing_key,
                value.where() + ": a table is given by exactly one of columns and rows, csv, json");
  Table table;
  if (csv) {
    const fs::path path = file(*csv);
    table = table_of_csv(read_text(path), path.string());
  } else if (json) {
    const JsonValue root = JsonValue::parse_file(file(*json));
    const auto pointer = value.find("pointer");
    table = table_of_json(pointer ? pointed_at(root, *pointer) : root);
  } else {
    table = inline_table(value);
  }
  table.caption = line_or(value, "caption", "");
  return table;
}

Block Reader::figure(const JsonValue& value) {
  const auto svg = value.find("svg"), png = value.find("png");
  if (svg.has_value() == png.has_value())
    throw Error(ErrorCode::json_missing_key,
                value.where() + ": a figure is given by exactly one of svg, png");
  return Figure{read_text(file(svg ? *svg : *png)), line(value.at("alt")), line_or(value, "caption", ""),
                svg ? Figure::Format::svg : Figure::Format::png};
}

Block Reader::fragment(const JsonValue& value) {
  Fragment out{read_text(file(value.at("html"))), line(value.at("title"))};
  if (const auto height = value.find("height")) out.height = static_cast<int>(height->integer(20, 10000));
  return out;
}

ErrorMap Reader::map(const JsonValue& value, const Picture& reference) {
  ErrorMap out;
  out.name = line(value.at("name"));
  out.layer = line_or(value, "layer", "");
  const ExrFile exr = read_exr(file(value.at("file")));
  const Picture picture = make_picture(exr, "", {line(value.at("channel"))});
  const std::string scale = value.at("scale").choice({"unit", "signed", "log"});
  out.scale = scale == "unit"     ? ErrorMap::Scale::unit
              : scale == "signed" ? ErrorMap::Scale::signed_
                                  : ErrorMap::Scale::log;
  if (const auto limit = value.find("limit")) out.limit = limit->number(std::numeric_limits<double>::min());
  if (picture.layers[0].planes.size() != 1)
    throw Error(ErrorCode::json_out_of_range,
                value.where() + "/channel: names a layer; name one channel of it");
  if (picture.width != reference.width || picture.height != reference.height)
    throw Error(ErrorCode::wrong_size, exr.path + ": has another size than " + reference.file);
  out.width = picture.width;
  out.height = picture.height;
  out.values = picture.layers[0].planes[0];
  value.finish();
  return out;
}

std::vector<std::string> chosen_layers(const JsonValue& value, const std::vector<const ExrFile*>& files) {
  if (const auto wanted = value.find("layers")) {
    std::vector<std::string> names;
    std::set<std::string> seen;
    for (const JsonValue& item : wanted->array(1)) {
      names.push_back(line(item));
      if (!seen.insert(names.back()).second)
        throw Error(ErrorCode::json_out_of_range, item.where() + ": the layer is named twice");
    }
    return names;
  }
  const std::vector<std::string> names = shared_layers(files);
  if (names.empty())
    throw Error(ErrorCode::wrong_size, value.where() + ": the files share no layer of one size");
  return names;
}

Picture labelled(const ExrFile& exr, const JsonValue& described, const std::vector<std::string>& layers) {
  return make_picture(exr, line_or(described, "label", fs::path(exr.path).filename().string()), layers);
}

std::vector<Table> Reader::metrics(const JsonValue& test, const std::string& label) {
  const auto path = test.find("metrics");
  if (!path) return {};
  std::vector<Table> tables = tables_of_result(parse_with_schema(file(*path), kResultSchemas).raw());
  for (Table& table : tables) table.caption = label + (table.caption.empty() ? "" : ": " + table.caption);
  return tables;
}

std::vector<Block> Reader::images(const JsonValue& value) {
  const JsonValue reference = value.at("reference");
  const std::vector<JsonValue> tests = value.at("tests").array(1);
  std::vector<ExrFile> files = {read_exr(file(reference.at("file")))};
  for (const JsonValue& test : tests) files.push_back(read_exr(file(test.at("file"))));
  std::vector<const ExrFile*> pointers;
  for (const ExrFile& exr : files) pointers.push_back(&exr);
  const std::vector<std::string> layers = chosen_layers(value, pointers);

  Images out;
  out.reference = labelled(files[0], reference, layers);
  reference.finish();
  std::vector<Block> tables;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    Images::Test test{labelled(files[i + 1], tests[i], layers), {}};
    if (test.picture.width != out.reference.width || test.picture.height != out.reference.height)
      throw Error(ErrorCode::wrong_size, files[i + 1].path + ": has another size than " + files[0].path);
    if (const auto maps = tests[i].find("maps"))
      for (const JsonValue& item : maps->array()) test.maps.push_back(map(item, out.reference));
    for (Table& table : metrics(tests[i], test.picture.label)) tables.push_back(std::move(table));
    tests[i].finish();
    out.tests.push_back(std::move(test));
  }
  const auto exposure = value.find("exposure");
  out.exposure = exposure ? exposure->number(-40, 40) : automatic_exposure(out.reference.layers.front());
  if (const auto tone = value.find("tone")) out.tone = tone->choice({"linear", "reinhard", "aces"});
  tables.insert(tables.begin(), std::move(out));
  return tables;
}

std::vector<Block> Reader::blocks(const JsonValue& value) {
  const std::string type = value.at("type").choice({"text", "table", "figure", "fragment", "images"});
  if (type == "images") return images(value);
  if (type == "table") return {table(value)};
  if (type == "figure") return {figure(value)};
  if (type == "fragment") return {fragment(value)};
  return {Text{line(value.at("text"))}};
}

Section Reader::section(const JsonValue& value, int level) {
  Section out{line(value.at("title")), {}, {}};
  if (const auto content = value.find("content")) {
    for (const JsonValue& item : content->array()) {
      for (Block& block : blocks(item)) out.content.push_back(std::move(block));
      item.finish();
    }
  }
  if (const auto sections = value.find("sections")) {
    if (level == 3)
      throw Error(ErrorCode::json_out_of_range,
                  sections->where() + ": sections are at most three levels deep");
    for (const JsonValue& item : sections->array()) out.sections.push_back(section(item, level + 1));
  }
  value.finish();
  return out;
}

}  // namespace

DescribedDocument read_document(const fs::path& path) {
  const JsonValue root = parse_with_schema(path, {"vsgltools/report/1"});
  DescribedDocument out;
  out.document.title = line(root.at("title"));
  out.document.summary = line_or(root, "summary", "");
  if (const auto failures = root.find("failures")) {
    for (const JsonValue& item : failures->array()) out.document.failures.push_back(line(item));
    out.document.passed = out.document.failures.empty();
    out.document.verdict = out.document.passed ? "passed" : "failed";
  }
  Reader reader(path.parent_path());
  for (const JsonValue& item : root.at("sections").array(1))
    out.document.sections.push_back(reader.section(item, 1));
  root.finish();
  out.files = reader.files();
  return out;
}

}  // namespace vsgl::report
