#!/usr/bin/env python3
"""Every glTF, OBJ and PLY file of Debian's assimp-testmodels, many of them malformed on purpose, either renders or ends in one
numbered error; none crashes."""

import argparse
import concurrent.futures
import json
import os
import pathlib
import tempfile

from blackbox import ERROR_LINE, require, run, run_checks

# Malformed on purpose: these must be refused.
REFUSED = ["glTF2/IndexOutOfRange/IndexOutOfRange.gltf", "glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf",
           "glTF2/MissingBin/BoxTextured.gltf", "glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
           "glTF2/RecursiveNodes/RecursiveNodes.gltf", "glTF2/SchemaFailures/sceneWrongType.gltf"]
# Sound: these must render.
RENDERED = ["glTF2/BoxTextured-glTF/BoxTextured.gltf", "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
            "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", "OBJ/box.obj", "OBJ/WusonOBJ.obj", "PLY/cube.ply"]


def bake(tool, model):
    """The result of rendering 8x8 pixels of the model."""
    scene = {"$schema": "vsgltools/scene/1", "meshes": [{"file": str(model)}], "resolution": [8, 8],
             "camera": {"position": [3, 2, 4], "target": [0, 0, 0], "vertical_fov_deg": 45},
             "lights": [{"type": "point", "position": [3, 4, 5], "radiant_intensity_w_sr": [1, 1, 1]}]}
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "scene.json"
        path.write_text(json.dumps(scene))
        return run([tool, path, "--gbuffer", pathlib.Path(folder) / "gbuffer.exr", "--threads", "1"])


def check(tool, root, model):
    name = str(model.relative_to(root))
    result = bake(tool, model)
    if result.status == 0:
        require(name not in REFUSED, f"{result}: expected a refusal")
        return
    result.expect_error(3, r"E3\d{3}: ")
    require(name not in RENDERED, f"{result}: expected a picture")
    message = ERROR_LINE.search(result.err)["message"]
    require(len(message) > 20, f"{result}: the message says nothing")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tool", type=pathlib.Path, help="path of rsm-bake")
    parser.add_argument("--models", type=pathlib.Path, default=pathlib.Path("/usr/share/assimp/models"))
    arguments = parser.parse_args()
    models = sorted(path for path in arguments.models.rglob("*") if path.suffix.lower() in {".gltf", ".glb", ".obj", ".ply"})
    absent = [name for name in REFUSED + RENDERED if arguments.models / name not in models]
    if absent:
        print(f"FAIL {arguments.models} lacks {absent}")
        return 1
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pending = {model: pool.submit(check, arguments.tool.resolve(), arguments.models, model) for model in models}
        return run_checks([(str(model.relative_to(arguments.models)), pending[model].result) for model in models])


if __name__ == "__main__":
    raise SystemExit(main())
