#!/usr/bin/env python3
"""Joins the sections of the papers' figures to one page: report-spec.json, and results.json and claims.csv with all that was measured.
Runs in the output folder."""

import csv
import json
import pathlib

from paper_measures import read_json


def table(columns, rows, caption):
    return {"type": "table", "caption": caption, "columns": columns, "rows": rows}


def main():
    plan = read_json("figures.json")
    figures = {name: read_json(f"figures/{name}/values.json") for name in plan["figures"]}
    sections = {name: read_json(f"figures/{name}/section.json") for name in plan["figures"]}
    head = ["figure", "claim", "holds here", "measured", "test"]
    lines = [[sections[name]["title"].partition(":")[0], claim["claim"], claim["holds"], claim["figures"], claim["test"]]
             for name, figure in figures.items() for claim in figure["claims"]]
    with open("claims.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *lines])
    pathlib.Path("results.json").write_text(json.dumps({"size": plan["size"], "figures": figures}, indent=2) + "\n", encoding="utf-8")
    claims = [{"title": "The papers' claims", "content": [table(head, lines, "Whether they hold in this run, and the figures that decide.")]}] if lines else []
    spec = {"$schema": "vsgltools/report/1", "title": "The papers' figures and tables, reproduced", "summary": plan["summary"],
            "sections": [*claims, *sections.values()]}
    pathlib.Path("report-spec.json").write_text(json.dumps(spec, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
