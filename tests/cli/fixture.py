#!/usr/bin/env python3
"""Runs the whole chain once, small, for the cases to start from: scene.json, scene.glb, gbuffer.exr, rsm.exr, pdf.exr, lights.exr,
ism.exr, indirect.exr; a tree of lights, tree.exr; and a scene under an environment map: sky.json, sky-sky.exr,
sky-gbuffer.exr, proxies.json."""

import argparse
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "configs" / "workflow"))
from chain import Chain, StageFailed, table


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the executables")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder to write, emptied before")
    arguments = parser.parse_args()
    shutil.rmtree(arguments.output, ignore_errors=True)
    chain = Chain(arguments.bin, arguments.output)
    try:
        chain.scene_gen("cornell-glossy", "--resolution", "48x32")
        chain.rsm_bake("--rsm-size", "32")
        chain.pdf_build("--gbuffer-lights", "64")
        chain.vsgl_gen("--method", "fis-2016", "--count", "16")
        chain.ismap("--points", "256", "--tile", "16")
        chain.shade()
        chain.run("scene-gen", "sky", "-o", chain.path("sky.json"), outputs=["sky.json", "sky.glb", "sky-sky.exr"])
        chain.run("rsm-bake", chain.path("sky.json"), "--gbuffer", chain.path("sky-gbuffer.exr"), "--resolution", "48x32",
                  outputs=["sky-gbuffer.exr"])
        chain.run("proxy-fit", chain.path("sky.json"), "-o", chain.path("proxies.json"), outputs=["proxies.json"])
        chain.run("vsgl-gen", "--method", "tree", "--rsm", chain.path("rsm.exr"), "-o", chain.path("tree.exr"), outputs=["tree.exr"])
    except StageFailed as failure:
        print(f"FAIL {failure}")
        return 1
    print(table(chain.rows))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
