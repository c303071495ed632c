#!/usr/bin/env python3
"""Writes what interop_layout_test.cpp compares: a shader with a buffer of each struct of shaders/interop/*.h, and a C++ table of their
members' offsets. usage: interop_layout.py <shaders/interop> <out.comp.glsl> <out.h>"""
import pathlib
import re
import sys

SHADER_HEAD = """#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 1) in;
"""


def structs(header):
    """(name, members) of each struct of a header, comments removed."""
    text = re.sub(r"//[^\n]*", "", header.read_text())
    for name, body in re.findall(r"\bstruct (\w+) \{(.*?)\};", text, re.S):
        declarations = re.findall(r"\w+ ([\w, ]+);", body)
        yield name, [member.strip() for names in declarations for member in names.split(",")]


def main(folder, shader_path, table_path):
    headers = sorted(p for p in pathlib.Path(folder).glob("*.h") if p.name != "interop.h")
    found = [entry for header in headers for entry in structs(header)]
    shader = SHADER_HEAD + "".join(f'#include "interop/{h.name}"\n' for h in headers)
    shader += "".join(
        f"layout(scalar, binding = {i}) buffer Of{name} {{ {name} of_{name}[]; }};\n" for i, (name, _) in enumerate(found))
    # Blocks that nothing touches would not reach the SPIR-V.
    shader += "void main() {\n" + "".join(f"  of_{name}[1] = of_{name}[0];\n" for name, _ in found) + "}\n"
    table = "".join(f'#include "interop/{h.name}"\n' for h in headers)
    table += "inline const std::vector<Member> members{\n"
    table += "".join(f'    {{"{name}", "{m}", offsetof(vsgl::interop::{name}, {m})}},\n' for name, ms in found for m in ms)
    table += "};\ninline const std::map<std::string, std::size_t> sizes{\n"
    table += "".join(f'    {{"{name}", sizeof(vsgl::interop::{name})}},\n' for name, _ in found) + "};\n"
    pathlib.Path(shader_path).write_text(shader)
    pathlib.Path(table_path).write_text(table)


main(*sys.argv[1:])
