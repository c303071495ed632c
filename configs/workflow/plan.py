"""From an experiment's JSON to its plan: the stages that must run, each with its options and input files, and the rows of the
table.

A stage's folder is named after a hash of its tool, options, arguments and input folders, so that equal stages are one and a
changed option changes the names of that stage and of those after it only."""

import hashlib
import json
import pathlib
import shlex

import jsonschema

from equal import total_lights

WITHOUT_DENSITY = ("tree", "texels", "two-vsgl")  # methods of vsgl-gen that follow none; the first is its default
TIMED = ("rsm-bake", "pdf-build", "vsgl-gen", "ismap", "shade", "render", "proxy-gi")  # that `repetitions` is for
SCHEMA = pathlib.Path(__file__).resolve().parents[1] / "schema" / "experiment.schema.json"


class ExperimentError(Exception):
    """The experiment's file is wrong; the message names the file and the JSON pointer."""


def read_experiment(path):
    """The experiment with its defaults filled in. Throws ExperimentError."""
    return complete(read_json(path), path)


def read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"), object_pairs_hook=unique_keys(path))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ExperimentError(f"{path}: {error}") from error


def judge(value, schema_path, path):
    """By a schema, which is returned."""
    schema = json.loads(schema_path.read_text(encoding="utf-8"))
    error = jsonschema.exceptions.best_match(jsonschema.Draft202012Validator(schema).iter_errors(value))
    if error is not None:
        raise ExperimentError(f"{path}: {pointer(error.absolute_path)}: {error.message}")
    return schema


def complete(experiment, path):
    """Judges the experiment of that file and fills in its defaults. Throws ExperimentError."""
    schema = judge(experiment, SCHEMA, path)
    for key in ("seeds", "plots", "repetitions"):
        experiment.setdefault(key, schema["properties"][key]["default"])
    experiment["reference"].setdefault("seed", schema["properties"]["reference"]["properties"]["seed"]["default"])
    check_names(path, experiment)
    return experiment


def unique_keys(path):
    """For json.loads: an object that has a key twice is an error."""
    def build(pairs):
        keys = [key for key, _ in pairs]
        for key in keys:
            if keys.count(key) > 1:
                raise ExperimentError(f"{path}: the key \"{key}\" stands twice in one object")
        return dict(pairs)
    return build


def pointer(path):
    return "/" + "/".join(str(part).replace("~", "~0").replace("/", "~1") for part in path)


def check_names(path, experiment):
    """What the schema cannot say: names that must exist, seeds that must differ."""
    def require(condition, where, message):
        if not condition:
            raise ExperimentError(f"{path}: {pointer(where)}: {message}")

    variants = experiment["variants"]
    for name, variant in variants.items():
        require("count" not in variant.get("pipeline", {}).get("vsgl_gen", {}) or "counts" not in variant,
                ["variants", name, "pipeline", "vsgl_gen", "count"], f"is given by /variants/{name}/counts as well; remove one")
        for stage in ("ismap", "shade"):
            require("error" not in (variant.get("pipeline", {}).get(stage) or {}) or "errors" not in variant,
                    ["variants", name, "pipeline", stage, "error"], f"is given by /variants/{name}/errors as well; remove one")
        if "reference" in variant:
            require("samples" not in variant["reference"], ["variants", name, "reference", "samples"],
                    f"belongs beside it, as a list: /variants/{name}/samples")
            require(experiment["reference"]["seed"] not in variant.get("seeds", experiment["seeds"]), ["reference", "seed"],
                    f"is a seed of the variant \"{name}\" too, which would share its paths and look better than it is")
    groups = experiment.get("groups", {})
    for name, members in groups.items():
        for i, member in enumerate(members):
            require(member in variants, ["groups", name, i], f"no variant \"{member}\"; there are {', '.join(variants)}")
    for name in variants:
        require(not groups or any(name in members for members in groups.values()), ["groups"], f"none has the variant \"{name}\"")
    if "equal" in experiment:
        lights, base = experiment["equal"]["lights"], experiment["equal"]["time_of"]
        counts = variants.get(base, {}).get("counts", [])
        require(lights in [total_lights(variants[base], n) for n in counts], ["equal", "time_of"],
                f"no variant \"{base}\" with {lights} lights")
    for name, decomposition in experiment.get("decompositions", {}).items():
        where = ["decompositions", name]
        for used, place in [(decomposition["variant"], where + ["variant"])] + [
                (step["variant"], where + ["steps", i, "variant"]) for i, step in enumerate(decomposition["steps"])]:
            require("pipeline" in variants.get(used, {}), place, f"no variant \"{used}\" with a pipeline; there are " +
                    ", ".join(other for other, variant in variants.items() if "pipeline" in variant))
            require("errors" not in variants[used], place, f"\"{used}\" has several images, one for each of its errors")
            counts = variants[used].get("counts")
            require(counts is None or set(variants[decomposition["variant"]].get("counts", [None])) <= set(counts), place,
                    f"\"{used}\" lacks numbers of lights that \"{decomposition['variant']}\" has")
        for i, step in enumerate(decomposition["steps"]):
            seeds = variants[step["variant"]].get("seeds", experiment["seeds"])
            require(not step.get("mean") or len(seeds) > 1, where + ["steps", i, "mean"],
                    f"\"{step['variant']}\" has no seed but the first, whose image is not part of the mean")


def digest(value):
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:12]


class Plan:
    """The stages of an experiment. scene(), bake(), trace() and shade() each add a stage, or find it if an equal one is there."""

    def __init__(self, experiment, path):
        self.experiment = experiment
        self.path = path
        self.folder = path.resolve().parent
        self.stages = {}
        self.origins = {}  # of a stage's options: JSON pointer into the experiment
        self.rows = []
        self.decompositions = []
        for scene in experiment["scenes"]:
            for frame in experiment.get("frames", [None]):
                self.add_frame(scene, frame)

    def stage(self, tool, label, inputs, options=None, arguments=(), origin=(), **further):
        """Returns its folder. inputs: name in the rule -> path, or list of paths, relative to the output folder. further: what
        else the rule needs to know."""
        if self.experiment.get("repetitions", 1) > 1 and tool in TIMED:
            further["repetitions"] = self.experiment["repetitions"]
        content = {"tool": tool, "options": options, "arguments": list(arguments), "inputs": inputs, **further}
        name = f"{tool}/{'-'.join(str(part) for part in label if part is not None)}-{digest(content)}"
        folder = f"stages/{name}"
        used = dict(inputs, tool=f"tools/{tool}.sha256")
        if options is not None:
            used["parameters"] = f"{folder}/parameters.json"
        self.stages[name] = {"folder": folder, "inputs": used, "options": options, "arguments": shlex.join(arguments),
                             "warm_up": tool in ("rsm-bake", "pdf-build"), **further}
        self.origins.setdefault(name, pointer(origin))
        return folder

    def scene(self, name):
        """The scene JSON and the mesh files that it names, as inputs."""
        scene = self.experiment["scenes"][name]
        if "generate" in scene:
            arguments = [*scene["generate"], "--resolution", self.experiment["resolution"]]
            patch = {"patch": scene["patch"]} if "patch" in scene else {}
            return {"scene": self.stage("scene-gen", [name], {}, None, arguments, **patch) + "/scene.json"}
        path = (self.folder / scene["scene"]).resolve()
        try:
            meshes = {mesh["file"] for mesh in json.loads(path.read_text(encoding="utf-8"))["meshes"]}
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise ExperimentError(f"{self.path}: {pointer(['scenes', name, 'scene'])}: {path}: {error}") from error
        return {"scene": str(path), "meshes": sorted(str(path.parent / mesh) for mesh in meshes)}

    def bake(self, scene, frame, options=None, origin=("rsm_bake",)):
        """Folder of G-buffer and RSM. options: None for the experiment's own."""
        options = self.experiment.get("rsm_bake", {}) if options is None else options
        options = {"resolution": self.experiment["resolution"]} | options
        return self.stage("rsm-bake", [scene, at(frame)], self.scene(scene), options, frame_arguments(frame), origin)

    def trace(self, scene, frame, options, seed, origin):
        """Image by path tracing."""
        inputs = {**self.scene(scene), "gbuffer": f"{self.bake(scene, frame)}/gbuffer.exr"}
        label = [scene, at(frame), options.get("strategy"), options["samples"], f"s{seed}"]
        arguments = ["--seed", str(seed), *frame_arguments(frame)]
        return self.stage("reference", label, inputs, options, arguments, origin) + "/reference.exr"

    def render(self, scene, frame, pipeline, count, seed, origin):
        """Image by `render`, of a pipeline that only this tool runs."""
        bake = {"resolution": self.experiment["resolution"]} | pipeline.get("rsm_bake", self.experiment.get("rsm_bake", {}))
        generation = pipeline.get("vsgl_gen", {}) | ({} if count is None else {"count": count})
        options = {"$schema": "vsgltools/pipeline/1", **pipeline, "rsm_bake": bake, "vsgl_gen": generation}
        arguments = ["--seed", str(seed), *frame_arguments(frame)]
        folder = self.stage("render", [scene, at(frame), count, f"s{seed}"], self.scene(scene), options, arguments, origin)
        return f"{folder}/image.exr", {"render": folder}

    def shade(self, scene, frame, pipeline, sweep, seed, origin):
        """Image by virtual lights, and the folders of the stages that make it."""
        n, error = sweep
        if "progressive" in pipeline:
            return self.render(scene, frame, pipeline, n, seed, origin)
        aimed = {} if error is None else {"error": error}
        def stage(tool, label, inputs, arguments=(), **further):
            key = tool.replace("-", "_")
            options = pipeline.get(key, {}) | further
            return self.stage(tool, [scene, at(frame), *label], inputs, options, arguments, (*origin, key))

        def method(key, option="method"):
            return (pipeline.get(key) or {}).get(option)

        own = "rsm_bake" in pipeline
        bake = self.bake(scene, frame, pipeline.get("rsm_bake"), (*origin, "rsm_bake") if own else ("rsm_bake",))
        rsm, gbuffer = f"{bake}/rsm.exr", f"{bake}/gbuffer.exr"
        stages = {"rsm-bake": bake}
        count = {} if n is None else {"count": n}
        inputs = {"rsm": rsm}
        if method("vsgl_gen") == "sphere-lights":
            inputs = self.scene(scene)
        elif (method("vsgl_gen") or WITHOUT_DENSITY[0]) not in WITHOUT_DENSITY:
            stages["pdf-build"] = stage("pdf-build", [method("pdf_build")], {"rsm": rsm, "gbuffer": gbuffer})
            inputs["pdf"] = f"{stages['pdf-build']}/pdf.exr"
        stages["vsgl-gen"] = stage("vsgl-gen", [method("vsgl_gen"), n, f"s{seed}"], inputs, ["--seed", str(seed)], **count)
        inputs = {"gbuffer": gbuffer, "lights": f"{stages['vsgl-gen']}/lights.exr"}
        if pipeline.get("ismap", {}) is not None:
            pixels = {} if method("ismap") == "ism" else {"gbuffer": gbuffer}
            seen = {**self.scene(scene), "lights": inputs["lights"], **pixels}
            label = [method("vsgl_gen"), n, f"s{seed}", method("ismap"), error]
            stages["ismap"] = stage("ismap", label, seen, frame_arguments(frame), **aimed)
            inputs["ism"] = f"{stages['ismap']}/ism.exr"
            aimed = {}
        stages["shade"] = stage("shade", [method("shade", "light_model"), n, f"s{seed}", error], inputs, **aimed)
        return f"{stages['shade']}/indirect.exr", stages

    def image(self, scene, frame, name, sweep, seed):
        """Of a variant: its path, and the folders of the stages that make it."""
        variant = self.experiment["variants"][name]
        if "pipeline" in variant:
            return self.shade(scene, frame, variant["pipeline"], sweep, seed, ("variants", name, "pipeline"))
        image = self.trace(scene, frame, variant["reference"] | {"samples": sweep[0]}, seed, ("variants", name, "reference"))
        return image, {"reference": str(pathlib.PurePath(image).parent)}

    def add_frame(self, scene, frame):
        """All images of one frame of a scene, and their comparison with its reference."""
        options = {key: value for key, value in self.experiment["reference"].items() if key != "seed"}
        truth = self.trace(scene, frame, options, self.experiment["reference"]["seed"], ("reference",))
        if not options.get("sphere_lights"):
            self.stages[stage_of(truth)]["checkpoint"] = True  # long, and its time does not count
        images = {}
        for name, variant in self.experiment["variants"].items():
            first = None
            for n, error in sweeps(variant):
                for seed in variant.get("seeds", self.experiment["seeds"]):
                    image, stages = self.image(scene, frame, name, (n, error), seed)
                    self.order(stages, first := first or stages)
                    images.setdefault((name, n), []).append(image)
                    comparison = self.stage("compare", [scene, at(frame), name, n, error, f"s{seed}"],
                                            {"test": image, "reference": truth}, None, ["--channels", "indirect"])
                    self.rows.append({"scene": scene, "frame": frame, "variant": name, "n": n, "error": error, "seed": seed,
                                      "image": image, "reference": truth, "stages": stages,
                                      "comparison": f"{comparison}/comparison.json"})
        for name, decomposition in self.experiment.get("decompositions", {}).items():
            self.decompose(scene, frame, name, decomposition, images, truth)

    def order(self, stages, first):
        """Of a variant's images the cheapest is made first, and after a warm-up run: so that shaders are compiled before times
        count."""
        for tool in ("vsgl-gen", "ismap", "shade", "render"):
            if tool not in stages:
                continue
            stage, before = (self.stages[stage_of(f"{folder}/report.json")] for folder in (stages[tool], first[tool]))
            before["warm_up"] = True
            if stage is not before:
                stage["inputs"]["after"] = f"{before['folder']}/report.json"

    def decompose(self, scene, frame, name, decomposition, images, truth):
        """For each number of lights: the image of the first seed, then the images with one cause of error less at each step."""
        for n in self.experiment["variants"][decomposition["variant"]].get("counts", [None]):
            steps = []
            for step in decomposition["steps"]:
                found = images.get((step["variant"], n)) or images[step["variant"], None]
                steps.append((step["name"], found[1:] if step.get("mean") else found[:1]))
            inputs = {"test": images[decomposition["variant"], n][0], "reference": truth,
                      "steps": sorted({path for _, paths in steps for path in paths})}
            arguments = ["--layer", "indirect"]
            for cause, paths in steps:
                arguments += ["--step", f"{cause}={','.join(paths)}"]
            folder = self.stage("compare", [scene, at(frame), name, n], inputs, None, arguments)
            self.decompositions.append({"name": name, "scene": scene, "frame": frame, "n": n,
                                        "comparison": f"{folder}/comparison.json"})

    def to_json(self):
        return {"experiment": self.experiment, "stages": self.stages, "rows": self.rows, "decompositions": self.decompositions}


def sweeps(variant):
    """(number of lights or samples, error) of each of its images, None where the variant does not say; the cheapest first."""
    if "errors" in variant:
        return [(None, error) for error in sorted(variant["errors"], reverse=True)]
    return [(n, None) for n in sorted(variant.get("counts", variant.get("samples", [None])))]


def stage_of(path):
    """Name of the stage that makes the file."""
    return str(pathlib.PurePath(path).parent.relative_to("stages"))


def at(frame):
    """Of a folder's name."""
    return None if frame is None else f"f{frame}"


def frame_arguments(frame):
    return [] if frame is None else ["--frame", str(frame)]
