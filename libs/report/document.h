#pragma once

// One HTML file: sections of text, tables, figures and image viewers. It needs no other file and loads
// nothing; its Content-Security-Policy forbids it. docs/report.md is its manual.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/provenance.h"
#include "report/picture.h"

namespace vsgl::report {

// Paragraphs, an empty line between two.
struct Text {
  std::string text;
};

// Cells: null, strings, booleans, numbers, and [x, y]: a pixel that the viewer before the table jumps to.
struct Table {
  std::string caption;  // empty: none
  std::vector<std::string> columns;
  std::vector<std::vector<nlohmann::ordered_json>> rows;  // each as long as columns
};

struct Figure {
  enum class Format { svg, png };
  std::string data;  // the picture itself
  std::string alt;
  std::string caption;  // empty: none
  Format format = Format::svg;
};

// HTML shown verbatim in a frame of its own, in which nothing runs.
struct Fragment {
  std::string html, title;
  int height = 400;  // CSS pixels
};

// A viewer. Every picture has the reference's size and its layers in its order.
struct Images {
  Picture reference;
  struct Test {
    Picture picture;
    std::vector<ErrorMap> maps;  // against the reference, of its size
  };
  std::vector<Test> tests;
  double exposure = 0;          // stops
  std::string tone = "linear";  // linear | reinhard | aces
};

using Block = std::variant<Text, Table, Figure, Fragment, Images>;

struct Section {
  std::string title;
  std::vector<Block> content;
  std::vector<Section> sections;
};

struct Document {
  std::string title;
  std::string summary;                // paragraphs; empty: none
  std::string verdict;                // "differs"; empty: none
  bool passed = true;                 // what the verdict says
  std::vector<std::string> failures;  // shown first
  std::vector<Section> sections;
  Provenance made_by;
};

// The whole file. Equal documents give equal bytes.
std::string render(const Document& document);

}  // namespace vsgl::report
