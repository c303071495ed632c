#pragma once

// Tables from files: CSV, JSON, and the results that compare writes.

#include <string>
#include <vector>

#include "base/strict_json.h"
#include "report/document.h"

namespace vsgl::report {

// CSV (RFC 4180) whose first row names the columns. Fields that are decimal numbers become numbers, empty
// ones null. Throws invalid_data naming `origin` and line when a row has another length or the text is no
// CSV.
Table table_of_csv(const std::string& text, const std::string& origin);

// An array of objects, one a row (columns: all keys, in the order in which they first appear; those of nested
// objects as "outer inner"), or one object: a row for each member. A member "..._pixel" of two integers is a
// pixel. Other arrays are left out. Throws json_wrong_type for anything else.
Table table_of_json(const JsonValue& value);

// All tables in a result of compare (vsgltools/compare/1 and its relatives): one for each array of objects
// but `failures`, with the percentiles in it, and last one of all single values.
std::vector<Table> tables_of_result(const nlohmann::ordered_json& result);

// Messages of its `failures`.
std::vector<std::string> failures_of_result(const nlohmann::ordered_json& result);

}  // namespace vsgl::report
