#include <ImathBox.h>
#include <ImathMatrix.h>
#include <ImathVec.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <omp.h>

#include <algorithm>
#include <new>

#include "base/error.h"
#include "image/exr.h"

namespace vsgl {
namespace {

constexpr unsigned kTileSize = 64;

bool threads_are_set = false;

Imf::Compression to_imf(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::none:
      return Imf::NO_COMPRESSION;
    case ExrCompression::zips:
      return Imf::ZIPS_COMPRESSION;
    case ExrCompression::zip:
      return Imf::ZIP_COMPRESSION;
    case ExrCompression::piz:
      return Imf::PIZ_COMPRESSION;
  }
  throw Error(ErrorCode::internal, "unknown ExrCompression");
}

struct AttributeWriter {
  Imf::Header& header;
  const std::string& name;

  void operator()(int value) const { header.insert(name, Imf::IntAttribute(value)); }
  void operator()(double value) const { header.insert(name, Imf::DoubleAttribute(value)); }
  void operator()(const std::string& value) const { header.insert(name, Imf::StringAttribute(value)); }
  void operator()(const std::array<double, 3>& v) const {
    header.insert(name, Imf::V3dAttribute(Imath::V3d(v[0], v[1], v[2])));
  }
  void operator()(const std::array<double, 16>& v) const {
    Imath::M44d matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = v[static_cast<std::size_t>(i)];
    header.insert(name, Imf::M44dAttribute(matrix));
  }
};

Imf::PixelType pixel_type(const Plane& plane) {
  return std::holds_alternative<std::vector<float>>(plane) ? Imf::FLOAT : Imf::UINT;
}

Imf::Header make_header(const ExrPart& part, const Imath::Box2i& display_window) {
  Imf::Header header;
  header.displayWindow() = display_window;
  header.dataWindow() = Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(part.width() - 1, part.height() - 1));
  header.compression() = to_imf(part.compression);
  if (!part.name.empty()) header.setName(part.name);
  header.setType(part.mipmap ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (part.mipmap)
    header.setTileDescription(
        Imf::TileDescription(kTileSize, kTileSize, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
  for (const auto& [name, plane] : part.levels.front().channels)
    header.channels().insert(name, Imf::Channel(pixel_type(plane)));
  for (const auto& [name, value] : part.attributes) std::visit(AttributeWriter{header, name}, value);
  return header;
}

// OpenEXR's slices are not const although writing only reads them.
Imf::FrameBuffer frame_buffer(const ExrLevel& level) {
  Imf::FrameBuffer buffer;
  for (const auto& [name, plane] : level.channels) {
    std::visit(
        [&, key = name](const auto& pixels) {
          char* base = const_cast<char*>(reinterpret_cast<const char*>(pixels.data()));
          buffer.insert(key, Imf::Slice(pixel_type(plane), base, sizeof(float),
                                        sizeof(float) * static_cast<std::size_t>(level.width)));
        },
        plane);
  }
  return buffer;
}

void require(bool condition, const std::string& message) {
  if (!condition) throw Error(ErrorCode::internal, "write_exr: " + message);
}

// What the format demands of every part; a violation is a bug of the caller.
void check_shape(const ExrPart& part) {
  require(!part.levels.empty() && part.width() > 0 && part.height() > 0, "empty part '" + part.name + "'");
  require(!part.levels.front().channels.empty(), "part '" + part.name + "' without channels");
  int levels = 1;
  while (part.mipmap && (std::max(part.width(), part.height()) >> levels) > 0) ++levels;
  require(static_cast<int>(part.levels.size()) == levels,
          "wrong number of levels in part '" + part.name + "'");
  for (int l = 0; l < levels; ++l) {
    const ExrLevel& level = part.levels[static_cast<std::size_t>(l)];
    require(level.width == std::max(1, part.width() >> l) && level.height == std::max(1, part.height() >> l),
            "level " + std::to_string(l) + " of part '" + part.name + "' has the wrong size");
    require(level.channels.size() == part.levels.front().channels.size(), "levels differ in their channels");
    const std::size_t pixels = static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    for (const auto& [name, plane] : level.channels) {
      const auto same = part.levels.front().channels.find(name);
      require(same != part.levels.front().channels.end() && same->second.index() == plane.index(),
              "channel '" + name + "' differs between levels");
      require(std::visit([](const auto& v) { return v.size(); }, plane) == pixels,
              "channel '" + name + "' of part '" + part.name + "' has the wrong number of pixels");
    }
  }
}

void write_part(Imf::MultiPartOutputFile& file, int index, const ExrPart& part) {
  if (!part.mipmap) {
    Imf::OutputPart out(file, index);
    out.setFrameBuffer(frame_buffer(part.levels.front()));
    out.writePixels(part.height());
    return;
  }
  Imf::TiledOutputPart out(file, index);
  for (int l = 0; l < out.numLevels(); ++l) {
    out.setFrameBuffer(frame_buffer(part.levels[static_cast<std::size_t>(l)]));
    out.writeTiles(0, out.numXTiles(l) - 1, 0, out.numYTiles(l) - 1, l);
  }
}

}  // namespace

void set_exr_threads(int threads) {
  threads_are_set = true;
  Imf::setGlobalThreadCount(std::max(0, threads));
}

void use_default_exr_threads() {
  const int threads = omp_get_max_threads();
  if (!threads_are_set) set_exr_threads(threads > 1 ? threads : 0);
}

void write_exr(const std::filesystem::path& path, const ExrFile& file) {
  require(!file.parts.empty(), "no parts");
  for (const ExrPart& part : file.parts) check_shape(part);
  check_finite(file);
  use_default_exr_threads();
  // The format wants one display window for all parts.
  const ExrPart& first = file.parts.front();
  const Imath::Box2i display(Imath::V2i(0, 0), Imath::V2i(first.width() - 1, first.height() - 1));
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : file.parts) headers.push_back(make_header(part, display));
  try {
    Imf::MultiPartOutputFile out(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < file.parts.size(); ++i) write_part(out, static_cast<int>(i), file.parts[i]);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::memory, path.string() + ": not enough memory to write it; use smaller images");
  } catch (const std::exception& error) {
    throw Error(ErrorCode::write_failed, path.string() + ": cannot be written (" + error.what() +
                                             "); check the folder, its permissions and the free disk space");
  }
}

}  // namespace vsgl
