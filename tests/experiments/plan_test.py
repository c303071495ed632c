#!/usr/bin/env python3
"""Reading of experiments, and what their plans share."""

import copy
import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "configs" / "workflow"))

from plan import ExperimentError, Plan, read_experiment  # noqa: E402
from plots import pareto_front  # noqa: E402
from scene_patch import merged  # noqa: E402

EXPERIMENT = {
    "$schema": "vsgltools/experiment/1",
    "resolution": "64x36",
    "scenes": {"box": {"generate": ["cornell"]}, "hall": {"scene": "hall.json"}},
    "reference": {"samples": 64},
    "variants": {
        "fis": {"pipeline": {"vsgl_gen": {"method": "fis-2016"}}, "counts": [256, 64]},
        "fis-sharp": {"pipeline": {"vsgl_gen": {"method": "fis-2016"}, "shade": {"cbr": 0}}, "counts": [64]},
        "texels": {"pipeline": {"vsgl_gen": {"method": "texels"}, "ismap": None}},
        "tree": {"pipeline": {"vsgl_gen": {"method": "tree"}, "ismap": {"method": "rays"}}, "errors": [0.01, 0.1]},
        "bare-tree": {"pipeline": {"vsgl_gen": {"method": "tree"}, "ismap": None}, "errors": [0.1]},
        "paths": {"reference": {"strategy": "mis"}, "samples": [1, 4]},
    },
    "seeds": [0, 1],
    "decompositions": {"split": {"variant": "fis-sharp", "steps": [{"name": "sampling", "variant": "fis", "mean": True},
                                                                   {"name": "clustering", "variant": "texels"}]}},
}


def tools(plan):
    """tool -> number of its stages."""
    names = [name.split("/")[0] for name in plan.stages]
    return {name: names.count(name) for name in set(names)}


class Files(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = pathlib.Path(temporary.name) / "test.json"
        self.experiment = copy.deepcopy(EXPERIMENT)
        (self.path.parent / "hall.json").write_text('{"meshes": [{"file": "hall.glb"}, {"file": "hall.glb"}]}', encoding="utf-8")

    def read(self):
        self.path.write_text(json.dumps(self.experiment), encoding="utf-8")
        return read_experiment(self.path)

    def plan(self):
        return Plan(self.read(), self.path)


class Strictness(Files):
    def assert_error(self, where, what):
        with self.assertRaises(ExperimentError) as caught:
            self.read()
        self.assertIn(f"{self.path}: {where}: ", str(caught.exception))
        self.assertIn(what, str(caught.exception))

    def test_base_is_right(self):
        self.read()

    def test_shipped_experiments_are_right(self):
        paths = sorted((ROOT / "configs" / "experiments").glob("*.json"))
        self.assertGreaterEqual(len(paths), 3)
        for path in paths:
            with self.subTest(path.name):
                self.assertTrue(Plan(read_experiment(path), path).rows)

    def test_unknown_key(self):
        self.experiment["variants"]["fis"]["pipeline"]["vsglgen"] = {}
        self.assert_error("/variants/fis/pipeline", "vsglgen")

    def test_wrong_type(self):
        self.experiment["variants"]["fis"]["counts"][1] = "64"
        self.assert_error("/variants/fis/counts/1", "'64' is not of type 'integer'")

    def test_missing_key(self):
        del self.experiment["reference"]["samples"]
        self.assert_error("/reference", "samples")

    def test_bad_name(self):
        self.experiment["scenes"]["Big Hall"] = {"generate": ["atrium"]}
        self.assert_error("/scenes", "Big Hall")

    def test_count_given_twice(self):
        self.experiment["variants"]["fis"]["pipeline"]["vsgl_gen"]["count"] = 5
        self.assert_error("/variants/fis/pipeline/vsgl_gen/count", "/variants/fis/counts")

    def test_samples_given_twice(self):
        self.experiment["variants"]["paths"]["reference"]["samples"] = 5
        self.assert_error("/variants/paths/reference/samples", "/variants/paths/samples")

    def test_error_given_twice(self):
        self.experiment["variants"]["tree"]["pipeline"]["ismap"]["error"] = 0.1
        self.assert_error("/variants/tree/pipeline/ismap/error", "/variants/tree/errors")

    def test_two_sweeps(self):
        self.experiment["variants"]["tree"]["counts"] = [64]
        self.assert_error("/variants/tree/counts", "does not allow")

    def test_decomposition_of_a_sweep_of_errors(self):
        self.experiment["decompositions"]["split"]["steps"][1]["variant"] = "tree"
        self.assert_error("/decompositions/split/steps/1/variant", "one for each of its errors")

    def test_group_of_an_unknown_variant(self):
        self.experiment["groups"] = {"all": ["fis", "fiss"]}
        self.assert_error("/groups/all/1", "no variant \"fiss\"")

    def test_variant_without_a_group(self):
        self.experiment["groups"] = {"lists": ["fis", "fis-sharp", "texels"], "trees": ["fis", "tree", "bare-tree"]}
        self.assert_error("/groups", "none has the variant \"paths\"")

    def test_equal_time_of_an_unknown_variant(self):
        self.experiment["equal"] = {"lights": 64, "time_of": "fiss"}
        self.assert_error("/equal/time_of", "no variant \"fiss\" with 64 lights")

    def test_equal_time_of_missing_lights(self):
        self.experiment["equal"] = {"lights": 256, "time_of": "fis-sharp"}
        self.assert_error("/equal/time_of", "no variant \"fis-sharp\" with 256 lights")
        self.experiment["equal"]["time_of"] = "fis"
        self.read()

    def test_seed_of_the_reference(self):
        self.experiment["reference"]["seed"] = 1
        self.assert_error("/reference/seed", "paths")

    def test_unknown_variant(self):
        self.experiment["decompositions"]["split"]["steps"][1]["variant"] = "texel"
        self.assert_error("/decompositions/split/steps/1/variant", "fis, fis-sharp, texels")

    def test_decomposition_of_paths(self):
        self.experiment["decompositions"]["split"]["variant"] = "paths"
        self.assert_error("/decompositions/split/variant", "no variant")

    def test_missing_counts(self):
        self.experiment["decompositions"]["split"]["variant"] = "fis"
        self.experiment["decompositions"]["split"]["steps"][0]["variant"] = "fis-sharp"
        self.assert_error("/decompositions/split/steps/0/variant", "lacks numbers of lights")

    def test_mean_of_one_seed(self):
        self.experiment["variants"]["fis"]["seeds"] = [3]
        self.assert_error("/decompositions/split/steps/0/mean", "no seed but the first")

    def test_key_twice(self):
        self.path.write_text('{"seeds": [1], "seeds": [2]}', encoding="utf-8")
        with self.assertRaisesRegex(ExperimentError, "seeds"):
            read_experiment(self.path)

    def test_scene_that_is_not_there(self):
        self.experiment["scenes"]["hall"]["scene"] = "hill.json"
        with self.assertRaisesRegex(ExperimentError, "/scenes/hall/scene: .*hill.json"):
            self.plan()

    def test_no_json(self):
        self.path.write_text("{", encoding="utf-8")
        with self.assertRaisesRegex(ExperimentError, "test.json"):
            read_experiment(self.path)


class Sharing(Files):
    def test_equal_stages_are_one(self):
        found = tools(self.plan())
        # A scene: 2 variants x 64 and fis x 256, each x 2 seeds; texels x 2 seeds; one tree a seed for 2 + 1 errors.
        self.assertEqual(found, {"scene-gen": 1, "rsm-bake": 2, "pdf-build": 2, "vsgl-gen": 2 * (2 + 2 + 2 + 2),
                                 "ismap": 2 * (2 + 2 + 4), "shade": 2 * (2 + 2 + 2 + 2 + 4 + 2), "reference": 2 * (1 + 4),
                                 "compare": 2 * (8 + 6 + 4 + 1)})

    def test_rows(self):
        rows = self.plan().rows
        self.assertEqual(len(rows), 2 * 2 * (2 + 1 + 1 + 2 + 1 + 2))
        self.assertEqual(len({row["image"] for row in rows}), len(rows))

    def test_shade_options_change_shade_and_compare_only(self):
        before = self.plan().stages
        self.experiment["variants"]["fis-sharp"]["pipeline"]["shade"]["cbr"] = 0.1
        changed = {name.split("/")[0] for name in self.plan().stages.keys() - before.keys()}
        self.assertEqual(changed, {"shade", "compare"})

    def test_bake_options_change_all_but_the_scene(self):
        before = self.plan().stages
        self.experiment["rsm_bake"] = {"rsm_size": "64"}
        after = self.plan().stages
        self.assertEqual({name.split("/")[0] for name in after.keys() & before.keys()}, {"scene-gen"})

    def test_fewest_lights_come_first(self):
        stages = self.plan().stages
        first = [stage for name, stage in stages.items() if name.startswith("vsgl-gen/box-fis-2016-64-s0")]
        later = [stage for name, stage in stages.items() if name.startswith("vsgl-gen/box-fis-2016-256-")]
        self.assertEqual((len(first), len(later)), (1, 2))
        self.assertTrue(first[0]["warm_up"])
        for stage in later:
            self.assertEqual(stage["inputs"]["after"], first[0]["folder"] + "/report.json")
            self.assertFalse(stage["warm_up"])

    def test_errors(self):
        """They are for ismap, or without it for shade; the largest, which is the cheapest, comes first; trees need no density."""
        plan = self.plan()
        options = lambda tool, label: [(stage["options"].get("error"), stage["warm_up"]) for name, stage in plan.stages.items()
                                       if name.startswith(f"{tool}/box-{label}")]
        self.assertEqual(options("ismap", "tree-s0-rays"), [(0.1, True), (0.01, False)])
        self.assertEqual(options("shade", "s0"), [(None, True), (None, True), (None, False), (0.1, True)])
        self.assertEqual([row["error"] for row in plan.rows if row["variant"] == "tree" and row["scene"] == "box"],
                         [0.1, 0.1, 0.01, 0.01])
        for stage in plan.stages.values():
            if stage["folder"].startswith("stages/vsgl-gen/box-tree"):
                self.assertNotIn("pdf", stage["inputs"])

    def test_progressive_images_are_rendered(self):
        pipeline = {"vsgl_gen": {"method": "vsl"}, "progressive": {"passes": 4}}
        self.experiment |= {"variants": {"passes": {"pipeline": pipeline, "counts": [8, 16]}}, "decompositions": {}}
        plan = self.plan()
        self.assertEqual({row["image"].split("/")[1] for row in plan.rows}, {"render"})
        options = [stage["options"] for name, stage in plan.stages.items() if name.startswith("render/box")]
        self.assertEqual([part["vsgl_gen"]["count"] for part in options], [8, 8, 16, 16])
        self.assertTrue(all(part["rsm_bake"] == {"resolution": "64x36"} for part in options))

    def test_sphere_lights_are_of_the_scene(self):
        pipeline = {"vsgl_gen": {"method": "sphere-lights"}, "ismap": None}
        self.experiment |= {"variants": {"spheres": {"pipeline": pipeline}}, "decompositions": {}}
        for name, stage in self.plan().stages.items():
            if name.startswith("vsgl-gen/"):
                self.assertEqual(set(stage["inputs"]) - {"meshes", "after"}, {"scene", "tool", "parameters"})
                self.assertEqual(stage["options"], {"method": "sphere-lights"})

    def test_scene_files_are_inputs(self):
        bake = next(stage for name, stage in self.plan().stages.items() if name.startswith("rsm-bake/hall"))
        folder = self.path.resolve().parent
        self.assertEqual(bake["inputs"]["scene"], str(folder / "hall.json"))
        self.assertEqual(bake["inputs"]["meshes"], [str(folder / "hall.glb")])

    def test_patch_is_part_of_the_scene(self):
        before = self.plan().stages
        self.experiment["scenes"]["box"]["patch"] = {"materials": {"*": {"diffuse": 0.5}}}
        after = self.plan().stages
        self.assertEqual([stage["patch"] for name, stage in after.items() if name.startswith("scene-gen/")],
                         [{"materials": {"*": {"diffuse": 0.5}}}])
        self.assertFalse({name for name in before.keys() & after.keys() if "/box" in name})

    def test_repetitions(self):
        self.experiment["repetitions"] = 3
        for name, stage in self.plan().stages.items():
            self.assertEqual("repetitions" in stage, name.split("/")[0] not in ("scene-gen", "reference", "compare"), name)

    def test_frames(self):
        self.experiment["frames"] = [0, 7]
        plan = self.plan()
        self.assertEqual(tools(plan)["rsm-bake"], 4)
        bakes = {stage["arguments"] for name, stage in plan.stages.items() if name.startswith("rsm-bake/")}
        self.assertEqual(bakes, {"--frame 0", "--frame 7"})

    def test_decomposition(self):
        plan = self.plan()
        self.assertEqual(len(plan.decompositions), 2)
        stage = plan.stages[plan.decompositions[0]["comparison"].removeprefix("stages/").removesuffix("/comparison.json")]
        words = stage["arguments"].removeprefix("--layer indirect ").split()
        self.assertEqual([word.split("=")[0] for word in words], ["--step", "sampling", "--step", "clustering"])
        self.assertEqual(words[1].count("-s1-"), 1)
        self.assertEqual(words[1].count(".exr"), 1, "the first seed is not part of the mean")
        self.assertEqual(words[3].count(".exr"), 1)
        self.assertEqual(set(stage["inputs"]["steps"]), {path for word in words[1::2] for path in word.split("=")[1].split(",")})


class Methods(unittest.TestCase):
    """error-vs-time.json sets every method beside the others."""

    # What its scenes have no light for; "auto" stands for the others.
    ABSENT = {"environment", "sphere-lights", "auto", "flat", "cut", "mixture"}
    CHOICES = [("pdf_build", "method"), ("pdf_build", "gbuffer_generation"), ("vsgl_gen", "method"), ("vsgl_gen", "lobe_filter"),
               ("ismap", "method"), ("shade", "light_model"), ("shade", "schedule"), ("shade", "specular_lobe")]

    def test_all_are_there(self):
        path = ROOT / "configs" / "experiments" / "error-vs-time.json"
        pipelines = [variant["pipeline"] for variant in read_experiment(path)["variants"].values() if "pipeline" in variant]
        stages = json.loads((ROOT / "configs" / "schema" / "pipeline.schema.json").read_text(encoding="utf-8"))["properties"]
        for stage, option in self.CHOICES:
            schema = stages[stage]["properties"][option]
            used = {(pipeline.get(stage) or {}).get(option, schema["default"]) for pipeline in pipelines}
            with self.subTest(f"{stage}.{option}"):
                self.assertGreater(len(schema["enum"]), 3)
                self.assertEqual(set(schema["enum"]) - used - self.ABSENT, set())
        self.assertTrue(any("progressive" in pipeline for pipeline in pipelines))


class Patches(unittest.TestCase):
    def test_merge_patch(self):
        value = {"a": {"b": 1, "c": 2}, "d": [1]}
        patched = merged(value, {"a": {"b": None, "e": {"f": 3}}, "d": [2, 3]})
        self.assertEqual(patched, {"a": {"c": 2, "e": {"f": 3}}, "d": [2, 3]})


class Figures(unittest.TestCase):
    def test_pareto_front(self):
        points = [(1, 9), (2, 5), (2, 6), (3, 5), (4, 7), (5, 1)]
        self.assertEqual(pareto_front(points), [(1, 9), (2, 5), (5, 1)])


if __name__ == "__main__":
    unittest.main()
