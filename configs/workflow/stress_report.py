"""The page of a stress run, for the tool `report`."""


def shown(value):
    return None if value is None else float(f"{value:.3g}")


def row_table(group):
    rows = [[row["row"], row["check"], row["cases"], row["failed"], shown(row["worst"]), shown(row["bound"]), row["left_out"]]
            for row in group["rows"]]
    return {"type": "table", "caption": "Ranges, and the case whose error comes nearest to its bound.",
            "columns": ["range", "compared with", "cases", "failed", "worst error", "bound", "pixels left out"], "rows": rows}


def case_table(group):
    rows = [[case["name"], case["check"], shown(case["error"]), shown(case["bound"]), case["wall_s"], case["failure"] or "ok"]
            for case in group["cases"]]
    columns = ["case", "compared with", "error", "bound", "seconds", "verdict"]
    return {"type": "table", "caption": "Every case.", "columns": columns, "rows": rows}


def section(group):
    return {"title": group["title"], "content": [{"type": "text", "text": group["text"]}, row_table(group)],
            "sections": [{"title": "Cases", "content": [case_table(group)]}]}


def page(found):
    """The description of the report."""
    failures = [f"{case['name']}: {case['failure']}" for group in found["groups"] for case in group["cases"] if case["failure"]]
    cases = sum(len(group["cases"]) for group in found["groups"])
    return {"$schema": "vsgltools/report/1", "title": "The tools at their extremes",
            "summary": f"{cases} cases in {found['wall_s']:.0f} s. docs/stability.md says what is compared with what.",
            "failures": failures, "sections": [section(group) for group in found["groups"]]}
