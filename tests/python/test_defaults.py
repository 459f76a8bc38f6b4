"""Every key and every default on the pages of scenarios and searches is that of the program.

Needs `pytest` from PyPI, and cargo. The schema's defaults are made by the functions that fill in what a file leaves out, so
that a default that changes in the code no longer agrees with its page.
"""

import json
import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# Defaults that the page gives in words: the schema has none, and the code works them out.
IN_WORDS = {
    "1/20 of the run",
    "1/200 of the run",
    "1/40 of the run",
    "1e-4 radii",
    "2(1-ν)/(2-ν)",
    "all pairs",
    "all",
    "as always",
    "as static",
    "at rest",
    "follows the grains",
    "never",
    "the group's",
    "the law's",
    "the origin",
    "worked out",
}
UNITS = {
    "": 1.0,
    "nm": 1e-9,
    "um": 1e-6,
    "mm": 1e-3,
    "ns": 1e-9,
    "us": 1e-6,
    "ms": 1e-3,
    "mPa s": 1e-3,
}
# Keys without which a material behaves as with this figure, which stands where the law asks for it and not in the schema.
WORKED_OUT = {"materials.NAME.activation_energy": "0 J/mol", "materials.NAME.emissivity": "0"}
NOTHING = object()


def number(text):
    """The SI value of a number or quantity as the page or the program writes it; nothing if it is none."""
    found = re.fullmatch(r"(-?[\d.,]+(?:e[+-]?\d+)?)(?: (.+))?", str(text))
    if not found:
        return None
    return float(found[1].replace(",", "")) * UNITS.get(found[2] or "", 1.0)


class Schema:
    """A JSON schema, walked by the paths of keys."""

    def __init__(self, root):
        self.root = root

    def plain(self, node):
        while "$ref" in node:
            node = self.root["$defs"][node["$ref"].removeprefix("#/$defs/")]
        return node

    def keys(self, node):
        """Keys below a node: what is there, whether it must be given, and its default."""
        node, found = self.plain(node), {}
        for name, below in node.get("properties", {}).items():
            is_required = name in node.get("required", [])
            found[name] = (below, is_required, below.get("default", NOTHING))
        if isinstance(node.get("additionalProperties"), dict):
            found["NAME"] = (node["additionalProperties"], False, NOTHING)
        if isinstance(node.get("items"), dict):
            found["0"] = (node["items"], False, NOTHING)
        for choice in node.get("oneOf", []) + node.get("anyOf", []):
            for name, below in self.keys(choice).items():
                found.setdefault(name, below)
        return found

    def find(self, path):
        node, found = self.root, None
        for name in path.split("."):
            known = self.keys(node)
            assert name in known, f"{path}: there is no key {name}; there are {', '.join(known)}"
            found = known[name]
            node = found[0]
        return found

    def names(self):
        """Names of all keys anywhere."""
        nodes = [self.root, *self.root["$defs"].values()]
        return {name for node in nodes for name in self.keys(node)} - {"NAME", "0"}


@pytest.fixture(scope="module")
def agglo(built):
    def call(*arguments, **more):
        return subprocess.run([built / "agglo", *arguments], check=True, capture_output=True, text=True, **more)

    return call


@pytest.fixture(scope="module")
def schema(agglo):
    return Schema(json.loads(agglo("schema").stdout))


@pytest.fixture(scope="module")
def search_schema(agglo):
    return Schema(json.loads(agglo("schema", "--search").stdout))


def tables(page):
    """The tables of a page: heading above, names of the columns, rows."""
    heading, lines = "", (ROOT / "docs" / page).read_text().splitlines() + [""]
    head, rows = None, []
    for line in lines:
        if line.startswith("|"):
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if head is None:
                head = cells
            elif not set(line) <= set("|-"):
                rows.append(cells)
            continue
        if head is not None:
            yield heading, head, rows
        head, rows = None, []
        if line.startswith("#"):
            heading = line.lstrip("# ")


def words(cell):
    return re.findall(r"`([^`]+)`", cell)


def where(heading):
    """The path that a heading is about."""
    found = re.findall(r"`\[*([\w.]+)\]*`", heading)
    return found[0].split(".*")[0] if found else ""


def documented(page):
    """Paths of keys on a page with the defaults that it gives."""
    for heading, head, rows in tables(page):
        if "default" not in head:
            continue
        at = head.index("default")
        of = words(head[0]) if head[0].startswith("key of") else []
        base = where(heading)
        if heading == "Top level":
            base = ""
        elif head[0] == "key of a beam":
            base = "acoustics.beams.0"
        elif base.startswith(("engine.", "bonds.")):
            base = f"{base.split('.')[0]}.{of[0]}"
        elif of:
            base = f"{base}.{of[0]}"
        elif heading == "`[[grains]]`":
            base = "grains.0"
        elif heading == "`[[mixtures]]`":
            base = "mixtures.0"
        table = base
        for row in rows:
            if head[0] == "table":
                named = words(row[0])
                if named:
                    name = named[0].strip("[]")
                    table = f"impact.restitution.hardness.{name}" if name == "solver.fixed_point" else name
                keys = words(row[1])
            else:
                keys = words(row[0])
            for key in keys:
                if "." in key and "[" in key or key.strip("[]") != key:
                    continue
                path = f"{table}.{key}" if table else key
                yield path.replace("start.from.from", "start.from"), row[at]


def agrees(text, is_required, default):
    """Whether a default in words or figures is what the schema has."""
    if text == "-":
        return is_required
    if is_required:
        return False
    if text in IN_WORDS or text.split(":")[0] == "none":
        return default in (NOTHING, None, [])
    if text in ("true", "false"):
        return default is (text == "true")
    if text.startswith("`"):
        return default == text.strip('`"')
    wanted, found = number(text), default if isinstance(default, list) else [default]
    return wanted is not None and all(number(value) == pytest.approx(wanted, rel=1e-12) for value in found)


def test_defaults_of_scenarios(schema):
    all_keys = list(documented("scenario.md"))
    wrong = []
    for path, text in all_keys:
        if "." not in path:
            # Whole tables have their keys elsewhere.
            continue
        _, is_required, default = schema.find(path)
        if path in WORKED_OUT and text == WORKED_OUT[path] and default in (NOTHING, None):
            continue
        if not agrees(text, is_required, default):
            found = "no default" if default is NOTHING else json.dumps(default)
            wrong.append(f"{path}: the page says {text}, the program {'wants it' if is_required else found}")
    assert not wrong, "docs/scenario.md:\n" + "\n".join(wrong)
    assert len(all_keys) > 130, f"{len(all_keys)} keys were found on the page"


def test_defaults_in_words_of_placement_and_sizes(schema):
    """`key` (unit, default) in the tables of words."""
    bases = {"placement": "grains.0.placement", "velocity_spread": "grains.0.velocity_spread", "size": "grains.0.size"}
    count = 0
    for heading, head, rows in tables("scenario.md"):
        base = bases.get(heading.strip("`"))
        if not base or head[0] != "word":
            continue
        for row in rows:
            word = words(row[0])[0]
            for key, told in re.findall(r"`(\w+)` \(([^)]*)\)", row[1]):
                text = told.split(", ")[-1]
                if text not in ("false", "true") and number(text) is None and text not in IN_WORDS:
                    continue
                _, is_required, default = schema.find(f"{base}.{word}.{key}")
                assert agrees(text, is_required, default), f"{word}.{key}: the page says {text}, found {default}"
                count += 1
    assert count >= 5, f"{count} defaults in words"


def test_every_key_of_scenarios_is_on_the_page(schema):
    # Fences of examples are no pairs of back quotes.
    page = re.sub(r"```.*?```", "", (ROOT / "docs/scenario.md").read_text(), flags=re.DOTALL)
    told = {name for word in words(page) for name in re.findall(r"\w+", word)}
    missing = sorted(schema.names() - told)
    assert not missing, f"docs/scenario.md does not tell of {', '.join(missing)}"


def test_defaults_of_searches(search_schema):
    """The table of keys in docs/search.md has every key with a default, and no others."""
    wrong, told = [], set()
    for heading, head, rows in tables("search.md"):
        if head[:3] != ["table", "key", "default"]:
            continue
        table = ""
        for row in rows:
            table = (words(row[0]) or [table])[0].strip("[]")
            for key in words(row[1]):
                path = f"{table}.{key}" if table else key
                told.add(path)
                _, is_required, default = search_schema.find(path)
                if not agrees(row[2], is_required, default):
                    wrong.append(f"{path}: the page says {row[2]}, the program {default}")
    assert not wrong, "docs/search.md:\n" + "\n".join(wrong)
    places = ["ensemble", "confirm", "polish"]
    for family in ("method", "plan", "ensemble.until"):
        below = search_schema.keys(search_schema.find(family)[0])
        places += [f"{family}.{word}" for word in below]
    wanted = {
        f"{place}.{key}"
        for place in places
        for key, (_, _, default) in search_schema.keys(search_schema.find(place)[0]).items()
        if default not in (NOTHING, None, [], False) and not isinstance(default, dict)
    }
    # The simplex that polishes has the keys of the method.
    missing = {path for path in wanted - told if not path.startswith("polish.")}
    assert not missing, f"docs/search.md does not tell of {', '.join(sorted(missing))}"


SCENARIO = """
version = 1
time.end = "4 ms"
[engine.verlet]
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.2
sound_speed = "5000 m/s"
contact_stiffness = "10 MPa"
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.random = { count = 10, region.sphere = { radius = "5 mm" } }
[contact.normal.strain_power]
[contact.damping.restitution]
restitution = 0.9
[contact.friction.mindlin]
static_friction = 0.5
stiffness_ratio = 0.8
[bonds.beam]
youngs_modulus = "1 GPa"
tensile_strength = "1 MPa"
shear_strength = "1 MPa"
gap = 2.0
[fields.drag]
law = "stokes"
[acoustics.force.published_step]
[[acoustics.beams]]
start = ["-9 mm", "0 m", "0 m"]
direction = [1.0, 0.0, 0.0]
radius = "1 mm"
rays = 10
strength.pressure = "1 Pa"
"""


def leaves(value, path=""):
    if isinstance(value, dict):
        for key, below in value.items():
            yield from leaves(below, f"{path}.{key}" if path else key)
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        yield from leaves(value[0], f"{path}.0")
    else:
        yield path, value


def test_a_run_fills_in_what_the_schema_says(agglo, schema, tmp_path):
    """What a file leaves out is written out in the folder with the defaults of the schema, output as parts of the run."""
    file, out = tmp_path / "scenario.toml", tmp_path / "out"
    file.write_text(SCENARIO)
    agglo("run", file, "-o", out, "--no-report")
    given = dict(leaves(tomllib.loads(SCENARIO)))
    resolved = dict(leaves(tomllib.loads((out / "scenario.toml").read_text())))
    parts = {"output.series": 200, "output.frames": 40, "output.checkpoints": 20}
    count = 0
    for path, value in resolved.items():
        if path in parts:
            assert number(value) == pytest.approx(4e-3 / parts[path], rel=1e-12), f"{path} = {value}"
            continue
        if path in given:
            continue
        _, _, default = schema.find(path.replace("materials.glass", "materials.NAME"))
        if default is NOTHING or default is None:
            continue
        same = value == default or (isinstance(value, str) and number(value) == number(default))
        assert same, f"{path}: the run takes {value}, the schema says {default}"
        count += 1
    assert count > 25, f"{count} defaults were compared: {sorted(resolved)}"
    assert set(parts) <= set(resolved)
