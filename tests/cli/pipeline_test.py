"""The whole chain from scene to image with the real tools: byte-identical artifacts in every run, on any number of threads, and JSON that
its schemas describe.

Usage: pipeline_test.py --bin FOLDER_OF_THE_TOOLS
"""

import argparse
import hashlib
import json
import pathlib
import sys
import tempfile

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "configs" / "workflow"))

from blackbox import require, run, run_checks  # noqa: E402
from chain import Chain  # noqa: E402

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "configs" / "schema"
ARTIFACTS = ["scene.json", "scene.glb", "gbuffer.exr", "rsm.exr", "pdf.exr", "lights.exr", "lights.json", "ism.exr",
             "indirect.exr", "tree.exr", "tree.json"]


def run_chain(bin_dir, folder, *common):
    """All stages at a tiny resolution; returns the SHA-256 of each artifact, and checks the tools' results against their schema."""
    chain = Chain(bin_dir, folder, common)
    chain.scene_gen("cornell-glossy", "--resolution", "32x24")
    chain.rsm_bake("--rsm-size", "32")
    chain.pdf_build("--gbuffer-lights", "64")
    chain.vsgl_gen("--method", "fis-2016", "--count", "48")
    chain.ismap("--points", "1024", "--tile", "16")
    chain.shade()
    chain.run("vsgl-gen", "--rsm", chain.path("rsm.exr"), "-o", chain.path("tree.exr"), "--info", chain.path("tree.json"),
              "--dump", outputs=["tree.exr", "tree.json"])
    for row in chain.rows:
        require_valid(row["result"], "result.schema.json", row["stage"])
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in ARTIFACTS}


def require_valid(instance, schema, what):
    try:
        jsonschema.validate(instance, json.loads((SCHEMAS / schema).read_text(encoding="utf-8")))
    except jsonschema.ValidationError as error:
        require(False, f"{what}: {schema}: {error.json_path}: {error.message}")


def require_same(one, other, what):
    different = [name for name in ARTIFACTS if one[name] != other[name]]
    require(not different, f"{what}: {', '.join(different)} differ")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    bin_dir = parser.parse_args().bin
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        first = run_chain(bin_dir, folder / "first", "--threads", "1")

        def compare(*arguments):
            return run([bin_dir / "compare", *arguments])

        def same_again():
            require_same(first, run_chain(bin_dir, folder / "again", "--threads", "1"), "a second run")

        def same_on_two_threads():
            require_same(first, run_chain(bin_dir, folder / "threads", "--threads", "2"), "two threads")

        def another_seed_differs():
            seeded = run_chain(bin_dir, folder / "seeded", "--threads", "1", "--seed", "7")
            for name in ("lights.exr", "ism.exr", "indirect.exr"):
                require(first[name] != seeded[name], f"{name}: --seed 7 changes nothing")
            result = compare(folder / "first" / "indirect.exr", folder / "seeded" / "indirect.exr")
            require(result.status == 1, f"{result}: expected status 1 for images that differ")

        def files_match_their_schemas():
            for name, kind in (("scene.json", "scene"), ("lights.json", "lights"), ("tree.json", "lights")):
                require_valid(json.loads((folder / "first" / name).read_text(encoding="utf-8")), f"{kind}.schema.json", name)

        def compare_agrees():
            compare(folder / "first" / "indirect.exr", folder / "again" / "indirect.exr").expect_success()

        return run_checks([("the same bytes in a second run", same_again),
                           ("the same bytes on two threads", same_on_two_threads),
                           ("scene and lights JSON match their schemas", files_match_their_schemas),
                           ("compare finds no difference between the runs", compare_agrees),
                           ("another seed gives another image", another_seed_differs)])


if __name__ == "__main__":
    sys.exit(main())
