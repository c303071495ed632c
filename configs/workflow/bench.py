#!/usr/bin/env python3
"""The benchmark: the shading kernel against native code on the same data, the demo chain stage by stage, and error against time of
a small experiment.

Times of the chain are medians of several runs, first cold (empty shader cache) and then warm. Nothing here is a pass or fail:
figures are for comparison inside one run, as ratios."""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from chain import StageFailed, phases
from demo import SCENES, run_scene
from plots import label

WORKFLOW = pathlib.Path(__file__).resolve().parent


def kernel(bin_dir, target):
    """Runs the kernel benchmark; returns its JSON."""
    subprocess.run([str(bin_dir / "shading_bench"), "--output", str(target)], check=True)
    return json.loads(target.read_text(encoding="utf-8"))


def chain_times(bin_dir, folder, repetitions):
    """Wall seconds per stage of each repetition, and the slowest phases of the last."""
    runs = []
    for _ in range(repetitions):
        chain = run_scene(bin_dir, folder, SCENES["bunny-cornell"])
        runs.append({row["stage"]: row["wall_s"] for row in chain.rows})
    costs = [(seconds, row["stage"], name) for row in chain.rows for name, seconds in phases(row["result"]).items()]
    return runs, sorted(costs, reverse=True)


def experiment(bin_dir, folder):
    """Runs configs/experiments/small.json, from nothing so that all times are new; returns the rows of its table."""
    shutil.rmtree(folder, ignore_errors=True)
    small = WORKFLOW.parent / "experiments" / "small.json"
    subprocess.run([sys.executable, WORKFLOW / "experiment.py", small, "--bin", bin_dir, "--output", folder], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((folder / "results.json").read_text(encoding="utf-8"))["rows"]


def print_experiment(rows):
    """Time and error of each image."""
    metrics = ["relmse_denoised", "relmse_trimmed", "flip", "luminance_bias"]
    print("\nexperiment small: 160x90, RSM 128x128\n" +
          f"{'scene':<16}{'variant':<28}{'time s':>9}{'with files':>12}" + "".join(f"{name:>17}" for name in metrics))
    for row in rows:
        times = row["times"]
        print(f"{row['scene']:<16}{label(row):<28}{times['time_s']:>9.3f}{times['time_with_files_s']:>12.3f}" +
              "".join(f"{row['metrics'][name]:>17.5f}" for name in metrics))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the built tools")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the results")
    parser.add_argument("--repetitions", type=int, default=3)
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)

    result = {"kernel": kernel(options.bin, options.output / "kernel.json")}
    cache = tempfile.mkdtemp(prefix="vsgl-bench-")
    os.environ["XDG_CACHE_HOME"] = cache
    try:
        cold, _ = chain_times(options.bin, options.output / "chain", 1)
        warm, costs = chain_times(options.bin, options.output / "chain", options.repetitions)
    finally:
        shutil.rmtree(cache)

    median = {stage: statistics.median(run[stage] for run in warm) for stage in warm[0]}
    print(f"\nchain: bunny-cornell, 640x360, 1024 lights, RSM 256x256\n{'stage':<12}{'cold s':>8}{'warm s':>8}{'share':>8}")
    total = sum(median.values())
    for stage, seconds in median.items():
        print(f"{stage:<12}{cold[0][stage]:>8.2f}{seconds:>8.2f}{seconds / total:>8.0%}")
    print(f"{'total':<12}{sum(cold[0].values()):>8.2f}{total:>8.2f}")
    print("largest costs: " + "; ".join(f"{stage} {name} {seconds:.2f} s" for seconds, stage, name in costs[:3]))

    result["chain"] = {"cold_s": cold[0], "warm_s": median, "runs": warm,
                       "costs": [{"stage": stage, "phase": name, "seconds": seconds} for seconds, stage, name in costs]}
    result["experiment"] = experiment(options.bin, options.output / "small")
    print_experiment(result["experiment"])

    target = options.output / "bench.json"
    target.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    print(f"results: {target}")


if __name__ == "__main__":
    try:
        main()
    except StageFailed as error:
        sys.exit(f"bench: {error}")
