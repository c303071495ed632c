#!/usr/bin/env python3
"""Runs small chains and compares their images with the committed ones in tests/golden/reference.

A threshold is a triple: values may differ by `threshold` in at most `fail-percent` of the pixels, and nowhere by more than
`hard-limit`. With --update the references are written anew."""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "configs" / "workflow"))

from chain import Chain, StageFailed  # noqa: E402

REFERENCE = ROOT / "tests" / "golden" / "reference"
CASES = {
    "cornell-vsgl": (["cornell"], ["--light-model", "vsgl"]),
    "cornell-glossy-vsgl": (["cornell-glossy"], ["--light-model", "vsgl"]),
    "cornell-glossy-vsgl-2014": (["cornell-glossy"], ["--light-model", "vsgl-2014"]),
    "cornell-glossy-vpl": (["cornell-glossy"], ["--light-model", "vpl"]),
    "caustic-ring-vsgl": (["caustic-ring"], ["--light-model", "vsgl"]),
    "thin-walls-vsgl": (["thin-walls"], ["--light-model", "vsgl"]),
    "atrium-vsgl": (["atrium", "--triangles", "6000"], ["--light-model", "vsgl"]),
}
THRESHOLDS = ["--threshold", "1e-3", "--fail-percent", "0.5", "--hard-limit", "0.2"]


def render(bin_dir, folder, scene, shade):
    chain = Chain(bin_dir, folder)
    chain.scene_gen(*scene, "--resolution", "64x36")
    chain.rsm_bake("--rsm-size", "64")
    chain.pdf_build("--gbuffer-lights", "256")
    chain.vsgl_gen("--count", "128", "--method", "vpl" if "vpl" in shade else "fis-2016")
    chain.ismap("--points", "2048", "--tile", "32")
    chain.shade(*shade)
    return chain.path("indirect.exr")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--case", choices=list(CASES), help="only this one")
    options = parser.parse_args()
    failed = []
    for name, (scene, shade) in CASES.items():
        if options.case and name != options.case:
            continue
        with tempfile.TemporaryDirectory() as folder:
            image = render(options.bin, folder, scene, shade)
            reference = REFERENCE / f"{name}.exr"
            if options.update:
                REFERENCE.mkdir(exist_ok=True)
                shutil.copyfile(image, reference)
                continue
            done = subprocess.run([str(pathlib.Path(options.bin) / "compare"), image, str(reference), *THRESHOLDS],
                                  capture_output=True, text=True, check=False)
            print(f"{name}: {'same' if done.returncode == 0 else 'DIFFERS'}")
            if done.returncode != 0:
                failed.append(name)
                print(done.stdout + done.stderr)
    if failed:
        sys.exit(f"golden: {', '.join(failed)} differ")


if __name__ == "__main__":
    try:
        main()
    except StageFailed as error:
        sys.exit(f"golden: {error}")
