#!/usr/bin/env python3
"""Drives the tools through extremes: the cases of configs/stress, each against a double-precision twin, a closed form or an
invariance. Prints a table of ranges, worst errors and bounds; writes results.json and report.html; ends with 1 where a case
fails. docs/stability.md explains it."""

import argparse
import concurrent.futures
import math
import os
import pathlib
import shutil
import sys
import time

import exr
from plan import ExperimentError
from stage import write_json
from stress_checks import CHECKS, CheckFailed
from stress_plan import FOLDER, Suite
from stress_report import page
from stress_tools import ToolBroke, ToolFailed, Workshop, run_tool


def methods_of(bin_dir):
    """tool -> the names in its registry."""
    return lambda tool: [line.split()[0] for line in run_tool([bin_dir / tool, "--list-methods"]).splitlines()]


def judge(workshop, case):
    """The case's line of results.json."""
    start = time.monotonic()
    found = {"row": case["row"], "name": case["name"], "check": case["check"], "bound": case["bound"], "error": None,
             "left_out": 0, "pixels": 0, "failure": None}
    try:
        measured = CHECKS[case["check"]](workshop, case)
        found |= {"error": measured.error if math.isfinite(measured.error) else None,
                  "left_out": measured.left_out, "pixels": measured.pixels}
        if not measured.error <= case["bound"]:
            found["failure"] = f"error {measured.error:.3g} exceeds the bound {case['bound']:.3g}"
    except (CheckFailed, ToolFailed, ToolBroke, exr.BadImage) as error:
        found["failure"] = str(error)
    return found | {"wall_s": round(time.monotonic() - start, 2)}


def run_group(suite, group, workshop, options):
    cases = [case for case in suite.cases(group, options.quick) if options.only in case["name"]]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return list(pool.map(lambda case: judge(workshop, case), cases))


def closeness(result):
    """Of the error to the bound; among exact cases the error itself."""
    return result["error"] / result["bound"] if result["bound"] > 0 else result["error"]


def rows_of(results):
    """A line for each row of the table: cases, failures, the error nearest to its bound."""
    rows = {}
    for result in results:
        rows.setdefault(result["row"], []).append(result)
    found = []
    for row, members in rows.items():
        worst = max((member for member in members if member["error"] is not None), key=closeness, default=None)
        found.append({"row": row, "check": members[0]["check"], "cases": len(members),
                      "failed": sum(member["failure"] is not None for member in members),
                      "worst": worst["error"] if worst else None, "bound": (worst or members[0])["bound"],
                      "worst_case": worst["name"] if worst else None,
                      **{key: sum(member[key] for member in members) for key in ("left_out", "pixels")}})
    return found


def table(rows):
    lines = [f"{'range':<78}{'cases':>6}{'worst error':>13}{'bound':>9}  verdict"]
    for row in rows:
        worst = "" if row["worst"] is None else f"{row['worst']:.2g}"
        verdict = "ok" if row["failed"] == 0 else f"{row['failed']} FAILED"
        left_out = f"; {row['left_out']} of {row['pixels']} pixels left out" if row["left_out"] else ""
        lines.append(f"{row['row']:<78}{row['cases']:>6}{worst:>13}{row['bound']:>9.2g}  {verdict}{left_out}")
    return "\n".join(lines)


def run(suite, options):
    """The document of results.json, printed group by group."""
    groups, begin = [], time.monotonic()
    for name in options.groups or suite.groups:
        workshop = Workshop(options.bin, options.output / "work" / name)
        results = run_group(suite, name, workshop, options)
        if not results:
            continue
        rows = rows_of(results)
        print(f"\n{suite.groups[name]['title']}\n{table(rows)}", flush=True)
        for result in results:
            if result["failure"]:
                print(f"FAIL {result['name']}: {result['failure']}", flush=True)
        about = {key: suite.groups[name][key] for key in ("title", "text")}
        groups.append({"name": name, **about, "rows": rows, "cases": results})
        if not options.keep:
            shutil.rmtree(options.output / "work" / name, ignore_errors=True)
    return {"$schema": "vsgltools/stress-results/1", "quick": options.quick, "wall_s": round(time.monotonic() - begin, 1),
            "groups": groups}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=lambda text: pathlib.Path(text).resolve(), help="folder of the built tools")
    parser.add_argument("--output", required=True, type=lambda text: pathlib.Path(text).resolve(), help="folder for the results")
    parser.add_argument("--groups", nargs="*", help="some of the files of configs/stress, by their names (default: all)")
    parser.add_argument("--only", default="", help="cases whose name has this text")
    parser.add_argument("--quick", action="store_true", help="a few cases of each group")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="cases at once (default: one a core)")
    parser.add_argument("--keep", action="store_true", help="keep what the tools made, in OUTPUT/work")
    options = parser.parse_args()
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    suite = Suite(FOLDER, methods_of(options.bin))
    found = run(suite, options)
    cases = [case for group in found["groups"] for case in group["cases"]]
    if not cases:
        raise ExperimentError(f"no case is called \"{options.only}\"")
    options.output.mkdir(parents=True, exist_ok=True)
    write_json(options.output / "results.json", found)
    write_json(options.output / "report-spec.json", page(found))
    run_tool([options.bin / "report", options.output / "report-spec.json", "-o", options.output / "report.html", "--overwrite",
              "--quiet"])
    failed = sum(case["failure"] is not None for case in cases)
    print(f"\n{len(cases)} cases in {found['wall_s']:.0f} s, {failed} failed. {options.output}/report.html, results.json")
    return 1 if failed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except ExperimentError as error:
        sys.exit(f"stress: {error}")
