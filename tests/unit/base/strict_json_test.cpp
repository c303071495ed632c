#include "base/strict_json.h"

#include "folder_test.h"

namespace vsgl {
namespace {

using test::expect_error;

JsonValue parse(const std::string& text) {
  return JsonValue::parse_text(text, "scene.json");
}

TEST(StrictJson, ReadsEveryType) {
  const JsonValue root = parse(R"({"n": 1.5, "i": -3, "b": true, "s": "x", "a": [1, 2, 3], "o": {"p": 1}})");
  EXPECT_EQ(root.at("n").number(), 1.5);
  EXPECT_EQ(root.at("i").number(), -3);
  EXPECT_EQ(root.at("i").integer(-5, 5), -3);
  EXPECT_TRUE(root.at("b").boolean());
  EXPECT_EQ(root.at("s").string(), "x");
  EXPECT_EQ(root.at("s").choice({"w", "x"}), "x");
  EXPECT_EQ(root.at("a").numbers<3>(), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(root.at("o").at("p").integer(0, 9), 1);
  EXPECT_FALSE(root.find("none").has_value());
  EXPECT_EQ(root.keys(), (std::vector<std::string>{"n", "i", "b", "s", "a", "o"}));
  root.finish();
}

TEST(StrictJson, SyntaxErrorsNameLineAndColumn) {
  expect_error(ErrorCode::json_syntax, "scene.json: parse error at line 2, column 8",
               [] { parse("{\n  \"a\": }"); });
  expect_error(ErrorCode::json_syntax, "scene.json: ", [] { parse(""); });
  expect_error(ErrorCode::json_syntax, "scene.json: ", [] { parse("{} {}"); });
  expect_error(ErrorCode::json_syntax, "scene.json: number overflow", [] { parse("[1e999]"); });
}

TEST(StrictJson, RefusesDuplicateKeys) {
  expect_error(ErrorCode::json_syntax, "\"a\" appears twice",
               [] { parse(R"({"a": 1, "b": {"a": 2}, "a": 3})"); });
  parse(R"([{"a": 1}, {"a": 2, "b": {"a": 3}}])");
}

TEST(StrictJson, WrongTypesNamePointerAndValue) {
  const JsonValue root = parse(R"({"lights": [{"cone_deg": "wide", "on": 1}], "a/b~c": null})");
  const JsonValue light = root.at("lights").array()[0];
  expect_error(ErrorCode::json_wrong_type, "scene.json: /lights/0/cone_deg: expected a number, got a string",
               [&] { light.at("cone_deg").number(); });
  expect_error(ErrorCode::json_wrong_type, "/lights/0/on: expected true or false, got 1",
               [&] { light.at("on").boolean(); });
  expect_error(ErrorCode::json_wrong_type, "/lights: expected a string, got an array",
               [&] { root.at("lights").string(); });
  expect_error(ErrorCode::json_wrong_type, "/lights/0: expected an array, got an object",
               [&] { light.array(); });
  expect_error(ErrorCode::json_wrong_type, "/a~1b~0c: expected an object, got null",
               [&] { root.at("a/b~c").at("x"); });
  expect_error(ErrorCode::json_wrong_type, "scene.json: /: expected an object", [] { parse("[]").finish(); });
}

TEST(StrictJson, IntegersAreNotFractions) {
  expect_error(ErrorCode::json_wrong_type, "expected an integer, got 1.5",
               [] { parse("1.5").integer(0, 9); });
  expect_error(ErrorCode::json_wrong_type, "expected an integer, got 1.0",
               [] { parse("1.0").integer(0, 9); });
}

TEST(StrictJson, RangesAreInclusiveAndNamed) {
  EXPECT_EQ(parse("[0, 1]").array()[1].number(0, 1), 1);
  expect_error(ErrorCode::json_out_of_range, "/0: 1.5 is outside the range: from 0 to 1",
               [] { parse("[1.5]").array()[0].number(0, 1); });
  expect_error(ErrorCode::json_out_of_range, "-1 is outside the range: at least 0",
               [] { parse("-1").number(0); });
  expect_error(ErrorCode::json_out_of_range, "10 is outside the range: from 0 to 9",
               [] { parse("10").integer(0, 9); });
  expect_error(ErrorCode::json_out_of_range, "18446744073709551615 is outside",
               [] { parse("18446744073709551615").integer(0, std::numeric_limits<std::int64_t>::max()); });
  expect_error(ErrorCode::json_out_of_range, "expected 3 elements, got 2",
               [] { parse("[1, 2]").numbers<3>(); });
  expect_error(ErrorCode::json_out_of_range, "expected at least 1 elements, got 0",
               [] { parse("[]").array(1); });
  expect_error(ErrorCode::json_out_of_range, "\"vsm\" is not one of: ism, exact", [] {
    parse("\"vsm\"").choice({"ism", "exact"});
  });
}

TEST(StrictJson, MissingKeysAreNamed) {
  expect_error(ErrorCode::json_missing_key, "scene.json: /camera: the key \"fov_deg\" is missing",
               [] { parse(R"({"camera": {}})").at("camera").at("fov_deg"); });
}

TEST(StrictJson, UnknownKeysSuggestTheNearest) {
  const JsonValue light = parse(R"({"light": {"cone_dge": 30, "name": "key"}})").at("light");
  light.find("cone_deg");
  light.find("name");
  expect_error(ErrorCode::json_unknown_key,
               "scene.json: /light/cone_dge: no such key; did you mean \"cone_deg\"?",
               [&] { light.finish(); });
  const JsonValue other = parse(R"({"zzzzzz": 1})");
  other.find("name");
  expect_error(ErrorCode::json_unknown_key, "/zzzzzz: no such key", [&] { other.finish(); });
}

TEST(StrictJson, CopiesShareTheKnownKeys) {
  const JsonValue root = parse(R"({"a": 1})");
  const JsonValue copy = root;
  copy.at("a");
  root.finish();
}

using StrictJsonFile = test::FolderTest;

TEST_F(StrictJsonFile, MessagesNameTheFile) {
  write("bad.json", "{");
  expect_error(ErrorCode::json_syntax, "bad.json: ", [&] { JsonValue::parse_file(path("bad.json")); });
  expect_error(ErrorCode::file_not_found, "none.json", [&] { JsonValue::parse_file(path("none.json")); });
}

TEST(NearestName, FindsSwapsAndOmissionsAndNothingFar) {
  const std::vector<std::string> names{"--count", "--kernel-scale", "--method", "--seed"};
  EXPECT_EQ(nearest_name("--cuont", names), "--count");
  EXPECT_EQ(nearest_name("--kernelscale", names), "--kernel-scale");
  EXPECT_EQ(nearest_name("--sed", names), "--seed");
  EXPECT_EQ(nearest_name("--environment", names), "");
  EXPECT_EQ(nearest_name("x", {"yz"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace vsgl
