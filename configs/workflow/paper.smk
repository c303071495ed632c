# The workflow of `make paper`: the rules of stages.smk, sequences of frames, and a page of all figures. paper.py writes
# plan.json, figures.json and figures/<figure>/figure.json.

include: "stages.smk"


wildcard_constraints:
    figure="[a-z0-9-]+"


localrules: paper, sequence, figure, paper_report


rule paper:
    input: "report.html"
    default_target: True


rule frames:
    input: inputs("frames")
    output: directory("stages/frames/{key}/frames"), "stages/frames/{key}/report.json"
    params: timing=timing("frames"), arguments=arguments("frames")
    threads: THREADS
    shell:
        "mkdir -p {output[0]} && " + run("render", stages="frames") + "{input.scene} --pipeline {input.parameters} "
        "{params.arguments} -o {output[0]}/%04d.exr"


rule sequence:
    input: inputs("sequence")
    output: directory("stages/sequence/{key}/frames")
    run:
        os.makedirs(output[0], exist_ok=True)
        for number, frame in enumerate(input.frames):
            os.symlink(os.path.relpath(frame, output[0]), f"{output[0]}/{number:04d}.exr")


rule flicker:
    input: inputs("flicker")
    output: outputs("flicker", "comparison.json")
    params: timing=timing("flicker"), arguments=arguments("flicker")
    threads: THREADS
    shell: run("compare", "0 1", "flicker") + "{input.test}/%04d.exr {input.reference}/%04d.exr {params.arguments} -o {output[0]}"


rule figure:
    input:
        lambda wildcards: PLAN["figures"][wildcards.figure],
        "figures/{figure}/figure.json",
        [f"{WORKFLOW}/{name}.py" for name in ("paper_figure", "paper_measures", "paper_operators", "paper_pictures", "paper_values", "exr")],
    output: "figures/{figure}/section.json", "figures/{figure}/values.json"
    shell: "{PYTHON} {WORKFLOW}/paper_figure.py {wildcards.figure}"


rule paper_report:
    input:
        "figures.json",
        "tools/report.sha256",
        f"{WORKFLOW}/paper_report.py",
        [f"figures/{name}/section.json" for name in PLAN["figures"]],
    output: "report.html", "report-spec.json", "results.json", "claims.csv"
    shell: "{PYTHON} {WORKFLOW}/paper_report.py && {BIN}/report report-spec.json --overwrite --quiet -o report.html"
