// light-cut --gbuffer gbuffer.exr --lights lights.exr -o cut.exr: the nodes of a light tree that each tile
// needs.

#include "base/tool.h"
#include "stages/cut/options.h"

namespace {

struct Arguments {
  std::filesystem::path gbuffer, lights, output;
  vsgl::CutParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  tool.input("--gbuffer", a.gbuffer, "pixels that will be shaded")->required();
  tool.input("--lights", a.lights, "light tree (vsgl-gen --method tree)")->required();
  tool.output("-o,--output", a.output, "cut to write")->required();
  vsgl::add_options(tool.app(), a.params);
}

template <class Read>
auto timed(vsgl::Report& report, const char* phase, Read read) {
  const vsgl::PhaseTimer timer(report, phase);
  return read();
}

vsgl::Exit run(const vsgl::Tool& tool, const Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const auto gbuffer = timed(report, "read gbuffer", [&] { return vsgl::read_gbuffer(a.gbuffer); });
  const auto lights = timed(report, "read lights", [&] { return vsgl::read_lights(a.lights); });
  const vsgl::Cut cut = vsgl::build_cut(gbuffer, lights, a.params, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), cut, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("light-cut", "chooses the nodes of a light tree that each tile of an image needs");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
