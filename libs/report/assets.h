#pragma once

// The page's own files (configs/report), embedded by embed.cmake.

#include <string_view>

namespace vsgl::report {

extern const std::string_view kPage;    // report.html, with {{placeholders}}
extern const std::string_view kStyle;   // report.css
extern const std::string_view kScript;  // all scripts, one after the other

}  // namespace vsgl::report
