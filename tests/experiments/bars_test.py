#!/usr/bin/env python3
"""The figures that bars.py takes from a table."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "configs" / "workflow" / "bars.py"
sys.path.insert(0, str(SCRIPT.parent))

from bars import curve_at  # noqa: E402

COLUMNS = ["scene", "frame", "variant", "n", "error", "seed", "ismap_s", "shade_s", "shading_s", "time_s", "time_with_files_s", "wall_s",
           "relmse_rgb", "relmse_trimmed", "relmse_trimmed_denoised", "luminance_bias"]


def row(variant, n, error, shading, time, wrong, seed=0, bias=1.0):
    return {"scene": "box", "frame": "", "variant": variant, "n": n, "error": error, "seed": seed, "ismap_s": 0.5, "shade_s": 2 * shading,
            "shading_s": shading, "time_s": time, "time_with_files_s": 2 * time, "wall_s": 3 * time, "relmse_rgb": 3 * wrong,
            "relmse_trimmed": wrong, "relmse_trimmed_denoised": wrong / 2, "luminance_bias": bias}


ROWS = [
    row("default", "", 0.1, 0.1, 1, 0.01, bias=0.98), row("default", "", 0.001, 0.4, 4, 0.0001),
    row("default-exact", "", 0.1, 0.125, 3, 0.002, bias=1.01), row("default-exact", "", 0.001, 0.5, 9, 0.0002),
    row("fis-2016", 1024, "", 1.5, 4, 0.4), row("fis-2016", 1024, "", 2.5, 12, 0.2, seed=1),
    row("fis-2016-exact", 1024, "", 1, 30, 0.1),
    row("vpl", 64, "", 0.1, 0.5, 0.02), row("vpl", 1024, "", 0.1, 2, 0.0009), row("vpl", 4096, "", 0.1, 2, 0.002),
    row("reference", 8, "", "", 5, 0.00005) | {"shading_s": "", "ismap_s": "", "shade_s": ""},
]


class Bars(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_script(self, rows):
        with open(self.folder / "results.csv", "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)
        return subprocess.run([sys.executable, SCRIPT, self.folder / "results.csv", "--json", self.folder / "bars.json"],
                              capture_output=True, text=True, check=False)

    def test_figures(self):
        done = self.run_script(ROWS)
        self.assertEqual(done.returncode, 0, done.stderr)
        box = json.loads((self.folder / "bars.json").read_text(encoding="utf-8"))["box"]
        self.assertAlmostEqual(box["exact"]["shading"], 1 / 8)
        self.assertAlmostEqual(box["exact"]["sight_and_shading"], 0.625 / 1.5)
        self.assertAlmostEqual(box["exact"]["relmse_trimmed"], 1 / 50)
        self.assertAlmostEqual(box["exact_high"]["relmse_trimmed"], 1 / 500)
        self.assertAlmostEqual(box["exact_high"]["relmse_trimmed_denoised"], 1 / 500)
        self.assertAlmostEqual(box["end_to_end"]["time"], 1 / 8)
        self.assertAlmostEqual(box["end_to_end"]["relmse_rgb"], 1 / 30)
        self.assertEqual((box["mean_exact"], box["mean"]), (1.01, 0.98))
        # On a logarithmic line from (1, .01) to (4, .0001) the curve is at .001 after 2 s.
        self.assertEqual([entry["image"] for entry in box["below_the_curve"]], ["vpl 1024", "reference 8"])
        self.assertIn("vpl 1024: 2.00 s", done.stdout)

    def test_missing_image(self):
        done = self.run_script([entry for entry in ROWS if entry["variant"] != "fis-2016-exact"])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("bars: box: no fis-2016-exact 1024", done.stderr)

    def test_curve(self):
        curve = [(4, 0.0001), (1, 0.01), (2, 0.5)]
        self.assertAlmostEqual(curve_at(curve, 2), 0.001)
        self.assertEqual(curve_at(curve, 100), 0.0001)
        self.assertEqual(curve_at(curve, 0.9), float("inf"))


if __name__ == "__main__":
    unittest.main()
