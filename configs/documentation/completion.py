#!/usr/bin/env python3
"""Writes the bash completion of a tool, from its --help."""

import argparse
import pathlib
import subprocess

import help_text

TEMPLATE = """# bash completion for {tool}; generated from its --help
{function}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  case $previous in
{branches}
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "{flags}" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F {function} {tool}
"""


def branch(option):
    """What follows an option that takes a value: its choices, a file, or nothing that could be guessed."""
    names = "|".join(name for name in (option.short, option.long) if name)
    if option.choices:
        action = f'mapfile -t COMPREPLY < <(compgen -W "{" ".join(option.choices)}" -- "$word"); return'
    elif option.type == "FOLDER":
        action = 'mapfile -t COMPREPLY < <(compgen -d -- "$word"); return'
    elif option.type == "FILE":
        action = 'mapfile -t COMPREPLY < <(compgen -f -- "$word"); return'
    else:
        action = "COMPREPLY=(); return"
    return f"    {names}) {action} ;;"


def script(tool, text):
    options = [option for option in help_text.parse(text).options if not option.positional]
    return TEMPLATE.format(tool=tool, function="_" + tool.replace("-", "_"),
                           branches="\n".join(branch(option) for option in options if option.type),
                           flags=" ".join(option.long for option in options))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tool", required=True, help="path of the executable")
    parser.add_argument("--output", required=True)
    arguments = parser.parse_args()
    text = subprocess.run([arguments.tool, "--help"], check=True, capture_output=True, text=True).stdout
    pathlib.Path(arguments.output).write_text(script(pathlib.Path(arguments.tool).name, text))


if __name__ == "__main__":
    main()
