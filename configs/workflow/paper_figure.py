#!/usr/bin/env python3
"""Measures, draws and tells one of the papers' figures from what its stages left: values.json, pictures, tables as CSV, and section.json,
its part of the page. Runs in the output folder.

Usage: paper_figure.py FIGURE"""

import csv
import pathlib
import sys

from paper_measures import Data, read_json
from paper_pictures import animate, draw
from paper_values import evaluate, fill, names
from stage import write_json

HEADS = {"found": "The paper", "here": "Here", "why": "Why they differ"}


def claims(content, values):
    """What the paper claims of it, whether it holds here, and the figures that decide."""
    return [{"claim": claim["claim"], "holds": bool(evaluate(claim["holds"], values)),
             "figures": ", ".join(f"{name} {values[name]:.4g}" for name in names(claim["holds"])), "test": claim["holds"]}
            for claim in content.get("claims", [])]


def table_rows(table, data):
    """A row is images, a sequence or a method; a column is a measure of them, or quotes the paper's own figures."""
    def cell(label, row, column):
        if "given" in column:
            return column["given"].get(label)
        return None if label in column.get("not", []) else data.one(row | column)
    return [[label, *(cell(label, row, column) for column in table["columns"].values())] for label, row in table["rows"].items()]


def write_table(table, rows, target):
    with open(target, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([["", *table["columns"]], *rows])


def viewer(content, data):
    """Some of the images beside their reference, to look at closely."""
    rows = [data.select(where)[0] for where in content["viewer"].values()]
    return {"type": "images", "reference": {"file": rows[0]["reference"], "label": "reference"},
            "tests": [{"file": row["image"], "label": label} for row, label in zip(rows, content["viewer"])], "layers": ["indirect"]}


def main():
    name = sys.argv[1]
    folder = pathlib.Path("figures") / name
    figure = read_json(folder / "figure.json")
    content = figure["content"]
    data = Data(figure)
    data.values = data.all()
    text = "\n\n".join(f"{HEADS[part]}: {fill(content['text'][part], data.values)}" for part in HEADS)
    blocks = [{"type": "text", "text": text}]
    for i, picture in enumerate(content.get("pictures", [])):
        target = folder / f"picture-{i + 1}.png"
        draw(picture, data, target)
        blocks.append({"type": "figure", "png": str(target), "alt": picture["alt"], "caption": fill(picture["caption"], data.values)})
    if "animation" in content:
        target = folder / "animation.png"
        animate(content["animation"], data, target)
        blocks.append({"type": "figure", "png": str(target), "alt": content["animation"]["alt"], "caption": content["animation"]["caption"]})
    for i, table in enumerate(content.get("tables", [])):
        rows = table_rows(table, data)
        write_table(table, rows, folder / f"table-{i + 1}.csv")
        blocks.append({"type": "table", "caption": table["caption"], "columns": [table.get("head", " "), *table["columns"]], "rows": rows})
    judged = claims(content, data.values)
    if "viewer" in content:
        blocks.append(viewer(content, data))
    write_json(folder / "values.json", {"figure": name, "values": data.values, "claims": judged})
    write_json(folder / "section.json", {"title": f"{content['paper']}, {content['label']}: {content['title']}", "content": blocks})


if __name__ == "__main__":
    main()
