"""The papers' figures: reading configs/paper/*.json, and the stages that must run for them. A figure is an experiment, or
sequences of frames, or both, and says what is measured, drawn and told of them. docs/paper.md describes the files."""

import copy
import pathlib

from paper_values import BadExpression, names, placeholders
from plan import ExperimentError, Plan, at, complete, frame_arguments, judge, pointer, read_json, stage_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "configs" / "paper"
SCHEMA = ROOT / "configs" / "schema" / "paper.schema.json"
SIZES = "sizes.json"


def figure_paths(folder):
    """Id -> file, in the order of the papers: their years, figures before tables."""
    found = {path.stem: path for path in folder.glob("*.json") if path.name != SIZES}
    def order(name):
        kind, paper, number = name.split("-")
        return paper, kind, int(number)
    return {name: found[name] for name in sorted(found, key=order)}


def read_sizes(folder):
    """Size -> parameter -> value, each size with the values of "default" that it does not change."""
    sizes = read_json(folder / SIZES)
    return {name: sizes["default"] | values for name, values in sizes.items()}


def sized(value, size, path):
    """The value with its "$parameters" replaced; words of a command line stay words."""
    if isinstance(value, dict):
        return {key: [str(sized(word, size, path)) for word in part] if key == "generate" else sized(part, size, path)
                for key, part in value.items()}
    if isinstance(value, list):
        return [sized(part, size, path) for part in value]
    if isinstance(value, str) and value.startswith("$") and value[1:]:
        if value[1:] not in size:
            raise ExperimentError(f"{path}: \"{value}\" is no parameter; {SIZES} has {', '.join(size)}")
        return size[value[1:]]
    return value


def read_figure(path, size):
    """A figure for a size (parameter -> value), its experiment with all defaults. Throws ExperimentError."""
    raw = read_json(path)
    judge(raw, SCHEMA, path)
    figure = {key: sized(value, size, path) if key in ("experiment", "sequences", "proxies") else value for key, value in raw.items()}
    if "experiment" in figure:
        figure["experiment"] = complete({"$schema": "vsgltools/experiment/1", **figure["experiment"]}, path)
    check_names(figure, path)
    return figure


def texts(figure):
    """(place, text) of all that may show measured figures."""
    found = [(["text", part], text) for part, text in figure["text"].items()]
    for i, picture in enumerate(figure.get("pictures", [])):
        found.append((["pictures", i, "caption"], picture["caption"]))
        for r, row in enumerate(picture["rows"]):
            found += [(["pictures", i, "rows", r, "panels", p, "title"], panel["title"]) for p, panel in enumerate(row["panels"])]
    return found


def check_names(figure, path):
    """That whatever a text or an expression uses is measured; an expression may use what stands before it."""
    known = []
    def require(used, place):
        for name in used:
            if name not in known:
                others = ", ".join(known) or "none"
                raise ExperimentError(f"{path}: {pointer(place)}: \"{name}\" is not measured; there are {others}")

    try:
        for name, measure in figure["measures"].items():
            require(names(measure.get("expression", "0")), ["measures", name])
            known.append(name)
        for i, claim in enumerate(figure.get("claims", [])):
            require(names(claim["holds"]), ["claims", i, "holds"])
        for i, table in enumerate(figure.get("tables", [])):
            for title, column in table["columns"].items():
                require(column.get("values", {}).values(), ["tables", i, "columns", title, "values"])
        for place, text in texts(figure):
            require(placeholders(text), place)
    except BadExpression as error:
        raise ExperimentError(f"{path}: {error}") from error


class FigureExperiment(Plan):
    """The figure's experiment; its options stand below /experiment."""

    def stage(self, tool, label, inputs, options=None, arguments=(), origin=(), **further):
        return super().stage(tool, label, inputs, options, arguments, ("experiment", *origin), **further)


class Sequences(Plan):
    """Frames of an animated scene, by `render` with several pipelines, each sequence compared with path tracing. Its options
    stand below /sequences."""

    def __init__(self, sequences, path):
        self.sequences = sequences
        frames = sequences["frames"]
        experiment = {key: sequences[key] for key in ("resolution", "rsm_bake", "reference") if key in sequences}
        experiment["reference"] = {"seed": 1000000} | experiment["reference"]
        experiment |= {"scenes": {"sequence": sequences["scene"]}, "frames": list(range(frames)), "variants": {}}
        super().__init__(experiment, path)
        truth = self.link([self.truth(frame) for frame in range(frames)])
        self.sequence_rows = [self.add_sequence(name, pipeline, truth) for name, pipeline in sequences["pipelines"].items()]

    def stage(self, tool, label, inputs, options=None, arguments=(), origin=(), **further):
        return super().stage(tool, label, inputs, options, arguments, ("sequences", *origin), **further)

    def truth(self, frame):
        """Each frame has a seed of its own: noise that repeats would not be told from light that stays."""
        options = {key: value for key, value in self.experiment["reference"].items() if key != "seed"}
        return self.trace("sequence", frame, options, self.experiment["reference"]["seed"] + frame, ("reference",))

    def link(self, files):
        """Folder in which images that several stages made are called as the frames of a sequence."""
        folder = self.stage("sequence", ["reference"], {"frames": files})
        del self.stages[stage_of(f"{folder}/frames")]["inputs"]["tool"]
        return f"{folder}/frames"

    def made_by(self, tool, rule, *rest):
        """A stage of another name than its tool's."""
        folder = self.stage(rule, *rest)
        self.stages[stage_of(f"{folder}/report.json")]["inputs"]["tool"] = f"tools/{tool}.sha256"
        return folder

    def add_sequence(self, name, pipeline, truth):
        own = {"rsm_bake": self.sequences.get("rsm_bake", {}) | pipeline.get("rsm_bake", {})}
        options = {"$schema": "vsgltools/pipeline/1", **pipeline, **own}
        frames = f"0:{self.sequences['frames'] - 1}"
        arguments = ["--frames", frames, "--resolution", self.sequences["resolution"]]
        folder = self.made_by("render", "frames", [name], self.scene("sequence"), options, arguments, ("pipelines", name))
        images = f"{folder}/frames"
        flicker = self.made_by("compare", "flicker", [name], {"test": images, "reference": truth}, None, ["--frames", frames])
        return {"sequence": name, "frames": self.sequences["frames"], "images": images, "reference": truth, "stage": folder,
                "comparison": f"{flicker}/comparison.json"}


class SphereProxies(Plan):
    """Images of one scene by sphere proxies, each compared with its own truth. Its options stand below /proxies."""

    def __init__(self, proxies, path):
        self.proxies = proxies
        experiment = {key: proxies[key] for key in ("resolution", "repetitions") if key in proxies}
        experiment |= {"scenes": {"scene": proxies["scene"]}, "frames": [proxies.get("frame")], "variants": {}}
        super().__init__(experiment, path)

    def stage(self, tool, label, inputs, options=None, arguments=(), origin=(), **further):
        return super().stage(tool, label, inputs, options, arguments, ("proxies", *origin), **further)

    def add_frame(self, scene, frame):
        files, place = self.scene(scene), frame_arguments(frame)
        gbuffer = f"{self.bake(scene, frame)}/gbuffer.exr"
        fit = self.stage("proxy-fit", [scene, at(frame)], files, self.proxies.get("proxy_fit", {}), place, ["proxy_fit"])
        spheres = f"{fit}/proxies.json"
        before = {}
        for name, variant in self.proxies["variants"].items():
            made = {"gbuffer": gbuffer, "proxies": spheres, "scene": files["scene"], **before}
            shaded = self.stage("proxy-gi", [name], made, variant["proxy_gi"], (), ["variants", name, "proxy_gi"])
            self.stages[stage_of(f"{shaded}/report.json")]["warm_up"] = True
            before = {"after": f"{shaded}/report.json"}  # one at a time: their times count
            options = {"environment": True, **self.proxies["reference"], **variant.get("reference", {})}
            traced = {**files, "gbuffer": gbuffer, "proxies": spheres}
            truth = self.stage("reference", [scene, at(frame)], traced, options, place, ["reference"]) + "/reference.exr"
            image = f"{shaded}/softgi.exr"
            compared = self.stage("compare", [name], {"test": image, "reference": truth}, None, ["--channels", "direct", "indirect"])
            self.rows.append({"scene": scene, "frame": frame, "variant": name, "n": None, "error": None, "seed": 0, "image": image,
                              "reference": truth, "stages": {"proxy-fit": fit, "proxy-gi": shaded},
                              "comparison": f"{compared}/comparison.json"})


class Figure:
    """A figure and its stages."""

    def __init__(self, name, path, size):
        self.name, self.path = name, path
        self.content = read_figure(path, size)
        self.plans = []
        self.rows, self.sequences = [], []
        if "experiment" in self.content:
            self.plans.append(FigureExperiment(self.content["experiment"], path))
            self.rows = self.plans[-1].rows
        if "proxies" in self.content:
            self.plans.append(SphereProxies(self.content["proxies"], path))
            self.rows = self.plans[-1].rows
        if "sequences" in self.content:
            self.plans.append(Sequences(self.content["sequences"], path))
            self.sequences = self.plans[-1].sequence_rows
        self.code = {method: self.sources(method, patterns) for method, patterns in self.content.get("code", {}).items()}

    def sources(self, method, patterns):
        """The source files of a method. A pattern without a file is an error: the code has moved."""
        found = []
        for i, pattern in enumerate(patterns):
            matches = sorted(str(path) for path in ROOT.glob(pattern))
            if not matches:
                raise ExperimentError(f"{self.path}: {pointer(['code', method, i])}: no file {pattern}")
            found += matches
        return found

    def files(self):
        """All that its tables and pictures are made from."""
        found = {row[key] for row in self.rows for key in ("image", "reference", "comparison")}
        for row in self.rows:
            for tool, folder in row["stages"].items():
                found.add(f"{folder}/report.json")
                found |= {f"{folder}/{output}" for output in {"vsgl-gen": ["lights.exr"], "pdf-build": ["pdf.exr"]}.get(tool, [])}
        found |= {row[key] for row in self.sequences for key in ("images", "reference", "comparison")}
        found |= {f"{row['stage']}/report.json" for row in self.sequences}
        return sorted(found | {path for paths in self.code.values() for path in paths})

    def to_json(self):
        return {"name": self.name, "content": self.content, "rows": self.rows, "sequences": self.sequences, "code": self.code}


class PaperPlan:
    """All figures' stages together: those that figures share run once."""

    def __init__(self, figures):
        self.figures = figures
        self.stages = {}
        for figure in figures:
            for plan in figure.plans:
                for name, stage in plan.stages.items():
                    self.add(name, copy.deepcopy(stage))

    def add(self, name, stage):
        known = self.stages.setdefault(name, stage)
        known["warm_up"] = known["warm_up"] or stage["warm_up"]
        if stage.get("checkpoint"):
            known["checkpoint"] = True
        if "after" in stage["inputs"]:
            known["inputs"].setdefault("after", stage["inputs"]["after"])

    def to_json(self):
        return {"stages": self.stages, "figures": {figure.name: figure.files() for figure in self.figures}}
