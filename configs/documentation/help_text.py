"""Reads the --help output of a tool: what the man pages, the bash completion and the black-box tests start from."""

import re
from dataclasses import dataclass, field

# "  -o, --output FILE (required)           lights to write"; the description may stand on the next line.
OPTION = re.compile(r"^  (?P<names>(?:-\w, )?--\S+|-\w)(?: (?P<type>[^ (]\S*(?: in \[[^\]]*\]| >=? 0)?(?: \.\.\.)?))?"
                    r"(?P<required> \(required\))?(?: \(default: (?P<default>.*?)\))?(?:\s{2,}(?P<text>\S.*))?$")
POSITIONAL = re.compile(r"^  (?P<names>[a-z]\S*) (?P<type>\S+(?: \.\.\.)?)(?P<required> \(required\))?"
                        r"(?: \(default: (?P<default>.*?)\))?(?:\s{2,}(?P<text>\S.*))?$")
RANGE = re.compile(r"^(?:INT|UINT|FLOAT) in \[(\S+) - (\S+)\]$")


@dataclass
class Option:
    """One option; `long` is "--count", or "scene" for a positional."""
    long: str
    short: str = ""
    type: str = ""  # "" for a flag, else "INT", "FILE", "{a,b}", "INT in [1 - 10]", "FLOAT >= 0", ...
    required: bool = False
    default: str = ""
    description: str = ""

    @property
    def positional(self):
        return not self.long.startswith("-")

    @property
    def key(self):
        """Its name in a --config file."""
        return self.long.lstrip("-").replace("-", "_")

    @property
    def choices(self):
        return self.type[1:-1].split(",") if self.type.startswith("{") else []

    @property
    def range(self):
        """(minimum, maximum) as printed, or None."""
        match = RANGE.match(self.type)
        return match.groups() if match else None


@dataclass
class Help:
    summary: str = ""
    usage: str = ""
    options: list = field(default_factory=list)  # positionals included

    def option(self, long):
        return next(option for option in self.options if option.long == long)


def _option(match, positional):
    names = match["names"].split(", ")
    longs = names if positional else [name for name in names if name.startswith("--")]
    if not longs:
        raise ValueError(f"option without a long name: {match[0]!r}")
    shorts = [name for name in names if name not in longs]
    return Option(longs[0], shorts[0] if shorts else "", match["type"] or "", bool(match["required"]),
                  match["default"] or "", match["text"] or "")


def parse(text):
    """The Help of a --help text. Raises ValueError for a line that it does not understand."""
    result = Help(summary=text.split("\n", 1)[0])
    section = ""
    for line in text.split("\n")[1:]:
        if line.startswith("Usage: "):
            result.usage = line
        elif re.match(r"^\S.*:$", line):
            section = line
        elif line.startswith(" " * 12):  # a description below its option
            last = result.options[-1]
            last.description = (last.description + " " + line.strip()).strip()
        elif line:
            positional = section == "Positionals:"
            match = (POSITIONAL if positional else OPTION).match(line)
            if not match:
                raise ValueError(f"not an option: {line!r}")
            result.options.append(_option(match, positional))
    return result
