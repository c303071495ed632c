#!/usr/bin/env python3
"""The demo: the chain on three scenes, with every artifact, PNG previews and timings left in the output folder."""

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
    preview(image, chain.path("indirect.png"), rgb("indirect"), exposure)
    oiiotool(image, "--ch", ",".join(rgb("indirect")), image, "--ch", ",".join(rgb("direct")), "--add", "--mulc",
             repr(exposure / 2), "--clamp:min=0:max=1", "--powc", repr(1 / 2.2), "--chnames", "R,G,B", "-d", "uint8",
             "-o", chain.path("global.png"))
    preview(chain.path("gbuffer.exr"), chain.path("normals.png"), xyz("shading_normal"), 0.5, 1.0, 0.5)
    preview(chain.path("gbuffer.exr"), chain.path("diffuse.png"), rgb("diffuse"), 1.0)
    mean, deviation = mean_and_deviation(chain.path("rsm.exr"), "flux")
    preview(chain.path("rsm.exr"), chain.path("rsm-flux.png"), rgb("power_diffuse"), 0.5 / max(mean + deviation, 1e-30))
    preview(chain.path("pdf.exr"), chain.path("pdf.png"), ["pdf.V"] * 3, 0.2)


def run_scene(bin_dir, folder, scene_arguments):
    chain = Chain(bin_dir, folder)
    chain.scene_gen(*scene_arguments, "--resolution", RESOLUTION)
    chain.rsm_bake("--rsm-size", "256")
    chain.pdf_build()
    chain.vsgl_gen("--count", "1024")
    chain.ismap()
    chain.shade()
    return chain


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, help="folder of the built tools")
    parser.add_argument("--output", required=True, help="folder for the results")
    parser.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    options = parser.parse_args()
    timings = {}
    for name in options.scenes:
        chain = run_scene(options.bin, pathlib.Path(options.output) / name, SCENES[name])
        previews(chain)
        timings[name] = chain.rows
        print(f"\n{name}: {chain.folder}/\n{table(chain.rows)}")
    target = pathlib.Path(options.output) / "timings.json"
    target.write_text(json.dumps(timings, indent=2) + "\n", encoding="utf-8")
    print(f"\nTimings: {target}")


if __name__ == "__main__":
    try:
        main()
    except StageFailed as error:
        sys.exit(f"demo: {error}")
