#!/usr/bin/env python3
"""Writes the man page of a tool with help2man, from its --help and --version."""

import argparse
import subprocess

import help_text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--help2man", required=True)
    parser.add_argument("--tool", required=True, help="path of the executable")
    parser.add_argument("--output", required=True)
    arguments = parser.parse_args()
    text = subprocess.run([arguments.tool, "--help"], check=True, capture_output=True, text=True).stdout
    subprocess.run([arguments.help2man, "--no-info", "--name", help_text.parse(text).summary, "--output",
                    arguments.output, arguments.tool], check=True)


if __name__ == "__main__":
    main()
