"""The page of a stress run, for the tool `report`."""

COMPARED = {
    "same": "image that should be the same",
    "twin": "sum in double precision",
    "power": "texels' power",
    "flux": "closed form of the flux",
    "moments": "moments of all texels",
    "black": "exactly 0",
    "error": "documented error",
    "sound": "finite, not negative",
}


def shown(value):
    return None if value is None else float(f"{value:.3g}")


def overview(groups):
    rows = [[group["title"], len(group["rows"]), len(group["cases"]), sum(row["failed"] for row in group["rows"]),
             shown(sum(case["wall_s"] for case in group["cases"]))] for group in groups]
    return {"type": "table", "columns": ["group", "ranges", "cases", "failed", "seconds"], "rows": rows}


def row_table(group):
    rows = [[row["row"], COMPARED[row["check"]], row["cases"], row["failed"], shown(row["worst"]), shown(row["bound"]),
             row["left_out"]] for row in group["rows"]]
    return {"type": "table", "caption": "Of each range the error that comes nearest to its bound.",
            "columns": ["range", "compared with", "cases", "failed", "worst error", "bound", "pixels left out"], "rows": rows}


def case_table(row, cases):
    """Of one range; a case is called by what varies."""
    rows = [[case["name"].removeprefix(row["row"]).removeprefix(", ") or "one case", shown(case["error"]), shown(case["bound"]),
             case["wall_s"], "failed" if case["failure"] else "ok"] for case in cases]
    return {"type": "table", "caption": row["row"], "columns": ["case", "error", "bound", "seconds", "verdict"], "rows": rows}


def ranges(group):
    return {"title": group["title"], "content": [{"type": "text", "text": group["text"]}, row_table(group)]}


def every_case(group):
    return {"title": f"{group['title']}: cases", "content": [
        case_table(row, [case for case in group["cases"] if case["row"] == row["row"]]) for row in group["rows"]]}


def page(found):
    """The description of the report."""
    groups = found["groups"]
    failures = [f"{case['name']}: {case['failure']}" for group in groups for case in group["cases"] if case["failure"]]
    cases = sum(len(group["cases"]) for group in groups)
    return {"$schema": "vsgltools/report/1", "title": "The tools at their extremes",
            "summary": f"{cases} cases in {found['wall_s']:.0f} s. docs/stability.md says what is compared with what.",
            "failures": failures,
            "sections": [{"title": "Overview", "content": [overview(groups)]}, *map(ranges, groups),
                         {"title": "Every case", "sections": list(map(every_case, groups))}]}
