#!/usr/bin/env python3
"""A few cases of each group of the stress suite pass; what it writes is as its schema says; and cases that should fail do."""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORKFLOW = ROOT / "configs" / "workflow"
SCHEMA = ROOT / "configs" / "schema" / "stress-results.schema.json"
BIN = None
sys.path.insert(0, str(WORKFLOW))

import stress  # noqa: E402
from stress_plan import FOLDER, Suite  # noqa: E402


def require_valid(results):
    jsonschema.validate(results, json.loads(SCHEMA.read_text(encoding="utf-8")))


class QuickRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.output = pathlib.Path(cls.folder.name)
        command = [sys.executable, WORKFLOW / "stress.py", "--quick", "--jobs", "1", "--bin", BIN, "--output", cls.output]
        cls.done = subprocess.run(command, capture_output=True, text=True, check=False)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_case_passes(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)

    def test_results_and_page(self):
        results = json.loads((self.output / "results.json").read_text(encoding="utf-8"))
        require_valid(results)
        files = {path.stem for path in FOLDER.glob("*.json")}
        self.assertEqual({group["name"] for group in results["groups"]}, files - {"common"})
        page = (self.output / "report.html").read_text(encoding="utf-8")
        for group in results["groups"]:
            for row in group["rows"]:
                self.assertIn(row["row"], self.done.stdout)
                self.assertIn(row["row"], page)


class Failures(unittest.TestCase):
    """A suite of cases that should fail, beside one that passes."""

    CASES = [
        {"row": "passes", "check": "sound", "bound": 0, "run": {"scene": "corner", "chain": "default"}},
        {"row": "another image", "check": "same", "bound": 1e-3, "run": {"scene": "corner", "chain": "default"},
         "base": {"set": {"intensity": 21}}},
        {"row": "not black", "check": "black", "bound": 0, "run": {"scene": "corner", "chain": "default"}},
        {"row": "no error", "check": "error", "bound": 0, "error": {"tool": "rsm-bake", "status": 3, "code": "E3020"},
         "run": {"scene": "corner", "chain": "default"}},
        {"row": "an error", "check": "sound", "bound": 0,
         "run": {"scene": "corner", "chain": "default", "set": {"intensity": 0}}},
    ]

    def test_each_is_told_from_what_passes(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder)
            (output / "common.json").write_text((FOLDER / "common.json").read_text(encoding="utf-8"), encoding="utf-8")
            group = {"$schema": "vsgltools/stress/1", "title": "Made to fail", "text": "All but one.", "cases": self.CASES}
            (output / "failures.json").write_text(json.dumps(group), encoding="utf-8")
            options = argparse.Namespace(bin=BIN, output=output, groups=None, quick=False, only="", jobs=1, keep=False)
            results = stress.run(Suite(output, stress.methods_of(BIN)), options)
            require_valid(results)
            self.assertEqual({case["row"] for case in results["groups"][0]["cases"] if case["failure"] is None}, {"passes"})


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True, type=lambda text: pathlib.Path(text).resolve())
    arguments, rest = parser.parse_known_args()
    BIN = arguments.bin
    unittest.main(argv=[sys.argv[0], *rest])
