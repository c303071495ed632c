#!/usr/bin/env python3
"""Measures, draws and tells one of the papers' figures from what its stages left: values.json, pictures, tables as CSV, and
section.json, its part of the page. Runs in the output folder.

Usage: paper_figure.py FIGURE"""

import csv
import pathlib
import sys

from paper_measures import Data, NothingFound, read_json
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
    """A row is images, a sequence or a method; a column is a measure of them, a measure for each row, or quotes the paper."""
    def cell(label, row, column):
        if label in column.get("not", []):
            return None
        if "given" in column:
            return column["given"].get(label)
        if "values" in column:
            return data.values[column["values"][label]]
        return data.one(row | column)
    return [[label, *(cell(label, row, column) for column in table["columns"].values())] for label, row in table["rows"].items()]


def write_table(table, rows, target):
    with open(target, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([["", *table["columns"]], *rows])


def text(content, values):
    return {"type": "text", "text": "\n\n".join(f"{HEADS[part]}: {fill(content['text'][part], values)}" for part in HEADS)}


def pictures(content, data, folder):
    """Draws them; blocks of the page."""
    blocks = []
    for i, picture in enumerate(content.get("pictures", [])):
        target = folder / f"picture-{i + 1}.png"
        draw(picture, data, target)
        blocks.append({"png": str(target), "alt": picture["alt"], "caption": fill(picture["caption"], data.values)})
    if "animation" in content:
        target = folder / "animation.png"
        animate(content["animation"], data, target)
        blocks.append({"png": str(target), "alt": content["animation"]["alt"], "caption": content["animation"]["caption"]})
    return [{"type": "figure", **block} for block in blocks]


def tables(content, data, folder):
    """Writes them; blocks of the page."""
    blocks = []
    for i, table in enumerate(content.get("tables", [])):
        rows = table_rows(table, data)
        write_table(table, rows, folder / f"table-{i + 1}.csv")
        columns = [table.get("head", " "), *table["columns"]]
        blocks.append({"type": "table", "caption": table["caption"], "columns": columns, "rows": rows})
    return blocks


def viewer(content, data):
    """Some of the images beside their reference, to look at closely."""
    rows = {label: data.select(where)[0] for label, where in content["viewer"].items()}
    references = {row["reference"] for row in rows.values()}
    if len(references) != 1:
        raise NothingFound(f"viewer: its images have {len(references)} references")
    return {"type": "images", "reference": {"file": references.pop(), "label": "reference"}, "layers": ["indirect"],
            "tests": [{"file": row["image"], "label": label} for label, row in rows.items()]}


def main():
    name = sys.argv[1]
    folder = pathlib.Path("figures") / name
    figure = read_json(folder / "figure.json")
    content = figure["content"]
    data = Data(figure)
    blocks = [text(content, data.values), *pictures(content, data, folder), *tables(content, data, folder)]
    if "viewer" in content:
        blocks.append(viewer(content, data))
    write_json(folder / "values.json", {"figure": name, "values": data.values, "claims": claims(content, data.values)})
    title = f"{content['paper']}, {content['label']}: {content['title']}"
    write_json(folder / "section.json", {"title": title, "content": blocks})


if __name__ == "__main__":
    main()
