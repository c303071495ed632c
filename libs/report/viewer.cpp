// An image viewer: its description as JSON, its pixels as blobs, and the origin of its files.

#include "report/elements.h"
#include "report/escape.h"

namespace vsgl::report {
namespace {

using Json = nlohmann::ordered_json;

Json stored(const EncodedPlanes& encoded, BlobStore& blobs) {
  return {{"blob", blobs.add(encoded.bytes)}, {"exponent", encoded.exponent}};
}

// One layer of all images: the reference, then each test as its difference from the reference.
Json layer_json(const Images& images, std::size_t index, BlobStore& blobs) {
  const int width = images.reference.width, height = images.reference.height;
  const Layer& reference = images.reference.layers[index];
  const EncodedPlanes base = encode(reference.planes, width, height);
  Json planes = Json::array({stored(base, blobs)});
  for (const Images::Test& test : images.tests) {
    std::vector<PlaneValues> differences;
    for (std::size_t p = 0; p < reference.planes.size(); ++p)
      differences.push_back(difference_from(test.picture.layers[index].planes[p], reference.planes[p]));
    planes.push_back(stored(encode(differences, width, height), blobs));
  }
  return {{"name", reference.name},
          {"channels", reference.planes.size()},
          {"exposure", automatic_exposure(reference)},
          {"planes", planes}};
}

const char* name_of(ErrorMap::Scale scale) {
  switch (scale) {
    case ErrorMap::Scale::unit:
      return "unit";
    case ErrorMap::Scale::signed_:
      return "signed";
    case ErrorMap::Scale::log:
      break;
  }
  return "log";
}

Json map_json(const ErrorMap& map, std::size_t image, BlobStore& blobs) {
  Json out = {{"name", map.name},
              {"layer", map.layer},
              {"image", image},
              {"scale", name_of(map.scale)},
              {"limit", map.limit}};
  out.update(stored(encode({&map.values, 1}, map.width, map.height), blobs));
  return out;
}

Json description(const Images& images, BlobStore& blobs) {
  Json out = {{"width", images.reference.width},
              {"height", images.reference.height},
              {"exposure", images.exposure},
              {"tone", images.tone},
              {"images", Json::array()},
              {"layers", Json::array()},
              {"maps", Json::array()}};
  out["images"].push_back({{"label", images.reference.label}, {"file", images.reference.file}});
  for (const Images::Test& test : images.tests) {
    out["images"].push_back({{"label", test.picture.label}, {"file", test.picture.file}});
    for (const ErrorMap& map : test.maps)
      out["maps"].push_back(map_json(map, out["images"].size() - 1, blobs));
  }
  for (std::size_t i = 0; i < images.reference.layers.size(); ++i)
    out["layers"].push_back(layer_json(images, i, blobs));
  return out;
}

std::string origin_html(const Picture& picture) {
  std::string out = "<div class=\"origin\"><h4>" + escape_html(picture.label) + "</h4><dl><dt>file</dt><dd>" +
                    escape_html(picture.file) + "</dd>";
  for (const auto& [key, value] : picture.origin) {
    out += "<dt>" + escape_html(key) + "</dt><dd>";
    if (const Json inputs = Json::parse(value, nullptr, false); key == "inputs" && inputs.is_object()) {
      for (const auto& [name, hash] : inputs.items())
        out += "<span class=\"input\">" + escape_html(name) + " <code>" +
               escape_html(hash.is_string() ? hash.get<std::string>() : hash.dump()) + "</code></span>";
    } else {
      out += "<code>" + escape_html(value) + "</code>";
    }
    out += "</dd>";
  }
  if (picture.origin.empty()) out += "<dt>origin</dt><dd>the header tells nothing</dd>";
  return out + "</dl></div>\n";
}

}  // namespace

std::string viewer_html(const Images& images, BlobStore& blobs) {
  std::string out = "<div class=\"viewer\"><script type=\"application/json\">" +
                    script_json(description(images, blobs)) + "</script></div>\n";
  out += "<details class=\"origins\"><summary>Where the files come from</summary><div class=\"origin-list\">";
  for (const Images::Test& test : images.tests) out += origin_html(test.picture);
  return out + origin_html(images.reference) + "</div></details>\n";
}

}  // namespace vsgl::report
