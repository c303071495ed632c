"""Runs the tools one after another on a scene, as a shell pipeline would, and keeps what each one reports."""

import json
import pathlib
import subprocess
import sys
import time


class StageFailed(Exception):
    """A tool ended with a status other than 0; the message is what it wrote to stderr."""


class Chain:
    """The stages from scene to image in one folder. Each method runs one tool and appends a row to `rows`."""

    def __init__(self, bin_dir, folder, common=()):
        self.bin = pathlib.Path(bin_dir).resolve()
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.common = list(common)
        self.rows = []

    def path(self, name):
        return str(self.folder / name)

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
        self.rows.append({"stage": tool, "wall_s": seconds, "output_bytes": size, "result": result})
        return result

    def scene_gen(self, *arguments):
        self.run("scene-gen", *arguments, "-o", self.path("scene.json"), outputs=["scene.json", "scene.glb"])

    def rsm_bake(self, *arguments):
        self.run("rsm-bake", self.path("scene.json"), "--gbuffer", self.path("gbuffer.exr"), "--rsm",
                 self.path("rsm.exr"), *arguments, outputs=["gbuffer.exr", "rsm.exr"])

    def pdf_build(self, *arguments):
        self.run("pdf-build", "--rsm", self.path("rsm.exr"), "--gbuffer", self.path("gbuffer.exr"), "-o",
                 self.path("pdf.exr"), *arguments, outputs=["pdf.exr"])

    def vsgl_gen(self, *arguments):
        self.run("vsgl-gen", "--rsm", self.path("rsm.exr"), "--pdf", self.path("pdf.exr"), "-o",
                 self.path("lights.exr"), "--info", self.path("lights.json"), *arguments,
                 outputs=["lights.exr", "lights.json"])

    def ismap(self, *arguments):
        self.run("ismap", self.path("scene.json"), "--lights", self.path("lights.exr"), "-o", self.path("ism.exr"),
                 *arguments, outputs=["ism.exr"])

    def shade(self, *arguments):
        self.run("shade", "--gbuffer", self.path("gbuffer.exr"), "--lights", self.path("lights.exr"), "--ism",
                 self.path("ism.exr"), "--rsm", self.path("rsm.exr"), "-o", self.path("indirect.exr"), *arguments,
                 outputs=["indirect.exr"])


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
