"""Writes docs/api.md from the signatures and docstrings of the package: python docs/book/api.py"""

import ast
import inspect
import re
import sys
from pathlib import Path

import agglo
from agglo import _agglo

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "crates/agglo-py/python/agglo"

HEAD = """# Python: all classes and functions

Made from the package itself by `docs/book/api.py`; [python.md](python.md) shows how they go together. Arrays are NumPy's; quantities are in
SI units, and names say which. `Columns` is a dict of arrays by their names, `Folder` a path, `Floats` an array of numbers.
"""


def definitions():
    """The definitions of the whole package by their names; what is written in Rust has them in its stub."""
    found = {}
    for file in [*sorted(PACKAGE.glob("*.py")), PACKAGE / "_agglo.pyi"]:
        for node in ast.parse(file.read_text(encoding="utf-8")).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                found[file.stem, node.name] = node
    return found


def signature(name, node, is_method=False):
    """A signature on one line, without the module's names before types."""
    arguments = ast.parse(ast.unparse(node)).body[0].args
    if is_method and arguments.args and arguments.args[0].arg in ("self", "cls"):
        del arguments.args[0]
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return re.sub(r"\bnpt?\.|ForwardRef", "", f"{name}({ast.unparse(arguments)}){returned}")


def docs(thing):
    """A docstring as Markdown: its sections as lists, its examples as code."""
    text = inspect.getdoc(thing) or ""
    lines, section = [], False
    for line in text.splitlines():
        if re.fullmatch(r"(Args|Returns|Raises|Attributes):", line):
            lines += ["", f"**{line[:-1]}**", ""]
            section = True
        elif section and (entry := re.match(r"    (\S[^:]*): (.*)", line)):
            lines.append(f"- `{entry[1]}`: {entry[2]}")
        elif section and line.startswith("    "):
            lines.append("  " + line.strip())
        else:
            section = section and not line.strip()
            lines.append(line)
    text = "\n".join(lines)
    return re.sub(r"((?:^(?:>>>|\.\.\.).*\n?(?:^(?!>>>|\.\.\.|$).*\n?)*)+)", r"```python\n\1\n```\n", text, flags=re.MULTILINE)


def members(name, node, known):
    """Methods and properties of a class that are not private, those of the package's own classes above it as well."""
    thing = getattr(agglo, name)
    above = [known[key] for base in node.bases for key in known if key[1] == ast.unparse(base)]
    for one in [one for each in (node, *above) for one in each.body]:
        if not isinstance(one, ast.FunctionDef) or one.name.startswith("_") and one.name != "__call__":
            continue
        decorators = {ast.unparse(decorator) for decorator in one.decorator_list}
        kind = f": {ast.unparse(one.returns)}" if one.returns else ""
        shown = f".{one.name}{kind}" if "property" in decorators else signature(f".{one.name}", one, True)
        shown = re.sub(r"\bnpt?\.", "", shown).replace(".__call__(", "(")
        yield f"#### `{shown}`\n\n{docs(getattr(thing, one.name))}\n"


def page():
    """The whole page."""
    known = definitions()
    parts = {"Classes": [], "Functions": [], "Errors": []}
    for name in agglo.__all__:
        thing = getattr(agglo, name)
        if isinstance(thing, str):
            continue
        module = "_agglo" if getattr(_agglo, name, None) is thing else thing.__module__.rpartition(".")[2]
        node = known[module, thing.__name__]
        if isinstance(node, ast.FunctionDef):
            parts["Functions"].append(f"### `agglo.{signature(name, node)}`\n\n{docs(thing)}\n")
            continue
        made = next((one for one in node.body if getattr(one, "name", "") in ("__init__", "__new__")), None)
        call = signature(name, made, True).partition(" -> ")[0] if made else name
        text = f"### `agglo.{call}`\n\n{docs(thing)}\n"
        kind = "Errors" if issubclass(thing, Exception) else "Classes"
        parts[kind].append("\n".join([text, *members(name, node, known)]) if kind == "Classes" else text)
    listed = [f"## {kind}\n\n" + "\n".join(entries) for kind, entries in parts.items()]
    return re.sub(r"\n{3,}", "\n\n", "\n".join([HEAD, *listed])).rstrip() + "\n"


if __name__ == "__main__":
    file = ROOT / "docs/api.md"
    if "--check" in sys.argv:
        sys.exit(0 if file.read_text(encoding="utf-8") == page() else "docs/api.md is not that of the package; run docs/book/api.py")
    file.write_text(page(), encoding="utf-8")
