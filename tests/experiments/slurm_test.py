#!/usr/bin/env python3
"""The tiny experiment through Slurm's queue, on a cluster of this one machine, leaves the same bytes as a local run."""

import pathlib
import shutil
import sys
import tempfile

import slurm
from workflow import ROOT, files, parser, require_same, run

SKIPPED = 77  # what CTest takes for "skipped"


def main():
    options = parser(__doc__).parse_args()
    if reason := slurm.missing():
        print(f"skipped: Slurm cannot run here: {reason}")
        return SKIPPED
    with tempfile.TemporaryDirectory() as temporary, slurm.cluster(cpus=2) as environment:
        folder = pathlib.Path(temporary) / "tiny"
        profile = f"--snakemake=--profile {ROOT}/configs/workflow/slurm"
        environment["CI"] = "true"  # Snakemake then asks for finished jobs every second instead of every ten
        run(options.bin, folder, "--jobs", "2", "--threads", "1", profile, env=environment)
        jobs = list((folder / "slurm").glob("*.out"))
        stages = list(folder.glob("stages/*/*/report.json"))
        assert len(jobs) >= len(stages), f"{len(jobs)} jobs of Slurm for {len(stages)} stages; did they run elsewhere?"
        shutil.rmtree(folder / "slurm")
        require_same(folder, options.undisturbed, options.bin, "through Slurm")
        print(f"{len(jobs)} jobs, {len(files(folder))} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
