"""Pictures of the papers' figures: rows of panels, each an image, an error map, a density with kernels, lights, or curves, drawn
with matplotlib; and animations of sequences. The same data give the same bytes."""

import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
from matplotlib.patches import Circle, Rectangle  # noqa: E402
from PIL import Image  # noqa: E402

import exr  # noqa: E402
import kernels  # noqa: E402
import paper_operators  # noqa: E402
from paper_measures import read_json  # noqa: E402
from paper_values import fill  # noqa: E402
from plots import COLOURS, MARKERS, STYLE  # noqa: E402

INCH = 4.8  # width of a panel
DPI = 110


def srgb(linear):
    """The transfer function of IEC 61966-2-1, of values clipped to 0..1."""
    clipped = numpy.clip(linear, 0, 1)
    return numpy.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)


def exposure(image):
    """The factor that brings the 95th percentile of the positive luminances to 0.8; 1 where there is none."""
    values = image @ exr.LUMINANCE
    values = values[values > 0]
    return 0.8 / float(numpy.quantile(values, 0.95)) if len(values) else 1.0


def cropped(image, crop):
    """The part [left, top, right, bottom] of an image, as fractions."""
    if crop is None:
        return image
    height, width = image.shape[:2]
    left, top, right, bottom = crop
    return image[round(top * height):round(bottom * height), round(left * width):round(right * width)]


def relative_error(image, truth):
    """|Ya - Yb| / (|Yb| + mean|Yb| / 100), as in compare --false-color."""
    a, b = image @ exr.LUMINANCE, truth @ exr.LUMINANCE
    return numpy.abs(a - b) / (numpy.abs(b) + numpy.abs(b).mean() / 100)


class Drawing:
    """One row of panels."""

    def __init__(self, data, row):
        self.data, self.row = data, row
        self.scale = None

    def colour(self, panel, path):
        """Tone-mapped by the exposure of the row's first image, and the row's own stops."""
        layer = panel.get("layer", "indirect")
        image = sum(exr.colour(path, part) for part in layer.split("+"))
        if self.scale is None:
            self.scale = exposure(image) * 2 ** self.row.get("stops", 0)
        return cropped(srgb(self.scale * image), panel.get("crop", self.row.get("crop")))

    def image(self, axes, panel):
        row = self.data.select(panel["image"])[0]
        show(axes, self.colour(panel, row["image"]))

    def reference(self, axes, panel):
        row = self.data.select(panel["reference"])[0]
        show(axes, self.colour(panel, row["reference"]))

    def error(self, axes, panel):
        row = self.data.select(panel["error"])[0]
        error = relative_error(exr.colour(row["image"]), exr.colour(row["reference"]))
        shown = cropped(error, panel.get("crop", self.row.get("crop")))
        axes.imshow(numpy.log10(numpy.clip(shown, 1e-3, 1)), cmap="inferno", vmin=-3, vmax=0, interpolation="nearest")

    def channel(self, axes, panel):
        """From 0 to the 99th percentile of the row's image that has most of it."""
        values = [self.values(other) for other in self.row["panels"] if "channel" in other]
        top = max(float(numpy.quantile(image, 0.99)) for image in values)
        axes.imshow(self.values(panel), cmap="viridis", vmin=0, vmax=top or 1, interpolation="nearest")

    def values(self, panel):
        image = exr.channels(self.data.select(panel["of"])[0]["image"], panel["channel"])
        return cropped(image, panel.get("crop", self.row.get("crop")))

    def density(self, axes, panel):
        """Brightness by its square root: kernels' sizes follow that."""
        row = self.data.select(panel["density"])[0]
        draw_density(axes, kernels.density(row["stages"]["pdf-build"]), panel.get("crop"))

    def kernels(self, axes, panel):
        row = self.data.select(panel["kernels"])[0]
        density = kernels.density(row["stages"]["pdf-build"])
        draw_density(axes, density, panel.get("crop"))
        for x, y, half, layer in kernels.squares(f"{row['stages']['vsgl-gen']}/lights.exr", len(density)):
            if layer == 0:
                corner = (x - half - 0.5, y - half - 0.5)
                axes.add_patch(Rectangle(corner, 2 * half, 2 * half, fill=False, edgecolor="#ff9a2e", linewidth=0.6))
                axes.plot(x - 0.5, y - 0.5, ".", color="#ff2020", markersize=1.6)

    def lights(self, axes, panel):
        """Disks of the radius of each light's footprint, in the light source's own view, by their radiance."""
        row = self.data.select(panel["lights"])[0]
        draw_lights(axes, row["stages"])

    def operators(self, axes, panel):
        """Of a lit sphere's radiance, against the sine of its half angle."""
        with plt.rc_context(STYLE):
            for i, (label, values) in enumerate(paper_operators.curves(panel["operators"]).items()):
                axes.plot(paper_operators.SINES, values, label=label, color=COLOURS[i], linestyle="--" if "fit" in label else "-")
        axes.set_xlabel("sin(half angle)")
        finish(axes, panel)

    def curves(self, axes, panel):
        """A metric against the number of lights, a curve a variant."""
        with plt.rc_context(STYLE):
            for i, (label, where) in enumerate(panel["curves"].items()):
                rows = self.data.select(where)
                points = sorted({row["n"]: self.data.one(panel["y"] | {"of": where | {"n": row["n"]}}) for row in rows}.items())
                axes.plot(*zip(*points), label=label, color=COLOURS[i], marker=MARKERS[i], markersize=4)
        axes.set_xscale("log", base=2)
        axes.set_xlabel("lights")
        finish(axes, panel)

    def bars(self, axes, panel):
        """Measured figures beside one another."""
        heights = [self.data.values[name] for name in panel["bars"].values()]
        axes.bar(list(panel["bars"]), heights, color=COLOURS[:len(heights)])
        finish(axes, panel)

    def steps(self, axes, panel):
        """The flicker of each step of sequences."""
        for i, (label, name) in enumerate(panel["steps"].items()):
            steps = read_json(self.data.sequence(name)["comparison"])["step_rms"]
            axes.plot(range(1, len(steps) + 1), steps, label=label, color=COLOURS[i])
        axes.set_xlabel("frame")
        axes.set_ylabel("rms of the change of the error, over the mean")
        finish(axes, panel)

    def frame(self, axes, panel):
        """A frame of a sequence, or of its reference."""
        sequence = self.data.sequence(panel["frame"])
        show(axes, self.colour(panel, frame_path(sequence, panel.get("number", 0), panel.get("truth", False))))


def finish(axes, panel):
    axes.set_yscale(panel.get("scale", "linear"))
    if "label" in panel:
        axes.set_ylabel(panel["label"])
    if axes.get_legend_handles_labels()[1]:
        axes.legend(frameon=False)
    axes.grid(True, which="both", linewidth=0.4, color="#d8d8d8")
    axes.set_axisbelow(True)


PLOTS = ("curves", "bars", "steps", "operators")
PANELS = ("image", "reference", "error", "channel", "density", "kernels", "lights", "frame", *PLOTS)


def show(axes, image):
    axes.imshow(image, interpolation="nearest")


def draw_density(axes, density, crop):
    shown = numpy.sqrt(density / max(float(numpy.quantile(density, 0.995)), 1e-30))
    axes.imshow(numpy.clip(shown, 0, 1), cmap="gray", interpolation="nearest")
    left, top, right, bottom = (len(density) * edge - 0.5 for edge in crop or (0, 0, 1, 1))
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)


def draw_lights(axes, stages):
    """Each light where the light source sees it: a circle of radius sqrt(2) sigma [Tokuyoshi 2014], bright by power over area;
    of one texel's radius where it is smaller."""
    found, _ = exr.read(f"{stages['vsgl-gen']}/lights.exr")
    rsm, source = exr.read(f"{stages['rsm-bake']}/rsm.exr")
    size = len(rsm["weight.V"])
    relative = numpy.stack([found[f"position.{c}"].ravel() for c in "XYZ"], axis=-1) - source["light.position"]
    depth = relative @ source["light.forward"]
    power = kernels.luminous_powers(found).ravel()
    kept = (power > 0) & (depth > 0)
    x, y = (relative[kept] @ source[f"light.{axis}"] / (depth[kept] * source[f"light.extent_{c}"])
            for axis, c in (("right", "x"), ("up", "y")))
    radius = numpy.sqrt(2 * found["variance.V"].ravel()[kept])
    pixels = numpy.maximum(radius / (depth[kept] * source["light.extent_x"]) * size / 2, 0.75)
    brightness = power[kept] / pixels**2
    brightness = 0.1 + 0.9 * srgb(brightness / numpy.quantile(brightness, 0.9))
    axes.set_facecolor("black")
    axes.set_xlim(0, size)
    axes.set_ylim(size, 0)
    axes.set_aspect("equal")
    for i in numpy.argsort(-pixels):
        centre = ((x[i] + 1) * size / 2, (1 - y[i]) * size / 2)
        axes.add_patch(Circle(centre, pixels[i], edgecolor=str(brightness[i]), fill=False, linewidth=1.2))


def frame_path(sequence, number, truth):
    return f"{sequence['reference' if truth else 'images']}/{number:04d}.exr"


def panel_kind(panel):
    return next(kind for kind in PANELS if kind in panel)


def place(figure, grid, line, panels, columns):
    """The axes of a row of panels. Plots at its end share what is left of the row."""
    plots = sum(panel_kind(panel) in PLOTS for panel in panels)
    share = (columns - len(panels)) // plots if plots else 0
    edges, column = [], 0
    for panel in panels:
        width = 1 + (share if panel_kind(panel) in PLOTS else 0)
        edges.append((column, column + width))
        column += width
    return [figure.add_subplot(grid[line, first:last]) for first, last in edges]


def draw(picture, data, target):
    """Writes target, a PNG of the picture's rows."""
    rows = picture["rows"]
    columns = max(len(row["panels"]) for row in rows)
    aspect = picture.get("aspect", 9 / 16)
    size = 3 * max(columns, 3)  # of text, in points: what fills a page's width stays legible
    with plt.rc_context({"font.size": size, "axes.titlesize": size, "legend.fontsize": size}):
        figure = plt.figure(layout="constrained", figsize=(INCH * columns, (INCH * aspect + 0.03 * size) * len(rows)))
        grid = figure.add_gridspec(len(rows), columns)
        for line, row in enumerate(rows):
            drawing = Drawing(data, row)
            places = place(figure, grid, line, row["panels"], columns)
            for axes, panel in zip(places, row["panels"]):
                kind = panel_kind(panel)
                getattr(drawing, kind)(axes, panel)
                axes.set_title(fill(panel["title"], data.values), loc="left")
                if kind not in PLOTS:
                    axes.set_xticks([])
                    axes.set_yticks([])
            if "label" in row:
                places[0].annotate(row["label"], (0, 0.5), xytext=(-14, 0), xycoords="axes fraction", textcoords="offset points",
                                   rotation=90, ha="right", va="center", fontweight="bold")
        figure.savefig(target, dpi=DPI, metadata={"Software": None})
        plt.close(figure)


def animate(animation, data, target):
    """Writes target, an animated PNG: sequences side by side, each under its title."""
    panels = animation["panels"]
    frames, scale = [], None
    number = min(data.sequence(panel["frame"])["frames"] for panel in panels)
    for t in range(number):
        paths = [frame_path(data.sequence(panel["frame"]), t, panel.get("truth", False)) for panel in panels]
        images = [exr.colour(path) for path in paths]
        scale = scale or exposure(images[0])
        titles = [fill(panel["title"], data.values) for panel in panels]
        frames.append(framed([srgb(scale * image) for image in images], titles))
    frames += frames[-2:0:-1]
    frames[0].save(target, save_all=True, append_images=frames[1:], duration=1000 // animation.get("rate", 15), loop=0)


def framed(images, titles):
    """Images in a row, each under its title, as a PIL image."""
    height, width = images[0].shape[:2]
    with plt.rc_context({"font.size": 9}):
        size = (width * len(images) / DPI + 0.1, height / DPI + 0.35)
        figure, grid = plt.subplots(1, len(images), squeeze=False, layout="constrained", figsize=size)
        for axes, image, title in zip(grid[0], images, titles):
            axes.imshow(image, interpolation="nearest")
            axes.set_title(title, loc="left", fontsize=9)
            axes.set_xticks([])
            axes.set_yticks([])
        file = io.BytesIO()
        figure.savefig(file, dpi=DPI)
        plt.close(figure)
    return Image.open(file).convert("RGB").quantize(128)
