#include "base/frame_name.h"

#include <regex>
#include <string>

namespace vsgl {
namespace {

const std::regex& frame_mark() {
  static const std::regex mark("%0([1-9])d");
  return mark;
}

}  // namespace

bool names_frames(const std::filesystem::path& path) {
  return std::regex_search(path.filename().string(), frame_mark());
}

std::filesystem::path frame_path(const std::filesystem::path& path, int frame) {
  const std::string name = path.filename().string(), digits = std::to_string(frame);
  std::string out;
  auto end = name.begin();
  for (std::sregex_iterator mark(name.begin(), name.end(), frame_mark()), none; mark != none; ++mark) {
    const std::size_t width = std::stoul((*mark)[1].str());
    out.append(end, (*mark)[0].first);
    out.append(width - std::min(width, digits.size()), '0');
    out += digits;
    end = (*mark)[0].second;
  }
  out.append(end, name.end());
  return path.parent_path() / out;
}

}  // namespace vsgl
