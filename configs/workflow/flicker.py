#!/usr/bin/env python3
"""How the methods flicker while a light moves: the sequences of configs/sequences/flicker.json, what compare tells of them, steps
at tile borders frame by frame, and a picture of one image row over time. What is there already and unchanged is not made again.
docs/cut.md explains the figures."""

import argparse
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402

from chain import StageFailed  # noqa: E402
from paper_pictures import exposure, srgb  # noqa: E402
from sequence import Sequence, relative_steps  # noqa: E402

DEFAULT = pathlib.Path(__file__).resolve().parents[1] / "sequences" / "flicker.json"
TRUTH, LIMIT = "reference", "limit"
FIGURES = ["flicker", "flicker_interval", "flicker_relative", "step_p99", "step_p999", "pops", "bias_mean", "rmse", "spectrum"]


def make(sequence, plan, scene):
    sequence.scene_gen(*scene["generate"])
    for label, pipeline in {LIMIT: plan["limit"], **plan["variants"]}.items():
        sequence.render(label, pipeline)
    sequence.reference(TRUTH, **plan["reference"])


def seams(sequence, label):
    """Percentiles of the steps at all tile borders of a frame: the medians and the largest values over the frames."""
    excess = [frame["excess"] for frame in sequence.seams(label, LIMIT)]
    columns = {name: [frame[name] for frame in excess] for name in ("median", "p99", "max")}
    return {name: {"median": float(numpy.median(values)), "largest": max(values)} for name, values in columns.items()}


def measure(sequence, variants):
    """Of each variant, and of the limit itself: against path tracing, and against the limit, which has no noise."""
    found = {}
    for label in [*variants, LIMIT]:
        truths = [TRUTH] if label == LIMIT else [TRUTH, LIMIT]
        found[label] = {}
        for truth in truths:
            figures = sequence.flicker(label, truth)
            found[label][truth] = {name: figures[name] for name in FIGURES}
    found["default"]["seams"] = seams(sequence, "default")
    return found


def draw(sequence, row, variants, target):
    """A column a method: its first frame, the image row marked there over time (downwards), how much its error changes from a
    frame to the next along that row, and the largest such change of each pixel."""
    truth = sequence.load(LIMIT)
    columns = {TRUTH: sequence.load(TRUTH), **{label: sequence.load(label) for label in variants}}
    scale = exposure(truth)
    y = round(row * (truth.shape[1] - 1))
    figure, axes = plt.subplots(4, len(columns), figsize=(2.2 * len(columns), 8.4), layout="constrained")
    changes = matplotlib.colors.LogNorm(0.002, 0.5)
    for (label, images), column in zip(columns.items(), axes.T):
        steps = numpy.abs(relative_steps(images, truth))
        column[0].imshow(srgb(scale * images[0]))
        column[0].axhline(y, color="white", linewidth=0.6)
        column[0].set_title(label, fontsize=9)
        column[1].imshow(srgb(scale * images[:, y]), interpolation="nearest", aspect="auto")
        column[2].imshow(steps[:, y] + 1e-9, norm=changes, cmap="magma", interpolation="nearest", aspect="auto")
        shown = column[3].imshow(steps.max(axis=0) + 1e-9, norm=changes, cmap="magma", interpolation="nearest")
        for cell in column:
            cell.set(xticks=[], yticks=[])
    for cell, text in zip(axes[:, 0], ["first frame", "row over time", "change of its error", "largest change"]):
        cell.set_ylabel(text, fontsize=8)
    figure.colorbar(shown, ax=axes[2:], label="change from a frame to the next, relative", shrink=0.8)
    figure.savefig(target, dpi=110, metadata={"Software": None})
    plt.close(figure)


def table(name, found):
    lines = [f"{name:<16}{'flicker':>9}{'95%':>18}{'visible':>9}{'p99 step':>10}{'pops':>7}   to the limit: flicker, p99, pops"]
    for label, truths in found.items():
        f = truths[TRUTH]
        low, high = f["flicker_interval"]
        visible = "" if f["spectrum"] is None else f"{f['spectrum']['visible']:.4f}"
        line = f"{label:<16}{f['flicker']:>9.4f}{f'{low:.4f} .. {high:.4f}':>18}{visible:>9}{f['step_p99']:>10.3f}{f['pops']:>7.0f}"
        if LIMIT in truths:
            g = truths[LIMIT]
            line += f"   {g['flicker']:.4f}, {g['step_p99']:.3f}, {g['pops']:.0f}"
        lines.append(line)
    steps = found["default"]["seams"]
    lines.append("default, steps at tile borders beyond those beside them: " +
                 ", ".join(f"{name} {value['median']:.4f} (largest {value['largest']:.4f})" for name, value in steps.items()))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("plan", type=pathlib.Path, nargs="?", default=DEFAULT,
                        help="JSON file (default: configs/sequences/flicker.json)")
    parser.add_argument("--bin", required=True, help="folder of the built tools")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the results")
    parser.add_argument("--scenes", nargs="*", help="some of the plan's scenes (default: all)")
    options = parser.parse_args()
    plan = json.loads(options.plan.read_text(encoding="utf-8"))
    results = {}
    for name in options.scenes or plan["scenes"]:
        sequence = Sequence(options.bin, options.output / name, plan["frames"], plan["resolution"])
        make(sequence, plan, plan["scenes"][name])
        results[name] = measure(sequence, plan["variants"])
        draw(sequence, plan["scenes"][name]["row"], plan["variants"], options.output / f"{name}.png")
        print(table(name, results[name]), flush=True)
    (options.output / "flicker.json").write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    print(f"\nFigures: {options.output / 'flicker.json'}")


if __name__ == "__main__":
    try:
        main()
    except StageFailed as error:
        sys.exit(f"flicker: {error}")
