#!/usr/bin/env python3
"""The stability atlas as a page: runs stability_atlas, draws heat maps of its errors and lets the tool `report` make one HTML file of
them. docs/stability.md explains what is seen."""

import argparse
import json
import math
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402

SPECULAR = {"mean": "error over the peak, mean of the lights", "arithmetic": "float32 against double precision, over the peak"}
RANGES = {"mean": (1e-4, 1), "arithmetic": (1e-8, 1e-2), "diffuse": (1e-6, 1), "light": (1e-8, 1)}


def colours(kind):
    """Logarithmic; what is not finite is magenta, what is beyond the range has the colour of its end."""
    palette = matplotlib.colormaps["viridis"].copy()
    palette.set_bad("#ff00ff")
    return palette, matplotlib.colors.LogNorm(*RANGES[kind], clip=True)


def array(values, shape):
    found = numpy.array([math.nan if value is None else value for value in values]).reshape(shape)
    return numpy.where(found == 0, 1e-300, found)


def heat_map(axes, values, kind):
    palette, norm = colours(kind)
    return axes.pcolormesh(numpy.ma.masked_invalid(values), cmap=palette, norm=norm, rasterized=True)


def ticks(axis, values, every, form="{:.0e}"):
    places = range(0, len(values), every)
    axis.set_ticks([place + 0.5 for place in places], [form.format(values[place]) for place in places], fontsize=6)


def save(figure, shown, label, target):
    figure.colorbar(shown, ax=figure.axes, label=label, shrink=0.6, aspect=40)
    figure.savefig(target, dpi=95, metadata={"Software": None})
    plt.close(figure)


def draw_specular(grid, models, kind, target):
    """A row a model, a column a view; sharpness of the light to the right, roughness upwards."""
    shape = (len(grid["alphas"]), len(grid["degrees"]), len(grid["sharpnesses"]))
    figure, axes = plt.subplots(len(models), shape[1], squeeze=False, layout="constrained",
                                figsize=(1.5 * shape[1] + 1.6, 1.35 * len(models) + 0.5))
    for row, model in zip(axes, models):
        values = array(model[kind], shape)
        for column, cell in enumerate(row):
            shown = heat_map(cell, values[:, column], kind)
            cell.set(xticks=[], yticks=[])
        row[0].set_ylabel(model["name"].replace(", ", ",\n"), fontsize=7)
        ticks(row[-1].yaxis, grid["alphas"], max(1, shape[0] // 3), "{:.3g}")
        row[-1].yaxis.tick_right()
    for cell, angle in zip(axes[0], grid["degrees"]):
        cell.set_title(f"view at {angle:g}°", fontsize=7)
    for cell in axes[-1]:
        ticks(cell.xaxis, grid["sharpnesses"], max(1, shape[2] // 3), "{:.3g}")
    save(figure, shown, SPECULAR[kind], target)


def draw_forms(forms, kind, label, rows, columns, target, width=3):
    """A panel a form."""
    lines = -(-len(forms) // width)
    figure, axes = plt.subplots(lines, width, squeeze=False, layout="constrained", figsize=(3.6 * width, 2.5 * lines))
    for cell, form in zip(axes.flat, forms):
        shown = heat_map(cell, array(form["error"], (len(rows[1]), len(columns[1]))), kind)
        cell.set_title(form["name"], fontsize=8)
        ticks(cell.xaxis, columns[1], max(1, len(columns[1]) // 5))
        ticks(cell.yaxis, rows[1], max(1, len(rows[1]) // 4), rows[2])
        cell.set_xlabel(columns[0], fontsize=7)
        cell.set_ylabel(rows[0], fontsize=7)
    for cell in axes.flat[len(forms):]:
        cell.set_visible(False)
    save(figure, shown, label, target)


def worst_cells(grid, count=6):
    """Of each model the cells of the largest mean error, with their arguments."""
    shape = (len(grid["alphas"]), len(grid["degrees"]), len(grid["sharpnesses"]))
    lines = []
    for model in grid["models"]:
        values = array(model["mean"], shape)
        order = numpy.argsort(numpy.where(numpy.isnan(values), math.inf, values), axis=None)[::-1][:count]
        for index in order:
            place = numpy.unravel_index(index, shape)
            lines.append([model["name"], *(float(f"{grid[axis][k]:.3g}") for axis, k in zip(("alphas", "degrees", "sharpnesses"), place)),
                          float(values[place]), model["largest"][index], model["arithmetic"][index]])
    return lines


def summary(grid):
    def line(model):
        arithmetic = model["arithmetic"]
        worst = None if arithmetic is None or None in arithmetic else max(arithmetic)
        return [model["name"], model["median_relative"], model["mean_of_peak"], worst, model["not_finite"]]
    return [line(model) for model in grid["models"] + grid["published"]]


def specular_section(grid, folder):
    name, content = grid["ndf"], []
    for kind, models, what in (("mean", grid["models"], "models"), ("mean", grid["published"], "published"),
                               ("arithmetic", [m for m in grid["models"] + grid["published"] if m["arithmetic"]], "arithmetic")):
        target = f"{name}-{what}.png"
        draw_specular(grid, models, kind, folder / target)
        content.append({"type": "figure", "png": target, "alt": f"{name}: heat maps, {what}", "caption": CAPTIONS[what]})
    content.insert(0, {"type": "table", "caption": "Over the whole grid.", "rows": summary(grid),
                       "columns": ["form", "median relative error", "mean error over the peak", "worst arithmetic", "not finite"]})
    content.append({"type": "table", "caption": "The worst cells of each model.", "rows": worst_cells(grid),
                    "columns": ["model", "alpha", "view, degrees", "sharpness", "mean error", "largest error", "arithmetic"]})
    tests = [{"file": f"{name}-{model['name']}.exr", "label": model["name"]} for model in grid["models"]]
    content.append({"type": "text", "text": "All values over their cell's largest: a column a sharpness, a block of columns a view; a row a "
                    "light, a block of 17 rows a roughness. The pixel under the pointer shows its figures."})
    content.append({"type": "images", "reference": {"file": f"{name}-quadrature.exr", "label": "quadrature"}, "tests": tests})
    return {"title": f"Specular lobes: {name}", "content": content}


CAPTIONS = {
    "models": "The lobe models as the shading kernels compute them, against quadrature. Each cell: the mean error of 17 lights up to four lobe "
              "widths off the mirror direction, over the cell's largest value. Sharpness of the light grows to the right, roughness upwards.",
    "published": "Forms as published, on the same scale. Magenta: not finite.",
    "arithmetic": "What float32 takes: the largest difference to the same formula in double precision; of published forms, to the library's form "
                  "of the same mathematics. Magenta: not finite. auto, mixture and blend include the kernels' polynomials."}


def spec(atlas, folder):
    diffuse, light = atlas["diffuse"], atlas["light"]
    draw_forms(diffuse["forms"], "diffuse", "error over the peak", ("light to the normal, degrees", diffuse["degrees"], "{:g}"),
               ("sharpness of the light", diffuse["sharpnesses"]), folder / "diffuse.png")
    draw_forms(light["forms"], "light", "relative error", ("sharpness of the emission", light["sharpnesses"], "{:.0e}"),
               ("distance over standard deviation", light["distances"]), folder / "light.png")
    worst = [[form["name"], "published" if form["published"] else "in use", max((e for e in form["error"] if e is not None)),
              form["error"].count(None)] for form in diffuse["forms"] + light["forms"]]
    return {
        "$schema": "vsgltools/report/1", "title": "Stability atlas",
        "summary": f"Errors over the whole range of the arguments, in float32 on {atlas['device']}, against quadrature in double precision. "
                   "docs/stability.md explains the worst cells.",
        "sections": [
            *(specular_section(grid, folder) for grid in atlas["specular"]),
            {"title": "Diffuse integrals", "content": [
                {"type": "figure", "png": "diffuse.png", "alt": "heat maps of the diffuse integrals",
                 "caption": "Means of the clamped cosine, and of the half space, under the normalised SG, against quadrature."}]},
            {"title": "Light of a cluster", "content": [
                {"type": "figure", "png": "light.png", "alt": "heat maps of the fluence of a cluster",
                 "caption": "Light that a cluster of variance 1 m² sends along the edge of its lobe, against double precision. The kernels take light "
                            "broader than sharpness 1e-3 as if it had that."},
                {"type": "table", "caption": "Worst errors of the diffuse integrals (over the peak) and of the light (relative).",
                 "columns": ["form", "status", "worst error", "not finite"], "rows": worst}]}]}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the built tools")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the results")
    parser.add_argument("--quick", action="store_true", help="a coarse grid, GGX only")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    quick = ["--quick"] if options.quick else []
    subprocess.run([options.bin / "stability_atlas", "-o", options.output, *quick], check=True, stdout=subprocess.DEVNULL)
    atlas = json.loads((options.output / "atlas.json").read_text(encoding="utf-8"))
    (options.output / "report.json").write_text(json.dumps(spec(atlas, options.output), indent=1) + "\n", encoding="utf-8")
    subprocess.run([options.bin / "report", options.output / "report.json", "-o", options.output / "report.html"], check=True)
    for grid in atlas["specular"]:
        for name, median, mean, arithmetic, broken in summary(grid):
            shown = "" if arithmetic is None else f"{arithmetic:.1e}"
            print(f"{grid['ndf']:<9}{name:<28}{median:>9.4f}{mean:>9.4f}{shown:>10}{broken:>8}")
    print(f"\n{options.output / 'report.html'}")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"atlas: {error}")
