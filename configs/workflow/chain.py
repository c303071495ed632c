"""Runs the tools one after another on a scene, as a shell pipeline would, and keeps what each one reports."""

import json
import pathlib
import subprocess
import sys
import time


class StageFailed(Exception):
    """A tool ended with a status other than 0; the message is what it wrote to stderr."""


class Chain:
    """The stages from scene to image in one folder. Each method runs one tool and appends a row to `rows`. Chains in one folder
    share scene, G-buffer and RSM; `suffix` tells their other files apart. What a tool finds unchanged has the row of the run that
    made it, from `earlier`, rows of a former chain."""

    def __init__(self, bin_dir, folder, common=(), suffix="", earlier=()):
        self.bin = pathlib.Path(bin_dir).resolve()
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.common = list(common)
        self.suffix = suffix
        self.earlier = {row["stage"]: row for row in earlier}
        self.rows = []
        self.changed = False  # whether a tool made something

    def path(self, name):
        return str(self.folder / name)

    def own(self, name):
        """Name of a file that is this chain's alone."""
        stem, _, extension = name.rpartition(".")
        return f"{stem}{self.suffix}.{extension}"

    def run(self, tool, *arguments, outputs):
        """Runs a tool; returns its JSON result."""
        command = [str(self.bin / tool), *arguments, "--json", "--overwrite", *self.common]
        start = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        seconds = time.monotonic() - start
        if done.returncode != 0:
            raise StageFailed(f"{' '.join(command)}\n{done.stderr}")
        sys.stderr.write(done.stderr)
        result = json.loads(done.stdout)
        size = sum(pathlib.Path(self.path(name)).stat().st_size for name in outputs)
        row = {"stage": tool, "wall_s": seconds, "output_bytes": size, "result": result}
        unchanged = any(entry["what"] == tool and entry["why"].startswith("unchanged") for entry in result["skipped"])
        self.changed |= not unchanged
        self.rows.append(self.earlier.get(tool, row) if unchanged else row)
        return result

    def scene_gen(self, *arguments):
        self.run("scene-gen", *arguments, "-o", self.path("scene.json"), outputs=["scene.json", "scene.glb"])

    def rsm_bake(self, *arguments):
        self.run("rsm-bake", self.path("scene.json"), "--gbuffer", self.path("gbuffer.exr"), "--rsm",
                 self.path("rsm.exr"), *arguments, outputs=["gbuffer.exr", "rsm.exr"])

    def pdf_build(self, *arguments):
        self.run("pdf-build", "--rsm", self.path("rsm.exr"), "--gbuffer", self.path("gbuffer.exr"), "-o",
                 self.path(self.own("pdf.exr")), *arguments, outputs=[self.own("pdf.exr")])

    def vsgl_gen(self, *arguments):
        density = any(row["stage"] == "pdf-build" for row in self.rows)
        pdf = ["--pdf", self.path(self.own("pdf.exr"))] if density else []
        names = [self.own("lights.exr"), self.own("lights.json")]
        self.run("vsgl-gen", "--rsm", self.path("rsm.exr"), *pdf, "-o", self.path(names[0]), "--info", self.path(names[1]), *arguments,
                 outputs=names)

    def ismap(self, *arguments):
        name = self.own("ism.exr")
        self.run("ismap", self.path("scene.json"), "--lights", self.path(self.own("lights.exr")), "--gbuffer", self.path("gbuffer.exr"),
                 "-o", self.path(name), *arguments, outputs=[name])

    def shade(self, *arguments):
        name = self.own("indirect.exr")
        self.run("shade", "--gbuffer", self.path("gbuffer.exr"), "--lights", self.path(self.own("lights.exr")), "--ism",
                 self.path(self.own("ism.exr")), "--rsm", self.path("rsm.exr"), "-o", self.path(name), *arguments, outputs=[name])

    def reference(self, *arguments):
        self.run("reference", self.path("scene.json"), "--gbuffer", self.path("gbuffer.exr"), "-o", self.path("reference.exr"), *arguments,
                 outputs=["reference.exr"])


def phases(result):
    """Host seconds per phase of a tool's result."""
    return {phase["name"]: phase["host_s"] for phase in result.get("phases", [])}


def skipped(result):
    return [entry["what"] for entry in result.get("skipped", [])]


def table(rows):
    """The rows of a chain as text: stage, wall time, output size, what was skipped."""
    lines = [f"{'stage':<12}{'wall s':>8}{'output':>12}  skipped"]
    for row in rows:
        size = f"{row['output_bytes'] / 1e6:.2f} MB"
        lines.append(f"{row['stage']:<12}{row['wall_s']:>8.2f}{size:>12}  {', '.join(skipped(row['result'])) or '-'}")
    total = sum(row["wall_s"] for row in rows)
    lines.append(f"{'total':<12}{total:>8.2f}")
    return "\n".join(lines)
