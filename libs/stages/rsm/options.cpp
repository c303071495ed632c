#include "stages/rsm/options.h"

#include <CLI/CLI.hpp>

namespace vsgl {

void add_options(CLI::App& app, BakeParams& params) {
  const auto set_rsm_size = [&rsm = params.rsm](const std::string& text) {
    const ImageSize size = read_image_size("--rsm-size", text, kMaxRsmSize);
    rsm.width = size.width;
    rsm.height = size.height;
  };
  const auto set_resolution = [&params](const std::string& text) {
    params.resolution = read_image_size("--resolution", text, kMaxResolution);
  };
  const auto set_normals = [&rsm = params.rsm](const std::string& text) {
    rsm.normals = text == "paper" ? NormalConvention::paper : NormalConvention::consistent;
  };
  app.add_option_function<std::string>("--rsm-size", set_rsm_size,
                                       "texels of each RSM layer, N or WIDTHxHEIGHT, 1 to 4096")
      ->default_str("512");
  app.add_option_function<std::string>(
      "--resolution", set_resolution,
      "pixels of the G-buffer, WIDTHxHEIGHT (default: the scene's); keeps the vertical field of view");
  app.add_option_function<std::string>(
         "--rsm-normals", set_normals,
         "what bent normals do to reflected light: consistent with a path tracer, or as in the papers")
      ->check(CLI::IsMember({"consistent", "paper"}))
      ->default_str("consistent");
  const auto set_visible = [&params](const std::string& text) {
    params.visible = text == "raster" ? VisibleBy::raster
                     : text == "rays" ? VisibleBy::rays
                                      : VisibleBy::automatic;
  };
  app.add_option_function<std::string>(
         "--visible", set_visible,
         "how visible triangles are found: raster, drawn; rays, traced; auto: rays on a CPU device")
      ->check(CLI::IsMember({"auto", "raster", "rays"}))
      ->default_str("auto");
}

}  // namespace vsgl
