"""What the tests of the workflow share: running the tiny experiment, and comparing what two runs left."""

import argparse
import hashlib
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXPERIMENT = ROOT / "configs" / "workflow" / "experiment.py"
TINY = ROOT / "configs" / "experiments" / "tiny.json"
# Measured, or made from what was measured.
MEASURED = ["report.json", "results.json", "results.csv", "equal.csv", "report.html", "report-spec.json"]


def parser(description):
    """With the arguments that all tests take."""
    result = argparse.ArgumentParser(description=description)
    result.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the tools")
    result.add_argument("--undisturbed", required=True, type=pathlib.Path, help="output folder of fixture.py")
    return result


def command(bin_dir, output, *further, experiment=TINY):
    return [sys.executable, EXPERIMENT, experiment, "--bin", bin_dir, "--output", output, *further]


def run(bin_dir, output, *further, experiment=TINY, env=None, check=True):
    """Runs an experiment to its end; returns its process. A failure fails the test, with what the workflow wrote."""
    arguments = command(bin_dir, output, *further, experiment=experiment)
    done = subprocess.run(arguments, env=env, capture_output=True, text=True, check=False)
    if check and done.returncode != 0:
        raise AssertionError(f"{done.args} ended with status {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def files(folder):
    """All files of an output folder but Snakemake's own."""
    return [path for path in sorted(folder.rglob("*")) if path.is_file() and ".snakemake" not in path.parts]


def digests(folder, measured=False):
    """Relative path -> SHA-256: of the files that are the same in every run, or of all."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files(folder)
            if measured or (path.name not in MEASURED and "plots" not in path.parts)}


def differences(one, other):
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))


def require_same(folder, undisturbed, bin_dir, what):
    """Everything but measured times is the same; and, given the same times, so are tables, plots and report."""
    different = differences(digests(folder), digests(undisturbed))
    assert not different, f"{what}: differs from the undisturbed run: {different}"
    for path in undisturbed.rglob("report.json"):
        shutil.copyfile(path, folder / path.relative_to(undisturbed))
    run(bin_dir, folder)
    different = differences(digests(folder, True), digests(undisturbed, True))
    assert not different, f"{what}: with the undisturbed run's times: differs: {different}"
