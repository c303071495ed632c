#!/usr/bin/env python3
"""Makes the experiment's tables, results.json, results.csv and equal.csv, from plan.json and what the stages left. Runs in the
output folder."""

import csv
import json
import pathlib

import equal

STAGES = ["rsm-bake", "pdf-build", "vsgl-gen", "ismap", "shade", "render", "reference"]
KEYS = ["scene", "frame", "variant", "n", "error", "seed"]


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def stage_times(folder):
    """Seconds of a stage: its phases without and with the reading and writing of files, the device's part of them, and the process
    from start to end."""
    report = read_json(f"{folder}/report.json")
    phases = [(phase["name"].split()[0] in ("read", "write"), phase["host_s"]) for phase in report["phases"]]
    process = {key: report["process"][key] for key in ("wall_s", "jobs", "threads", "processor")}
    return {"time_s": sum(seconds for files, seconds in phases if not files),
            "time_with_files_s": sum(seconds for _, seconds in phases),
            "device_s": sum(phase.get("device_s", 0) for phase in report["phases"]), **process}


def row_times(folders):
    """Of all stages that made an image."""
    stages = {tool: stage_times(folders[tool]) for tool in STAGES if tool in folders}
    sums = {key: sum(stage[key] for stage in stages.values()) for key in ("time_s", "time_with_files_s", "wall_s")}
    conditions = {"jobs": max(stage["jobs"] for stage in stages.values()),
                  "threads": sorted({stage["threads"] for stage in stages.values()}),
                  "processors": sorted({stage["processor"] for stage in stages.values()})}
    shading = stages["shade"]["device_s"] if "shade" in stages else None
    return {**sums, "stages": {tool: stage["time_s"] for tool, stage in stages.items()}, "shading_s": shading, **conditions}


def metrics(comparison, name="indirect"):
    """The figures that compare gives for a layer, and the standard error of its luminance's bias."""
    layer = next(layer for layer in read_json(comparison)["layers"] if layer["layer"] == name)
    return layer["metrics"] | {"luminance_bias_error": layer["luminance_bias"]["standard_error"]}


def write_csv(rows, target):
    """A line per image. Times: time_s is the sum of the stages' phases without files, <stage>_s its parts, shading_s the device's
    part of shade."""
    used = [tool for tool in STAGES if any(tool in row["times"]["stages"] for row in rows)]
    names = list(dict.fromkeys(name for row in rows for name in row["metrics"]))
    with open(target, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        sums = ["shading_s", "time_s", "time_with_files_s", "wall_s", "jobs"]
        writer.writerow([*KEYS, *(f"{tool.replace('-', '_')}_s" for tool in used), *sums, *names])
        for row in rows:
            times = row["times"]
            writer.writerow([*(row[key] for key in KEYS), *(times["stages"].get(tool) for tool in used),
                             *(times[key] for key in sums), *(row["metrics"].get(name) for name in names)])


def main():
    plan = read_json("plan.json")
    rows = [{key: row[key] for key in (*KEYS, "image", "reference")} |
            {"metrics": metrics(row["comparison"]), "times": row_times(row["stages"])} for row in plan["rows"]]
    decompositions = [{key: entry[key] for key in ("name", "scene", "frame", "n")} |
                      {"decomposition": read_json(entry["comparison"])} for entry in plan["decompositions"]]
    tables = equal.compare_methods(plan["experiment"], rows)
    result = {"$schema": "vsgltools/experiment-results/1", "rows": rows, "decompositions": decompositions, "equal": tables}
    pathlib.Path("results.json").write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    write_csv(rows, "results.csv")
    with open("equal.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([equal.COLUMNS, *equal.table_rows(tables)])


if __name__ == "__main__":
    main()
