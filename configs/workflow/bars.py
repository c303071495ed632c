#!/usr/bin/env python3
"""Reads an experiment's results.csv and tells, scene by scene, what the default chain costs and errs beside the papers' chain and
every other variant. Ratios are of means over seeds and frames: below 1 the default is faster, or nearer to the reference.

Usage: bars.py RESULTS.csv [--error 0.1] [--json FILE]"""

import argparse
import csv
import json
import math
import pathlib
import statistics
import sys

ERRORS = ("relmse_trimmed", "relmse_rgb", "relmse_trimmed_denoised")
METRICS = (*ERRORS, "luminance_bias")
TIMES = ("shading_s", "ismap_s", "shade_s", "time_s", "time_with_files_s", "wall_s")
OWN, EXACT = "default", "default-exact"
PAPERS, PAPERS_EXACT = "fis-2016", "fis-2016-exact"
LIGHTS = 1024


class MissingRow(Exception):
    """The table lacks an image that a ratio needs."""


def number(text):
    return float(text) if text else None


def mean(rows, key):
    values = [number(row.get(key, "")) for row in rows]
    return None if not values or None in values else statistics.fmean(values)


def read_points(path):
    """(scene, variant, n, error) -> the means of its images."""
    groups = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            groups.setdefault((row["scene"], row["variant"], number(row["n"]), number(row["error"])), []).append(row)
    return {key: {name: mean(rows, name) for name in (*METRICS, *TIMES)} for key, rows in groups.items()}


def name_of(variant, n, error):
    return variant + (f" {n:g}" if n is not None else "") + (f" error {error:g}" if error is not None else "")


def find(points, scene, variant, n=None, error=None):
    if (scene, variant, n, error) not in points:
        raise MissingRow(f"{scene}: no {name_of(variant, n, error)} in the table")
    return points[scene, variant, n, error]


def sight_and_shading(point):
    """Seconds of the visibility stage, in which the default chooses its cut, and of shading on the device."""
    return point["ismap_s"] + point["shading_s"]


def curve_at(curve, time):
    """Error of the curve, [(time, error)], after that time, along straight lines between its points on logarithmic axes; infinite
    before its first point."""
    front = []
    for cost, error in sorted(curve):
        if not front or error < front[-1][1]:
            front.append((cost, error))
    after = next((i for i, (cost, _) in enumerate(front) if cost > time), len(front))
    if after in (0, len(front)):
        return front[-1][1] if after else math.inf
    (t0, e0), (t1, e1) = front[after - 1:after + 1]
    return e0 * (e1 / e0) ** (math.log(time / t0) / math.log(t1 / t0))


def below_curve(points, scene):
    """Images of other variants that lie below the default's curve of error against time, also in part of its time."""
    curve = [(point["time_s"], point["relmse_trimmed"]) for (place, variant, *_), point in points.items()
             if place == scene and variant == OWN]
    found = []
    for (place, variant, n, error), point in points.items():
        if place != scene or variant in (OWN, EXACT):
            continue
        time, wrong = point["time_s"], point["relmse_trimmed"]
        ahead = any(time <= cost and wrong <= deviation for cost, deviation in curve)
        if ahead or wrong < curve_at(curve, time) < math.inf:
            found.append({"image": name_of(variant, n, error), "time_s": time, "relmse_trimmed": wrong})
    return found


def ratios(ours, theirs, **times):
    """Of time, by the functions given, and of error."""
    found = {name: seconds(ours) / seconds(theirs) for name, seconds in times.items()}
    return found | {metric: ours[metric] / theirs[metric] for metric in ERRORS}


def judge(points, scene, error, high):
    """All figures of one scene."""
    exact, papers_exact = find(points, scene, EXACT, error=error), find(points, scene, PAPERS_EXACT, LIGHTS)
    own, papers = find(points, scene, OWN, error=error), find(points, scene, PAPERS, LIGHTS)
    accurate = find(points, scene, EXACT, error=high)
    return {
        "exact": ratios(exact, papers_exact, shading=lambda point: point["shading_s"], sight_and_shading=sight_and_shading),
        "exact_high": ratios(accurate, papers_exact, shading=lambda point: point["shading_s"]),
        "end_to_end": ratios(own, papers, time=lambda point: point["time_s"], wall=lambda point: point["wall_s"]),
        "mean_exact": exact["luminance_bias"],
        "mean": own["luminance_bias"],
        "below_the_curve": below_curve(points, scene),
    }


def text(results, error, high):
    lines = [f"Default at error {error:g} over {PAPERS} with {LIGHTS} lights; relMSE trimmed (untrimmed; trimmed, less the reference's noise)."]
    head = (f"{'scene':<22}{'shading':>9}{'+ sight':>9}{'relMSE':>30}{f'relMSE at {high:g}':>30}{'whole':>9}{'wall':>9}{'relMSE':>30}"
            f"{'mean exact':>12}{'mean':>8}")
    lines += ["", f"{'':<22}{'exact visibility on both sides':>48}{'':>30}{'each with its own visibility':>48}", head]
    errors = lambda entry: f"{entry['relmse_trimmed']:.2e} ({entry['relmse_rgb']:.1e}; {entry['relmse_trimmed_denoised']:.1e})"
    for scene, entry in results.items():
        exact, end = entry["exact"], entry["end_to_end"]
        lines.append(f"{scene:<22}{exact['shading']:>9.3f}{exact['sight_and_shading']:>9.3f}{errors(exact):>30}"
                     f"{errors(entry['exact_high']):>30}{end['time']:>9.3f}{end['wall']:>9.3f}{errors(end):>30}"
                     f"{entry['mean_exact']:>12.4f}{entry['mean']:>8.4f}")
    lines += ["", "Images below the default's curve of error against time:"]
    for scene, entry in results.items():
        others = [f"{other['image']}: {other['time_s']:.2f} s, {other['relmse_trimmed']:.2e}" for other in entry["below_the_curve"]]
        lines += [f"{scene:<22}{other}" for other in others or ["none"]]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="results.csv of an experiment")
    parser.add_argument("--error", type=float, default=0.1, help="of the default chain (default 0.1)")
    parser.add_argument("--high", type=float, default=0.001, help="error that stands for high accuracy (default 0.001)")
    parser.add_argument("--json", type=pathlib.Path, help="file for the same figures")
    options = parser.parse_args()
    points = read_points(options.results)
    results = {scene: judge(points, scene, options.error, options.high) for scene in dict.fromkeys(key[0] for key in points)}
    print(text(results, options.error, options.high))
    if options.json:
        options.json.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    try:
        main()
    except MissingRow as error:
        sys.exit(f"bars: {error}")
