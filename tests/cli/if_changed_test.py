#!/usr/bin/env python3
"""--if-changed: a tool does nothing where its outputs are those that it would make, and runs again after any change.

Usage: if_changed_test.py --bin FOLDER_OF_THE_TOOLS
"""

import argparse
import json
import os
import pathlib
import shutil
import sys
import tempfile

import jsonschema

from blackbox import require, run, run_checks

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONG_AGO_NS = 10**18


class IfChangedTest:
    def __init__(self, bin_dir, folder):
        self.bin = bin_dir.resolve()
        self.folder = folder
        self.call("scene-gen", "cornell-glossy", "--resolution", "48x32", "--animate", "object", "--frames", "3", "-o", "scene.json")
        self.bake = ["rsm-bake", "scene.json", "--gbuffer", "gbuffer.exr", "--rsm", "rsm.exr", "--rsm-size", "32"]
        self.made = ["gbuffer.exr", "rsm.exr"]

    def call(self, tool, *arguments, status=0):
        """Runs a tool; returns its JSON result."""
        result = run([self.bin / tool, *arguments, "--json"], cwd=self.folder)
        require(result.status == status, f"{result}: expected status {status}")
        return json.loads(result.out)

    def make(self, *arguments, status=0):
        """Whether the tool worked. Its result holds by the schema."""
        result = self.call(*arguments, "--if-changed", "--overwrite", status=status)
        jsonschema.validate(result, json.loads((ROOT / "configs/schema/result.schema.json").read_text()))
        skipped = [entry["why"] for entry in result["skipped"] if entry["what"] == arguments[0]]
        require(all(why.startswith("unchanged") for why in skipped), f"{skipped}")
        require(not skipped or not result["phases"], f"{arguments[0]} says that it did nothing, but took time: {result['phases']}")
        return not skipped

    def age(self, names):
        """Makes the files old that are there."""
        for name in names:
            if (self.folder / name).exists():
                os.utime(self.folder / name, ns=(LONG_AGO_NS, LONG_AGO_NS))

    def require_skipped(self, command, names, status=0):
        self.age(names)
        before = [(self.folder / name).read_bytes() for name in names]
        require(not self.make(*command, status=status), f"{command[0]} ran although nothing changed")
        for name, content in zip(names, before):
            path = self.folder / name
            require(path.stat().st_mtime_ns == LONG_AGO_NS and path.read_bytes() == content, f"{name} was touched")

    def require_run(self, why, command, names, status=0):
        self.age(names)
        require(self.make(*command, status=status), f"{command[0]} did not run although {why}")
        for name in names:
            require((self.folder / name).stat().st_mtime_ns != LONG_AGO_NS, f"{name} is the old one although {why}")
        self.require_skipped(command, names, status)

    def check_unchanged(self):
        self.make(*self.bake)
        self.require_skipped(self.bake, self.made)
        for flags in (["--threads", "1"], ["-v"], ["--progress", "never"], ["--device", "cpu"]):
            self.require_skipped([*self.bake, *flags], self.made)
        run([self.bin / "rsm-bake", *self.bake[1:], "--if-changed"], cwd=self.folder).expect_success()  # nothing to overwrite

    def check_without_the_flag(self):
        for name in self.made:
            (self.folder / name).unlink(missing_ok=True)
        before = set(self.folder.iterdir())
        self.call(*self.bake)
        after = {path.name for path in set(self.folder.iterdir()) - before}
        require(after == set(self.made), f"left behind: {after}")
        self.make(*self.bake)
        self.age(self.made)
        self.call(*self.bake, "--overwrite")
        require((self.folder / "rsm.exr").stat().st_mtime_ns != LONG_AGO_NS, "nothing was done without --if-changed")

    def check_options(self):
        self.make(*self.bake)
        self.require_run("an option changed", [*self.bake, "--rsm-normals", "paper"], self.made)
        self.require_run("it changed back", self.bake, self.made)
        self.require_run("the seed changed", [*self.bake, "--seed", "1"], self.made)
        self.require_run("nothing may be skipped", [*self.bake, "--no-skip"], self.made)
        (self.folder / "options.json").write_text(json.dumps({"rsm_normals": "paper"}))
        self.make(*self.bake)
        self.require_run("an option of a file changed", [*self.bake, "--config", "options.json"], self.made)
        self.require_run("one output less is asked for", [*self.bake[:4], "--rsm-size", "32"], self.made[:1])
        result = run([self.bin / "rsm-bake", *self.bake[1:], "--if-changed"], cwd=self.folder)
        result.expect_error(2, "E2006: .*--overwrite")

    def check_inputs(self):
        self.make(*self.bake)
        scene = self.folder / "scene.json"
        text = scene.read_text()
        scene.write_text(text + "\n")
        self.require_run("its input changed", self.bake, self.made)
        scene.write_text(text)
        self.make(*self.bake)
        os.utime(scene)
        self.require_skipped(self.bake, self.made)
        mesh = self.folder / "scene.glb"
        content = mesh.read_bytes()
        self.call("scene-gen", "cornell-glossy", "--resolution", "48x32", "--scale", "1.5", "-o", "other.json")
        mesh.write_bytes((self.folder / "other.glb").read_bytes())
        self.require_run("a file that its input names changed", self.bake, self.made)
        mesh.write_bytes(content)
        shutil.copy(scene, self.folder / "copy.json")
        self.make(*self.bake)
        self.require_run("the input lies elsewhere", ["rsm-bake", "copy.json", *self.bake[2:]], self.made)

    def check_outputs(self):
        self.make(*self.bake)
        for name in self.made:
            path = self.folder / name
            path.unlink()
            self.require_run(f"{name} is missing", self.bake, self.made)
            path.write_bytes(b"damaged")
            self.require_run(f"{name} is damaged", self.bake, self.made)
            content = bytearray(path.read_bytes())
            at = content.index(b"0.1.0")
            content[at:at + 5] = b"0.0.9"
            path.write_bytes(content)
            self.require_run(f"{name} is of another version", self.bake, self.made)

    def check_record(self):
        self.make(*self.bake)
        record = self.folder / ".gbuffer.exr.run.json"
        good = json.loads(record.read_text())
        record.write_text("{")
        self.require_run("the record is damaged", self.bake, self.made)
        record.write_text(json.dumps(good | {"program": "0" * 64}))
        self.require_run("the program is another", self.bake, self.made)
        moved = self.folder / "moved"
        moved.mkdir()
        for path in self.folder.iterdir():
            if path.is_file():
                shutil.copy(path, moved)
        result = run([self.bin / "rsm-bake", *self.bake[1:], "--if-changed", "--json"], cwd=moved).expect_success()
        require(json.loads(result.out)["skipped"], "a folder that moved as a whole is made again")

    def check_every_tool(self):
        """The whole chain twice, and a verdict that is repeated."""
        self.make(*self.bake)
        chain = [
            (["scene-gen", "cornell", "-o", "cornell.json"], ["cornell.json", "cornell.glb"]),
            (["pdf-build", "--rsm", "rsm.exr", "--gbuffer", "gbuffer.exr", "-o", "pdf.exr"], ["pdf.exr"]),
            (["vsgl-gen", "--method", "fis-2016", "--rsm", "rsm.exr", "--pdf", "pdf.exr", "-o", "lights.exr", "--info", "lights.json",
              "--count", "32"], ["lights.exr", "lights.json"]),
            (["ismap", "scene.json", "--method", "ism", "--lights", "lights.exr", "-o", "ism.exr", "--tile", "16"], ["ism.exr"]),
            (["shade", "--gbuffer", "gbuffer.exr", "--lights", "lights.exr", "--ism", "ism.exr", "-o", "image.exr"], ["image.exr"]),
            (["reference", "scene.json", "--gbuffer", "gbuffer.exr", "--samples", "8", "-o", "reference.exr"], ["reference.exr"]),
            (["render", "scene.json", "--frames", "0:1", "-o", "frame.%04d.exr"], ["frame.0000.exr", "frame.0001.exr"]),
        ]
        for command, made in chain:
            require(self.make(*command), f"{command[0]} did not run")
            self.require_skipped(command, made)
        verdict = ["compare", "image.exr", "reference.exr", "-o", "verdict.json", "--limit", "relmse=0"]
        require(self.make(*verdict, status=1), "compare did not run")
        self.require_skipped(verdict, ["verdict.json"], status=1)
        self.require_run("other frames are wanted", ["render", "scene.json", "--frames", "1:2", "-o", "frame.%04d.exr"], ["frame.0001.exr"])
        sequences = ["compare", "frame.%04d.exr", "frame.%04d.exr", "--frames", "1:2", "-o", "flicker.json"]
        require(self.make(*sequences) and self.make(*sequences), "a sequence may have got new frames, but nothing was done")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    bin_dir = parser.parse_args().bin
    with tempfile.TemporaryDirectory() as temporary:
        test = IfChangedTest(bin_dir, pathlib.Path(temporary))
        return run_checks([("unchanged", test.check_unchanged), ("without the flag", test.check_without_the_flag),
                           ("options", test.check_options), ("inputs", test.check_inputs), ("outputs", test.check_outputs),
                           ("record", test.check_record), ("every tool", test.check_every_tool)])


if __name__ == "__main__":
    sys.exit(main())
