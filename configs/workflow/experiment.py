#!/usr/bin/env python3
"""Runs an experiment: scenes x frames x variants x N x seeds, each image compared with a reference. What is there already and
still valid is not made again. docs/experiments.md describes the files."""

import argparse
import fcntl
import hashlib
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

from plan import ExperimentError, Plan, read_experiment
from stage import remove_leftovers

WORKFLOW = pathlib.Path(__file__).resolve().parent
PYTHON = "/usr/bin/python3"  # the one whose packages Debian's packages are
SNAKEMAKE = "/usr/bin/snakemake"
TOOLS = ["scene-gen", "rsm-bake", "pdf-build", "vsgl-gen", "ismap", "shade", "render", "reference", "compare", "report",
         "proxy-fit", "proxy-gi"]
# What else a tool must be given before it looks at its options.
DRY_RUN = {
    "rsm-bake": ["scene.json", "--gbuffer", "gbuffer.exr", "--rsm", "rsm.exr"],
    "pdf-build": ["--rsm", "rsm.exr", "-o", "pdf.exr"],
    "vsgl-gen": ["--rsm", "rsm.exr", "--pdf", "pdf.exr", "-o", "lights.exr"],
    "ismap": ["scene.json", "--lights", "lights.exr", "-o", "ism.exr"],
    "shade": ["--gbuffer", "gbuffer.exr", "--lights", "lights.exr", "-o", "indirect.exr"],
    "reference": ["scene.json", "--gbuffer", "gbuffer.exr", "-o", "reference.exr"],
    "proxy-fit": ["scene.json", "-o", "proxies.json"],
    "proxy-gi": ["--gbuffer", "gbuffer.exr", "--proxies", "proxies.json", "--environment", "sky.exr", "-o", "softgi.exr"],
}


def write_if_changed(path, text):
    """So that a file's time tells when its content changed. As a whole or not at all."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.tmp-{os.getpid()}")
    temporary.write_text(text, encoding="utf-8")
    temporary.rename(path)


def as_text(value):
    return json.dumps(value, indent=2) + "\n"


def write_inputs(plan, folder, bin_dir):
    """The files that stages depend on besides artifacts: the plan, each stage's options, each tool's hash."""
    for tool in TOOLS:
        if not (bin_dir / tool).is_file():
            raise ExperimentError(f"{bin_dir / tool}: no such tool; build the tools first")
        write_if_changed(folder / "tools" / f"{tool}.sha256", hashlib.sha256((bin_dir / tool).read_bytes()).hexdigest() + "\n")
    for stage in plan.stages.values():
        if stage["options"] is not None:
            write_if_changed(folder / stage["folder"] / "parameters.json", as_text(stage["options"]))
    write_if_changed(folder / "plan.json", as_text(plan.to_json()))


def check_options(plan, path, bin_dir):
    """Lets each tool judge its options before hours are spent: a dry run, which opens no file, for each set of options."""
    done = set()
    for name, stage in plan.stages.items():
        for tool, options in tool_options(name.split("/")[0], stage["options"]):
            parameters = json.dumps(options)
            if (tool, parameters) in done:
                continue
            done.add((tool, parameters))
            dry_run(tool, parameters, f"{path}: {plan.origins[name]}", bin_dir)


def tool_options(tool, options):
    """(tool, options) whose options the stage has: of a pipeline those of each of its tools."""
    if options is None:
        return []
    if tool in DRY_RUN:
        return [(tool, options)]
    parts = [(key.replace("_", "-"), part) for key, part in options.items()]
    return [(key, part) for key, part in parts if key in DRY_RUN and part is not None]


def dry_run(tool, parameters, place, bin_dir):
    """Throws ExperimentError where the tool refuses the options, JSON."""
    with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
        file.write(parameters)
        file.flush()
        command = [bin_dir / tool, *DRY_RUN[tool], "--config", file.name, "--dry-run"]
        answer = subprocess.run(command, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise ExperimentError(f"{place}: {answer.stderr.strip()}")


def remove_strangers(plan, folder, keep_temporary):
    """What the experiment does not have (any more): stages of former versions, temporary files of killed runs."""
    remove_leftovers(folder)
    remove_leftovers(folder / "tools")
    for stage in folder.glob("stages/*/*"):
        name = f"{stage.parent.name}/{stage.name}"
        if name not in plan.stages:
            shutil.rmtree(stage)
            continue
        remove_leftovers(stage)
        if name.startswith("ismap/") and not keep_temporary:
            (stage / "ism.exr").unlink(missing_ok=True)


def lock_folder(folder):
    """Its descriptor. Held by this process and by snakemake, so that a lock ends with its owners, however they end."""
    lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise ExperimentError(f"{folder}: another run of the experiment is at work there") from error
    return lock


def run_snakemake(snakefile, folder, bin_dir, threads, jobs, further, lock, device="auto"):
    """Its exit status. Its own locks are off: they would outlive a killed run. Folders are named after options, so that the times
    of files are all that a rerun needs to look at."""
    command = [SNAKEMAKE, "--snakefile", WORKFLOW / snakefile, "--directory", folder, "--scheduler", "greedy", "--nolock",
               "--rerun-incomplete", "--rerun-triggers", "mtime", "--drop-metadata", "--quiet", "all"]
    if not {"--profile", "--cluster", "--cores"} & set(further):
        command += ["--cores", str(jobs * threads)]
    settings = [f"bin={bin_dir}", f"workflow={WORKFLOW}", f"threads={threads}", f"jobs={jobs}", f"python={PYTHON}",
                f"device={device}"]
    return subprocess.run([*command, *further, "--config", *settings], check=False, pass_fds=[lock]).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("experiment", type=pathlib.Path, help="JSON file")
    parser.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the built tools")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the results")
    parser.add_argument("--jobs", type=int, default=1, help="tools that run at once; more than 1 disturbs the times (default 1)")
    parser.add_argument("--threads", type=int, help="of each tool (default: all cores, divided by --jobs)")
    parser.add_argument("--snakemake", type=shlex.split, default=[], metavar="ARGS",
                        help="further arguments of snakemake, in one word")
    options = parser.parse_args()
    path = options.experiment
    experiment = read_experiment(path)
    plan = Plan(experiment, path)
    bin_dir, folder = options.bin.resolve(), options.output.resolve()
    check_options(plan, path, bin_dir)
    folder.mkdir(parents=True, exist_ok=True)
    lock = lock_folder(folder)
    write_inputs(plan, folder, bin_dir)
    threads = options.threads or max(1, len(os.sched_getaffinity(0)) // options.jobs)
    status = run_snakemake("Snakefile", folder, bin_dir, threads, options.jobs, options.snakemake, lock)
    if status != 0 or {"-n", "--dry-run", "--dryrun"} & set(options.snakemake):
        return status
    remove_strangers(plan, folder, "--notemp" in options.snakemake)
    print(f"results: {folder}/report.html, results.csv, equal.csv, results.json")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except ExperimentError as error:
        print(f"experiment: error: {error}", file=sys.stderr)
        sys.exit(2)
