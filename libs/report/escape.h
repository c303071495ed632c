#pragma once

// Text from files on its way into the page: nothing of it may become markup.

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace vsgl::report {

// As the content of an element or of a quoted attribute: & < > " ' become references; bytes that are not
// UTF-8 and control characters become U+FFFD.
std::string escape_html(std::string_view text);

// JSON as the content of a <script type="application/json">: "<" is written as \u003c, so that neither
// "</script" nor "<!--" can occur.
std::string script_json(const nlohmann::ordered_json& value);

std::string base64(std::span<const std::byte> bytes);

}  // namespace vsgl::report
