// Makes a broken copy of an EXR artifact, for the black-box tests of the tools' readers.
//
//   exr_corrupt IN OUT drop-channel CHANNEL       leaves the channel out of every part and level; a part's
//   only channel is renamed exr_corrupt IN OUT set-channel CHANNEL VALUE  first pixel of the first part that
//   has it (a float, also nan or inf) exr_corrupt IN OUT retype-channel CHANNEL     FLOAT becomes UINT and
//   the other way round exr_corrupt IN OUT resize                     one column and one row more (twice the
//   side for MIPMAP parts) of zeros exr_corrupt IN OUT drop-part                  leaves the last part out
//   exr_corrupt IN OUT drop-levels                level 0 of each part only, as scan lines exr_corrupt IN OUT
//   drop-attribute NAME exr_corrupt IN OUT set-attribute NAME VALUE   of the attribute's own type (int,
//   double or text)
//
// Exit status 1 with a message when the file has nothing of that name.

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "image/exr.h"

namespace {

using vsgl::ExrFile;
using vsgl::ExrLevel;
using vsgl::ExrPart;
using vsgl::Plane;

// write_exr() refuses NaN and infinity; they are planted in the bytes of the uncompressed file, in place of
// this number.
constexpr float kMarker = 1.2345678e30F;

using Arguments = std::vector<std::string>;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

void require_found(bool found, const std::string& name) {
  if (!found) fail("nothing is named " + name);
}

void drop_channel(ExrFile& file, const std::string& name) {
  std::size_t dropped = 0;
  for (ExrPart& part : file.parts) {
    for (ExrLevel& level : part.levels) {
      auto channel = level.channels.extract(name);
      if (channel.empty()) continue;
      ++dropped;
      channel.key() = "renamed.V";
      if (level.channels.empty()) level.channels.insert(std::move(channel));
    }
  }
  require_found(dropped > 0, name);
}

void set_channel(ExrFile& file, const std::string& name, float value) {
  for (ExrPart& part : file.parts) {
    const auto plane = part.levels.front().channels.find(name);
    if (plane == part.levels.front().channels.end()) continue;
    if (auto* floats = std::get_if<std::vector<float>>(&plane->second)) {
      floats->front() = std::isfinite(value) ? value : kMarker;
    } else {
      std::get<std::vector<std::uint32_t>>(plane->second).front() = static_cast<std::uint32_t>(value);
    }
    return;
  }
  require_found(false, name);
}

void retype_channel(ExrFile& file, const std::string& name) {
  bool found = false;
  for (ExrPart& part : file.parts) {
    for (ExrLevel& level : part.levels) {
      const auto plane = level.channels.find(name);
      if (plane == level.channels.end()) continue;
      found = true;
      const std::size_t size = static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
      const bool is_float = std::holds_alternative<std::vector<float>>(plane->second);
      plane->second = is_float ? Plane(std::vector<std::uint32_t>(size)) : Plane(std::vector<float>(size));
    }
  }
  require_found(found, name);
}

ExrLevel zeros_like(const ExrLevel& level, int width, int height) {
  ExrLevel out{.width = width, .height = height, .channels = {}};
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const auto& [name, plane] : level.channels) {
    std::visit([&](const auto& values) { out.channels[name] = std::decay_t<decltype(values)>(size); }, plane);
  }
  return out;
}

// Only the first part grows, so that it no longer fits the others.
void resize(ExrFile& file) {
  ExrPart& part = file.parts.front();
  if (part.mipmap) {
    part.levels.insert(part.levels.begin(),
                       zeros_like(part.levels.front(), 2 * part.width(), 2 * part.height()));
  } else {
    part.levels = {zeros_like(part.levels.front(), part.width() + 1, part.height() + 1)};
  }
}

void drop_part(ExrFile& file) {
  if (file.parts.size() < 2) fail("the file has only one part");
  file.parts.pop_back();
}

void drop_levels(ExrFile& file) {
  bool found = false;
  for (ExrPart& part : file.parts) {
    found = found || part.mipmap;
    part.mipmap = false;
    part.levels.resize(1);
  }
  if (!found) fail("no part has mip levels");
}

void drop_attribute(ExrFile& file, const std::string& name) {
  std::size_t dropped = 0;
  for (ExrPart& part : file.parts) dropped += part.attributes.erase(name);
  require_found(dropped > 0, name);
}

void set_attribute(ExrFile& file, const std::string& name, const std::string& text) {
  bool found = false;
  for (ExrPart& part : file.parts) {
    const auto attribute = part.attributes.find(name);
    if (attribute == part.attributes.end()) continue;
    found = true;
    if (std::holds_alternative<int>(attribute->second)) {
      attribute->second = std::stoi(text);
    } else if (std::holds_alternative<double>(attribute->second)) {
      attribute->second = std::stod(text);
    } else if (std::holds_alternative<std::string>(attribute->second)) {
      attribute->second = text;
    } else {
      fail(name + " is a vector or a matrix");
    }
  }
  require_found(found, name);
}

void plant(const std::string& path, float value) {
  std::string bytes = vsgl::read_text(path);
  const auto marker = std::bit_cast<std::array<char, 4>>(kMarker);
  const auto at = bytes.find(std::string_view(marker.data(), marker.size()));
  if (at == std::string::npos) fail("the marker is not in the file");
  std::memcpy(bytes.data() + at, &value, sizeof value);
  vsgl::write_text(path, bytes);
}

void corrupt(const Arguments& arguments) {
  const std::string output = arguments.at(1), operation = arguments.at(2);
  ExrFile file = vsgl::read_exr(arguments.at(0));
  float planted = 0;
  if (operation == "drop-channel") {
    drop_channel(file, arguments.at(3));
  } else if (operation == "set-channel") {
    planted = std::stof(arguments.at(4));
    set_channel(file, arguments.at(3), planted);
  } else if (operation == "retype-channel") {
    retype_channel(file, arguments.at(3));
  } else if (operation == "resize") {
    resize(file);
  } else if (operation == "drop-part") {
    drop_part(file);
  } else if (operation == "drop-levels") {
    drop_levels(file);
  } else if (operation == "drop-attribute") {
    drop_attribute(file, arguments.at(3));
  } else if (operation == "set-attribute") {
    set_attribute(file, arguments.at(3), arguments.at(4));
  } else {
    fail("no operation is named " + operation);
  }
  for (ExrPart& part : file.parts) part.compression = vsgl::ExrCompression::none;
  vsgl::write_exr(output, file);
  if (!std::isfinite(planted)) plant(output, planted);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    corrupt({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "exr_corrupt: " << error.what() << "\n";
    return 1;
  }
}
