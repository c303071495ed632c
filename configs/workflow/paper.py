#!/usr/bin/env python3
"""Reproduces the papers' figures and tables on our own scenes: configs/paper/*.json as experiments, all on one page. What is
there already and still valid is not made again. docs/paper.md describes it."""

import argparse
import os
import pathlib
import shlex
import sys

from experiment import as_text, check_options, lock_folder, remove_strangers, run_snakemake, write_if_changed, write_inputs
from paper_plan import FOLDER, Figure, PaperPlan, figure_paths, read_sizes
from plan import ExperimentError
from stage import processor

SUMMARY = ("Each figure and table of the two papers on virtual spherical Gaussian lights [Tokuyoshi 2014, Tokuyoshi 2016], as an "
           "experiment on scenes of this project. Claims are tested, and every number in the texts headed \"Here\" was measured "
           "in this run.")


def selected(folder, only):
    """Id -> file of all figures, or of those named."""
    paths = figure_paths(folder)
    unknown = [name for name in only if name not in paths]
    if unknown:
        raise ExperimentError(f"--only: no figure {unknown[0]}; there are {', '.join(paths)}")
    return {name: path for name, path in paths.items() if not only or name in only}


def check_figures(figures, bin_dir):
    """All tools accept all options; reports every figure that they do not have the methods for."""
    refused = []
    for figure in figures:
        for plan in figure.plans:
            try:
                check_options(plan, figure.path, bin_dir)
            except ExperimentError as error:
                refused.append(str(error))
    if refused:
        remedy = "these figures need other tools: `make build`, or choose figures with --only"
        raise ExperimentError("\n".join([*refused, remedy]))


def summary(options, size):
    values = ", ".join(f"{key.replace('_', ' ')} {value}" for key, value in size.items())
    return f"{SUMMARY}\n\nSize \"{options.size}\": {values}. Processor: {processor()}; device: {options.device}."


def run(options):
    """Its exit status."""
    sizes = read_sizes(options.figures)
    if options.size not in sizes:
        raise ExperimentError(f"--size: no size {options.size}; there are {', '.join(sizes)}")
    size = sizes[options.size]
    figures = [Figure(name, path, size) for name, path in selected(options.figures, options.only).items()]
    bin_dir, folder = options.bin.resolve(), options.output.resolve()
    check_figures(figures, bin_dir)
    plan = PaperPlan(figures)
    folder.mkdir(parents=True, exist_ok=True)
    lock = lock_folder(folder)
    write_inputs(plan, folder, bin_dir)
    for figure in figures:
        write_if_changed(folder / "figures" / figure.name / "figure.json", as_text(figure.to_json()))
    overview = {"size": options.size, "summary": summary(options, size), "figures": [figure.name for figure in figures]}
    write_if_changed(folder / "figures.json", as_text(overview))
    threads = options.threads or max(1, len(os.sched_getaffinity(0)) // options.jobs)
    status = run_snakemake("paper.smk", folder, bin_dir, threads, options.jobs, options.snakemake, lock, options.device)
    if status != 0 or {"-n", "--dry-run", "--dryrun"} & set(options.snakemake):
        return status
    if not options.only and options.size == "default":
        remove_strangers(plan, folder, "--notemp" in options.snakemake)
    print(f"results: {folder}/report.html, results.json, claims.csv, figures/")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the built tools")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the results")
    parser.add_argument("--only", nargs="+", default=[], metavar="FIGURE", help="only these figures (files of configs/paper)")
    parser.add_argument("--figures", type=pathlib.Path, default=FOLDER, help="folder of figures (default: configs/paper)")
    parser.add_argument("--size", default="default", help="of images and sample counts: default, quick or papers")
    parser.add_argument("--quick", action="store_const", const="quick", dest="size", help="the same as --size quick")
    parser.add_argument("--device", default="auto", help="Vulkan device of the tools (default: auto)")
    parser.add_argument("--jobs", type=int, default=1, help="tools that run at once; more than 1 disturbs the times (default 1)")
    parser.add_argument("--threads", type=int, help="of each tool (default: all cores, divided by --jobs)")
    parser.add_argument("--snakemake", type=shlex.split, default=[], metavar="ARGS",
                        help="further arguments of snakemake, in one word")
    return run(parser.parse_args())


if __name__ == "__main__":
    try:
        sys.exit(main())
    except ExperimentError as error:
        print(f"paper: error: {error}", file=sys.stderr)
        sys.exit(2)
