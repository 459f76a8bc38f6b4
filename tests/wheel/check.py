"""Builds the wheel as it is given out and tries it on the plainest processor that it is meant for. `./test.sh --wheel` runs it.

`check.py` builds the wheel into target/wheel, `check.py WHEEL` takes one that is there. It looks at its name, its size, the
licenses and the list of what it is built from; at the instructions of its module; and runs it in an environment of its own, here
and emulated by QEMU as an x86-64 without AVX, to the same bits. Needs maturin beside the Python that runs it, readelf and objdump
(binutils), cc, and qemu-x86_64 (qemu-user), on Linux on x86-64; elsewhere it looks at the files alone.
"""

import bisect
import json
import platform
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from collections import Counter
from pathlib import Path

import licenses

ROOT = Path(__file__).resolve().parents[2]
HERE = ROOT / "target/wheel"

LARGEST_MB = 15
# The module as it is when tests are run is no wheel to give out; nor is one of a machine's own tag.
NAME = r"agglo-[\d.]+-cp310-abi3-(manylinux_\d+_\d+_x86_64|macosx_\w+|win_amd64)\.whl"

# Instructions of AVX, FMA, AVX-512 begin with v; those with two letters more at the end compute with doubles.
WIDE = re.compile(r"^\s+([0-9a-f]+):\s+(v(?!er[rw]\b|m\w+$)\w+)")
DOUBLES = re.compile(r"[sp]d$")
# Crates and the standard library choose such code when it runs, by what the processor says of itself (`objdump -d` names it where
# a module is not stripped): memchr looks for bytes (find_avx2, find_raw_avx2, rfind_raw_avx2), crc32fast sums up (calculate_avx2,
# calculate_avx512), simd-adler32 as well (update_imp), ab_glyph_rasterizer draws letters (draw_line_avx2), and compiler_builtins
# has fma (fma_with_fma, fma_with_fma4). These are 11 of more than 10,000 functions; built for one processor it would be most.
# Of our own code two functions may: contacts side by side (math/lanes), with AVX2 and with AVX-512. More would be parts of them that were
# not inlined.
MOST_WIDE_FUNCTIONS = 20
MOST_COMPUTING_FUNCTIONS = 2

# A plain x86-64: SSE2 and SSE3. NumPy's own wheels want x86-64-v2, so the package is tried on the first processor that has all of
# it, and the module alone, which the program is, on the plain one.
PLAIN, FOR_NUMPY = "qemu64", "Nehalem"

SMALL = {
    "grains.0.placement.random.count": 60,
    "acoustics.beams.0.rays": 500,
    "acoustics.beams.0.pulses.count": 1,
    "time.end": "2 ms",
}
FEW = {"grains.0.size.length_ratio.count": 100, "grains.0.placement.fill.count": 100}
# Acts as the program does, without the package around the module and without NumPy.
PROGRAM = "import sys; sys.path.insert(0, sys.argv[1]); import _agglo; sys.exit(_agglo.act_on(['agglo', *sys.argv[2:]]))"
# Prints every bit of where the grains are, of soft and of hard spheres.
STEPS = f"""
import agglo
for kind, small in (("acoustic", {SMALL!r}), ("reacting", {FEW!r})):
    simulation = agglo.Simulation(agglo.Scenario.template(kind, small))
    simulation.run_until(1e-3)
    print(kind, simulation.grains()["position_m"].tobytes().hex())
"""

checked = []


def holds(is_right, what):
    """Notes down what was found, or ends with it as an error."""
    if not is_right:
        sys.exit(f"error: {what}")
    checked.append(what)
    print(f"  {what}", flush=True)


def said(command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=ROOT, **more)
    if done.returncode != 0:
        words = " ".join(str(word) for word in command)[:300]
        sys.exit(f"error: {words}\nends with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def build():
    for old in HERE.glob("*.whl"):
        old.unlink()
    maturin = Path(sys.executable).with_name("maturin")
    said([maturin, "build", "--release", "--locked", "--quiet", "--out", HERE, "--interpreter", sys.executable])
    return next(HERE.glob("*.whl"))


def look_at_the_files(wheel, archive):
    size = wheel.stat().st_size / 1e6
    holds(re.fullmatch(NAME, wheel.name), f"its name is {wheel.name}: CPython 3.10 and later")
    holds(size < LARGEST_MB, f"it has {size:.1f} MB, of {LARGEST_MB} at most")
    module = [name for name in archive.namelist() if re.search(r"\.(so|pyd)$", name)]
    holds(len(module) == 1, f"its module is {', '.join(module)}")
    home = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA")).rsplit("/", 1)[0]
    about = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    names = about["license-files"]
    for name in names:
        kept = f"{home}/licenses/{name}"
        is_ours = kept in archive.namelist() and archive.read(kept) == (ROOT / name).read_bytes()
        holds(is_ours, f"it has the project's {name}")
    text = archive.read(f"{home}/METADATA").decode()
    holds(f"License-Expression: {about['license']}" in text, f"it is under {about['license']}")
    return module[0], home


def look_at_the_list_of_parts(archive, home):
    """The list of what the module is built from, which maturin writes as CycloneDX, against Cargo.lock."""
    lists = [name for name in archive.namelist() if re.match(f"{re.escape(home)}/sboms/.*\\.cyclonedx\\.json", name)]
    holds(len(lists) == 1, f"it has a list of what it is built from: {', '.join(lists)}")
    parts = json.loads(archive.read(lists[0]))["components"]
    data = licenses.metadata()
    holds(not licenses.faults(data), "the licenses of all crates can be passed on with it")
    holds(licenses.FILE.read_text() == licenses.made(data), "LICENSE-THIRD-PARTY is what Cargo.lock asks for")
    there = {(part["name"], part["version"]) for part in parts}
    untold = [f"{name} {version}" for name, version in map(named, licenses.linked(data)) if (name, version) not in there]
    holds(not untold, f"the list has {len(there)} crates; of those that are linked it lacks {', '.join(untold) or 'none'}")
    bare = sorted(part["name"] for part in parts if not part.get("licenses"))
    holds(not bare, f"crates without a license in the list: {', '.join(bare) or 'none'}")


def named(package):
    return package["name"], package["version"]


def look_at_the_instructions(module):
    """No code of ours but that in lanes may need AVX. It computes with doubles everywhere, so that such instructions would tell."""
    # Names are gone; where functions begin is known from what unwinds them.
    frames = said(["readelf", "--debug-dump=frames", module])
    starts = sorted(int(start, 16) for start in re.findall(r"FDE cie=\S+ pc=([0-9a-f]+)\.\.", frames))
    wide, doubles = Counter(), Counter()
    command = ["objdump", "-d", "--no-show-raw-insn", str(module)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            found = WIDE.match(line)
            if found:
                function = starts[bisect.bisect(starts, int(found[1], 16)) - 1]
                wide[function] += 1
                doubles[function] += bool(DOUBLES.search(found[2]))
    holds(process.returncode == 0 and len(starts) > 1000, f"its module has {len(starts)} functions")
    told = f"{len(wide)} of them have instructions of AVX and later, {sum(wide.values())} in all; {MOST_WIDE_FUNCTIONS} may"
    holds(len(wide) <= MOST_WIDE_FUNCTIONS, told)
    # fma has one, in each of two functions that do nothing else.
    computing = [f"{function:x}" for function, count in doubles.items() if count > 1]
    told = f"{len(computing)} of these compute with doubles, of {MOST_COMPUTING_FUNCTIONS} at most: {', '.join(computing) or 'none'}"
    holds(len(computing) <= MOST_COMPUTING_FUNCTIONS, told)


def environment(wheel):
    """A Python with the wheel and NumPy alone; gives it, and where the package is."""
    python = HERE / "venv/bin/python"
    said([sys.executable, "-m", "venv", "--clear", HERE / "venv"])
    wanted = (ROOT / "tests/python/requirements.txt").read_text()
    numpy = re.search("^numpy==.*$", wanted, re.MULTILINE)[0]
    said([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", numpy])
    said([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", wheel])
    return python, Path(said([python, "-c", "import agglo; print(agglo.__file__)"]).strip()).parent


def look_at_the_emulator():
    """Whether it refuses what it should; else what runs on it would show nothing."""
    source = HERE / "avx.c"
    source.write_text('int main(void) { __asm__ volatile("vxorpd %%ymm0, %%ymm0, %%ymm0" ::: "xmm0"); return 0; }\n')
    said(["cc", source, "-o", HERE / "avx"])
    for processor in (PLAIN, FOR_NUMPY):
        done = subprocess.run(["qemu-x86_64", "-cpu", processor, str(HERE / "avx")], capture_output=True)
        # Killed by the signal of an illegal instruction, as it is or as shells tell of it.
        holds(done.returncode in (-4, 132), f"QEMU as {processor} refuses an instruction of AVX")


def run_it(python, package):
    series = {}
    for kind, emulated in (("here", []), (PLAIN, ["qemu-x86_64", "-cpu", PLAIN])):
        program = [*emulated, python, "-c", PROGRAM, package]
        scenario, out = ROOT / "scenarios/acoustic-dispersal.toml", HERE / f"out-{kind}"
        shutil.rmtree(out, ignore_errors=True)
        (HERE / f"{kind}.png").unlink(missing_ok=True)
        values = [word for key, value in SMALL.items() for word in ("--set", f"{key}={value}")]
        said([*program, "run", scenario, *values, "-o", out])
        said([*program, "render", out, "-o", HERE / f"{kind}.png"])
        series[kind] = {path.name: path.read_bytes() for path in sorted((out / "series").iterdir())}
        series[kind]["picture"] = (HERE / f"{kind}.png").read_bytes()
    holds(len(series["here"]) > 3, f"the program runs here and on a plain x86-64 ({PLAIN}), and draws a picture")
    holds(series["here"] == series[PLAIN], "to the same bits")
    steps = said([python, "-c", STEPS])
    holds(said(["qemu-x86_64", "-cpu", FOR_NUMPY, python, "-c", STEPS]) == steps, f"so does the package with NumPy ({FOR_NUMPY})")


def main():
    HERE.mkdir(parents=True, exist_ok=True)
    wheel = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else build()
    with zipfile.ZipFile(wheel) as archive:
        module, home = look_at_the_files(wheel, archive)
        look_at_the_list_of_parts(archive, home)
        archive.extract(module, HERE / "unpacked")
    if (platform.system(), platform.machine()) != ("Linux", "x86_64"):
        sys.exit("error: instructions can be looked at on Linux on x86-64 alone")
    look_at_the_instructions(HERE / "unpacked" / module)
    python, package = environment(wheel)
    look_at_the_emulator()
    run_it(python, package)
    print(f"the wheel is as it should be: {len(checked)} points")


if __name__ == "__main__":
    main()
