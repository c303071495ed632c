#!/usr/bin/env python3
"""--no-skip computes what the scene does not need. Of the default chain that changes the image by less than a quarter of the error
that it aims at (docs/render.md), on every scene of the experiments.

Usage: no_skip_test.py --bin FOLDER_OF_THE_TOOLS
"""

import argparse
import json
import pathlib
import sys
import tempfile

from blackbox import require, run, run_checks

SCENES = {
    "cornell": ["cornell"],
    "cornell-glossy": ["cornell-glossy"],
    "cornell-glossy-sharp": ["cornell-glossy", "--alpha", "0.05"],
    "caustic-ring": ["caustic-ring"],
    "atrium": ["atrium", "--triangles", "6000"],
}
ERROR = 0.1
BOUND = (ERROR / 4) ** 2  # relMSE
MEAN = 0.001


class NoSkipTest:
    def __init__(self, bin_dir, folder):
        self.bin = bin_dir.resolve()
        self.folder = folder
        self.pipeline = folder / "pipeline.json"
        self.pipeline.write_text(json.dumps({"$schema": "vsgltools/pipeline/1", "rsm_bake": {"rsm_size": "64"},
                                             "vsgl_gen": {"method": "tree"}, "ismap": {"method": "rays", "error": ERROR},
                                             "shade": {"light_model": "fvpl"}}))

    def tool(self, name, *arguments):
        return run([self.bin / name, *arguments], cwd=self.folder)

    def render(self, name, output, *arguments):
        """What the run skipped."""
        result = self.tool("render", f"{name}.json", "--pipeline", self.pipeline, "-o", output, "--json", *arguments).expect_success()
        return {entry["what"] for entry in json.loads(result.out)["skipped"]}

    def check(self, name):
        self.tool("scene-gen", *SCENES[name], "--resolution", "96x54", "-o", f"{name}.json").expect_success()
        skipped = self.render(name, f"{name}.exr")
        kept = self.render(name, f"{name}-whole.exr", "--no-skip")
        require(kept < skipped, f"{name}: without --no-skip {skipped} is left out, with it {kept}")
        compared = self.tool("compare", f"{name}.exr", f"{name}-whole.exr", "--channels", "indirect", "-o", f"{name}-difference.json",
                             "--limit", f"relmse_rgb={BOUND}", "--limit", f"luminance_bias={MEAN}")
        require(compared.status == 0, f"{compared}\n{compared.out}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    bin_dir = parser.parse_args().bin
    with tempfile.TemporaryDirectory() as temporary:
        test = NoSkipTest(bin_dir, pathlib.Path(temporary))
        return run_checks([(name, lambda n=name: test.check(n)) for name in SCENES])


if __name__ == "__main__":
    sys.exit(main())
