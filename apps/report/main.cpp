// report SPEC.json -o REPORT.html: one HTML file of tables, plots and images, to open anywhere, without a
// network.

#include "base/tool.h"
#include "report/document.h"
#include "report/spec.h"

int main(int argc, char** argv) {
  vsgl::Tool tool("report", "makes one self-contained HTML file of tables, plots and images");
  std::filesystem::path spec, output;
  tool.input("spec", spec, "description of the report, JSON (docs/report.md)")->required();
  tool.output("-o,--output", output, "HTML file to write")->required();

  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    vsgl::report::DescribedDocument described;
    {
      const vsgl::PhaseTimer timer(report, "read");
      described = vsgl::report::read_document(spec);
      for (const auto& file : described.files) tool.depends_on(file);
      described.document.made_by = tool.provenance();
    }
    const vsgl::PhaseTimer timer(report, "write");
    const std::string page = vsgl::report::render(described.document);
    vsgl::write_text(outputs.add(output), page);
    report.count("files", described.files.size());
    report.count("bytes", page.size());
    return vsgl::Exit::ok;
  });
}
