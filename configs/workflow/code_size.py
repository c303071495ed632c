"""How much code a method is: lines that are neither empty nor comments, and the device's dispatches that a run of it makes."""

import re


def code_lines(text):
    """Of C++ or GLSL."""
    without = re.sub(r"/\*.*?\*/", lambda match: "\n" * match[0].count("\n"), text, flags=re.DOTALL)
    return sum(bool(re.sub(r"//.*", "", line).strip()) for line in without.splitlines())


def dispatches(report):
    """From what a tool printed under --json."""
    return sum(report["counts"]["dispatches"].values())
