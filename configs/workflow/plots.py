"""Plots of an experiment's table with matplotlib: error against time, with the Pareto front, and error against N. The same table
gives the same bytes."""

import pathlib
import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

# Okabe and Ito's palette, told apart with any colour vision, and a marker each for print without colour.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7A5230"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
LABELS = {"relmse_rgb": "relMSE", "relmse_denoised": "relMSE, less the reference's noise", "relmse_trimmed": "relMSE, trimmed",
          "relmse_trimmed_denoised": "relMSE, trimmed, less the reference's noise", "flip": "FLIP", "ssim": "SSIM", "luminance_bias": "mean over the reference's", "time_s": "time without files, s",
          "n": "lights, or samples a pixel"}
STYLE = {"svg.hashsalt": "vsgltools", "svg.fonttype": "path", "font.size": 9, "axes.grid": True, "axes.grid.which": "both",
         "grid.linewidth": 0.4, "grid.color": "#d8d8d8", "axes.axisbelow": True, "axes.spines.top": False,
         "axes.spines.right": False}


def pareto_front(points):
    """Of (cost, error) pairs: those for which no other is at most as dear and at most as wrong; by rising cost."""
    front = []
    for cost, error in sorted(points):
        if not front or error < front[-1][1]:
            front.append((cost, error))
    return front


def effort(row):
    """Of two images of a variant the one with more of it is the dearer one: more lights or samples, or a smaller error."""
    return -row["error"] if row["error"] is not None else row["n"] or 0


def label(row):
    """"default, error 0.02", "vpl, 64"."""
    if row["error"] is not None:
        return f"{row['variant']}, error {row['error']:g}"
    return row["variant"] if row["n"] is None else f"{row['variant']}, {row['n']}"


def series(rows, scene, metric, x):
    """variant -> [(x, error)], the means over seeds and frames, by rising effort. Without what logarithmic axes cannot show."""
    groups = {}
    for row in rows:
        if row["scene"] == scene:
            groups.setdefault((row["variant"], row["n"], row["error"]), []).append(row)
    found = {}
    for (variant, n, _), group in sorted(groups.items(), key=lambda item: effort(item[1][0])):
        errors = [row["metrics"].get(metric) for row in group]
        places = [row["times"]["time_s"] if x == "time_s" else n for row in group]
        if None not in places and all(error is not None and error > 0 for error in errors):
            found.setdefault(variant, []).append((statistics.fmean(places), statistics.fmean(errors)))
    return found


def twos_and_fives(axis):
    """Labels of an axis between its powers of ten, where there are few of these."""
    low, high = axis.get_view_interval()
    if high > 300 * low:
        return matplotlib.ticker.NullFormatter()
    return matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "25" else "")


def draw(axes, curves, variants, x, metric):
    """One scene's curves."""
    for variant, points in curves.items():
        index = variants.index(variant)
        axes.plot(*zip(*points), color=COLOURS[index % len(COLOURS)], marker=MARKERS[index % len(MARKERS)], markersize=4,
                  linewidth=1.4, label=variant)
    if x == "time_s":
        front = pareto_front([point for points in curves.values() for point in points])
        axes.plot(*zip(*front), color="#404040", linewidth=0.8, linestyle=":", marker="o", markersize=9, markerfacecolor="none",
                  label="Pareto front", zorder=1)
    for scale, axis in ((axes.set_xscale, axes.xaxis), (axes.set_yscale, axes.yaxis)):
        scale("log")
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(twos_and_fives(axis))
    axes.set_xlabel(LABELS[x])
    axes.set_ylabel(LABELS.get(metric, metric))


def legend(figure, panels):
    """One for all panels, below them."""
    labels = {}
    for panel in panels.flat:
        labels.update((label, handle) for handle, label in zip(*panel.get_legend_handles_labels()))
    figure.legend(labels.values(), labels.keys(), loc="upper center", bbox_to_anchor=(0.5, 0), ncol=min(len(labels), 5),
                  frameon=False)


def plot(rows, metric, x, target):
    """A panel a scene. Writes target.svg and target.png; nothing, and returns False, where there is nothing to show."""
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    variants = list(dict.fromkeys(row["variant"] for row in rows))
    curves = {scene: series(rows, scene, metric, x) for scene in scenes}
    if not any(curves.values()):
        return False
    columns = min(2, len(scenes))
    lines = -(-len(scenes) // columns)
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(lines, columns, squeeze=False, layout="constrained", figsize=(4.6 * columns, 3.4 * lines))
        for panel, scene in zip(panels.flat, scenes):
            panel.set_title(scene, loc="left", fontweight="bold")
            if curves[scene]:
                draw(panel, curves[scene], variants, x, metric)
        for panel in panels.flat[len(scenes):]:
            panel.set_visible(False)
        legend(figure, panels)
        pathlib.Path(target).parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(f"{target}.svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
        figure.savefig(f"{target}.png", dpi=110, metadata={"Software": None}, bbox_inches="tight")
        plt.close(figure)
    return True
