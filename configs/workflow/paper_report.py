#!/usr/bin/env python3
"""Joins the sections of the papers' figures to one page: report-spec.json, and results.json and claims.csv with all that was
measured. Runs in the output folder."""

import csv
import pathlib

from paper_measures import read_json
from stage import write_json


HEAD = ["figure", "claim", "holds here", "measured", "test"]


def claim_rows(figures, sections):
    return [[sections[name]["title"].partition(":")[0], claim["claim"], claim["holds"], claim["figures"], claim["test"]]
            for name, figure in figures.items() for claim in figure["claims"]]


def main():
    plan = read_json("figures.json")
    figures = {name: read_json(f"figures/{name}/values.json") for name in plan["figures"]}
    sections = {name: read_json(f"figures/{name}/section.json") for name in plan["figures"]}
    rows = claim_rows(figures, sections)
    with open("claims.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
    write_json(pathlib.Path("results.json"), {"size": plan["size"], "figures": figures})
    caption = "Whether they hold in this run, and the figures that decide."
    claims = {"type": "table", "caption": caption, "columns": HEAD[:-1], "rows": [row[:-1] for row in rows]}
    write_json(pathlib.Path("report-spec.json"), {
        "$schema": "vsgltools/report/1",
        "title": "The papers' figures and tables, reproduced",
        "summary": plan["summary"],
        "sections": [{"title": "The papers' claims", "content": [claims]}, *sections.values()],
    })


if __name__ == "__main__":
    main()
