#include "pipeline/pipeline.h"

#include "base/error.h"
#include "base/option_json.h"
#include "stages/cut/options.h"
#include "stages/lights/options.h"
#include "stages/pdf/options.h"
#include "stages/shading/options.h"
#include "stages/visibility/options.h"

namespace vsgl {
namespace {

constexpr const char* kSchema = "vsgltools/pipeline/1";

void check_schema(const JsonValue& root) {
  const JsonValue schema = root.at("$schema");
  if (schema.string() != kSchema)
    throw Error(ErrorCode::wrong_schema,
                schema.where() + ": expected \"" + kSchema + "\", got \"" + schema.string() + "\"");
}

void add_options(CLI::App& app, Progressive& progressive) {
  app.add_option("--passes", progressive.passes)->check(CLI::Range(1, max_passes));
  app.add_option("--alpha", progressive.alpha)->check(CLI::Range(0.0, 1.0));
}

template <class... Params>
void read_stage(const JsonValue& root, const std::string& key, Params&... params) {
  const auto object = root.find(key);
  if (!object) return;
  CLI::App app;
  app.option_defaults()->always_capture_default();
  (add_options(app, params), ...);
  options::read_object(app, *object);
}

}  // namespace

Pipeline read_pipeline(const std::filesystem::path& path) {
  const JsonValue root = JsonValue::parse_file(path);
  check_schema(root);
  Pipeline pipeline;
  read_stage(root, "rsm_bake", pipeline.rsm_bake);
  read_stage(root, "pdf_build", pipeline.pdf_build);
  read_stage(root, "vsgl_gen", pipeline.vsgl_gen);
  if (const auto ismap = root.find("ismap"); ismap && ismap->raw().is_null())
    pipeline.ismap.reset();
  else
    read_stage(root, "ismap", *pipeline.ismap);
  read_stage(root, "shade", pipeline.shade, pipeline.light_cut);
  if (root.find("progressive")) read_stage(root, "progressive", pipeline.progressive.emplace());
  root.finish();
  return pipeline;
}

void Pipeline::set_seed(std::uint64_t seed) {
  pdf_build.seed = vsgl_gen.seed = shade.seed = seed;
  if (ismap) ismap->seed = seed;
}

void Pipeline::set_skip(bool skip) {
  pdf_build.skip = shade.skip = skip;
  if (ismap) ismap->skip_powerless = skip;
}

void Pipeline::set_error(double error) {
  light_cut.error = error;
  if (ismap) ismap->error = error;
}

}  // namespace vsgl
