#!/usr/bin/env python3
"""Runs one file of cases: a command that passes, then the same command with one thing broken at a time.

A file holds {"setup": [...], "command": [...], "outputs": [...], "cases": [...]}; `setup` makes the inputs, `command` must pass and write
`outputs`. Each case starts from a copy of those inputs and may have
  setup            more commands, breaking an input
  replace          {argument: another}; an argument that the command does not have fails the case
  append           more arguments
  env              environment variables
  status           expected exit status
  stderr_matches   regular expression that the one error line matches (status 2 and above)
  files            files that must be there afterwards (status 0 and 1)
A failure (status 2 and above) must leave every file as it was, and no new one.
Words of setup commands: a tool, exr_corrupt, or one of BUILTINS. "{fixture}" stands for the folder of shared artifacts."""

import argparse
import json
import pathlib
import shutil
import tempfile

from blackbox import Failure, require, run, run_checks

KEYS = {"name", "setup", "replace", "append", "env", "status", "stderr_matches", "files"}


def write(folder, name, text):
    (folder / name).write_text(text)


def copy(folder, source, target):
    shutil.copy(folder / source, folder / target)


def truncate(folder, name, size):
    """Keeps that many bytes; below 1 that fraction."""
    data = (folder / name).read_bytes()
    keep = int(float(size) * len(data)) if float(size) < 1 else int(size)
    require(keep < len(data), f"{name} has only {len(data)} bytes")
    (folder / name).write_bytes(data[:keep])


def json_set(folder, name, pointer, value):
    """Sets the value (JSON) at a JSON pointer, whose parent exists."""
    document = json.loads((folder / name).read_text())
    target = document
    *parents, last = [int(token) if token.isdigit() else token for token in pointer.split("/")[1:]]
    for token in parents:
        target = target[token]
    target[last] = json.loads(value)
    (folder / name).write_text(json.dumps(document))


def json_drop(folder, name, pointer):
    document = json.loads((folder / name).read_text())
    target = document
    *parents, last = [int(token) if token.isdigit() else token for token in pointer.split("/")[1:]]
    for token in parents:
        target = target[token]
    del target[last]
    (folder / name).write_text(json.dumps(document))


def mkdir(folder, name):
    (folder / name).mkdir()


def remove(folder, name):
    (folder / name).unlink()


BUILTINS = {"write": write, "copy": copy, "truncate": truncate, "json-set": json_set, "json-drop": json_drop,
            "mkdir": mkdir, "remove": remove}


def snapshot(folder):
    """Bytes of every file, by name."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class CaseFile:
    def __init__(self, path, bin_folder, fixture, folder):
        self.document = json.loads(path.read_text())
        self.bin = bin_folder
        self.fixture = fixture
        self.inputs = folder / "inputs"
        self.scratch = folder / "scratch"
        self.inputs.mkdir()
        self.outputs = self.document["outputs"]

    def expand(self, words):
        return [word.replace("{fixture}", str(self.fixture)) for word in words]

    def prepare(self, commands, folder):
        for words in commands:
            program, *arguments = self.expand(words)
            if program in BUILTINS:
                BUILTINS[program](folder, *arguments)
            else:
                run([self.bin / program, *arguments], cwd=folder).expect_success()

    def command(self, case):
        words, replace = self.document["command"], case.get("replace", {})
        absent = [word for word in replace if word not in words]
        require(not absent, f"the command has no argument {absent}")
        words = [replace.get(word, word) for word in words]
        program, *arguments = self.expand(words + case.get("append", []))
        return [self.bin / program, *arguments]

    def check(self, case):
        unknown = set(case) - KEYS
        require(not unknown, f"unknown keys {unknown}")
        shutil.rmtree(self.scratch, ignore_errors=True)
        shutil.copytree(self.inputs, self.scratch)
        self.prepare(case.get("setup", []), self.scratch)
        before = snapshot(self.scratch)
        result = run(self.command(case), cwd=self.scratch, env=case.get("env"))
        if case["status"] < 2:
            require(result.status == case["status"], f"{result}: expected status {case['status']}")
        else:
            result.expect_error(case["status"], case["stderr_matches"])
        for name in case.get("files", []):
            require((self.scratch / name).is_file(), f"{result}: {name} is missing")
        after = snapshot(self.scratch)
        if case["status"] >= 2:
            changed = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
            require(not changed, f"{result}: the failure made or changed {changed}")
        temporary = [name for name in after if ".tmp-" in name]
        require(not temporary, f"{result}: temporary files were left: {temporary}")

    def checks(self):
        self.prepare(self.document.get("setup", []), self.inputs)
        base = {"name": "passes unbroken", "status": 0, "files": self.outputs}
        cases = [base, *self.document["cases"]]
        names = [case["name"] for case in cases]
        require(len(set(names)) == len(names) > 1, "the cases need names of their own, and there must be some")
        return [(case["name"], lambda c=case: self.check(c)) for case in cases]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", type=pathlib.Path)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the executables")
    parser.add_argument("--fixture", type=pathlib.Path, required=True, help="folder of shared artifacts")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        case_file = CaseFile(arguments.cases, arguments.bin.resolve(), arguments.fixture.resolve(), pathlib.Path(folder))
        try:
            checks = case_file.checks()
        except (Failure, OSError) as failure:
            print(f"FAIL setup\n{failure}")
            return 1
        return run_checks(checks)


if __name__ == "__main__":
    raise SystemExit(main())
