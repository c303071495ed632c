#include "scene/ply_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"

namespace vsgl::scene {
namespace {

enum class Encoding { ascii, little_endian, big_endian };

struct Type {
  std::size_t size = 0;
  bool is_float = false, is_signed = false;
};

struct Property {
  std::string name;
  Type type, count_type;  // of the values; of a list's length
  bool list = false;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

// Assimp takes a number in place of a name for the count.
bool is_name(const std::string& word) {
  return std::isalpha(static_cast<unsigned char>(word[0])) || word[0] == '_';
}

class PlyChecker {
 public:
  PlyChecker(std::string bytes, std::string file) : bytes_(std::move(bytes)), file_(std::move(file)) {}

  void check() {
    read_header();
    for (const Element& element : elements_)
      for (std::uint64_t i = 0; i < element.count; ++i)
        for (const Property& property : element.properties) skip(element, property, i);
  }

 private:
  [[noreturn]] void broken(const std::string& what) const {
    throw Error(ErrorCode::mesh_unreadable, file_ + ": " + what);
  }

  std::string line() {
    const auto end = bytes_.find('\n', at_);
    if (end == std::string::npos) broken("the header does not end");
    std::string out = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (!out.empty() && out.back() == '\r') out.pop_back();
    return out;
  }

  void read_header() {
    if (line() != "ply") broken("not a PLY file: it does not begin with \"ply\"");
    bool format = false;
    while (true) {
      const std::string text = line();
      std::istringstream words(text);
      std::string keyword;
      words >> keyword;
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "format") {
        read_format(words, text);
        format = true;
      } else if (keyword == "element") {
        Element element;
        if (!(words >> element.name >> element.count) || !is_name(element.name))
          broken("header line \"" + text + "\" is not understood");
        elements_.push_back(element);
      } else if (keyword == "property" && !elements_.empty()) {
        elements_.back().properties.push_back(read_property(words, text));
      } else {
        broken("header line \"" + text + "\" is not understood");
      }
    }
    if (!format) broken("the header does not name the format");
    for (const Element& element : elements_) {
      if (element.properties.empty()) broken("the element \"" + element.name + "\" has no properties");
      if (element.name == "vertex") vertices_ = element.count;
    }
  }

  void read_format(std::istringstream& words, const std::string& text) {
    std::string name;
    words >> name;
    if (name == "ascii") {
      encoding_ = Encoding::ascii;
    } else if (name == "binary_little_endian") {
      encoding_ = Encoding::little_endian;
    } else if (name == "binary_big_endian") {
      encoding_ = Encoding::big_endian;
    } else {
      broken("header line \"" + text + "\" is not understood");
    }
  }

  Property read_property(std::istringstream& words, const std::string& text) const {
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      property.list = true;
      words >> type;
      property.count_type = read_type(type, text);
      if (property.count_type.is_float)
        broken("header line \"" + text + "\": a list's length must be an integer");
      words >> type;
    }
    property.type = read_type(type, text);
    if (!(words >> property.name) || !is_name(property.name))
      broken("header line \"" + text + "\" is not understood");
    return property;
  }

  Type read_type(const std::string& name, const std::string& text) const {
    if (name == "char" || name == "int8") return {1, false, true};
    if (name == "uchar" || name == "uint8") return {1, false, false};
    if (name == "short" || name == "int16") return {2, false, true};
    if (name == "ushort" || name == "uint16") return {2, false, false};
    if (name == "int" || name == "int32") return {4, false, true};
    if (name == "uint" || name == "uint32") return {4, false, false};
    if (name == "float" || name == "float32") return {4, true, true};
    if (name == "double" || name == "float64") return {8, true, true};
    broken("header line \"" + text + "\": unknown type \"" + name + "\"");
  }

  // Steps over one property of one element and looks at vertex indices on the way.
  void skip(const Element& element, const Property& property, std::uint64_t index) {
    const std::string where = "element \"" + element.name + "\" " + std::to_string(index);
    if (!property.list) {
      step(property.type, where);
      return;
    }
    const std::int64_t length = step(property.count_type, where);
    if (length < 0) broken(where + ": a list of negative length");
    const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
    for (std::int64_t i = 0; i < length; ++i) {
      const std::int64_t value = step(property.type, where);
      if (indices && (value < 0 || static_cast<std::uint64_t>(value) >= vertices_)) {
        broken(where + ": uses vertex " + std::to_string(value) + " of " + std::to_string(vertices_));
      }
    }
  }

  // The next value; 0 for a floating-point one.
  std::int64_t step(const Type& type, const std::string& where) {
    return encoding_ == Encoding::ascii ? step_ascii(type, where) : step_binary(type, where);
  }

  std::int64_t step_binary(const Type& type, const std::string& where) {
    if (bytes_.size() - at_ < type.size) broken(where + ": the file ends too early");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t place = encoding_ == Encoding::little_endian ? i : type.size - 1 - i;
      value |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + i])} << (8 * place);
    }
    at_ += type.size;
    if (type.is_float) return 0;
    const std::size_t unused = 64 - 8 * type.size;
    return type.is_signed ? std::bit_cast<std::int64_t>(value << unused) >> unused
                          : std::bit_cast<std::int64_t>(value);
  }

  std::int64_t step_ascii(const Type& type, const std::string& where) {
    constexpr const char* blanks = " \t\r\n";
    at_ = std::min(bytes_.find_first_not_of(blanks, at_), bytes_.size());
    if (at_ == bytes_.size()) broken(where + ": the file ends too early");
    const std::size_t end = std::min(bytes_.find_first_of(blanks, at_), bytes_.size());
    const std::string word = bytes_.substr(at_, end - at_);
    at_ = end;
    char* rest = nullptr;
    const double value = std::strtod(word.c_str(), &rest);
    if (*rest != '\0') broken(where + ": \"" + word + "\" is not a number");
    if (type.is_float) return 0;
    if (!(std::abs(value) < 9e15)) broken(where + ": \"" + word + "\" is not an index");
    return static_cast<std::int64_t>(value);
  }

  std::string bytes_, file_;
  std::size_t at_ = 0;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::uint64_t vertices_ = 0;
};

}  // namespace

void check_ply_file(const std::filesystem::path& path) {
  PlyChecker(read_text(path), path.string()).check();
}

}  // namespace vsgl::scene
