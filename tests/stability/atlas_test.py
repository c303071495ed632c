#!/usr/bin/env python3
"""A small atlas: the page is made, no form in use fails to be finite, and what the atlas is to show is there: forms as published that
break where those in use do not."""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ATLAS = pathlib.Path(__file__).with_name("atlas.py")
BIN = None


class Atlas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.output = pathlib.Path(cls.folder.name) / "atlas"
        subprocess.run([sys.executable, ATLAS, "--bin", BIN, "--output", cls.output, "--quick"], check=True, stdout=subprocess.DEVNULL)
        cls.atlas = json.loads((cls.output / "atlas.json").read_text(encoding="utf-8"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_page_shows_every_map(self):
        page = (self.output / "report.html").read_text(encoding="utf-8")
        for what in ("GGX: heat maps, models", "GGX: heat maps, published", "GGX: heat maps, arithmetic",
                     "heat maps of the diffuse integrals", "heat maps of the fluence of a cluster"):
            self.assertIn(what, page)

    def test_every_lobe_model_is_there(self):
        listed = subprocess.run([BIN / "shade", "--help"], check=True, capture_output=True, text=True).stdout
        for model in self.atlas["specular"][0]["models"]:
            self.assertIn(model["name"], listed)
        self.assertGreaterEqual(len(self.atlas["specular"][0]["models"]), 5)

    def test_forms_in_use_are_finite(self):
        for model in self.atlas["specular"][0]["models"]:
            self.assertEqual(model["not_finite"], 0, model["name"])
            self.assertNotIn(None, model["mean"] + model["arithmetic"], model["name"])
        for form in self.atlas["diffuse"]["forms"] + self.atlas["light"]["forms"]:
            if not form["published"]:
                self.assertNotIn(None, form["error"], form["name"])

    def test_published_forms_break(self):
        models = {model["name"]: model for model in self.atlas["specular"][0]["models"]}
        for form in self.atlas["specular"][0]["published"]:
            same = form["name"].removesuffix(", as published")
            if same in ("sg", "asg-asg", "ndf-filter"):  # of the same mathematics
                self.assertGreater(form["mean_of_peak"], 2 * models[same]["mean_of_peak"], same)
                self.assertEqual(form["not_finite"] > 0, same != "sg", same)

    def test_figures_are_those_of_the_claims(self):
        models = {model["name"]: model for model in self.atlas["specular"][0]["models"]}
        for name in ("sg", "asg", "asg-asg"):
            self.assertLess(max(models[name]["arithmetic"]), 1e-3, name)
        self.assertLess(models["auto"]["mean_of_peak"], 0.1)
        diffuse = {form["name"]: max(form["error"]) for form in self.atlas["diffuse"]["forms"] if None not in form["error"]}
        self.assertLess(diffuse["clamped cosine, library"], 1.5e-3)
        self.assertLess(diffuse["clamped cosine, kernels"], 1.5e-3)
        self.assertGreater(diffuse["cosine pulled out"], 0.5)
        light = {form["name"]: form["error"] for form in self.atlas["light"]["forms"]}
        self.assertLess(max(light["library"]), 3e-5)
        self.assertGreater(max(error for error in light["as published"] if error is not None), 0.5)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    options, rest = parser.parse_known_args()
    BIN = options.bin
    unittest.main(argv=[sys.argv[0], *rest])
