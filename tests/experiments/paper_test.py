#!/usr/bin/env python3
"""The papers' figures: all of configs/paper is right and every tool takes its options; what they compute; one small figure from
scene to page."""

import argparse
import copy
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORKFLOW = ROOT / "configs" / "workflow"
sys.path.insert(0, str(WORKFLOW))

import numpy  # noqa: E402

import kernels  # noqa: E402
from code_size import code_lines, dispatches  # noqa: E402
from experiment import check_options  # noqa: E402
from paper_figure import claims  # noqa: E402
from paper_pictures import relative_error, srgb  # noqa: E402
from paper_plan import FOLDER, Figure, PaperPlan, figure_paths, read_figure, read_sizes  # noqa: E402
from paper_values import BadExpression, evaluate, fill, names, placeholders, without_placeholders  # noqa: E402
from plan import ExperimentError  # noqa: E402

OPTIONS = None
SIZES = {"default": {"resolution": "48x32", "lights": 16}, "quick": {"lights": 8}}
PIPELINE = {
    "pdf_build": {"method": "brsm-vsgl", "gbuffer_lights": 16},
    "vsgl_gen": {"method": "fis-2016", "count": "$lights"},
    "ismap": None,
    "shade": {"light_model": "vsgl"},
}
FIGURE = {
    "$schema": "vsgltools/paper/1",
    "paper": "2016",
    "label": "Fig. 1",
    "title": "a small figure",
    "experiment": {
        "resolution": "$resolution",
        "scenes": {"box": {"generate": ["cornell-glossy"]}},
        "rsm_bake": {"rsm_size": "16"},
        "reference": {"samples": 4},
        "variants": {"modified": {"pipeline": PIPELINE}},
    },
    "sequences": {
        "resolution": "24x16",
        "scene": {"generate": ["cornell", "--animate", "light", "--frames", "2"]},
        "frames": 2,
        "rsm_bake": {"rsm_size": "16"},
        "reference": {"samples": 4},
        "pipelines": {"modified": PIPELINE},
    },
    "code": {"modified": ["libs/stages/lights/fis_2016.cpp"]},
    "measures": {
        "error": {"metric": "relmse_rgb", "of": {"variant": "modified"}},
        "gap": {"kernels": "gap", "of": {}},
        "brightest": {"light": "brightest", "of": {}},
        "share": {"light": "share", "of": {}},
        "frame": {"frame_time": True, "sequence": "modified"},
        "shading": {"frame_time": ["shade"], "sequence": "modified"},
        "time": {"time": ["vsgl-gen"], "of": {}},
        "lights": {"count": "lights", "stage": "vsgl-gen", "of": {}},
        "flicker": {"flicker": "flicker", "sequence": "modified"},
        "lines": {"code": "lines", "method": "modified"},
        "twice": {"expression": "2 * lights"},
    },
    "claims": [{"claim": "There are lights", "holds": "lights > 0"}, {"claim": "There are none", "holds": "lights < 1"}],
    "pictures": [{
        "caption": "{lights} lights",
        "alt": "a box",
        "rows": [
            {"panels": [{"image": {"variant": "modified"}, "title": "image {error:.2f}"}, {"reference": {}, "title": "truth"}]},
            {"panels": [{"density": {}, "title": "density"}, {"kernels": {}, "title": "kernels"}]},
            {"panels": [{"lights": {}, "title": "lights"}]},
            {"label": "frames", "panels": [{"frame": "modified", "title": "frame"}, {"error": {}, "title": "error"}]},
            {"panels": [{"steps": {"modified": "modified"}, "title": "steps"}, {"bars": {"time": "time"}, "title": "bars"}]},
        ],
    }],
    "animation": {"caption": "moves", "alt": "a box", "panels": [{"frame": "modified", "title": "it moves"}]},
    "tables": [{"caption": "table", "rows": {"modified": {"of": {"variant": "modified"}}, "quoted": {}},
                "columns": {"relMSE": {"metric": "relmse_rgb", "not": ["quoted"]}, "paper": {"given": {"quoted": 3}}}}],
    "viewer": {"modified": {"variant": "modified"}},
    "text": {"found": "Few lights.", "here": "There are {lights} lights, {twice:.1f} if doubled.", "why": "It is small."},
}


class Shipped(unittest.TestCase):
    """configs/paper"""

    def test_every_figure_in_every_size(self):
        sizes = read_sizes(FOLDER)
        self.assertLessEqual({"default", "quick", "papers"}, set(sizes))
        for name, path in figure_paths(FOLDER).items():
            for size, values in sizes.items():
                with self.subTest(name, size=size):
                    figure = Figure(name, path, values)
                    self.assertTrue(figure.files())

    def test_tools_take_all_options(self):
        size = read_sizes(FOLDER)["default"]
        for name, path in figure_paths(FOLDER).items():
            for plan in Figure(name, path, size).plans:
                with self.subTest(name):
                    check_options(plan, path, OPTIONS.bin)

    def test_findings_are_measured(self):
        """What a text says of this run comes from this run: it holds measures, and no number but in names."""
        for name, path in figure_paths(FOLDER).items():
            text = read_figure(path, read_sizes(FOLDER)["default"])["text"]["here"]
            with self.subTest(name):
                self.assertTrue(placeholders(text))
                self.assertEqual(re.findall(r"\b[\d.]*\d\b", re.sub(r"`[^`]*`", "", without_placeholders(text))), [])


class Strictness(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = pathlib.Path(temporary.name) / "fig-2016-1.json"
        self.figure = copy.deepcopy(FIGURE)

    def read(self):
        self.path.write_text(json.dumps(self.figure), encoding="utf-8")
        return Figure("fig-2016-1", self.path, SIZES["default"])

    def assert_error(self, *what):
        with self.assertRaises(ExperimentError) as caught:
            self.read()
        for part in (str(self.path), *what):
            self.assertIn(part, str(caught.exception))

    def test_base_is_right(self):
        self.assertEqual(self.read().content["experiment"]["variants"]["modified"]["pipeline"]["vsgl_gen"]["count"], 16)

    def test_unknown_parameter(self):
        self.figure["experiment"]["resolution"] = "$resolutoin"
        self.assert_error("$resolutoin", "resolution, lights")

    def test_unknown_key(self):
        self.figure["measure"] = {}
        self.assert_error("measure")

    def test_placeholder_that_is_not_measured(self):
        self.figure["text"]["here"] = "{eror:.2f}"
        self.assert_error("/text/here", "\"eror\"", "error, gap")

    def test_broken_placeholder(self):
        self.figure["text"]["here"] = "{error"
        self.assert_error("{error")

    def test_claim_of_something_else(self):
        self.figure["claims"][0]["holds"] = "light > 0"
        self.assert_error("/claims/0/holds", "\"light\"")

    def test_expression_of_a_later_measure(self):
        self.figure["measures"] = {"first": {"expression": "error"}, **self.figure["measures"]}
        self.assert_error("/measures/first", "\"error\"")

    def test_wrong_experiment(self):
        self.figure["experiment"]["variants"]["modified"]["pipline"] = {}
        self.assert_error("pipline")

    def test_code_that_has_moved(self):
        self.figure["code"]["modified"] = ["libs/stages/lights/fis_1816.cpp"]
        self.assert_error("/code/modified/0", "fis_1816")

    def test_method_that_the_tools_do_not_have(self):
        image, frames = self.figure["experiment"]["variants"]["modified"], self.figure["sequences"]["pipelines"]
        places = [(image, "pipeline", "/experiment/variants/modified"), (frames, "modified", "/sequences/pipelines/modified")]
        for holder, key, place in places:
            right = holder[key]
            holder[key] = right | {"vsgl_gen": {"method": "fis-1816"}}
            figure = self.read()
            with self.assertRaisesRegex(ExperimentError, f"fig-2016-1.json: {place}.*fis-1816"):
                for plan in figure.plans:
                    check_options(plan, figure.path, OPTIONS.bin)
            holder[key] = right

    def test_shared_stages_run_once(self):
        one, other = self.read(), self.read()
        together = PaperPlan([one, other]).to_json()["stages"]
        self.assertEqual(together.keys(), PaperPlan([one]).to_json()["stages"].keys())


class Values(unittest.TestCase):
    def test_arithmetic(self):
        values = {"a": 6.0, "b": 4}
        cases = {"a / b - 1": 0.5, "max(a, 2 * b)": 8, "-a + abs(-b)": -2, "b < a": True, "0 < a < b": False,
                 "a < b or b >= 4": True}
        for expression, expected in cases.items():
            self.assertEqual(evaluate(expression, values), expected, expression)
        self.assertTrue(math.isnan(evaluate("a / 0", values)))
        self.assertEqual(names("max(a, b) / a"), ["a", "b"])

    def test_nothing_but_arithmetic(self):
        for expression in ("open('x')", "a.real", "__import__('os')", "[a]", "a if a else b", "c", "a +"):
            with self.subTest(expression), self.assertRaises(BadExpression):
                evaluate(expression, {"a": 1, "b": 2})

    def test_text(self):
        self.assertEqual(fill("{a:.1f} and {b:.0%}", {"a": 1.25, "b": 0.5}), "1.2 and 50%")
        self.assertEqual(placeholders("{a:.1f} and {b}"), ["a", "b"])

    def test_claims(self):
        content = {"claims": [{"claim": "more", "holds": "a > b"}]}
        self.assertEqual([entry["holds"] for a in (1, 3) for entry in claims(content, {"a": a, "b": 2})], [False, True])

    def test_code_lines(self):
        self.assertEqual(code_lines("// one\nint a; // two\n\n/* three\nfour */ int b;\n  \n"), 2)

    def test_dispatches(self):
        self.assertEqual(dispatches({"counts": {"lights": 7, "dispatches": {"draw": 2, "sum": 3}}}), 5)


class Pictures(unittest.TestCase):
    def test_transfer_function(self):
        linear = numpy.array([-1, 0, 0.0031308, 0.5, 1, 7])
        numpy.testing.assert_allclose(srgb(linear), [0, 0, 0.04045, 0.735357, 1, 1], atol=1e-4)

    def test_relative_error(self):
        grey = lambda *values: numpy.array([[[value] * 3 for value in values]], dtype=float)
        numpy.testing.assert_allclose(relative_error(grey(1, 3), grey(1, 2)), [[0, 1 / 2.015]], rtol=1e-6)

    def test_kernels_that_tile(self):
        tiles = numpy.array([[x, y, 2, 0] for x in (2, 6) for y in (2, 6)], dtype=float)
        numpy.testing.assert_array_equal(kernels.covered(tiles, 8), numpy.ones((8, 8)))

    def test_kernels_cover_parts_of_texels(self):
        cover = kernels.covered(numpy.array([[2, 2, 1.5, 0], [6, 6, 1, 1]], dtype=float), 8)
        self.assertAlmostEqual(cover.sum(), 9)
        self.assertEqual((cover[1, 1], cover[0, 1], cover[0, 0], cover[3, 3]), (1, 0.5, 0.25, 0.25))


class Whole(unittest.TestCase):
    """A figure with everything in it, from scene to page, at a size for tests."""

    def test_figure(self):
        with tempfile.TemporaryDirectory() as temporary:
            folder, out = pathlib.Path(temporary) / "figures", pathlib.Path(temporary) / "out"
            folder.mkdir()
            (folder / "fig-2016-1.json").write_text(json.dumps(FIGURE), encoding="utf-8")
            (folder / "sizes.json").write_text(json.dumps(SIZES), encoding="utf-8")
            command = [sys.executable, WORKFLOW / "paper.py", "--bin", OPTIONS.bin, "--figures", folder, "--output", out]
            done = subprocess.run([*command, "--quick"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            values = json.loads((out / "results.json").read_text(encoding="utf-8"))["figures"]["fig-2016-1"]
            self.assertEqual(values["values"]["lights"], 8)
            self.assertEqual(values["values"]["twice"], 16)
            self.assertGreater(values["values"]["error"], 0)
            self.assertGreater(values["values"]["lines"], 10)
            self.assertTrue(0 < values["values"]["gap"] < 1 <= values["values"]["brightest"])
            self.assertTrue(values["values"]["brightest"] / 8 <= values["values"]["share"] + 1e-9 < 1)
            self.assertTrue(0 < values["values"]["shading"] < values["values"]["frame"])
            self.assertEqual([claim["holds"] for claim in values["claims"]], [True, False])
            page = (out / "report.html").read_text(encoding="utf-8")
            self.assertIn("There are 8.0 lights, 16.0 if doubled.", page)
            self.assertEqual(page.count("data:image/png"), 2)
            self.assertIn("quoted,,3", (out / "figures/fig-2016-1/table-1.csv").read_text(encoding="utf-8"))
            self.assertEqual((out / "claims.csv").read_text(encoding="utf-8").count("\n"), 3)
            unknown = subprocess.run([*command, "--only", "fig-2016-9"], capture_output=True, text=True, check=False)
            self.assertEqual(unknown.returncode, 2)
            self.assertIn("no figure fig-2016-9; there are fig-2016-1", unknown.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the tools")
    OPTIONS, rest = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + rest)
