"""Runs the tools for the stress suite, each under a time limit, and keeps what was made: cases share scenes and chains."""

import hashlib
import json
import pathlib
import re
import shlex
import struct
import subprocess
import threading

import exr
from scene_patch import merged
from stress_inputs import edit

TIMEOUT_S = 240
STAGES = {  # what each stage reads and writes besides its options; inputs that are not there are left out
    "rsm_bake": (["{scene}"], {}, {"--gbuffer": "gbuffer.exr", "--rsm": "rsm.exr"}),
    "pdf_build": ([], {"--rsm": "rsm.exr", "--gbuffer": "gbuffer.exr"}, {"-o": "pdf.exr"}),
    "vsgl_gen": ([], {"--rsm": "rsm.exr", "--pdf": "pdf.exr"}, {"-o": "lights.exr"}),
    "light_cut": ([], {"--gbuffer": "gbuffer.exr", "--lights": "lights.exr"}, {"-o": "cut.exr"}),
    "ismap": (["{scene}"], {"--lights": "lights.exr", "--gbuffer": "gbuffer.exr", "--cut": "cut.exr"}, {"-o": "ism.exr"}),
    "shade": ([], {"--gbuffer": "gbuffer.exr", "--lights": "lights.exr", "--ism": "ism.exr"}, {"-o": "indirect.exr"}),
}
ERROR = re.compile(r"^[a-z-]+: error E(\d{4}): .+$", re.MULTILINE)


class ToolFailed(Exception):
    """A tool ended with an error, as it should where the input is bad; `code` is its number, such as "E3016"."""

    def __init__(self, tool, status, message):
        super().__init__(f"{tool} ended with status {status}: {message.strip()[-400:]}")
        self.tool, self.status = tool, status
        lines = ERROR.findall(message)
        self.code = f"E{lines[0]}" if len(lines) == 1 else None


class ToolBroke(Exception):
    """A crash, a hang, or an answer that no tool may give."""


def run_tool(command, timeout=TIMEOUT_S):
    """Standard output of a tool. Throws ToolFailed and ToolBroke."""
    words = [str(word) for word in command]
    tool = pathlib.Path(words[0]).name
    try:
        done = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=timeout, check=False)
    except subprocess.TimeoutExpired as error:
        raise ToolBroke(f"{tool}: still at work after {timeout} s: {shlex.join(words)}") from error
    if done.returncode == 0 and not ERROR.search(done.stderr):
        return done.stdout
    told = "Sanitizer" in done.stderr or "runtime error:" in done.stderr
    if done.returncode < 0 or done.returncode >= 70 or told or done.returncode < 2:
        raise ToolBroke(f"{shlex.join(words)} ended with status {done.returncode}: {done.stderr.strip()[-600:]}")
    if len(ERROR.findall(done.stderr)) != 1:
        raise ToolBroke(f"{shlex.join(words)} ended with {done.returncode}, not one error line: {done.stderr.strip()[-600:]}")
    raise ToolFailed(tool, done.returncode, done.stderr)


class Made:
    """What a chain left in its folder."""

    def __init__(self, folder, results):
        self.folder = folder
        self.results = results  # tool -> its JSON result

    def path(self, name):
        return self.folder / name

    def image(self, layer="indirect"):
        return exr.colour(self.path("indirect.exr"), layer)


def digest(value):
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:16]


class Workshop:
    """Makes runs, each once, in folders named after what they are."""

    def __init__(self, bin_dir, folder):
        self.bin = bin_dir
        self.folder = folder
        self.guard = threading.Lock()
        self.locks, self.made = {}, {}

    def make(self, run):
        """Made. Throws what the run's tools end in, the same each time."""
        return self._once(digest(run), lambda folder: self._chain(run, folder))

    def _once(self, key, build):
        with self.guard:
            lock = self.locks.setdefault(key, threading.Lock())
        with lock:
            if key not in self.made:
                folder = self.folder / key
                folder.mkdir(parents=True, exist_ok=True)
                try:
                    self.made[key] = build(folder)
                except (ToolFailed, ToolBroke) as error:
                    self.made[key] = error
        if isinstance(self.made[key], Exception):
            raise self.made[key]
        return self.made[key]

    def tool(self, name, *arguments):
        return run_tool([self.bin / name, *arguments])

    def _scene(self, scene, folder):
        """scene.json: what `generate` makes or `json` says, patched; `files` go beside it."""
        path = folder / "scene.json"
        for name, content in scene.get("files", {}).items():
            write_file(folder / name, content)
        if "generate" in scene:
            self.tool("scene-gen", *shlex.split(scene["generate"]), "-o", path, "--overwrite", "--quiet")
        made = json.loads(path.read_text(encoding="utf-8")) if "generate" in scene else scene["json"]
        path.write_text(json.dumps(merged(made, scene.get("patch", {})), indent=2), encoding="utf-8")
        return Made(folder, {})

    def _baked(self, run, options, folder):
        """Scene, G-buffer and RSM, which chains share."""
        made = self._scene(run["scene"], folder)
        made.results["rsm-bake"] = self._stage("rsm_bake", options, folder, folder)
        return made

    def _chain(self, run, folder):
        chain = merged(run["chain"], run.get("options", {}))
        baked = self._once(digest([run["scene"], chain["rsm_bake"]]), lambda place: self._baked(run, chain["rsm_bake"], place))
        for name in ("gbuffer.exr", "rsm.exr"):
            (folder / name).unlink(missing_ok=True)
            (folder / name).symlink_to(baked.path(name).resolve())
        results = dict(baked.results)
        self._edit(run, "gbuffer.exr", folder)
        for stage in list(STAGES)[1:]:
            if chain.get(stage) is None:
                continue
            results[stage.replace("_", "-")] = self._stage(stage, chain[stage], folder, baked.folder)
            self._edit(run, STAGES[stage][2]["-o"], folder)
        return Made(folder, results)

    def _stage(self, stage, options, folder, scene_folder):
        words, inputs, outputs = STAGES[stage]
        command = [word.format(scene=scene_folder / "scene.json") for word in words]
        for flag, name in inputs.items():
            if (folder / name).exists():
                command += [flag, folder / name]
        for flag, name in outputs.items():
            command += [flag, folder / name]
        config = folder / f"{stage}.json"
        config.write_text(json.dumps(options), encoding="utf-8")
        common = ["--config", config, "--threads", "1", "--json", "--overwrite", "--quiet"]
        return json.loads(self.tool(stage.replace("_", "-"), *command, *common))

    @staticmethod
    def _edit(run, name, folder):
        """Replaces values of an artifact, as the run says."""
        if name in run.get("edit", {}):
            edit(folder / name, run["edit"][name])


def write_file(path, content):
    """A text, by its lines, or a picture of floats: {"width", "height", "values"}, written as PFM."""
    if isinstance(content, list):
        path.write_text("\n".join(content) + "\n", encoding="utf-8")
        return
    values = [float(value) for value in content["values"]]
    data = struct.pack(f"<{len(values)}f", *values)
    path.write_bytes(f"PF\n{content['width']} {content['height']}\n-1.0\n".encode() + data)
