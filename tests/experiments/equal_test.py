#!/usr/bin/env python3
"""The tables of methods side by side: equal numbers of lights, equal times."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "configs" / "workflow" / "equal.py"
sys.path.insert(0, str(SCRIPT.parent))

from equal import COLUMNS, Image, after, between, compare_methods, table_rows, total_lights  # noqa: E402

LIST = {"pipeline": {"vsgl_gen": {"method": "fis-2016"}}, "counts": [64, 256]}
EXPERIMENT = {
    "scenes": {"box": {}, "hall": {}},
    "plots": ["relmse", "flip"],
    "equal": {"lights": 256, "time_of": "fis"},
    "variants": {
        "fis": LIST,
        "slow": LIST,
        "passes": {"pipeline": {"progressive": {"passes": 4}}, "counts": [16, 64]},
        "two": {"pipeline": {"vsgl_gen": {"method": "two-vsgl"}}},
        "tree": {"pipeline": {"vsgl_gen": {"method": "tree"}}, "errors": [0.1, 0.01]},
        "paths": {"reference": {}, "samples": [4, 16]},
    },
}


def row(scene, variant, n, error, time, wrong, seed=0):
    return {"scene": scene, "frame": None, "variant": variant, "n": n, "error": error, "seed": seed, "times": {"time_s": time},
            "metrics": {"relmse": wrong, "flip": 1}}


BOX = [
    row("box", "fis", 64, None, 1, 0.4), row("box", "fis", 64, None, 3, 0.2, 1),
    row("box", "fis", 256, None, 3, 0.1), row("box", "fis", 256, None, 5, 0.3, 1),  # 4 s, 0.2
    row("box", "slow", 64, None, 12, 0.03), row("box", "slow", 256, None, 48, 0.01),
    row("box", "passes", 16, None, 2, 0.08), row("box", "passes", 64, None, 8, 0.02),
    row("box", "two", None, None, 3.5, 0.7),
    row("box", "tree", None, 0.1, 0.5, 0.002), row("box", "tree", None, 0.01, 1, 0.001),
    row("box", "paths", 4, None, 2, 0.5), row("box", "paths", 16, None, 8, -0.5),
]


def methods(rows, scene=0):
    return {method["variant"]: method for method in compare_methods(EXPERIMENT, rows)[scene]["methods"]}


class Lights(unittest.TestCase):
    def test_all_passes_count(self):
        self.assertEqual(total_lights(LIST, 64), 64)
        self.assertEqual(total_lights(EXPERIMENT["variants"]["passes"], 16), 64)

    def test_passes_that_are_not_given(self):
        schema = json.loads((ROOT / "configs" / "schema" / "pipeline.schema.json").read_text(encoding="utf-8"))
        passes = schema["properties"]["progressive"]["properties"]["passes"]["default"]
        self.assertEqual(total_lights({"pipeline": {"progressive": {}}, "counts": [3]}, 3), 3 * passes)

    def test_what_has_no_number_of_lights(self):
        for name, n in (("two", None), ("tree", None), ("paths", 4)):
            self.assertIsNone(total_lights(EXPERIMENT["variants"][name], n))


class EqualLights(unittest.TestCase):
    def test_means_of_seeds(self):
        found = methods(BOX)["fis"]
        self.assertEqual((found["lights"], found["time_s"]), (256, 4))
        self.assertAlmostEqual(found["error"], 0.2)

    def test_passes_together(self):
        found = methods(BOX)["passes"]
        self.assertEqual((found["lights"], found["time_s"], found["error"]), (256, 8, 0.02))

    def test_what_has_no_number_of_lights(self):
        for name in ("two", "tree", "paths"):
            found = methods(BOX)[name]
            self.assertEqual((found["lights"], found["time_s"], found["error"]), (None, None, None), name)


class EqualTime(unittest.TestCase):
    """After 4 s."""

    def test_the_variant_itself(self):
        self.assertAlmostEqual(methods(BOX)["fis"]["error_in_time"], 0.2)

    def test_logarithmic_line(self):
        found = methods(BOX)["passes"]
        self.assertAlmostEqual(found["error_in_time"], 0.04)  # half-way from (2, .08) to (8, .02)
        self.assertEqual(found["how"], "between N = 64 and N = 256")

    def test_error_below_the_noise(self):
        found = methods(BOX)["paths"]
        self.assertAlmostEqual(found["error_in_time"], 0)
        self.assertEqual(found["how"], "between 4 samples and 16 samples")

    def test_near_enough(self):
        found = methods(BOX)["two"]
        self.assertEqual((found["error_in_time"], found["how"]), (0.7, "its image, 0.88 of the time"))

    def test_nothing_beyond_the_ends(self):
        slow, tree = methods(BOX)["slow"], methods(BOX)["tree"]
        self.assertEqual((slow["error_in_time"], slow["how"]), (None, "not within it: N = 64 takes 3.0 times as long"))
        self.assertEqual((tree["error_in_time"], tree["how"]), (None, "unknown: error 0.01 is done in 0.25 of it, with 0.001"))

    def test_ends_of_what_is_near(self):
        curve = [Image("a", 1, 10, 0.5), Image("b", 2, 20, 0.25)]
        self.assertEqual(after(curve, 8.1)[0], 0.5)
        self.assertIsNone(after(curve, 7.9)[0])
        self.assertEqual(after(curve, 24.9)[0], 0.25)
        self.assertIsNone(after(curve, 25.1)[0])

    def test_points_of_the_curve(self):
        curve = [Image("a", 1, 1, 0.9), Image("b", 2, 2, 0.3), Image("c", 3, 8, 0.1)]
        for image in curve:
            self.assertAlmostEqual(after(curve, image.time)[0], image.error)
        self.assertAlmostEqual(after(curve, 4)[0], math.sqrt(0.3 * 0.1))

    def test_equal_times(self):
        self.assertEqual(between(Image("a", 1, 2, 0.4), Image("b", 2, 2, 0.1), 2), 0.1)

    def test_images_that_cheaper_ones_beat(self):
        curve = [Image("a", 1, 1, 0.9), Image("b", 2, 2, 1.5), Image("c", 3, 4, 0.1), Image("d", 4, 4.1, 0.2)]
        self.assertAlmostEqual(after(curve, 2)[0], 0.3)
        self.assertEqual(after(curve, 4.1), (0.1, "c, 0.98 of the time"))


class Tables(unittest.TestCase):
    def test_a_scene_without_the_metric_has_none(self):
        black = [dict(entry, scene="hall", metrics={"flip": 0}) for entry in BOX]
        self.assertEqual([table["scene"] for table in compare_methods(EXPERIMENT, BOX + black)], ["box"])

    def test_scenes_are_apart(self):
        hall = [dict(entry, scene="hall", times={"time_s": 2 * entry["times"]["time_s"]}) for entry in BOX]
        tables = compare_methods(EXPERIMENT, BOX + hall)
        self.assertEqual([(table["scene"], table["time_s"]) for table in tables], [("box", 4), ("hall", 8)])
        self.assertAlmostEqual(methods(BOX + hall, 1)["passes"]["error_in_time"], 0.04)

    def test_not_asked_for(self):
        self.assertEqual(compare_methods({key: value for key, value in EXPERIMENT.items() if key != "equal"}, BOX), [])

    def test_rows_fit_the_columns(self):
        rows = table_rows(compare_methods(EXPERIMENT, BOX))
        self.assertEqual([line[COLUMNS.index("variant")] for line in rows], list(EXPERIMENT["variants"]))
        self.assertEqual({len(line) for line in rows}, {len(COLUMNS)})

    def test_markdown(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
            json.dump({"equal": compare_methods(EXPERIMENT, BOX)}, file)
            file.flush()
            done = subprocess.run([sys.executable, SCRIPT, file.name], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("`box`: 256 lights; 4.00 s, which `fis` takes", done.stdout)
        self.assertIn("| `passes` | 8.00 | 2.00e-02 | 4.00e-02 | between N = 64 and N = 256 |", done.stdout)
        self.assertIn("| `slow` | 48.00 | 1.00e-02 | - |", done.stdout)


if __name__ == "__main__":
    unittest.main()
