#include "report/elements.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/hash.h"
#include "report/escape.h"

namespace vsgl::report {
namespace {

using Json = nlohmann::ordered_json;

std::string caption_html(const std::string& tag, const std::string& caption) {
  return caption.empty() ? "" : "<" + tag + ">" + escape_html(caption) + "</" + tag + ">";
}

// The attribute by which the page sorts numbers.
std::string number_cell(const std::string& sort_key, const std::string& content) {
  return "<td class=\"number\" data-value=\"" + sort_key + "\">" + content + "</td>";
}

std::string cell_html(const Json& cell) {
  if (cell.is_null()) return "<td class=\"none\">–</td>";
  if (cell.is_boolean()) return cell.get<bool>() ? "<td>yes</td>" : "<td>no</td>";
  if (cell.is_number()) {
    const std::string exact = cell.dump();
    return number_cell(exact, cell.is_number_integer() ? exact : number_text(cell.get<double>()));
  }
  if (cell.is_array()) {
    const std::string x = cell.at(0).dump(), y = cell.at(1).dump();
    return number_cell(x, "<button type=\"button\" class=\"pixel-link\" data-x=\"" + x + "\" data-y=\"" + y +
                              "\" title=\"Show this pixel\">" + x + ", " + y + "</button>");
  }
  return "<td>" + escape_html(cell.get<std::string>()) + "</td>";
}

// Whether a column's title belongs to the right, above numbers.
bool holds_numbers(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return row[column].is_number() || row[column].is_array(); });
}

std::string html_of(const Text& text) {
  return paragraphs(text.text);
}

std::string html_of(const Figure& figure) {
  // As an image nothing in it runs or loads. A plot follows the theme, a picture does not.
  const bool plot = figure.format == Figure::Format::svg;
  return "<figure class=\"" + std::string(plot ? "plot" : "plot photo") + "\"><img alt=\"" +
         escape_html(figure.alt) + "\" src=\"data:image/" + (plot ? "svg+xml" : "png") + ";base64," +
         base64(std::as_bytes(std::span(figure.data))) + "\">" + caption_html("figcaption", figure.caption) +
         "</figure>\n";
}

std::string html_of(const Fragment& fragment) {
  return "<iframe sandbox class=\"fragment\" title=\"" + escape_html(fragment.title) + "\" height=\"" +
         std::to_string(fragment.height) + "\" srcdoc=\"" + escape_html(fragment.html) + "\"></iframe>\n";
}

}  // namespace

std::size_t BlobStore::add(const std::vector<std::byte>& bytes) {
  const auto [entry, is_new] = known_.emplace(sha256(bytes), blobs_.size());
  if (is_new) blobs_.push_back(base64(bytes));
  return entry->second;
}

std::string BlobStore::html() const {
  std::string out;
  for (std::size_t i = 0; i < blobs_.size(); ++i)
    out += "<script type=\"application/octet-stream\" id=\"blob-" + std::to_string(i) + "\">" + blobs_[i] +
           "</script>\n";
  return out;
}

std::string number_text(double value) {
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 5);
  return {buffer.data(), end.ptr};
}

std::string paragraphs(const std::string& text) {
  std::string out;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find("\n\n", start), text.size());
    if (end > start) out += "<p>" + escape_html(std::string_view(text).substr(start, end - start)) + "</p>\n";
    start = end + 2;
  }
  return out;
}

std::string table_html(const Table& table) {
  std::string out = "<div class=\"table-frame\"><table class=\"sortable\">" +
                    caption_html("caption", table.caption) + "<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += (holds_numbers(table, c) ? "<th scope=\"col\" class=\"number\">" : "<th scope=\"col\">") +
           escape_html(table.columns[c]) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const Json& cell : row) out += cell_html(cell);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string block_html(const Block& block, BlobStore& blobs) {
  if (const auto* table = std::get_if<Table>(&block)) return table_html(*table);
  if (const auto* images = std::get_if<Images>(&block)) return viewer_html(*images, blobs);
  if (const auto* figure = std::get_if<Figure>(&block)) return html_of(*figure);
  if (const auto* fragment = std::get_if<Fragment>(&block)) return html_of(*fragment);
  return html_of(std::get<Text>(block));
}

}  // namespace vsgl::report
