"""A report in a browser, and the files of its folder."""

import csv
import re
import struct
from pathlib import Path

READY = """() => ["replay", "charts"].every((id) => {
  const part = document.getElementById(id);
  return !part || part.dataset.ready || part.querySelector("[role=alert]");
})"""
SETTLED = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
PICTURE = """() => {
  const stage = document.querySelector("#replay canvas");
  const copy = document.createElement("canvas");
  Object.assign(copy, { width: stage.width, height: stage.height });
  const pen = copy.getContext("2d", { willReadFrequently: true });
  pen.drawImage(stage, 0, 0);
  const words = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
  window.pictures ??= [];
  window.pictures.push(words);
  return [window.pictures.length - 1, new Set(words).size];
}"""
DIFFERENCE = """([a, b]) => {
  const [one, other] = [window.pictures[a], window.pictures[b]];
  let count = 0;
  for (let at = 0; at < one.length; at += 1) count += one[at] !== other[at];
  return count / one.length;
}"""


class Picture:
    """A picture of the stage; it stays in the page, which tells how many colors it has."""

    def __init__(self, page):
        self.page = page
        page.settle()
        self.number, self.colors = page.evaluate(PICTURE)

    def differs_from(self, other):
        """Part of the pixels that differ between two pictures of one page and size."""
        return self.page.evaluate(DIFFERENCE, [self.number, other.number])


class Page:
    """A page of a report; `trouble` has what the console and the network should not have seen."""

    def __init__(self, context, folder):
        self.context = context
        self.tab = context.new_page()
        self.trouble = []
        self.address = (Path(folder) / "report.html").resolve().as_uri()
        self.tab.on("console", self._said)
        self.tab.on("pageerror", lambda error: self.trouble.append(f"error: {error}"))
        self.tab.on("request", self._asked)
        self.tab.goto(self.address)
        self.tab.wait_for_function(READY)
        self.settle()

    def _said(self, message):
        # The software renderer of tests says that reading pixels is slow.
        if "GPU stall due to ReadPixels" not in message.text:
            self.trouble.append(f"{message.type}: {message.text}")

    def _asked(self, request):
        if not request.url.startswith(("blob:", "data:")) and request.url != self.address:
            self.trouble.append(f"request: {request.url}")

    def evaluate(self, script, argument=None):
        return self.tab.evaluate(script, argument)

    def settle(self):
        """Two pictures later everything asked for so far is drawn."""
        self.evaluate(SETTLED)

    def picture(self):
        return Picture(self)

    def replay(self, expression):
        """An expression or statements over `replay`; gives the last value."""
        return self.evaluate(f"{{ const replay = window.agglo.replay; {expression} }}")

    def part(self, name):
        """A control of the replay."""
        return self.tab.locator(f"#replay [data-part={name}]")

    def lines(self, chart):
        """The lines of a chart: name, x, y and error bars."""
        return self.evaluate(
            """(id) => document.getElementById(id).data.map(({ name, x, y, error_y }) =>
              ({ name, x: x && [...x], y: y && [...y], error: error_y?.array ? [...error_y.array] : null }))""",
            f"chart-{chart}",
        )

    def close(self):
        self.context.close()


def table(path):
    """A table as columns of numbers by name; words stay words."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [_number(row[name]) for row in rows] for name in rows[0]}


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text


def frame(path):
    """The arrays of a .vtp file of ours: names with flat lists of numbers."""
    content = Path(path).read_bytes()
    mark = b'<AppendedData encoding="raw">\n_'
    data = content.index(mark) + len(mark)
    arrays = {}
    for tag in re.findall(r"<DataArray [^>]*>", content[:data].decode("latin-1")):
        name, kind, offset = (re.search(rf' {key}="([^"]*)"', tag) for key in ("Name", "type", "offset"))
        if name is None or offset is None or kind[1] not in ("Float64", "UInt32"):
            continue
        letter, size = ("d", 8) if kind[1] == "Float64" else ("I", 4)
        at = data + int(offset[1])
        (length,) = struct.unpack_from("<Q", content, at)
        arrays[name[1]] = list(struct.unpack_from(f"<{length // size}{letter}", content, at + 8))
    return arrays
