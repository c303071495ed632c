#!/usr/bin/env python3
"""render against the separate tools: the same artifacts, with headers that differ in tool, command line and input files only; sequences
whose frames are those rendered alone; every method of every tool from a pipeline JSON.

Usage: render_test.py --bin FOLDER_OF_THE_TOOLS
"""

import argparse
import json
import pathlib
import struct
import sys
import tempfile

import jsonschema

from blackbox import require, run, run_checks
import help_text

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = "vsgltools/pipeline/1"
STAGES = {"rsm_bake": "rsm-bake", "pdf_build": "pdf-build", "vsgl_gen": "vsgl-gen", "ismap": "ismap", "shade": "shade"}
SCENES = {
    "cornell-glossy": ["cornell-glossy", "--resolution", "48x32"],
    "atrium": ["atrium", "--triangles", "6000", "--resolution", "48x32"],
}
SMALL = {
    "rsm_bake": {"rsm_size": "32"},
    "pdf_build": {"gbuffer_lights": 64, "view_samples": 32},
    "vsgl_gen": {"method": "fis-2016", "count": 48},
    "ismap": {"method": "ism", "points": 512, "tile": 16},
    "shade": {"light_model": "vsgl"},
}
TREE = {"vsgl_gen": {"method": "tree"}, "ismap": {"method": "auto"}, "shade": {"light_model": "fvpl"}}
FOR_LISTS = ("auto", "ism", "aism", "tessellated", "raytraced", "none")  # methods of ismap
# Changes to SMALL; None takes a stage away.
PIPELINES = {
    "default": TREE,
    "default, exact": {**TREE, "ismap": {"method": "rays", "exact": True, "error": 0.005}, "shade": {"light_model": "fvpl", "diffuse_scale": 1}},
    "default, no shadows": {**TREE, "ismap": None, "shade": {"light_model": "fvpl", "error": 0.05}},
    "vsgl": {},
    "vpl": {"pdf_build": {"method": "flux"}, "vsgl_gen": {"method": "vpl"}, "shade": {"light_model": "vpl"}},
    "fis-2014": {"rsm_bake": {"rsm_normals": "paper"}, "pdf_build": {"method": "brsm-vpl"}, "vsgl_gen": {"method": "fis-2014"},
                 "shade": {"light_model": "vsgl-2014", "cbr": 0}},
    "exact visibility": {"ismap": {"method": "raytraced"}},
    "no shadows": {"pdf_build": {"gbuffer_generation": "kmeans-3d"}, "ismap": None},
    "drawn": {"rsm_bake": {"visible": "raster"}},
}
ON_BOTH = ["default", "vsgl", "exact visibility", "drawn"]  # pipelines that run on both scenes; the others on the first
KEPT = ["gbuffer.exr", "rsm.exr", "pdf.exr", "lights.exr", "ism.exr"]
OWN_ATTRIBUTES = {"vsgl.tool", "vsgl.command", "vsgl.inputs"}


def pipeline(changes):
    document = {"$schema": SCHEMA}
    for stage, options in SMALL.items():
        change = changes.get(stage, {})
        document[stage] = None if change is None else {**options, **change}
    return document


def flags(options):
    """The options of a stage as its tool's flags."""
    words = []
    for key, value in options.items():
        words += ["--" + key.replace("_", "-")] + ([] if value is True else [str(value)])
    return words


def read_exr(path):
    """The attributes of each part of an OpenEXR file, {name: (type, bytes)}, and the bytes of all its pixels."""
    data = path.read_bytes()
    multipart, at, parts = bool(struct.unpack_from("<I", data, 4)[0] & 0x1000), 8, [{}]

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        value, at = data[at:end].decode(), end + 1
        return value

    while True:
        name = text()
        if name:
            kind = text()
            size = struct.unpack_from("<I", data, at)[0]
            parts[-1][name] = (kind, data[at + 4:at + 4 + size])
            at += 4 + size
        elif multipart and data[at] != 0:
            parts.append({})
        else:
            break
    first_chunk = struct.unpack_from("<Q", data, at + multipart)[0]  # the table of offsets follows the headers
    return parts, data[first_chunk:]


class RenderTest:
    def __init__(self, bin_dir, folder):
        self.bin = bin_dir.resolve()
        self.folder = folder
        for name, arguments in SCENES.items():
            self.tool("scene-gen", *arguments, "-o", f"{name}.json")

    def tool(self, name, *arguments):
        return run([self.bin / name, *arguments], cwd=self.folder).expect_success()

    def render(self, scene, document, output, *arguments):
        """Runs render on a pipeline document; returns its JSON result."""
        (self.folder / "pipeline.json").write_text(json.dumps(document))
        result = self.tool("render", f"{scene}.json", "--pipeline", "pipeline.json", "-o", output, "--overwrite", "--json", *arguments)
        return json.loads(result.out)

    def run_tools(self, scene, document, into):
        """The same chain with the separate tools; returns the names of the artifacts."""
        (self.folder / into).mkdir()
        at = lambda name: f"{into}/{name}.exr"
        stage = lambda key, *paths: self.tool(STAGES[key], *paths, *flags(document[key]))
        stage("rsm_bake", f"{scene}.json", "--gbuffer", at("gbuffer"), "--rsm", at("rsm"))
        tree, density = document["vsgl_gen"]["method"] == "tree", []
        if not tree:
            stage("pdf_build", "--rsm", at("rsm"), "--gbuffer", at("gbuffer"), "-o", at("pdf"))
            density = ["--pdf", at("pdf")]
        stage("vsgl_gen", "--rsm", at("rsm"), *density, "-o", at("lights"))
        shadows = []
        if document["ismap"] is not None:
            stage("ismap", f"{scene}.json", "--lights", at("lights"), "--gbuffer", at("gbuffer"), "-o", at("ism"))
            shadows = ["--ism", at("ism")]
        elif tree:  # shade chooses the same cut where it is not given one
            error = document["shade"].pop("error")
            self.tool("light-cut", "--gbuffer", at("gbuffer"), "--lights", at("lights"), "--error", str(error), "-o", at("cut"))
            stage("shade", "--gbuffer", at("gbuffer"), "--lights", at("lights"), "--rsm", at("rsm"), "-o", f"{into}.exr", "--error", str(error))
            shadows = ["--cut", at("cut")]
            given = [self.bin / "shade", "--gbuffer", at("gbuffer"), "--lights", at("lights"), *shadows, "-o", at("image")]
            run([*given, "--error", "0.1"], cwd=self.folder).expect_error(2, "E2005: --(cut|error) excludes --(cut|error)")
            run([*given, "--ism", at("cut")], cwd=self.folder).expect_error(2, "E2005: --(cut|ism) excludes --(cut|ism)")
        stage("shade", "--gbuffer", at("gbuffer"), "--lights", at("lights"), *shadows, "--rsm", at("rsm"), "-o", at("image"))

    def require_same(self, one, other):
        (ours, pixels), (theirs, other_pixels) = read_exr(self.folder / one), read_exr(self.folder / other)
        require(len(pixels) > 500 and pixels == other_pixels, f"{one} and {other}: their pixels are not the same bytes")
        require(len(ours) == len(theirs) and ours, f"{one}: {len(ours)} parts, {other}: {len(theirs)}")
        for a, b in zip(ours, theirs):
            require(len(a) > 10, f"{one}: too few attributes to be true: {list(a)}")
            different = [name for name in a.keys() | b.keys() if a.get(name) != b.get(name) and name not in OWN_ATTRIBUTES]
            require(not different, f"{one} and {other}: the header attributes {different} differ")

    def check_same_as_tools(self, scene, name):
        document = pipeline(PIPELINES[name])
        kept, apart = f"kept {scene} {name}", f"apart {scene} {name}"
        (self.folder / kept).mkdir()
        self.render(scene, document, f"{kept}/image.exr", "--keep", kept, "--direct")
        self.run_tools(scene, document, apart)
        made = sorted(path.name for path in (self.folder / apart).iterdir())
        require(made == sorted(path.name for path in (self.folder / kept).iterdir()), f"{kept} does not hold just {made}")
        for artifact in made:
            self.require_same(f"{kept}/{artifact}", f"{apart}/{artifact}")
        self.tool("compare", f"{kept}/image.exr", f"{apart}/image.exr")
        if (self.folder / f"{apart}.exr").exists():
            self.require_same(f"{apart}.exr", f"{apart}/image.exr")

    def check_environment(self):
        """Lit by the environment that the scene names, turned and scaled, a scene without lights renders as with the tools."""
        self.tool("scene-gen", "sky", "--resolution", "32x18", "-o", "sky.json")
        scene = json.loads((self.folder / "sky.json").read_text())
        scene["environment"].update({"rotation_deg": [0, 40, 10], "scale": 0.5})
        scene["lights"] = []
        (self.folder / "sky.json").write_text(json.dumps(scene))
        document = {"$schema": SCHEMA, "vsgl_gen": {"method": "environment", "count": 40}, "ismap": {"method": "auto"},
                    "shade": {"light_model": "vsgl"}}
        (self.folder / "sky").mkdir()
        self.render("sky", document, "sky/image.exr", "--keep", "sky")
        made = sorted(path.name for path in (self.folder / "sky").iterdir())
        require(made == ["gbuffer.exr", "image.exr", "ism.exr", "lights.exr"], f"kept: {made}")
        self.tool("rsm-bake", "sky.json", "--gbuffer", "sky-gbuffer.exr")
        self.tool("vsgl-gen", "--method", "environment", "--count", "40", "--environment", "sky-sky.exr",
                  "--environment-rotation", "0,40,10", "--environment-scale", "0.5", "-o", "sky-lights.exr")
        self.tool("ismap", "sky.json", "--lights", "sky-lights.exr", "--gbuffer", "sky-gbuffer.exr", "-o", "sky-ism.exr")
        self.tool("shade", "--light-model", "vsgl", "--gbuffer", "sky-gbuffer.exr", "--lights", "sky-lights.exr", "--ism", "sky-ism.exr",
                  "-o", "sky-image.exr")
        for name in made:
            self.require_same(f"sky/{name}", f"sky-{name}")
        refused = [self.bin / "render", "sky.json", "-o", "dark.exr"]
        run(refused, cwd=self.folder).expect_error(3, "E3020: .*environment")
        (self.folder / "pipeline.json").write_text(json.dumps(document))
        run([self.bin / "render", "cornell-glossy.json", "--pipeline", "pipeline.json", "-o", "dark.exr"], cwd=self.folder).expect_error(
            2, "E2004: .*environment")

    def check_sphere_lights(self):
        """The scene's sphere lights light it as with the tools; the RSM is made for direct light alone."""
        self.tool("scene-gen", "sphere-light", "--resolution", "32x18", "-o", "spheres.json")
        scene = json.loads((self.folder / "spheres.json").read_text())
        sphere = {"radius_m": 0.05, "radiance_w_m2_sr": [3, 2, 1]}
        scene["sphere_lights"] += [{"position": [0.2 * i, 0.5, -3], **sphere} for i in range(12)]
        (self.folder / "spheres.json").write_text(json.dumps(scene))
        document = json.loads((ROOT / "configs/pipelines/sphere-lights.json").read_text())
        (self.folder / "spheres").mkdir()
        self.render("spheres", document, "spheres/image.exr", "--keep", "spheres")
        made = sorted(path.name for path in (self.folder / "spheres").iterdir())
        require(made == ["gbuffer.exr", "image.exr", "lights.exr"], f"kept: {made}")
        self.tool("rsm-bake", "spheres.json", "--gbuffer", "spheres-gbuffer.exr")
        self.tool("vsgl-gen", "--method", "sphere-lights", "--sphere-lights", "spheres.json", "-o", "spheres-lights.exr")
        self.tool("shade", "--light-model", "vsgl", "--cbr", "0", "--gbuffer", "spheres-gbuffer.exr", "--lights", "spheres-lights.exr",
                  "-o", "spheres-image.exr")
        for name in made:
            self.require_same(f"spheres/{name}", f"spheres-{name}")
        (self.folder / "pipeline.json").write_text(json.dumps(document))
        run([self.bin / "render", "cornell-glossy.json", "--pipeline", "pipeline.json", "-o", "dark.exr"], cwd=self.folder).expect_error(
            3, "E3020: .*sphere_lights")
        run([self.bin / "vsgl-gen", "--sphere-lights", "spheres.json", "-o", "dark.exr"], cwd=self.folder).expect_error(
            2, "E2002: .*sphere-lights")

    def check_frames(self):
        self.tool("scene-gen", "cornell-glossy", "--resolution", "48x32", "--animate", "object", "--frames", "3", "-o", "moving.json")
        for name, document, kept in (("vsgl", pipeline({}), KEPT), ("tree", pipeline(TREE), [name for name in KEPT if name != "pdf.exr"])):
            self.check_sequence(name, document, kept)

    def check_sequence(self, into, document, kept):
        (self.folder / into).mkdir()
        result = self.render("moving", document, f"{into}/image.%04d.exr", "--frames", "0:2", "--keep", into)
        built = [frame["pipelines_built"] for frame in result["counts"]["frames"]]
        require(built[0] > 3 and built[1:] == [0, 0], f"pipelines built for the frames: {built}")
        require([frame["frame"] for frame in result["counts"]["frames"]] == [0, 1, 2], "wrong frames in the report")
        images = []
        for frame in range(3):
            self.render("moving", document, "alone.exr", "--frame", str(frame))
            images.append((self.folder / "alone.exr").read_bytes())
            require(images[-1] == (self.folder / f"{into}/image.{frame:04}.exr").read_bytes(), f"frame {frame} depends on those before it")
            for name in kept:
                require((self.folder / f"{into}/{name[:-4]}.{frame:04}.exr").is_file(), f"{name} of frame {frame} is missing")
        require(len(set(images)) == 3, "the frames do not differ")

    def check_passes(self):
        """Progressive rendering gives the bytes that the tools give pass by pass."""
        chain = {"pdf_build": {"method": "flux"}, "vsgl_gen": {"method": "vsl"}, "ismap": {"method": "raytraced"}, "shade": {"light_model": "vsl"}}
        document = pipeline(chain)
        self.render("cornell-glossy", {**document, "progressive": {"passes": 3, "alpha": 0.5}}, "passes.exr", "--direct")
        (self.folder / "passes").mkdir()
        at = lambda name: f"passes/{name}.exr"
        stage = lambda key, *paths: self.tool(STAGES[key], *paths, *flags(document[key]), "--overwrite")
        stage("rsm_bake", "cornell-glossy.json", "--gbuffer", at("gbuffer"), "--rsm", at("rsm"))
        stage("pdf_build", "--rsm", at("rsm"), "--gbuffer", at("gbuffer"), "-o", at("pdf"))
        for number in ("1", "2", "3"):
            of_pass = ["--pass", number, "--pass-alpha", "0.5"]
            stage("vsgl_gen", "--rsm", at("rsm"), "--pdf", at("pdf"), "-o", at("lights"), *of_pass)
            stage("ismap", "cornell-glossy.json", "--lights", at("lights"), "--gbuffer", at("gbuffer"), "-o", at("ism"))
            before = ["--accumulate", at(f"mean{int(number) - 1}")] if number != "1" else []
            stage("shade", "--gbuffer", at("gbuffer"), "--lights", at("lights"), "--ism", at("ism"), "--rsm", at("rsm"), *before, *of_pass,
                  "-o", at(f"mean{number}"))
        self.require_same("passes.exr", at("mean3"))
        require(read_exr(self.folder / at("mean2"))[1] != read_exr(self.folder / at("mean3"))[1], "the third pass changes nothing")

    def check_chains(self):
        """Markov chains go on from frame to frame as --previous makes them do."""
        (self.folder / "chains").mkdir()
        self.tool("scene-gen", "cornell-glossy", "--resolution", "48x32", "--animate", "camera", "--frames", "2", "-o", "turning.json")
        options = {"method": "metropolis", "count": 64, "mutations": 2, "large_step": 0.5}
        self.render("turning", pipeline({"vsgl_gen": options}), "chains/image.%04d.exr", "--frames", "0:1", "--keep", "chains")
        given = ["--rsm", "chains/rsm.0001.exr", "--pdf", "chains/pdf.0001.exr", *flags(options)]
        self.tool("vsgl-gen", *given, "--previous", "chains/lights.0000.exr", "-o", "chains/next.exr")
        self.require_same("chains/lights.0001.exr", "chains/next.exr")
        self.tool("vsgl-gen", *given, "-o", "chains/alone.exr")
        require(read_exr(self.folder / "chains/alone.exr")[1] != read_exr(self.folder / "chains/next.exr")[1], "the frame before plays no part")

    def check_threads(self):
        for document in (pipeline({}), pipeline(TREE)):
            for threads in ("1", "2"):
                self.render("atrium", document, f"threads{threads}.exr", "--direct", "--threads", threads)
            require((self.folder / "threads1.exr").read_bytes() == (self.folder / "threads2.exr").read_bytes(), "two threads give other bytes")

    def check_methods(self):
        tried = 0
        for stage, tool in STAGES.items():
            if stage == "rsm_bake":
                continue
            methods = [line.split()[0] for line in self.tool(tool, "--list-methods").out.splitlines()]
            require(methods, f"{tool} lists no methods")
            key = "light_model" if tool == "shade" else "method"
            for method in methods:
                if method in ("environment", "sphere-lights"):  # see check_environment, check_sphere_lights
                    continue
                on_tree = method == "tree" or (stage == "ismap" and method not in FOR_LISTS)
                base = TREE if on_tree else {}
                self.render("cornell-glossy", pipeline({**base, stage: {key: method}}), "method.exr")
                tried += 1
        require(tried >= 12, f"only {tried} methods tried")

    def check_defaults(self):
        """Without a pipeline the tools' defaults hold."""
        result = json.loads(self.tool("render", "cornell-glossy.json", "-o", "default.exr", "--resolution", "8x8", "--json").out)
        stages = result["counts"]["frames"][0]["stages"]
        counts = {stage["tool"]: stage["counts"] for stage in stages}
        tree = help_text.parse(self.tool("vsgl-gen", "--help").out).option("--method").default == "tree"
        wanted = [tool for tool in STAGES.values() if not tree or tool != "pdf-build"]
        require(list(counts) == wanted, f"stages that ran: {list(counts)}")
        if not tree:
            require(counts["vsgl-gen"]["lights"] + counts["vsgl-gen"]["dropped"] == 1024, f"not the default number of lights: {counts}")
        same = lambda *options: self.tool("render", "cornell-glossy.json", "--resolution", "16x16", "-o", "error.exr", "--overwrite", *options)
        images = []
        (self.folder / "pipeline.json").write_text(json.dumps(pipeline(TREE)))
        for options in ([], ["--error", "0.1"], ["--error", "0.5"]):
            same("--pipeline", "pipeline.json", *options)
            images.append(read_exr(self.folder / "error.exr")[1])
        require(images[0] == images[1] != images[2], "--error does not replace the pipeline's")

    def check_schema(self):
        """The schema knows just the keys that the tools take, and the committed pipelines hold by it."""
        schema = json.loads((ROOT / "configs/schema/pipeline.schema.json").read_text())
        for stage, tool in STAGES.items():
            options = help_text.parse(self.tool(tool, "--help").out).options
            shared = help_text.parse(self.tool("scene-gen", "--help").out).options
            wanted = {option.key: option for option in options
                      if option.type != "FILE" and option.long not in ("--frame", "--list-methods", "--dump", "--pass", "--pass-alpha", "--environment-rotation", "--environment-scale")
                      and (option.long == "--resolution" or option.long not in [other.long for other in shared])}
            known = schema["properties"][stage]["properties"]
            require(sorted(wanted) == sorted(known), f"schema of {stage}: {sorted(known)}, {tool} takes {sorted(wanted)}")
            for key, option in wanted.items():
                if option.choices:
                    require(option.choices == [str(choice) for choice in known[key]["enum"]], f"{stage}/{key}: choices {option.choices}, schema {known[key]['enum']}")
                if option.default:
                    require(str(known[key]["default"]) == option.default, f"{stage}/{key}: default {option.default}")
        committed = sorted((ROOT / "configs/pipelines").glob("*.json"))
        require(len(committed) >= 4, "pipelines are missing")
        for path in committed:
            jsonschema.validate(json.loads(path.read_text()), schema)

    def check_report(self):
        result = self.render("cornell-glossy", pipeline({}), "report.exr")
        cut = self.render("cornell-glossy", pipeline(PIPELINES["default, no shadows"]), "report.exr")
        require([stage["tool"] for stage in cut["counts"]["frames"][0]["stages"]] == ["rsm-bake", "vsgl-gen", "light-cut", "shade"],
                f"stages in the report: {cut['counts']['frames']}")
        jsonschema.validate(result, json.loads((ROOT / "configs/schema/result.schema.json").read_text()))
        stages = result["counts"]["frames"][0]["stages"]
        require([stage["tool"] for stage in stages] == list(STAGES.values()), f"stages in the report: {stages}")
        require(all(stage["host_s"] > 0 and stage["device_s"] > 0 for stage in stages), f"a stage without time: {stages}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    bin_dir = parser.parse_args().bin
    with tempfile.TemporaryDirectory() as temporary:
        test = RenderTest(bin_dir, pathlib.Path(temporary))
        checks = [(f"{scene}, {name}: the tools' artifacts", lambda s=scene, n=name: test.check_same_as_tools(s, n))
                  for name in PIPELINES for scene in SCENES if scene == "cornell-glossy" or name in ON_BOTH]
        checks += [("an environment", test.check_environment), ("sphere lights", test.check_sphere_lights), ("frames of a sequence", test.check_frames), ("Markov chains", test.check_chains), ("passes", test.check_passes), ("the same bytes on two threads", test.check_threads),
                   ("every method", test.check_methods), ("defaults", test.check_defaults), ("schema", test.check_schema),
                   ("report", test.check_report)]
        return run_checks(checks)


if __name__ == "__main__":
    sys.exit(main())
