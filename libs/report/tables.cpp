#include "report/tables.h"

#include <csv.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>

#include "base/error.h"
#include "report/elements.h"

namespace vsgl::report {
namespace {

using Json = nlohmann::ordered_json;
// A wider table is turned on its side.
constexpr std::size_t kMostColumns = 20;
// A longer list is no cell.
constexpr std::size_t kLongestList = 4;

using Row = std::vector<std::pair<std::string, Json>>;  // column and cell

// A whole decimal number as such, anything else as text.
Json cell_of(const std::string& text) {
  if (text.empty()) return nullptr;
  std::int64_t integer = 0;
  const char *begin = text.data(), *end = begin + text.size();
  if (std::from_chars(begin, end, integer).ptr == end) return integer;
  double number = 0;
  const auto parsed = std::from_chars(begin, end, number);
  if (parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(number)) return number;
  return text;
}

std::string spaced(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

bool is_pixel(const std::string& key, const Json& value) {
  return key.ends_with("_pixel") && value.is_array() && value.size() == 2 && value[0].is_number_integer() &&
         value[1].is_number_integer();
}

// "a, b, c".
std::string joined(const Json& list) {
  std::string text;
  for (const Json& item : list) {
    if (!text.empty()) text += ", ";
    text += item.is_string()         ? item.get<std::string>()
            : item.is_number_float() ? number_text(item.get<double>())
                                     : item.dump();
  }
  return text;
}

bool is_short_list(const Json& value) {
  return value.is_array() && value.size() <= kLongestList &&
         std::none_of(value.begin(), value.end(), [](const Json& item) { return item.is_structured(); });
}

// Members of an object as cells; nested ones with their path. "metrics" adds nothing to a name.
void flatten(const Json& object, const std::string& prefix, Row& row) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + spaced(key);
    if (value.is_object()) {
      flatten(value, key == "metrics" ? prefix : name + " ", row);
    } else if (!value.is_array() || is_pixel(key, value)) {
      row.emplace_back(name, value);
    } else if (is_short_list(value)) {
      row.emplace_back(name, joined(value));
    }
  }
}

bool is_empty(const Json& cell) {
  return cell.is_null() || cell == "";
}

// A row for each object; columns in which nothing stands are left out.
Table table_of_rows(const std::vector<Row>& rows) {
  Table table;
  for (const Row& row : rows)
    for (const auto& [name, cell] : row)
      if (!is_empty(cell) &&
          std::find(table.columns.begin(), table.columns.end(), name) == table.columns.end())
        table.columns.push_back(name);
  for (const Row& row : rows) {
    auto& cells = table.rows.emplace_back(table.columns.size());
    for (const auto& [name, cell] : row) {
      const auto column = std::find(table.columns.begin(), table.columns.end(), name);
      if (column != table.columns.end())
        cells[static_cast<std::size_t>(column - table.columns.begin())] = cell;
    }
  }
  return table;
}

// Rows become columns, named by what stood first in them.
Table transposed(const Table& table) {
  Table out{table.caption, {table.columns.empty() ? "" : table.columns.front()}, {}};
  for (const auto& row : table.rows)
    out.columns.push_back(row.front().is_string() ? row.front().get<std::string>() : row.front().dump());
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    auto& cells = out.rows.emplace_back(1, table.columns[c]);
    for (const auto& row : table.rows) cells.push_back(row[c]);
  }
  return out;
}

Table table_of_object(const Json& object) {
  Row row = {{"", "value"}};
  flatten(object, "", row);
  return transposed(table_of_rows({row}));
}

bool is_array_of_objects(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_object(); });
}

Table table_of_array(const Json& array) {
  std::vector<Row> rows;
  for (const Json& item : array) flatten(item, "", rows.emplace_back());
  return table_of_rows(rows);
}

// {"at": [50, 90], "relative": [0.1, 0.2]}: a column for each list.
Table table_of_lists(const Json& lists) {
  std::vector<Row> rows;
  for (const auto& [key, list] : lists.items()) {
    rows.resize(std::max(rows.size(), list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) rows[i].emplace_back(spaced(key), list[i]);
  }
  return table_of_rows(rows);
}

// What libcsv's callbacks fill.
struct CsvRows {
  std::vector<std::vector<std::string>> rows = {{}};
};
void on_field(void* text, std::size_t size, void* rows) {
  static_cast<CsvRows*>(rows)->rows.back().emplace_back(static_cast<const char*>(text), size);
}
void on_row(int /*terminator*/, void* rows) {
  static_cast<CsvRows*>(rows)->rows.emplace_back();
}

std::vector<std::vector<std::string>> parse_csv(const std::string& text, const std::string& origin) {
  csv_parser parser;
  if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0)
    throw Error(ErrorCode::memory, origin + ": not enough memory to read the table");
  const std::unique_ptr<csv_parser, decltype(&csv_free)> release(&parser, &csv_free);
  CsvRows out;
  if (csv_parse(&parser, text.data(), text.size(), on_field, on_row, &out) != text.size() ||
      csv_fini(&parser, on_field, on_row, &out) != 0)
    throw Error(ErrorCode::invalid_data, origin + ": row " + std::to_string(out.rows.size()) +
                                             ": is no CSV (" + csv_strerror(csv_error(&parser)) +
                                             "); quote fields as \"a \"\"b\"\"\"");
  out.rows.pop_back();  // begun after the last row's end
  return std::move(out.rows);
}

}  // namespace

Table table_of_csv(const std::string& text, const std::string& origin) {
  const auto rows = parse_csv(text, origin);
  if (rows.empty())
    throw Error(ErrorCode::invalid_data, origin + ": is empty; its first row must name the columns");
  Table table{"", rows.front(), {}};
  for (std::size_t r = 1; r < rows.size(); ++r) {
    if (rows[r].size() != table.columns.size())
      throw Error(ErrorCode::invalid_data, origin + ": row " + std::to_string(r + 1) + ": has " +
                                               std::to_string(rows[r].size()) + " fields, the first row " +
                                               std::to_string(table.columns.size()));
    std::vector<Json> cells;
    for (const std::string& field : rows[r]) cells.push_back(cell_of(field));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table table_of_json(const JsonValue& value) {
  if (value.raw().is_object()) return table_of_object(value.raw());
  if (is_array_of_objects(value.raw())) return table_of_array(value.raw());
  throw Error(
      ErrorCode::json_wrong_type,
      value.where() + ": expected an object, or an array of objects that is not empty, to show as a table");
}

std::vector<Table> tables_of_result(const Json& result) {
  Json settings = Json::object();
  std::vector<Table> tables;
  const auto add = [&](Table table, const std::string& caption) {
    if (table.rows.empty()) return;
    table.caption = caption;
    tables.push_back(std::move(table));
  };
  for (const auto& [key, value] : result.items()) {
    if (is_array_of_objects(value) && key != "failures") {
      const Table table = table_of_array(value);
      add(table.columns.size() > kMostColumns ? transposed(table) : table, spaced(key));
      for (const Json& item : value)
        if (item.contains("percentiles"))
          add(table_of_lists(item["percentiles"]), "percentiles of " + item.value("layer", spaced(key)));
    } else if (key != "failures" && key != "$schema") {
      settings[key] = value;
    }
  }
  add(table_of_object(settings), "what was compared, and how");
  return tables;
}

std::vector<std::string> failures_of_result(const Json& result) {
  std::vector<std::string> messages;
  if (!result.contains("failures")) return messages;
  for (const Json& failure : result["failures"]) messages.push_back(failure.at("message").get<std::string>());
  return messages;
}

}  // namespace vsgl::report
