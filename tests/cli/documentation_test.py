#!/usr/bin/env python3
"""The man page and the bash completion of a tool agree with its --help."""

import argparse
import pathlib
import re
import subprocess

from blackbox import require, run, run_checks
import help_text


def completions(script, tool, words):
    """What bash offers for the last of `words`, which follow the tool's name."""
    function = "_" + tool.replace("-", "_")
    program = f'source "$1"; COMP_WORDS=("${{@:2}}"); COMP_CWORD=$(($# - 2)); {function}; printf "%s\\n" "${{COMPREPLY[@]}}"'
    completed = subprocess.run(["bash", "-c", program, "bash", str(script), tool, *words], check=True,
                               capture_output=True, text=True)
    return completed.stdout.split()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tool", type=pathlib.Path, help="the executable")
    parser.add_argument("--share", type=pathlib.Path, required=True, help="folder of man/ and bash-completion/")
    arguments = parser.parse_args()
    name = arguments.tool.name
    page = arguments.share / "man" / "man1" / f"{name}.1"
    script = arguments.share / "bash-completion" / "completions" / name
    options = [option for option in help_text.parse(run([arguments.tool, "--help"]).expect_success().out).options
               if not option.positional]

    def man_page():
        text = page.read_text().replace("\\-", "-")
        require(re.search(rf"^\.SH NAME\n{name} - \S", text, re.MULTILINE), f"{page} has no NAME section")
        missing = [option.long for option in options if option.long not in text]
        require(not missing, f"{page} lacks {missing}")

    def flags():
        require(sorted(completions(script, name, ["--"])) == sorted(option.long for option in options),
                f"{script} does not offer exactly the flags of --help")

    def choices():
        for option in options:
            if option.choices:
                offered = completions(script, name, [option.long, ""])
                require(offered == option.choices, f"{script} offers {offered} after {option.long}")

    return run_checks([("man page", man_page), ("completion of flags", flags), ("completion of choices", choices)])


if __name__ == "__main__":
    raise SystemExit(main())
