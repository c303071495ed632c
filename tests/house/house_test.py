#!/usr/bin/env python3
"""Rules of the source tree: citations resolve, includes run one way, docs/errors.md and the enum agree. Each rule is also shown
to fail on a tree that breaks it."""

import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = {".h", ".cpp", ".glsl", ".comp", ".vert", ".frag"}
CITATION_KEY = r"[A-Z][A-Za-z]+ (?:19|20)\d\d[a-z]?"

# Which rank a library has; it may include its own headers and those of lower ranks.
RANKS = {"base": 0, "math": 1, "sh": 2, "image": 2, "scene": 2, "gpu": 2, "pyramid": 3, "report": 3, "trace": 3, "kmeans": 4, "artifact": 4, "cluster": 5, "reference": 6, "pipeline": 7}
STAGE_RANK = 6


def sources(root, *folders):
    found = [path for folder in folders for path in sorted((root / folder).rglob("*")) if path.suffix in SOURCES]
    if not found:
        raise ValueError(f"no sources in {folders} below {root}")
    return found


def cited_keys(text):
    """Citation keys in square brackets, which may hold several and may run over comment lines."""
    joined = re.sub(r"\n\s*//\s*", " ", text)
    return {key for bracket in re.findall(r"\[[^\[\]]*\]", joined) for key in re.findall(rf"(?<![\w-]){CITATION_KEY}\b", bracket)}


def unresolved_citations(root):
    """(file, key) of every citation that docs/bibliography.md does not list."""
    listed = set(re.findall(rf"^- \*\*\[({CITATION_KEY})\]\*\*", (root / "docs/bibliography.md").read_text(), re.MULTILINE))
    used = [(path.relative_to(root), key) for path in sources(root, "libs", "shaders") for key in cited_keys(path.read_text())]
    if not used:
        raise ValueError("no citation found at all")
    return [(str(path), key) for path, key in used if key not in listed]


def library_of(path):
    """"base", or "stages/rsm", from a path relative to libs/."""
    parts = pathlib.PurePath(path).parts
    return "/".join(parts[:2]) if parts[0] == "stages" else parts[0]


def rank_of(library):
    return STAGE_RANK if library.startswith("stages/") else RANKS[library]


def backward_includes(root):
    """(file, header) of every #include that runs against the arrows base <- math <- {image, scene <- trace, gpu <- pyramid} <- artifact <- cluster <-
    {stages/*, reference} <- pipeline."""
    found = []
    for path in sources(root, "libs"):
        relative = path.relative_to(root / "libs")
        library = library_of(relative)
        for header in re.findall(r'^\s*#\s*include\s*"([^"]+)"', path.read_text(), re.MULTILINE):
            if "/" not in header or not (root / "libs" / header).exists():
                continue  # interop headers, generated SPIR-V
            other = library_of(header)
            if other != library and rank_of(other) >= rank_of(library):
                found.append((str(relative), header))
    return found


def error_disagreements(root):
    """Numbers and names that stand only in the enum or only in docs/errors.md."""
    enum = re.search(r"enum class ErrorCode[^{]*\{(.*?)\};", (root / "libs/base/error.h").read_text(), re.DOTALL)[1]
    code = {(number, name) for name, number in re.findall(r"^\s*(\w+) = (\d{4}),", enum, re.MULTILINE)}
    table = set(re.findall(r"^\| E(\d{4}) \| `(\w+)` \| \S.* \| \S.* \|$", (root / "docs/errors.md").read_text(), re.MULTILINE))
    if not code or not table:
        raise ValueError("no error number found")
    return sorted(code ^ table)


class House(unittest.TestCase):
    def test_citations_resolve(self):
        self.assertEqual(unresolved_citations(ROOT), [])

    def test_includes_run_one_way(self):
        self.assertEqual(backward_includes(ROOT), [])

    def test_errors_are_documented(self):
        self.assertEqual(error_disagreements(ROOT), [])


class PlantedViolations(unittest.TestCase):
    """The same checks on small trees that break each rule once."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def test_unknown_citation(self):
        self.write("docs/bibliography.md", "- **[Keller 1997]** A. Keller.\n")
        self.write("shaders/a.glsl", "// [Keller 1997, Eq. (1)] and [Keller 1997; Nobody\n// 2001a, p. 3]\n")
        self.write("libs/math/a.h", "// [Keller 1998]\n")
        self.assertEqual(unresolved_citations(self.root), [("libs/math/a.h", "Keller 1998"), ("shaders/a.glsl", "Nobody 2001a")])

    def test_backward_include(self):
        self.write("libs/base/error.h", "")
        self.write("libs/math/vec.h", '#include "base/error.h"\n#include "interop/light.h"\n')
        self.write("libs/base/bad.cpp", '#include "math/vec.h"\n#include "base/error.h"\n')
        self.assertEqual(backward_includes(self.root), [("base/bad.cpp", "math/vec.h")])

    def test_stages_are_apart(self):
        self.write("libs/stages/rsm/rsm.h", "")
        self.write("libs/stages/pdf/pdf.h", "")
        self.write("libs/stages/pdf/pdf.cpp", '#include "stages/pdf/pdf.h"\n  #include "stages/rsm/rsm.h"\n')
        self.assertEqual(backward_includes(self.root), [("stages/pdf/pdf.cpp", "stages/rsm/rsm.h")])

    def test_siblings_are_apart(self):
        self.write("libs/image/exr.h", "")
        self.write("libs/gpu/a.cpp", '#include "image/exr.h"\n')
        self.assertEqual(backward_includes(self.root), [("gpu/a.cpp", "image/exr.h")])

    def test_undocumented_and_invented_errors(self):
        self.write("libs/base/error.h", "enum class ErrorCode : int {\n  a = 2001,  // x\n  b = 3001,\n};\n")
        self.write("docs/errors.md", "| E2001 | `a` | Meaning. | Remedy. |\n| E3002 | `c` | Meaning. | Remedy. |\n")
        self.assertEqual(error_disagreements(self.root), [("3001", "b"), ("3002", "c")])

    def test_nothing_found_is_an_error(self):
        self.write("docs/bibliography.md", "")
        self.write("libs/math/a.h", "// no citation\n")
        (self.root / "shaders").mkdir()
        with self.assertRaises(ValueError):
            unresolved_citations(self.root)


if __name__ == "__main__":
    unittest.main()
