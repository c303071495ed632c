"""Runs the real executables and judges what they print: the common ground of the black-box tests."""

import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "configs" / "documentation"))

TIMEOUT_S = 120
ERROR_LINE = re.compile(r"^(?P<tool>[a-z-]+): error E(?P<number>\d{4}): (?P<message>.+)$", re.MULTILINE)


class Failure(Exception):
    """A check that did not hold."""


def require(condition, message):
    if not condition:
        raise Failure(message)


class Result:
    """What a command did. Raises Failure for a death by signal, which no test expects."""

    def __init__(self, command, completed):
        self.command = " ".join(map(str, command))
        self.status = completed.returncode
        self.out = completed.stdout
        self.err = completed.stderr
        # AddressSanitizer ends with status 1 and says so.
        crashed = self.status < 0 or self.status > 128 or "Sanitizer" in self.err or "runtime error:" in self.err
        require(not crashed, f"{self}: crashed")

    def __str__(self):
        return f"$ {self.command}\n  status {self.status}\n  stderr: {self.err.strip()[-1500:]}"

    def expect_success(self):
        require(self.status == 0, f"{self}: expected success")
        return self

    def expect_error(self, status, pattern):
        """Exactly one numbered error, of that status; `pattern` (a regular expression) matches its line; stdout is empty."""
        lines = list(ERROR_LINE.finditer(self.err))
        require(self.status == status, f"{self}: expected status {status}")
        require(len(lines) == 1, f"{self}: expected one line of the form 'tool: error E1234: message'")
        require(re.search(pattern, lines[0][0]), f"{self}: expected a message like {pattern!r}")
        number = int(lines[0]["number"])
        require((70 if number // 1000 == 7 else number // 1000) == status, f"{self}: number and status disagree")
        require(self.out == "", f"{self}: stdout must stay empty, got {self.out[:200]!r}")
        return self


def run(command, cwd=None, env=None, stdout=subprocess.PIPE):
    """Runs a command to its end, with `env` on top of the environment."""
    completed = subprocess.run([str(part) for part in command], cwd=cwd, env={**os.environ, **(env or {})},
                               stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE, text=True,
                               errors="replace", timeout=TIMEOUT_S, check=False)
    completed.stdout = completed.stdout or ""
    return Result(command, completed)


def run_checks(checks):
    """Calls each (name, function) and prints a line for each; returns the process's exit status. No check at all is a failure."""
    failed = 0
    for name, check in checks:
        try:
            check()
            print(f"ok   {name}")
        except (Failure, OSError, subprocess.SubprocessError) as failure:
            failed += 1
            print(f"FAIL {name}\n{failure}")
    print(f"{len(checks)} checks, {failed} failed")
    return 1 if failed or not checks else 0
