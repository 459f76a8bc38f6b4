"""What a run fills in for keys that its file leaves out is what the schema says, and with it the tables of the guide.

Needs `pytest` from PyPI, and cargo.
"""

import json
import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

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


@pytest.fixture(scope="module")
def agglo(built):
    def call(*arguments, **more):
        return subprocess.run([built / "agglo", *arguments], check=True, capture_output=True, text=True, **more)

    return call


@pytest.fixture(scope="module")
def schema(agglo):
    return Schema(json.loads(agglo("schema").stdout))


SCENARIO = """
version = 1
time.end = "4 ms"
[engine.verlet]
[materials.glass]
density = "2500 kg/m3"
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
