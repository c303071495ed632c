#include <ImathBox.h>
#include <ImathMatrix.h>
#include <ImathVec.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <fstream>
#include <new>

#include "base/error.h"
#include "image/exr.h"

namespace vsgl {
namespace {

// Bounds on what a header may claim. Lights are one pixel wide and one row each, hence the height.
constexpr int kMaxWidth = 1 << 16;
constexpr int kMaxHeight = 1 << 24;
constexpr int kMaxTileSide = 1 << 12;
constexpr std::size_t kMaxChannels = 1 << 15;  // visibility bits of 2^20 lights
constexpr double kMaxBytes = 32.0 * (1 << 30);
// zlib cannot compress better than 1032:1, so a header that claims more pixels than that is corrupt.
constexpr double kMaxZipRatio = 1100;
// Nor do the other codecs come near this.
constexpr double kMaxRatio = 1e5;

struct Source {
  const std::filesystem::path& path;
  Imf::MultiPartInputFile& file;

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::exr_unreadable,
                path.string() + ": " + what + "; write the file again with the tool that made it");
  }
};

ExrCompression from_imf(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
      return ExrCompression::none;
    case Imf::ZIPS_COMPRESSION:
      return ExrCompression::zips;
    case Imf::PIZ_COMPRESSION:
      return ExrCompression::piz;
    default:
      return ExrCompression::zip;
  }
}

std::map<std::string, ExrAttribute> read_attributes(const Imf::Header& header) {
  static const std::vector<std::string> structural = {"name", "type", "version", "chunkCount"};
  std::map<std::string, ExrAttribute> out;
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string name = it.name();
    if (std::find(structural.begin(), structural.end(), name) != structural.end()) continue;
    const Imf::Attribute& attribute = it.attribute();
    if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
      out[name] = i->value();
    } else if (const auto* d = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) {
      out[name] = d->value();
    } else if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
      out[name] = s->value();
    } else if (const auto* v = dynamic_cast<const Imf::V3dAttribute*>(&attribute)) {
      out[name] = std::array<double, 3>{v->value().x, v->value().y, v->value().z};
    } else if (const auto* m = dynamic_cast<const Imf::M44dAttribute*>(&attribute)) {
      std::array<double, 16> values;
      for (int k = 0; k < 16; ++k) values[static_cast<std::size_t>(k)] = m->value()[k / 4][k % 4];
      out[name] = values;
    }
  }
  return out;
}

bool is_tiled(const Imf::Header& header) {
  return header.hasType() ? header.type() == Imf::TILEDIMAGE : header.hasTileDescription();
}
bool is_mipmap(const Imf::Header& header) {
  return is_tiled(header) && header.tileDescription().mode == Imf::MIPMAP_LEVELS;
}

double pixel_bytes(const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  double channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) ++channels;
  const double pixels = (window.max.x - window.min.x + 1.0) * (window.max.y - window.min.y + 1.0);
  return pixels * channels * sizeof(float) * (is_mipmap(header) ? 4.0 / 3.0 : 1.0);
}

// Rejects what we do not read and headers that claim more pixels than the file can hold, before anything is
// allocated.
void check_headers(const Source& source) {
  const double file_bytes = static_cast<double>(std::filesystem::file_size(source.path));
  double total = 0;
  for (int i = 0; i < source.file.parts(); ++i) {
    const Imf::Header& header = source.file.header(i);
    if (header.hasType() && Imf::isDeepData(header.type())) source.fail("deep pixels are not supported");
    if (is_tiled(header) && header.tileDescription().mode == Imf::RIPMAP_LEVELS)
      source.fail("RIPMAP levels are not supported");
    if (is_mipmap(header) && header.tileDescription().roundingMode != Imf::ROUND_DOWN)
      source.fail("mip levels that are rounded up are not supported");
    std::size_t channels = 0;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it, ++channels)
      if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
        source.fail(std::string("channel '") + it.name() + "' is subsampled, which is not supported");
    if (channels == 0 || channels > kMaxChannels) source.fail(std::to_string(channels) + " channels");
    const Imf::Compression c = header.compression();
    const bool zip = c == Imf::NO_COMPRESSION || c == Imf::ZIP_COMPRESSION || c == Imf::ZIPS_COMPRESSION;
    const double bytes = pixel_bytes(header);
    if (bytes > file_bytes * (zip ? kMaxZipRatio : kMaxRatio))
      source.fail("truncated, or its header is corrupt: it claims more pixels than the file can hold");
    total += bytes;
  }
  if (total > kMaxBytes) source.fail("more than 32 GiB of pixels, which is not supported");
  for (int i = 0; i < source.file.parts(); ++i)
    if (!source.file.partComplete(i)) source.fail("truncated: pixels are missing");
}

ExrLevel make_level(const Imf::Header& header, int width, int height) {
  ExrLevel level{width, height, {}};
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (it.channel().type == Imf::UINT) {
      level.channels[it.name()] = std::vector<std::uint32_t>(pixels);
    } else {
      level.channels[it.name()] = std::vector<float>(pixels);
    }
  }
  return level;
}

// `origin`: the data window's corner, which is the same at every mip level. HALF is widened by OpenEXR.
Imf::FrameBuffer frame_buffer(ExrLevel& level, Imath::V2i origin) {
  Imf::FrameBuffer buffer;
  const Imath::Box2i window(origin, origin + Imath::V2i(level.width - 1, level.height - 1));
  for (auto& [name, plane] : level.channels) {
    if (auto* floats = std::get_if<std::vector<float>>(&plane)) {
      buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, floats->data(), window));
    } else {
      buffer.insert(name, Imf::Slice::Make(Imf::UINT, std::get<1>(plane).data(), window));
    }
  }
  return buffer;
}

void read_tiles(Imf::MultiPartInputFile& file, int index, ExrPart& part) {
  Imf::TiledInputPart in(file, index);
  for (int l = 0; l < in.numLevels(); ++l) {
    part.levels.push_back(make_level(in.header(), in.levelWidth(l), in.levelHeight(l)));
    in.setFrameBuffer(frame_buffer(part.levels.back(), in.header().dataWindow().min));
    in.readTiles(0, in.numXTiles(l) - 1, 0, in.numYTiles(l) - 1, l);
  }
}

void read_scan_lines(Imf::MultiPartInputFile& file, int index, ExrPart& part) {
  Imf::InputPart in(file, index);
  const Imath::Box2i window = in.header().dataWindow();
  part.levels.push_back(
      make_level(in.header(), window.max.x - window.min.x + 1, window.max.y - window.min.y + 1));
  in.setFrameBuffer(frame_buffer(part.levels.back(), window.min));
  in.readPixels(window.min.y, window.max.y);
}

ExrPart read_part(Imf::MultiPartInputFile& file, int index) {
  const Imf::Header& header = file.header(index);
  ExrPart part;
  if (header.hasName()) part.name = header.name();
  part.mipmap = is_mipmap(header);
  part.compression = from_imf(header.compression());
  part.attributes = read_attributes(header);
  if (is_tiled(header)) {
    read_tiles(file, index, part);
  } else {
    read_scan_lines(file, index, part);
  }
  return part;
}

}  // namespace

ExrFile read_exr(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path))
    throw Error(ErrorCode::file_not_found,
                path.string() +
                    ": no such file, or it cannot be opened; check the path, or run the tool that writes it");
  use_default_exr_threads();
  Imf::Header::setMaxImageSize(kMaxWidth, kMaxHeight);
  Imf::Header::setMaxTileSize(kMaxTileSide, kMaxTileSide);
  try {
    Imf::MultiPartInputFile in(path.c_str(), Imf::globalThreadCount(), /*reconstructChunkOffsetTable=*/false);
    check_headers(Source{path, in});
    ExrFile file;
    file.path = path.string();
    for (int i = 0; i < in.parts(); ++i) file.parts.push_back(read_part(in, i));
    return file;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::memory, path.string() + ": not enough memory to read it; use smaller images");
  } catch (const std::exception& error) {
    throw Error(ErrorCode::exr_unreadable, path.string() + ": not an EXR file, truncated or corrupt (" +
                                               error.what() +
                                               "); write the file again with the tool that made it");
  }
}

}  // namespace vsgl
