#!/usr/bin/env python3
"""Draws the experiment's plots and writes report-spec.json, from which the tool `report` makes report.html. Runs in the output
folder."""

import json
import pathlib

import plots
from equal import NEAR

AGAINST = {"time_s": "time", "n": "the number of lights or samples"}
FRONT = " Rings on a dotted line: the Pareto front, which no other point beats in both."
EQUAL = (f"Between two images of a method, of which none errs more than a cheaper one, errors are interpolated on logarithmic "
         f"axes; the first and the last also stand for times that differ from theirs by a factor of at most {NEAR}.")
DECOMPOSED = ("the causes of the error, each taken away after those above it. Share of the error's power, with its 95% interval; "
              "mean and root mean square relative to the reference's mean.")


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def table(caption, columns, rows):
    return {"type": "table", "caption": caption, "columns": columns, "rows": rows}


def conditions(experiment, rows):
    """What one must know to judge the figures."""
    times = [row["times"] for row in rows]
    processors = sorted({name for entry in times for name in entry["processors"]})
    threads = sorted({count for entry in times for count in entry["threads"]})
    jobs = max(entry["jobs"] for entry in times)
    alone = "One tool ran at a time."
    disturbed = f"Up to {jobs} tools ran at once, so the times are longer than they would be alone."
    return (f"Images of {experiment['resolution']} pixels, compared with {experiment['reference']['samples']} samples a pixel of "
            f"path tracing. Processor: {', '.join(processors)}; threads of each tool: {', '.join(map(str, threads))}. "
            f"{disturbed if jobs > 1 else alone}")


def figures(metrics, rows, x, group):
    """Plots of each metric; those with nothing to show are left out."""
    found = []
    for metric in metrics:
        target = f"plots/{'-'.join(part for part in (metric, x, group) if part)}"
        if plots.plot(rows, metric, x, target):
            what = f"{plots.LABELS.get(metric, metric)} against {AGAINST[x]}"
            found.append({"type": "figure", "svg": f"{target}.svg", "alt": f"{what}, logarithmic axes, a panel a scene",
                          "caption": f"{what}; the mean over seeds and frames.{FRONT if x == 'time_s' else ''}"})
    return found


def grouped_figures(experiment, rows, x):
    """Of the first group every metric, of the others the first one: a section's content, or its sections."""
    if "groups" not in experiment:
        return {"content": figures(experiment["plots"], rows, x, None)}
    found = []
    for name in experiment["groups"]:
        metrics = experiment["plots"] if not found else experiment["plots"][:1]
        content = figures(metrics, members(experiment, rows, name), x, name)
        found.append({"title": name.replace("-", " "), "content": content})
    return {"sections": [section for section in found if section["content"]]}


def members(experiment, rows, group):
    """The rows of a group's variants, in its order."""
    return [row for name in experiment["groups"][group] for row in rows if row["variant"] == name]


def equal_tables(tables):
    """All variants side by side, a table a scene."""
    found = []
    for entry in tables:
        metric = plots.LABELS.get(entry["metric"], entry["metric"])
        caption = (f"{entry['scene']}: {metric} with {entry['lights']} lights; and after {entry['time_s']:.2f} s, which "
                   f"{entry['time_of']} takes for them. {EQUAL}")
        columns = ["method", f"time with {entry['lights']} lights, s", "error", f"error after {entry['time_s']:.2f} s", "found"]
        keys = ["variant", "time_s", "error", "error_in_time", "how"]
        found.append(table(caption, columns, [[method[key] for key in keys] for method in entry["methods"]]))
    return found


def main_table(experiment, rows):
    metrics = list(dict.fromkeys([*experiment["plots"], "relmse_rgb", "ssim", "luminance_bias"]))
    metrics = [name for name in metrics if any(name in row["metrics"] for row in rows)]
    keys = ["scene", *(["frame"] if "frames" in experiment else []), "variant", "n", "error", "seed"]
    times = {"time, s": "time_s", "with files, s": "time_with_files_s", "process, s": "wall_s"}
    return table("Each image. results.csv has all figures.", [*keys, *times, *(plots.LABELS.get(name, name) for name in metrics)],
                 [[*(row[key] for key in keys), *(row["times"][key] for key in times.values()),
                   *(row["metrics"].get(name) for name in metrics)] for row in rows])


def stage_table(rows):
    tools = list(dict.fromkeys(tool for row in rows for tool in row["times"]["stages"]))
    keys = ["scene", "frame", "variant", "n", "error", "seed"]
    return table("Seconds of each stage, without the reading and writing of files.", [*keys, *tools],
                 [[*(row[key] for key in keys), *(row["times"]["stages"].get(tool) for tool in tools)] for row in rows])


def viewer(rows):
    """The first frame of a scene: each variant's image with the largest N or smallest error, of its first seed, beside the
    reference."""
    best = {}
    for row in rows:
        other = best.get(row["variant"])
        if row["frame"] == rows[0]["frame"] and (other is None or plots.effort(row) > plots.effort(other)):
            best[row["variant"]] = row
    tests = [{"file": row["image"], "label": plots.label(row)} for row in best.values()]
    reference = {"file": rows[0]["reference"], "label": "reference"}
    return {"type": "images", "reference": reference, "tests": tests, "layers": ["indirect"]}


def decomposition_lines(entry):
    """The whole error, then what each cause has of it."""
    found = entry["decomposition"]
    nothing = {"share_interval": [None, None], "mean": None, "relmse_after": None}
    lines = [{**nothing, **found["total"], "cause": "whole error", "share": 1}, *found["steps"], found["remainder"],
             {**nothing, **found["noise"], "cause": "noise of the reference"}]
    return [[entry["scene"], entry["frame"], entry["n"], line["cause"], line["share"], *line["share_interval"], line["mean"],
             line["rms"], line.get("relmse"), line["relmse_after"]] for line in lines]


def decomposition_tables(decompositions):
    columns = ["scene", "frame", "n", "cause", "share", "from", "to", "mean", "rms", "relMSE", "relMSE without it"]
    return [table(f"{name}: {DECOMPOSED}", columns,
                  [line for entry in decompositions if entry["name"] == name for line in decomposition_lines(entry)])
            for name in dict.fromkeys(entry["name"] for entry in decompositions)]


def sections(plan, results):
    experiment, rows = plan["experiment"], results["rows"]
    shown = members(experiment, rows, next(iter(experiment["groups"]))) if "groups" in experiment else rows
    viewers = [{"title": scene, "content": [viewer([row for row in shown if row["scene"] == scene])]}
               for scene in experiment["scenes"]]
    found = [{"title": "Error against time", **grouped_figures(experiment, rows, "time_s")},
             {"title": "Error against N", **grouped_figures(experiment, rows, "n")},
             {"title": "Equal numbers of lights, equal times", "content": equal_tables(results["equal"])},
             {"title": "Causes of the error", "content": decomposition_tables(results["decompositions"])},
             {"title": "Images", "sections": viewers},
             {"title": "Figures", "content": [main_table(experiment, rows), stage_table(rows)]}]
    return [section for section in found if section.get("content") or section.get("sections")]


def main():
    plan, results = read_json("plan.json"), read_json("results.json")
    experiment = plan["experiment"]
    summary = [experiment["description"]] if "description" in experiment else []
    spec = {"$schema": "vsgltools/report/1", "title": experiment.get("title", "Experiment"),
            "summary": "\n\n".join([*summary, conditions(experiment, results["rows"])]), "sections": sections(plan, results)}
    pathlib.Path("report-spec.json").write_text(json.dumps(spec, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
