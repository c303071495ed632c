#include "report/document.h"

#include <openssl/evp.h>

#include <array>

#include "base/error.h"
#include "report/assets.h"
#include "report/elements.h"
#include "report/escape.h"

namespace vsgl::report {
namespace {

// "s2-1" for the first section of the second one.
std::string section_id(const std::string& parent, std::size_t index) {
  return (parent.empty() ? "s" : parent + "-") + std::to_string(index + 1);
}

std::string contents_html(const std::vector<Section>& sections, const std::string& parent) {
  std::string out = "<ol>";
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::string id = section_id(parent, i);
    out += "<li><a href=\"#" + id + "\">" + escape_html(sections[i].title) + "</a>";
    if (!sections[i].sections.empty()) out += contents_html(sections[i].sections, id);
    out += "</li>";
  }
  return out + "</ol>";
}

// A table of contents, where there is something to choose from.
std::string navigation_html(const Document& document) {
  const bool flat = document.sections.size() < 3 &&
                    (document.sections.empty() || document.sections.front().sections.size() < 2);
  if (flat) return "";
  return "<nav aria-label=\"Contents\"><h2>Contents</h2>" + contents_html(document.sections, "") + "</nav>\n";
}

std::string section_html(const Section& section, const std::string& id, int level, BlobStore& blobs) {
  const std::string heading = "h" + std::to_string(level);
  std::string out = "<section id=\"" + id + "\" aria-labelledby=\"" + id + "-title\"><" + heading + " id=\"" +
                    id + "-title\">" + escape_html(section.title) + "</" + heading + ">\n";
  // Figures in a row, and tables in a row, stand side by side where there is room.
  std::string row;
  for (const Block& block : section.content) {
    const std::string wanted = std::holds_alternative<Figure>(block)  ? "plots"
                               : std::holds_alternative<Table>(block) ? "tables"
                                                                      : "";
    if (wanted != row && !row.empty()) out += "</div>\n";
    if (wanted != row && !wanted.empty()) out += "<div class=\"" + wanted + "\">\n";
    row = wanted;
    out += block_html(block, blobs);
  }
  if (!row.empty()) out += "</div>\n";
  for (std::size_t i = 0; i < section.sections.size(); ++i)
    out += section_html(section.sections[i], section_id(id, i), level + 1, blobs);
  return out + "</section>\n";
}

std::string header_html(const Document& document) {
  std::string out = "<header class=\"page\"><h1>" + escape_html(document.title) + "</h1>";
  if (!document.verdict.empty()) {
    out += "<p class=\"verdict " + std::string(document.passed ? "passed" : "failed") + "\">" +
           escape_html(document.verdict) + "</p>";
  }
  out += "</header>\n" + paragraphs(document.summary);
  if (!document.failures.empty()) {
    out += "<section class=\"failures\" aria-labelledby=\"failures-title\"><h2 id=\"failures-title\">" +
           std::to_string(document.failures.size()) +
           (document.failures.size() == 1 ? " failure" : " failures") + "</h2><ul>";
    for (const std::string& failure : document.failures) out += "<li>" + escape_html(failure) + "</li>";
    out += "</ul></section>\n";
  }
  return out;
}

std::string footer_html(const Provenance& made_by) {
  return "<footer><p>Made by <code>" + escape_html(made_by.command_line) + "</code> (vsgltools " +
         escape_html(made_by.tool_version) +
         "). This file needs no other file and loads nothing.</p></footer>\n";
}

std::string body_html(const Document& document, BlobStore& blobs) {
  std::string out = header_html(document) + navigation_html(document);
  for (std::size_t i = 0; i < document.sections.size(); ++i)
    out += section_html(document.sections[i], section_id("", i), 2, blobs);
  return out + footer_html(document.made_by);
}

// Only the page's own script runs, and nothing can be fetched or sent anywhere.
std::string security_policy() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  if (EVP_Digest(kScript.data(), kScript.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw Error(ErrorCode::internal, "SHA-256 of the report's script failed");
  return "default-src 'none'; script-src 'sha256-" + base64(std::as_bytes(std::span(digest.data(), size))) +
         "'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'";
}

// Replaces {{name}} by what `value_of` gives. What is put in is not looked at again.
template <typename ValueOf>
std::string filled(std::string_view page, const ValueOf& value_of) {
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{"), close = page.find("}}", open);
    if (close == std::string_view::npos) return out + std::string(page);
    out += page.substr(0, open);
    out += value_of(page.substr(open + 2, close - open - 2));
    page.remove_prefix(close + 2);
  }
}

}  // namespace

std::string render(const Document& document) {
  BlobStore blobs;
  const std::string body = body_html(document, blobs);
  return filled(kPage, [&](std::string_view name) -> std::string {
    if (name == "policy") return security_policy();
    if (name == "title") return escape_html(document.title);
    if (name == "style") return std::string(kStyle);
    if (name == "body") return body;
    if (name == "blobs") return blobs.html();
    if (name == "script") return std::string(kScript);
    throw Error(ErrorCode::internal, "the report's page has an unknown placeholder: " + std::string(name));
  });
}

}  // namespace vsgl::report
