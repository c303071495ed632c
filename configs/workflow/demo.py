#!/usr/bin/env python3
"""The demo: on three scenes the default chain and the papers', beside path tracing, with every artifact, PNG previews, timings and
errors left in the output folder. What is there already and unchanged is not made again."""

import argparse
import json
import pathlib
import re
import subprocess
import sys

from chain import Chain, StageFailed, table

MODELS = "/usr/share/glmark2/models"
TEXTURES = "/usr/share/glmark2/textures"
RESOLUTION = "640x360"
SAMPLES = "128"  # a pixel, of the reference
PAPERS = "-2016"  # in the names of the papers' files
SCENES = {
    "bunny-cornell": ["cornell", "--mesh", f"{MODELS}/bunny.obj"],
    "caustic-ring": ["caustic-ring"],
    "atrium": ["atrium", "--triangles", "20000", "--texture-dir", TEXTURES],
}


def oiiotool(*arguments):
    return subprocess.run(["oiiotool", "--nosoftwareattrib", *arguments], check=True, capture_output=True, text=True).stdout


def mean_and_deviation(path, layer):
    """Largest channel mean and standard deviation of a layer's R, G, B."""
    stats = oiiotool(path, "--ch", ",".join(f"{layer}.{c}" for c in "RGB"), "--printstats")
    figures = {}
    for name in ("Avg", "StdDev"):
        match = re.search(rf"Stats {name}:\s+(.*?)\s+\(float\)", stats)
        if match is None:
            raise StageFailed(f"oiiotool printed no {name} for {path}:\n{stats}")
        figures[name] = max(float(word) for word in match.group(1).split()[:3])
    return figures["Avg"], figures["StdDev"]


def preview(source, target, channels, scale, gamma=1 / 2.2, offset=0.0, subimage=0):
    """Writes channels of an EXR as PNG: (value * scale + offset)^gamma."""
    oiiotool(source, "--subimage", str(subimage), "--ch", ",".join(channels), "--mulc", repr(scale), "--addc",
             repr(offset), "--clamp:min=0:max=1", "--powc", repr(gamma), "--chnames", "R,G,B", "-d", "uint8", "-o",
             target)


def previews(chain):
    """PNG pictures of the artifacts that a person wants to see first."""
    image = chain.path("indirect.exr")
    mean, deviation = mean_and_deviation(image, "indirect")
    exposure = 0.7 / max(mean + 1.5 * deviation, 1e-12)
    rgb = lambda layer: [f"{layer}.{c}" for c in "RGB"]
    xyz = lambda layer: [f"{layer}.{c}" for c in "XYZ"]
    pictures = ["indirect", f"indirect{PAPERS}", "reference"]
    for name in pictures:
        preview(chain.path(f"{name}.exr"), chain.path(f"{name}.png"), rgb("indirect"), exposure)
    oiiotool(*(chain.path(f"{name}.png") for name in pictures), "--mosaic:pad=4", f"{len(pictures)}x1", "-o",
             chain.path("side-by-side.png"))
    oiiotool(image, "--ch", ",".join(rgb("indirect")), image, "--ch", ",".join(rgb("direct")), "--add", "--mulc",
             repr(exposure / 2), "--clamp:min=0:max=1", "--powc", repr(1 / 2.2), "--chnames", "R,G,B", "-d", "uint8",
             "-o", chain.path("global.png"))
    preview(chain.path("gbuffer.exr"), chain.path("normals.png"), xyz("shading_normal"), 0.5, 1.0, 0.5)
    preview(chain.path("gbuffer.exr"), chain.path("diffuse.png"), rgb("diffuse"), 1.0)
    mean, deviation = mean_and_deviation(chain.path("rsm.exr"), "flux")
    preview(chain.path("rsm.exr"), chain.path("rsm-flux.png"), rgb("power_diffuse"), 0.5 / max(mean + deviation, 1e-30))
    preview(chain.path(f"pdf{PAPERS}.exr"), chain.path("pdf.png"), ["pdf.V"] * 3, 0.2)


def run_scene(bin_dir, folder, scene_arguments, earlier=(), common=()):
    """The default chain."""
    chain = Chain(bin_dir, folder, common, earlier=earlier)
    chain.scene_gen(*scene_arguments, "--resolution", RESOLUTION)
    chain.rsm_bake("--rsm-size", "256")
    chain.vsgl_gen("--method", "tree")
    chain.ismap("--method", "auto")
    chain.shade("--light-model", "fvpl")
    return chain


def run_papers(chain, earlier, common):
    """The chain of 2016 on the scene of another chain: 1024 lights with imperfect shadow maps."""
    papers = Chain(chain.bin, chain.folder, common, PAPERS, earlier)
    papers.rows = [row for row in chain.rows if row["stage"] in ("scene-gen", "rsm-bake")]
    papers.pdf_build("--method", "brsm-vsgl")
    papers.vsgl_gen("--method", "fis-2016", "--count", "1024")
    papers.ismap("--method", "ism")
    papers.shade("--light-model", "vsgl")
    return papers


def figures(chain):
    """relMSE of a chain's image without the worst 0.1% of pixels and with them, and its mean over the reference's."""
    target = chain.path(chain.own("comparison.json"))
    command = [str(chain.bin / "compare"), chain.path(chain.own("indirect.exr")), chain.path("reference.exr"), "--channels", "indirect",
               "-o", target, "--overwrite", "--if-changed", "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):  # 1: the images differ, of course
        raise StageFailed(f"{' '.join(command)}\n{done.stderr}")
    layers = json.loads(pathlib.Path(target).read_text(encoding="utf-8"))["layers"]
    metrics = next(layer["metrics"] for layer in layers if layer["layer"] == "indirect")
    return {name: metrics[name] for name in ("relmse_trimmed", "relmse_rgb", "luminance_bias")}


def read_timings(path):
    """What a former demo left: scene -> chain -> its rows."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, json.JSONDecodeError):
        return {}


def demonstrate(bin_dir, folder, name, earlier):
    """Both chains on one scene; returns what timings.json keeps of them."""
    common = ["--if-changed"]
    rows = lambda chain: earlier.get(chain, {}).get("rows", [])
    default = run_scene(bin_dir, folder, SCENES[name], rows("default"), common)
    papers = run_papers(default, rows("papers"), common)
    truth = Chain(bin_dir, folder, common, earlier=rows("reference"))
    truth.reference("--samples", SAMPLES)
    if default.changed or papers.changed or truth.changed:
        previews(default)
    result = {"default": {"rows": default.rows, "error": figures(default)}, "papers": {"rows": papers.rows, "error": figures(papers)},
              "reference": {"rows": truth.rows}}
    for title, chain in (("default: light tree, cut, rays", "default"), ("2016: 1024 VSGLs, shadow maps", "papers")):
        error = result[chain]["error"]
        print(f"\n{name}, {title}\n{table(result[chain]['rows'])}\nrelMSE {error['relmse_trimmed']:.2g} "
              f"({error['relmse_rgb']:.2g} with the worst 0.1% of pixels), mean over the reference's {error['luminance_bias']:.3f}")
    print(f"{name}: {folder}/side-by-side.png (default, 2016, reference with {SAMPLES} samples a pixel in {truth.rows[0]['wall_s']:.1f} s)")
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, help="folder of the built tools")
    parser.add_argument("--output", required=True, help="folder for the results")
    parser.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    options = parser.parse_args()
    target = pathlib.Path(options.output) / "timings.json"
    earlier = read_timings(target)
    timings = {name: demonstrate(options.bin, pathlib.Path(options.output) / name, name, earlier.get(name, {})) for name in options.scenes}
    target.write_text(json.dumps({**earlier, **timings}, indent=2) + "\n", encoding="utf-8")
    print(f"\nTimings and errors: {target}")


if __name__ == "__main__":
    try:
        main()
    except StageFailed as error:
        sys.exit(f"demo: {error}")
