#!/usr/bin/env python3
"""Draws the experiment's plots and writes report-spec.json, from which the tool `report` makes report.html. Runs in the output folder."""

import json
import pathlib

import plots

AGAINST = {"time_s": "time", "n": "the number of lights or samples"}


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def conditions(experiment, rows):
    """What one must know to judge the figures."""
    times = [row["times"] for row in rows]
    processors = sorted({name for entry in times for name in entry["processors"]})
    threads = sorted({count for entry in times for count in entry["threads"]})
    jobs = max(entry["jobs"] for entry in times)
    disturbed = (f"Up to {jobs} tools ran at once, so the times are longer than they would be alone." if jobs > 1 else
                 "One tool ran at a time.")
    return (f"Images of {experiment['resolution']} pixels, compared with {experiment['reference']['samples']} samples a pixel of path tracing. "
            f"Processor: {', '.join(processors)}; threads of each tool: {', '.join(map(str, threads))}. {disturbed}")


def figures(experiment, rows, x):
    """Plots of each metric; those with nothing to show are left out."""
    found = []
    for metric in experiment["plots"]:
        target = f"plots/{metric}-{x}"
        if plots.plot(rows, metric, x, target):
            name = plots.LABELS.get(metric, metric)
            found.append({"type": "figure", "svg": f"{target}.svg", "alt": f"{name} against {AGAINST[x]}, logarithmic axes, a panel a scene",
                          "caption": f"{name} against {AGAINST[x]}; the mean over seeds and frames." +
                                     (" Rings on a dotted line: the Pareto front, which no other point beats in both." if x == "time_s" else "")})
    return found


def main_table(experiment, rows):
    metrics = list(dict.fromkeys([*experiment["plots"], "relmse_rgb", "ssim", "luminance_bias"]))
    metrics = [name for name in metrics if any(name in row["metrics"] for row in rows)]
    frame = ["frame"] if "frames" in experiment else []
    columns = ["scene", *frame, "variant", "N", "seed", "time, s", "with files, s", "process, s", *(plots.LABELS.get(name, name) for name in metrics)]
    lines = [[row["scene"], *(row[key] for key in frame), row["variant"], row["n"], row["seed"], row["times"]["time_s"],
              row["times"]["time_with_files_s"], row["times"]["wall_s"], *(row["metrics"].get(name) for name in metrics)] for row in rows]
    return {"type": "table", "caption": "Each image. results.csv has all figures.", "columns": columns, "rows": lines}


def stage_table(rows):
    """Seconds of each stage, without files."""
    tools = list(dict.fromkeys(tool for row in rows for tool in row["times"]["stages"]))
    return {"type": "table", "caption": "Seconds of each stage, without the reading and writing of files.",
            "columns": ["scene", "variant", "N", "seed", *tools],
            "rows": [[row["scene"], row["variant"], row["n"], row["seed"], *(row["times"]["stages"].get(tool) for tool in tools)] for row in rows]}


def viewer(rows, comparisons):
    """The first frame of a scene: each variant's dearest image beside the reference."""
    frame, seed = rows[0]["frame"], {}
    best = {}
    for row in rows:
        if row["frame"] == frame and row["seed"] == seed.setdefault(row["variant"], row["seed"]):
            if row["variant"] not in best or row["n"] > best[row["variant"]]["n"]:
                best[row["variant"]] = row
    tests = [{"file": row["image"], "label": row["variant"] + ("" if row["n"] is None else f", {row['n']}"), "metrics": comparisons[row["image"]]}
             for row in best.values()]
    return {"type": "images", "reference": {"file": rows[0]["reference"], "label": "reference"}, "tests": tests, "layers": ["indirect"]}


def decomposition_tables(decompositions):
    """One for each; whatever figures compare gives for the steps."""
    blocks = []
    for name in dict.fromkeys(entry["name"] for entry in decompositions):
        lines = [{"scene": entry["scene"], "frame": entry["frame"], "N": entry["n"], **step} for entry in decompositions if entry["name"] == name
                 for step in entry["decomposition"]["steps"]]
        columns = [key for key in dict.fromkeys(key for line in lines for key in line)
                   if all(not isinstance(line.get(key), (dict, list)) for line in lines) and any(line.get(key) is not None for line in lines)]
        blocks.append({"type": "table", "caption": f"{name}: shares of the error by cause.", "columns": columns,
                       "rows": [[line.get(key) for key in columns] for line in lines]})
    return blocks


def main():
    plan, results = read_json("plan.json"), read_json("results.json")
    experiment, rows = plan["experiment"], results["rows"]
    comparisons = {row["image"]: row["comparison"] for row in plan["rows"]}
    scenes = {scene: [row for row in rows if row["scene"] == scene] for scene in experiment["scenes"]}
    sections = [{"title": "Error against time", "content": figures(experiment, rows, "time_s")},
                {"title": "Error against N", "content": figures(experiment, rows, "n")},
                {"title": "Decomposition of the error", "content": decomposition_tables(results["decompositions"])},
                {"title": "Images", "sections": [{"title": scene, "content": [viewer(of_scene, comparisons)]} for scene, of_scene in scenes.items()]},
                {"title": "Figures", "content": [main_table(experiment, rows), stage_table(rows)]}]
    spec = {"$schema": "vsgltools/report/1", "title": experiment.get("title", "Experiment"),
            "summary": "\n\n".join([*([experiment["description"]] if "description" in experiment else []), conditions(experiment, rows)]),
            "sections": [section for section in sections if section.get("content") or section.get("sections")]}
    pathlib.Path("report-spec.json").write_text(json.dumps(spec, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
