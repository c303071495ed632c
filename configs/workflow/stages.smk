# A rule per tool. plan.json says what each stage reads; the folder's name {key} stands for its options. Included by the
# workflows, which run in their output folder; `--config` gives bin, workflow, threads, jobs, python and device.

import json
import shlex

PLAN = json.load(open("plan.json", encoding="utf-8"))
BIN = config["bin"]
WORKFLOW = config["workflow"]
THREADS = int(config["threads"])
PYTHON = config["python"]
DEVICE = config["device"]


def stage(tool, wildcards):
    return PLAN["stages"][f"{tool}/{wildcards.key}"]


def inputs(tool):
    """The input files of a stage of this tool, by their names in the rule. `after` gives the order only."""
    def found(wildcards):
        files = stage(tool, wildcards)["inputs"]
        return {name: ancient(path) if name == "after" else path for name, path in files.items()}
    return unpack(found)


def arguments(tool):
    return lambda wildcards: stage(tool, wildcards)["arguments"]


def given(flag, name):
    """The flag and its file, where the stage has it."""
    return lambda wildcards, input: f"{flag} {input[name]}" if name in input.keys() else ""


def timing(tool):
    """How often it runs: once more before where its shaders may not be compiled yet, several times where times must be sure."""
    def flags(wildcards):
        found = stage(tool, wildcards)
        return f"--repetitions {found.get('repetitions', 1)}" + (" --warm-up" if found["warm_up"] else "")
    return flags


def patch(wildcards):
    """Changes of a generated scene."""
    changes = stage("scene-gen", wildcards).get("patch")
    if changes is None:
        return ""
    words = [PYTHON, f"{WORKFLOW}/scene_patch.py", json.dumps(changes), f"stages/scene-gen/{wildcards.key}/scene.json"]
    return "&& " + shlex.join(words)


def checkpoint(wildcards):
    """From which long work goes on after an interruption."""
    return f"--checkpoint stages/reference/{wildcards.key}/checkpoint" if stage("reference", wildcards).get("checkpoint") else ""


def outputs(tool, *names):
    return [f"stages/{tool}/{{key}}/{name}" for name in (*names, "report.json")]


def run(tool, accept="0", stages=None):
    """Runs the tool in its folder, which is among those of the tool's name or of another; see stage.py."""
    return (f"{PYTHON} {WORKFLOW}/stage.py --folder stages/{stages or tool}/{{wildcards.key}} --threads {{threads}} "
            f"--jobs {config['jobs']} --device {DEVICE} --accept {accept} {{params.timing}} -- {BIN}/{tool} ")


wildcard_constraints:
    key="[^/]+"


rule scene_gen:
    input: inputs("scene-gen")
    output: outputs("scene-gen", "scene.json")
    params: timing=timing("scene-gen"), arguments=arguments("scene-gen"), patch=patch
    threads: THREADS
    shell: run("scene-gen") + "{params.arguments} -o {output[0]} {params.patch}"


rule rsm_bake:
    input: inputs("rsm-bake")
    output: outputs("rsm-bake", "gbuffer.exr", "rsm.exr")
    params: timing=timing("rsm-bake"), arguments=arguments("rsm-bake")
    threads: THREADS
    shell: run("rsm-bake") + "{input.scene} --config {input.parameters} {params.arguments} --gbuffer {output[0]} --rsm {output[1]}"


rule pdf_build:
    input: inputs("pdf-build")
    output: outputs("pdf-build", "pdf.exr")
    params: timing=timing("pdf-build")
    threads: THREADS
    shell: run("pdf-build") + "--rsm {input.rsm} --gbuffer {input.gbuffer} --config {input.parameters} -o {output[0]}"


rule vsgl_gen:
    input: inputs("vsgl-gen")
    output: outputs("vsgl-gen", "lights.exr")
    params:
        timing=timing("vsgl-gen"), arguments=arguments("vsgl-gen"), rsm=given("--rsm", "rsm"), pdf=given("--pdf", "pdf"),
        spheres=given("--sphere-lights", "scene")
    threads: THREADS
    shell:
        run("vsgl-gen") + "{params.rsm} {params.pdf} {params.spheres} --config {input.parameters} {params.arguments} "
        "-o {output[0]}"


rule ismap:
    input: inputs("ismap")
    output: temp("stages/ismap/{key}/ism.exr"), outputs("ismap")
    params: timing=timing("ismap"), arguments=arguments("ismap"), gbuffer=given("--gbuffer", "gbuffer")
    threads: THREADS
    shell:
        run("ismap") + "{input.scene} --lights {input.lights} {params.gbuffer} --config {input.parameters} {params.arguments} "
        "-o {output[0]}"


rule shade:
    input: inputs("shade")
    output: outputs("shade", "indirect.exr")
    params: timing=timing("shade"), ism=given("--ism", "ism")
    threads: THREADS
    shell:
        run("shade") + "--gbuffer {input.gbuffer} --lights {input.lights} {params.ism} --config {input.parameters} "
        "-o {output[0]}"


rule render:
    input: inputs("render")
    output: outputs("render", "image.exr")
    params: timing=timing("render"), arguments=arguments("render")
    threads: THREADS
    shell: run("render") + "{input.scene} --pipeline {input.parameters} {params.arguments} -o {output[0]}"


rule reference:
    input: inputs("reference")
    output: outputs("reference", "reference.exr")
    params:
        timing=timing("reference"), arguments=arguments("reference"), checkpoint=checkpoint, proxies=given("--proxies", "proxies")
    threads: THREADS
    shell:
        run("reference") + "{input.scene} --gbuffer {input.gbuffer} {params.proxies} --config {input.parameters} "
        "{params.arguments} {params.checkpoint} -o {output[0]}"


rule proxy_fit:
    input: inputs("proxy-fit")
    output: outputs("proxy-fit", "proxies.json")
    params: timing=timing("proxy-fit"), arguments=arguments("proxy-fit")
    threads: THREADS
    shell: run("proxy-fit") + "{input.scene} --config {input.parameters} {params.arguments} -o {output[0]}"


rule proxy_gi:
    input: inputs("proxy-gi")
    output: outputs("proxy-gi", "softgi.exr")
    params:
        timing=timing("proxy-gi"), sky=lambda wildcards, input: input.scene.removesuffix(".json") + "-sky.exr"
    threads: THREADS
    shell:
        run("proxy-gi") + "--gbuffer {input.gbuffer} --proxies {input.proxies} --environment {params.sky} "
        "--config {input.parameters} -o {output[0]}"


rule compare:
    input: inputs("compare")
    output: outputs("compare", "comparison.json")
    params: timing=timing("compare"), arguments=arguments("compare")
    threads: THREADS
    shell: run("compare", "0 1") + "{input.test} {input.reference} {params.arguments} -o {output[0]}"
