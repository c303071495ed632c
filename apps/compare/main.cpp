// compare A.exr B.exr: does A hold the same as the reference B?

#include "decomposition.h"
#include "files.h"
#include "html.h"
#include "sequences.h"

int main(int argc, char** argv) {
  vsgl::Tool tool("compare", "compares two artifacts: metrics, thresholds, error maps");
  vsgl::app::Inputs inputs;
  tool.input("test", inputs.test, "artifact to judge (A)")->required();
  tool.input("reference", inputs.reference, "artifact to judge it by (B)")->required();
  tool.output("-o,--output", inputs.output, "JSON with all figures");
  vsgl::app::declare_html(tool, inputs.html);

  // Each mode declares its flags here and is chosen below.
  vsgl::app::FilesArguments files;
  declare_files(tool, files);
  vsgl::app::SequenceArguments sequences;
  declare_sequences(tool, sequences);
  vsgl::app::DecompositionArguments decomposition;
  declare_decomposition(tool, decomposition);

  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    if (are_sequences(tool, inputs))
      return compare_sequences(tool, inputs, sequences, files.maps.layer, files.limits, report, outputs);
    if (is_decomposition(tool, decomposition))
      return decompose_error(tool, inputs, decomposition, files.maps.layer, files.limits, report, outputs);
    return compare_files(tool, inputs, files, report, outputs);
  });
}
