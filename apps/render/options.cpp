#include "options.h"

#include <charconv>
#include <cstdio>
#include <set>

namespace vsgl::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFrameMark = "%04d";
constexpr int kMaxFrame = 999'999;

Error not_a_range(const std::string& text) {
  return Error(ErrorCode::bad_value, "--frames: \"" + text + "\" is no range; give FIRST:LAST, as 0:29");
}

int read_frame(const std::string& text, std::string_view digits) {
  int frame = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), frame);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) throw not_a_range(text);
  if (error == std::errc::result_out_of_range || frame < 0 || frame > kMaxFrame)
    throw Error(ErrorCode::out_of_range,
                "--frames: " + text + ": frames must be from 0 to " + std::to_string(kMaxFrame));
  return frame;
}

std::pair<int, int> read_frames(const std::string& text) {
  const std::string_view view = text;
  const std::size_t colon = view.find(':');
  if (colon == std::string_view::npos) throw not_a_range(text);
  const int first = read_frame(text, view.substr(0, colon)), last = read_frame(text, view.substr(colon + 1));
  if (last < first)
    throw Error(ErrorCode::out_of_range, "--frames: " + text + ": the last frame is before the first");
  return {first, last};
}

std::string numbered(const std::string& name, int frame) {
  char digits[16];
  std::snprintf(digits, sizeof digits, kFrameMark, frame);
  const std::size_t mark = name.find(kFrameMark);
  return mark == std::string::npos ? name : name.substr(0, mark) + digits + name.substr(mark + 4);
}

}  // namespace

void declare(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  a.scene.declare(tool);
  tool.input("--pipeline", a.pipeline,
             "pipeline JSON: the options of each stage (default: those of the tools)");
  tool.output("-o,--output", a.output, "image to write; %04d in its name stands for the frame")->required();
  tool.output_folder(
      "--keep", a.keep,
      "folder for gbuffer.exr, rsm.exr, pdf.exr, lights.exr, ism.exr or cut.exr (of several frames: "
      "gbuffer.0000.exr, ...), those that are made");
  CLI::Option* frame = app.get_option("--frame");
  CLI::Option* frames = app.add_option_function<std::string>(
      "--frames", [&a](const std::string& text) { a.frames = read_frames(text); },
      "frames of an animated scene, FIRST:LAST");
  frames->excludes(frame);
  tool.keep_from_provenance(frame);  // each image names its own frame
  tool.keep_from_provenance(frames);
  app.add_option_function<std::string>(
      "--resolution",
      [&a](const std::string& text) { a.resolution = read_image_size("--resolution", text, kMaxResolution); },
      "pixels of the image, WIDTHxHEIGHT (default: the pipeline's, or else the scene's)");
  app.add_option_function<double>(
         "--error", [&a](double error) { a.error = error; },
         "relative error of the image that the cut of a light tree may cause (default: the pipeline's)")
      ->check(CLI::Range(1e-5, 1.0));
  app.add_flag("--direct", a.direct, "add the light sources' own light as a layer");
}

Pipeline resolve_pipeline(const Arguments& a, const CommonOptions& common) {
  Pipeline pipeline = a.pipeline.empty() ? Pipeline() : read_pipeline(a.pipeline);
  if (a.resolution) pipeline.rsm_bake.resolution = a.resolution;
  if (a.error) pipeline.set_error(*a.error);
  pipeline.set_seed(common.seed);
  pipeline.set_skip(!common.no_skip);
  return pipeline;
}

FramePaths paths_of(int frame, const Arguments& a, const Pipeline& pipeline) {
  const bool several = a.last() > a.first();
  if (several && a.output.filename().string().find(kFrameMark) == std::string::npos)
    throw Error(ErrorCode::bad_value, "--output: " + a.output.string() +
                                          ": several frames need %04d in the name, as image.%04d.exr");
  FramePaths paths;
  paths.image = a.output.parent_path() / numbered(a.output.filename().string(), frame);
  if (a.keep.empty()) return paths;
  const auto kept = [&](const std::string& name) {
    return a.keep / numbered(name + (several ? ".%04d.exr" : ".exr"), frame);
  };
  paths.gbuffer = kept("gbuffer");
  paths.rsm = kept("rsm");
  if (lights_method(pipeline.vsgl_gen.method).needs_pdf) paths.pdf = kept("pdf");
  paths.lights = kept("lights");
  paths.sight = kept(pipeline.ismap ? "ism" : "cut");
  return paths;
}

void check_outputs(const Arguments& a, const Pipeline& pipeline, bool overwrite) {
  for (int frame = a.first(); frame <= a.last(); ++frame) {
    const FramePaths paths = paths_of(frame, a, pipeline);
    std::set<fs::path> taken;
    for (const fs::path* path :
         {&paths.image, &paths.gbuffer, &paths.rsm, &paths.pdf, &paths.lights, &paths.sight}) {
      if (path->empty()) continue;
      OutputSet::check(*path, overwrite);
      if (!taken.insert(fs::weakly_canonical(*path)).second)
        throw Error(ErrorCode::conflicting_options,
                    "--output: " + path->string() + " is also written by --keep; choose another output");
    }
  }
}

}  // namespace vsgl::render
