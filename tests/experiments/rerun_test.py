#!/usr/bin/env python3
"""What is run again after a change, and what is not."""

import json
import pathlib
import shutil
import tempfile
import unittest

import workflow

OPTIONS = None


def ran(folder, before):
    """Stages (tool, label without hash) whose times are new since `before`, a result of stage_times()."""
    return sorted(name.rsplit("-", 1)[0] for name, content in stage_times(folder).items() if before.get(name) != content)


def stage_times(folder):
    """Stage -> what report.json says and when it was written: a run of the stage changes it."""
    return {str(path.parent.relative_to(folder / "stages")): (path.read_bytes(), path.stat().st_mtime_ns)
            for path in folder.glob("stages/*/*/report.json")}


class Rerun(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name) / "tiny"
        shutil.copytree(OPTIONS.undisturbed, self.folder, symlinks=True, ignore=shutil.ignore_patterns(".snakemake"))
        self.before = stage_times(self.folder)

    def run_edited(self, edit):
        """Runs tiny.json after edit(experiment)."""
        experiment = json.loads(workflow.TINY.read_text(encoding="utf-8"))
        edit(experiment)
        path = self.folder.parent / "tiny.json"
        path.write_text(json.dumps(experiment), encoding="utf-8")
        workflow.run(OPTIONS.bin, self.folder, experiment=path)

    def test_nothing(self):
        workflow.run(OPTIONS.bin, self.folder)
        self.assertEqual(ran(self.folder, self.before), [])

    def test_shade_options(self):
        self.run_edited(lambda experiment: experiment["variants"]["fis-2016"]["pipeline"]["shade"].update(cbr=0))
        again = ran(self.folder, self.before)
        # Shadow maps are not kept.
        self.assertEqual(sorted({name.split("/")[0] for name in again}), ["compare", "ismap", "shade"])
        self.assertEqual(len(again), 6)
        self.assertEqual(len(stage_times(self.folder)), len(self.before), "stages that nobody needs any more are still there")

    def test_another_count(self):
        self.run_edited(lambda experiment: experiment["variants"]["vpl"].update(counts=[16, 20]))
        self.assertEqual(ran(self.folder, self.before), ["compare/cornell-glossy-vpl-20-s0", "ismap/cornell-glossy-vpl-20-s0-ism",
                                                         "shade/cornell-glossy-vpl-20-s0", "vsgl-gen/cornell-glossy-vpl-20-s0"])

    def test_another_tool(self):
        (self.folder / "tools" / "reference.sha256").write_text("another\n", encoding="utf-8")
        workflow.run(OPTIONS.bin, self.folder)
        self.assertEqual(sorted({name.split("/")[0] for name in ran(self.folder, self.before)}), ["compare", "reference"])

    def test_deleted_artifact(self):
        for path in self.folder.glob("stages/compare/*vpl*/comparison.json"):
            path.unlink()
        workflow.run(OPTIONS.bin, self.folder)
        self.assertEqual(ran(self.folder, self.before), ["compare/cornell-glossy-vpl-16-s0"])


if __name__ == "__main__":
    import sys
    OPTIONS, rest = workflow.parser(__doc__).parse_known_args()
    unittest.main(argv=sys.argv[:1] + rest)
