"""From configs/stress/*.json to the cases of a stress run: variables filled in, each case complete. docs/stability.md describes
the files."""

import itertools
import pathlib

from plan import ExperimentError, judge, read_json
from scene_patch import merged

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = ROOT / "stress"
SCHEMA = ROOT / "schema" / "stress.schema.json"
COMMON = "common.json"  # scenes and chains that the groups name


def fill(value, variables):
    """A copy with {names} in strings replaced by variables; a string that is one name only becomes the variable itself."""
    if isinstance(value, dict):
        return {key: fill(inner, variables) for key, inner in value.items()}
    if isinstance(value, list):
        return [fill(inner, variables) for inner in value]
    if not isinstance(value, str):
        return value
    for name, variable in variables.items():
        if value == "{" + name + "}":
            return variable
        value = value.replace("{" + name + "}", str(variable))
    return value


class Suite:
    """All groups of a folder. `methods_of`: tool -> names of its methods, for variables that run over a registry."""

    def __init__(self, folder, methods_of):
        self.methods_of = methods_of
        self.common = self._read(folder / COMMON)
        self.groups = {path.stem: self._read(path) for path in sorted(folder.glob("*.json")) if path.name != COMMON}

    @staticmethod
    def _read(path):
        value = read_json(path)
        judge(value, SCHEMA, path)
        return value

    def cases(self, group, quick=False):
        """The group's cases, each a dictionary without variables; with `quick` those marked so, the first of each row."""
        found = []
        for template in self.groups[group]["cases"]:
            if quick and "quick" not in template:
                continue
            vary = {**template.get("vary", {}), **(template["quick"] if quick else {})}
            for variables in self._combinations(vary):
                own = {key: part for key, part in template.items() if key not in ("vary", "quick", "run", "base")}
                case = fill(own, variables)
                case |= {"name": self._name(case, variables), "run": self._run(template["run"], variables)}
                if "base" in template:
                    case["base"] = self._run({**template["run"], **template["base"]}, variables)
                found.append(case)
        return found

    @staticmethod
    def _name(case, variables):
        return ", ".join([case["row"], *(f"{key} {value}" for key, value in variables.items())])

    def _combinations(self, vary):
        """Each a dictionary; a value {"methods_of": tool} runs over the tool's registry."""
        lists = []
        for values in vary.values():
            if isinstance(values, dict):
                values = [name for name in self.methods_of(values["methods_of"]) if name not in values.get("except", [])]
            lists.append(values)
        return [dict(zip(vary, values)) for values in itertools.product(*lists)]

    def _run(self, run, variables):
        """The run with its scene and chain looked up by their names; what it sets counts more than what varies."""
        variables = {**self.common["variables"], **variables}
        variables |= fill(run.get("set", {}), variables)
        run = fill({key: part for key, part in run.items() if key != "set"}, variables)
        for key in ("scene", "chain"):
            run[key] = fill(self._whole(f"{key}s", run[key]), variables)
        return run

    def _whole(self, kind, part):
        """A scene or chain by its name, or one that changes another, the one that it is `like`."""
        if isinstance(part, str):
            return self._whole(kind, self._named(kind, part))
        if "like" not in part:
            return part
        return merged(self._whole(kind, part["like"]), {key: value for key, value in part.items() if key != "like"})

    def _named(self, kind, name):
        if name not in self.common[kind]:
            raise ExperimentError(f"{FOLDER / COMMON}: /{kind} has no \"{name}\"; it has {', '.join(self.common[kind])}")
        return self.common[kind][name]
