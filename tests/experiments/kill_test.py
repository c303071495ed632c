#!/usr/bin/env python3
"""The tiny experiment, killed with SIGKILL at ten random moments (all of its processes) and restarted each time, ends with the
bytes of the undisturbed run. So does one that dies between the writing of a temporary file and its renaming."""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import tempfile
import time

from workflow import command, parser, require_same, run

KILLS = 10


def progress(folder):
    """How many steps are done: stages, table, plots, report."""
    last = ["results.json", "report-spec.json", "report.html"]
    return len(list(folder.glob("stages/*/*/report.json"))) + sum((folder / name).exists() for name in last)


def run_until(bin_dir, folder, steps, delay):
    """Starts the experiment and kills it `delay` seconds after so many steps are done; returns False if it ended before."""
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(command(bin_dir, folder), stdout=output, stderr=output, start_new_session=True)
        while process.poll() is None and progress(folder) < steps:
            time.sleep(0.01)
        time.sleep(delay)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return True
        output.seek(0)
        assert process.returncode == 0, f"restarted run ended with status {process.returncode}\n{output.read()}"
        return False


def killed_at_random(bin_dir, undisturbed, folder):
    """Ten kills, each of which finds some more done. A run that gets done before its kill starts over from nothing."""
    moments = random.Random(20)
    kills = []
    for steps in sorted(moments.sample(range(progress(undisturbed)), KILLS)):
        delay = moments.uniform(0, 1)
        while not run_until(bin_dir, folder, steps, delay):
            shutil.rmtree(folder)
        kills.append(f"{steps} + {delay:.2f} s")
    run(bin_dir, folder)
    print(f"killed after these steps and seconds: {', '.join(kills)}; of {progress(undisturbed)} steps")


def killed_at_rename(bin_dir, undisturbed, folder, shim, tool, name):
    """All processes die when the tool, or its stage, is about to give a file its name. What the tool had made before is taken away
    first."""
    shutil.copytree(undisturbed, folder)
    shutil.rmtree(folder / "stages" / tool)
    environment = dict(os.environ, LD_PRELOAD=str(shim), KILL_AT_RENAME=name)
    done = subprocess.run(command(bin_dir, folder), env=environment, capture_output=True, check=False, start_new_session=True)
    assert done.returncode == -signal.SIGKILL, f"{tool} renamed nothing to {name}"
    made = [path.name for path in (folder / "stages" / tool).rglob("*")]
    assert name not in made, f"{name} is there though {tool} was killed before"
    assert any(other.startswith(f".{pathlib.Path(name).stem}") and ".tmp-" in other for other in made), f"{name}: no temporary file"
    run(bin_dir, folder)


def main():
    arguments = parser(__doc__)
    arguments.add_argument("--shim", required=True, type=pathlib.Path, help="kill_at_rename.so")
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary) / "random"
        killed_at_random(options.bin, options.undisturbed, folder)
        require_same(folder, options.undisturbed, options.bin, "killed at random")
        for tool, name in (("rsm-bake", "rsm.exr"), ("compare", "report.json")):
            folder = pathlib.Path(temporary) / tool
            killed_at_rename(options.bin, options.undisturbed, folder, options.shim, tool, name)
            require_same(folder, options.undisturbed, options.bin, f"{tool}, killed at the renaming of {name}")


if __name__ == "__main__":
    main()
