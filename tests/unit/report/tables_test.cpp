#include "report/tables.h"

#include <gtest/gtest.h>

#include "../expect_error.h"

namespace vsgl::report {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<Json>>;
using Names = std::vector<std::string>;
using test::expect_error;

Table json_table(const std::string& text) {
  return table_of_json(JsonValue::parse_text(text, "t.json"));
}

TEST(CsvTable, NumbersTextsAndGaps) {
  const Table table = table_of_csv("a,\"b \"\"c\"\"\",d\r\n1,-2.5e-3,\n\"x,y\",1.2.3,0x10\n", "t.csv");
  EXPECT_EQ(table.columns, (Names{"a", "b \"c\"", "d"}));
  EXPECT_EQ(table.rows, (Rows{{1, -2.5e-3, nullptr}, {"x,y", "1.2.3", "0x10"}}));
}

TEST(CsvTable, LastRowNeedsNoNewline) {
  EXPECT_EQ(table_of_csv("a\n1", "t.csv").rows, (Rows{{1}}));
}

TEST(CsvTable, BrokenFilesAreErrors) {
  expect_error(ErrorCode::invalid_data, {"t.csv: row 3: has 1 fields, the first row 2"},
               [] { table_of_csv("a,b\n1,2\n3\n", "t.csv"); });
  expect_error(ErrorCode::invalid_data, {"t.csv: row 2: is no CSV"},
               [] { table_of_csv("a\n\"b\n", "t.csv"); });
  expect_error(ErrorCode::invalid_data, {"is empty"}, [] { table_of_csv("", "t.csv"); });
}

TEST(JsonTable, ObjectsAreRows) {
  const Table table = json_table(
      R"([{"n": 1, "in": {"x": 2}, "worst_pixel": [3, 4]}, {"n": "a", "metrics": {"mse": null, "m": 5}}])");
  EXPECT_EQ(table.columns, (Names{"n", "in x", "worst pixel", "m"}));
  EXPECT_EQ(table.rows, (Rows{{1, 2, Json::array({3, 4}), nullptr}, {"a", nullptr, nullptr, 5}}));
}

TEST(JsonTable, AnObjectIsTwoColumns) {
  const Table table =
      json_table(R"({"a_b": 1, "c": {"d": true}, "short": [1, 2.5], "long": [1, 2, 3, 4, 5]})");
  EXPECT_EQ(table.columns, (Names{"", "value"}));
  EXPECT_EQ(table.rows, (Rows{{"a b", 1}, {"c d", true}, {"short", "1, 2.5"}}));
}

TEST(JsonTable, OtherValuesAreErrors) {
  for (const char* text : {"[1, 2]", "[]", "3", "\"a\""})
    expect_error(ErrorCode::json_wrong_type, {"t.json: /: expected an object"}, [&] { json_table(text); });
}

TEST(ResultTables, OneForEachListAndOneForTheRest) {
  const Json result = Json::parse(R"({"$schema": "vsgltools/compare/1", "result": "differs",
      "channels": [{"channel": "a", "mse": 1}, {"channel": "b", "mse": 2}],
      "layers": [{"layer": "indirect", "percentiles": {"at": [50, 90, 95, 99, 99.9], "relative": [1, 2, 3, 4, 5]}}],
      "failures": [{"kind": "limit", "message": "too far"}]})");
  const std::vector<Table> tables = tables_of_result(result);
  Names captions;
  for (const Table& table : tables) captions.push_back(table.caption);
  EXPECT_EQ(captions, (Names{"channels", "layers", "percentiles of indirect", "what was compared, and how"}));
  EXPECT_EQ(tables[0].rows, (Rows{{"a", 1}, {"b", 2}}));
  EXPECT_EQ(tables[2].rows.back(), (std::vector<Json>{99.9, 5}));
  EXPECT_EQ(tables[3].rows, (Rows{{"result", "differs"}}));
  EXPECT_EQ(failures_of_result(result), Names{"too far"});
}

}  // namespace
}  // namespace vsgl::report
