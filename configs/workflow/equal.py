#!/usr/bin/env python3
"""Methods side by side, scene by scene: error and time of each variant with an equal number of lights, and its error after an
equal time, which is that of one variant with so many lights. results.py calls this for experiments that say `equal`; as a program
it prints the tables of an experiment's results.json in Markdown."""

import argparse
import dataclasses
import functools
import json
import math
import pathlib
import statistics

NEAR = 1.25  # an image stands for an equal time if its own differs by no more than this factor
PIPELINES = pathlib.Path(__file__).resolve().parents[1] / "schema" / "pipeline.schema.json"


@dataclasses.dataclass(frozen=True)
class Image:
    """Of a variant; time and error are means over seeds and frames."""
    label: str
    lights: int | None  # all of its passes together; None where the variant is not swept over numbers of lights
    time: float  # s
    error: float  # of the metric asked for; less the reference's noise it may be below 0


def total_lights(variant, n):
    """Of an image with n of vsgl_gen.count, all passes together."""
    if n is None or "counts" not in variant:
        return None
    progressive = variant["pipeline"].get("progressive")
    return n if progressive is None else n * progressive.get("passes", default_passes())


@functools.cache
def default_passes():
    """Of `progressive` where a pipeline does not say."""
    return json.loads(PIPELINES.read_text(encoding="utf-8"))["properties"]["progressive"]["properties"]["passes"]["default"]


def label(row, variant):
    """"N = 1024", "error 0.1", "32 samples"."""
    if row["error"] is not None:
        return f"error {row['error']:g}"
    if "samples" in variant:
        return f"{row['n']} samples"
    lights = total_lights(variant, row["n"])
    return "its image" if lights is None else f"N = {lights}"


def images(rows, scene, name, variant, metric):
    """The variant's images of the scene that have the metric, by rising time."""
    groups = {}
    for row in rows:
        if (row["scene"], row["variant"]) == (scene, name):
            groups.setdefault((row["n"], row["error"]), []).append(row)
    found = []
    for group in groups.values():
        errors = [row["metrics"].get(metric) for row in group]
        if None not in errors:
            time = statistics.fmean(row["times"]["time_s"] for row in group)
            lights = total_lights(variant, group[0]["n"])
            found.append(Image(label(group[0], variant), lights, time, statistics.fmean(errors)))
    return sorted(found, key=lambda image: image.time)


def between(first, second, time):
    """Error on the straight line between two images on logarithmic axes; on a linear axis of errors where one is not above 0."""
    share = math.log(time / first.time) / math.log(second.time / first.time) if second.time > first.time else 1
    if first.error > 0 < second.error:
        return first.error * (second.error / first.error) ** share
    return first.error + share * (second.error - first.error)


def front(found):
    """Of images by rising time those that err less than all before them."""
    kept = []
    for image in found:
        if not kept or image.error < kept[-1].error:
            kept.append(image)
    return kept


def after(found, time):
    """(error, how it was found) of a variant, whose images these are, after that time: on the line through those that err less
    than all cheaper ones. The error is None where none comes near enough: the line is not continued beyond its ends."""
    curve = front(found)
    if not curve:
        return None, "no image with this metric"
    later = next((i for i, image in enumerate(curve) if image.time >= time), len(curve))
    if 0 < later < len(curve):
        first, second = curve[later - 1], curve[later]
        return between(first, second, time), f"between {first.label} and {second.label}"
    nearest = curve[0] if later == 0 else curve[-1]
    ratio = nearest.time / time
    if 1 / NEAR <= ratio <= NEAR:
        return nearest.error, nearest.label if ratio == 1 else f"{nearest.label}, {ratio:.2f} of the time"
    if later == 0:
        return None, f"not within it: {nearest.label} takes {ratio:.1f} times as long"
    return None, f"unknown: {nearest.label} is done in {ratio:.2f} of it, with {nearest.error:.3g}"


def compare_scene(experiment, rows, scene):
    """The scene's table: the time, and of each variant what it costs and errs. None where the metric does not exist, as errors
    relative to a black image."""
    asked, metric = experiment["equal"], experiment["plots"][0]
    curves = {name: images(rows, scene, name, variant, metric) for name, variant in experiment["variants"].items()}
    equals = {name: next((image for image in curve if image.lights == asked["lights"]), None) for name, curve in curves.items()}
    if equals[asked["time_of"]] is None:
        return None
    time = equals[asked["time_of"]].time
    methods = []
    for name, curve in curves.items():
        same = equals[name]
        error, how = after(curve, time)
        methods.append({"variant": name, "lights": same.lights if same else None, "time_s": same.time if same else None,
                        "error": same.error if same else None, "error_in_time": error, "how": how})
    return {"scene": scene, "lights": asked["lights"], "time_of": asked["time_of"], "time_s": time, "metric": metric,
            "methods": methods}


def compare_methods(experiment, rows):
    """A table a scene; none where the experiment does not ask for them."""
    if "equal" not in experiment:
        return []
    tables = [compare_scene(experiment, rows, scene) for scene in experiment["scenes"]]
    return [table for table in tables if table is not None]


COLUMNS = ["scene", "lights", "equal_time_s", "variant", "time_s", "error", "error_in_time", "how"]


def table_rows(tables):
    """In the order of COLUMNS."""
    return [[table["scene"], table["lights"], table["time_s"], method["variant"], method["time_s"], method["error"],
             method["error_in_time"], method["how"]] for table in tables for method in table["methods"]]


def figure(value):
    """Three digits, or what stands for no value."""
    if value is None:
        return "-"
    return f"{value:.2e}" if value > 0 else "below the noise"


def markdown(table):
    lines = [f"`{table['scene']}`: {table['lights']} lights; {table['time_s']:.2f} s, which `{table['time_of']}` takes", "",
             "| method | time, s | error | error after the equal time | found |", "|---|---|---|---|---|"]
    for method in table["methods"]:
        time = "-" if method["time_s"] is None else f"{method['time_s']:.2f}"
        cells = [f"`{method['variant']}`", time, figure(method["error"]), figure(method["error_in_time"]), method["how"]]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path, help="results.json of an experiment")
    results = parser.parse_args().results
    if not results.is_file():
        parser.error(f"{results}: no such file; name the results.json that an experiment has written")
    tables = json.loads(results.read_text(encoding="utf-8")).get("equal")
    if not tables:
        parser.error(f"{results}: its experiment has no key \"equal\"")
    print("\n\n".join(markdown(table) for table in tables))


if __name__ == "__main__":
    main()
