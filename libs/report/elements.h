#pragma once

// Blocks of a document as HTML. Private to this library.

#include <map>
#include <string>
#include <vector>

#include "report/document.h"

namespace vsgl::report {

// Data that blocks refer to by number; equal data is stored once.
class BlobStore {
 public:
  std::size_t add(const std::vector<std::byte>& bytes);
  // <script type="application/octet-stream" id="blob-0">base64</script> ...
  std::string html() const;

 private:
  std::vector<std::string> blobs_;  // base64
  std::map<std::string, std::size_t> known_;
};

std::string paragraphs(const std::string& text);
std::string table_html(const Table& table);
std::string viewer_html(const Images& images, BlobStore& blobs);
std::string block_html(const Block& block, BlobStore& blobs);

// A number as a cell shows it: five significant digits.
std::string number_text(double value);

}  // namespace vsgl::report
