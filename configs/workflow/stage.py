#!/usr/bin/env python3
"""Runs one tool of the chain for the workflow, in its stage's folder. report.json keeps what the tool tells and what its process
took: all that was measured is there, so that everything else is the same bytes in every run.

The folder is locked while the tool runs. A tool that outlives a workflow killed half-way is so waited for, not met."""

import argparse
import fcntl
import json
import os
import pathlib
import platform
import resource
import subprocess
import sys
import time


def processor():
    """Name of the processor, as far as the system tells."""
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def write_json(path, value):
    """As a whole or not at all."""
    temporary = path.with_name(f".{path.name}.tmp-{os.getpid()}")
    temporary.write_text(json.dumps(value, indent=2) + "\n", encoding="utf-8")
    temporary.rename(path)


def remove_leftovers(folder):
    """Temporary files of tools that were killed. Only under the folder's lock."""
    for path in folder.glob(".*.tmp-*"):
        path.unlink()


def measure(command, lock):
    """Runs the command, which keeps the lock as long as it lives; returns its status, output and what it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False, pass_fds=[lock])
    wall = time.monotonic() - start
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime
    return done, {"wall_s": wall, "cpu_s": cpu, "peak_memory_bytes": used.ru_maxrss * 1024}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True, type=pathlib.Path, help="of the stage")
    parser.add_argument("--threads", required=True, type=int, help="of the tool")
    parser.add_argument("--jobs", required=True, type=int, help="that run at once on the machine and so disturb the times")
    parser.add_argument("--device", default="auto", help="of the tool")
    parser.add_argument("--accept", type=int, nargs="*", default=[0], help="exit statuses that are no failure")
    parser.add_argument("--warm-up", action="store_true", help="run the tool once before: its shaders are compiled then")
    parser.add_argument("--repetitions", type=int, default=1, help="the run of median length counts (default 1)")
    parser.add_argument("command", nargs="+", help="the tool and its arguments")
    options = parser.parse_args()
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")  # threads that wait give their core away, to other jobs for instance

    options.folder.mkdir(parents=True, exist_ok=True)
    lock = os.open(options.folder, os.O_RDONLY | os.O_DIRECTORY)
    fcntl.flock(lock, fcntl.LOCK_EX)
    remove_leftovers(options.folder)
    command = [*options.command, "--threads", str(options.threads), "--device", options.device, "--json", "--overwrite", "--quiet"]
    if options.warm_up:
        measure(command, lock)
    runs = [measure(command, lock) for _ in range(options.repetitions)]
    done, measured = sorted(runs, key=lambda run: run[1]["wall_s"])[len(runs) // 2]
    if done.returncode not in options.accept:
        sys.exit(f"stage: {' '.join(options.command)} ended with status {done.returncode}")
    process = {**measured, "threads": options.threads, "jobs": options.jobs, "host": platform.node(), "processor": processor()}
    write_json(options.folder / "report.json", {**json.loads(done.stdout), "process": process})
    print(f"{measured['wall_s']:8.1f} s  {options.folder.parent.name}/{options.folder.name}", file=sys.stderr)


if __name__ == "__main__":
    main()
