#!/usr/bin/env python3
"""What every tool owes its user, checked on the real executable from its own --help: help, version, --config, --dry-run, and a
numbered error for each bad argument."""

import argparse
import json
import pathlib
import subprocess
import tempfile

from blackbox import Failure, require, run, run_checks
import help_text

COMMON = ["--help", "--version", "--config", "--device", "--threads", "--seed", "--json", "--dry-run", "--overwrite",
          "--if-changed", "--progress", "--quiet", "--verbose", "--no-skip"]
NOT_IN_CONFIG = ["--help", "--version", "--config", "--dry-run", "--list-methods"]


def sample(option, index):
    """A value that the option takes; files need not exist for --dry-run, but must differ."""
    if option.choices:
        return option.choices[0]
    if option.range:
        return option.range[0]
    if option.type.startswith(("INT", "UINT", "FLOAT")):
        return ",".join("1" for _ in option.type.split(","))
    return f"file{index}.exr"


def swapped(flag):
    """The flag with two neighbouring letters swapped, or None where that changes nothing."""
    for i in range(len(flag) - 2, 2, -1):
        if flag[i] != flag[i - 1] and "-" not in flag[i - 1:i + 1]:
            return flag[:i - 1] + flag[i] + flag[i - 1] + flag[i + 1:]
    return None


class ToolTest:
    def __init__(self, tool, folder):
        self.tool = tool
        self.name = tool.name
        self.folder = pathlib.Path(folder)
        self.help = help_text.parse(self.run("--help").expect_success().out)
        self.named = [option for option in self.help.options if not option.positional]
        self.own = [option for option in self.help.options if option.long not in COMMON]
        # One of its own and one common flag stand for all where the frame of the tools treats all alike.
        self.typical = [next(option for option in self.own if self.misspell(option)), self.help.option("--threads")]
        self.required = self.arguments(option for option in self.help.options if option.required)

    def run(self, *arguments, **more):
        return run([self.tool, *arguments], cwd=self.folder, **more)

    def arguments(self, options):
        words = []
        for index, option in enumerate(options):
            words += [sample(option, index)] if option.positional else [option.long, sample(option, index)]
        return words

    def misspell(self, option):
        """The option's flag with two letters swapped; None for positionals and where that is another flag or the same."""
        flag = None if option.positional else swapped(option.long)
        return None if flag in [other.long for other in self.named] else flag

    def fails(self, status, pattern, *arguments):
        self.run(*arguments).expect_error(status, rf"^{self.name}: error {pattern}")

    def config(self, text):
        (self.folder / "config.json").write_text(text)
        return ["--config", "config.json", "--dry-run"]

    def checks(self):
        """(name, function) of every check."""
        checks = [("help", self.check_help), ("version", self.check_version),
                  ("full stdout", self.check_full_stdout), ("dry run", self.check_dry_run),
                  ("missing required", self.check_missing), ("conflict", self.check_conflict),
                  ("config file", self.check_config_file), ("config keys", self.check_config_keys),
                  ("config types", self.check_config_types)]
        checks += [(f"misspelt {option.long}", lambda o=option: self.check_misspelt(o)) for option in self.typical]
        checks += [(f"bad value of {option.long}", lambda o=option: self.check_values(o))
                   for option in self.named if option.type]
        return checks

    def check_help(self):
        result = self.run("--help").expect_success()
        require(result.err == "", f"{result}: stderr must stay empty")
        require(len(self.help.summary) > 15 and not self.help.summary.startswith("Usage"), "the summary is missing")
        require(self.help.usage.startswith(f"Usage: {self.name} "), f"wrong usage line: {self.help.usage!r}")
        for flag in COMMON:
            require(any(option.long == flag for option in self.named), f"--help does not list {flag}")
        for option in self.help.options:
            require(option.description, f"--help does not describe {option.long}")

    def check_version(self):
        result = self.run("--version").expect_success()
        words = result.out.split()
        require(words[:2] == [self.name, "(vsgltools)"] and len(words) == 3, f"unexpected version: {result.out!r}")

    def check_full_stdout(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            self.run("--help", stdout=full).expect_error(4, "E4001: standard output")

    def check_dry_run(self):
        before = sorted(self.folder.iterdir())
        first = self.run(*self.required, "--seed", "7", "--dry-run").expect_success()
        require(sorted(self.folder.iterdir()) == before, "--dry-run wrote a file")
        resolved = json.loads(first.out)
        listed = [option.key for option in self.help.options if option.long not in NOT_IN_CONFIG]
        unknown = [key for key in resolved if key not in listed]
        require(not unknown, f"--help does not list {unknown}")
        for option in self.help.options:
            shown = option.key in resolved
            wanted = option.long not in NOT_IN_CONFIG and bool(option.required or option.default or not option.type)
            require(shown or not wanted, f"--dry-run leaves {option.key} out")
        second = self.run(*self.config(first.out)).expect_success()
        require(second.out == first.out, f"{second}: its own --dry-run output, as --config, resolves to something else")

    def check_missing(self):
        required = [option for option in self.help.options if option.required]
        for left_out in required:
            rest = [option for option in required if option is not left_out]
            if left_out.positional and any(option.positional for option in rest):
                continue  # the other positional would take its place
            self.fails(2, f"E2004: {left_out.long} is required", *self.arguments(rest))

    def check_conflict(self):
        self.fails(2, "E2005: --quiet excludes --verbose", *self.required, "-q", "-v")

    def check_config_file(self):
        self.fails(2, "E2002: .*none.json", "--config", "none.json")
        self.fails(2, "E2002: config.json: parse error at line 1", *self.config("{"))
        self.fails(2, "E2002: config.json: /: expected an object", *self.config("[]"))

    def check_config_keys(self):
        for option in self.typical:
            key = self.misspell(option).lstrip("-").replace("-", "_")
            self.fails(2, f'E2001: config.json: /{key}: no such key; did you mean "{option.key}"', *self.config(json.dumps({key: 1})))

    def check_config_types(self):
        for option in [*self.own, self.help.option("--threads")]:
            if option.long in NOT_IN_CONFIG:
                continue
            text = json.dumps({option.key: {"an": "object"}})
            self.fails(2, f"E2002: config.json: /{option.key}: expected ", *self.config(text))

    def check_misspelt(self, option):
        flag = self.misspell(option)
        self.fails(2, f"E2001: {flag}: no such option; did you mean {option.long}", flag)

    def check_values(self, option):
        name = option.long
        # The value is judged before missing arguments are.
        bad = lambda pattern, value: self.fails(2, f"{pattern}: {name}: ", *self.required_but(option), name, value)
        if option.choices:
            bad("E2002", "no-such-choice")
        elif option.range:
            low, high = (float(bound) for bound in option.range)
            bad("E2003", f"{low - 1:.0f}")
            bad("E2003", f"{high + 1:.0f}" if high < 1e15 else f"{high * 10:.0f}")
        elif option.type.startswith(("FLOAT >", "INT >")):
            bad("E2003", "-1")
        if option.type.startswith(("INT", "UINT", "FLOAT")):
            count = option.type.count(",") + 1
            bad("E2002", ",".join(["nan"] * count))
        self.fails(2, f"E2002: {name}: ", name)  # no value at all

    def required_but(self, left_out):
        return self.arguments(option for option in self.help.options if option.required and option is not left_out)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tool", type=pathlib.Path, help="the executable")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        try:
            checks = ToolTest(arguments.tool.resolve(), folder).checks()
        except (Failure, ValueError, subprocess.TimeoutExpired) as failure:
            print(f"FAIL help\n{failure}")
            return 1
        return run_checks(checks)


if __name__ == "__main__":
    raise SystemExit(main())
