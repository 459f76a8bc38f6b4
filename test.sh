#!/usr/bin/env bash
# Runs every test: the Rust tests, the examples in the documentation, the Python tests that read our files with VTK and do
# what the tutorials say, and the tests that open reports in a browser. Then it builds the guide.
#
# Needs Rust (cargo) and Python 3.11 or later. What else is missing is installed: Python packages into target/venv, and Debian
# packages only where something does not work without them (then it says which).
#
# --long repeats the storms of kills and of two processes in one folder 500 times, not 20 times, and reads thirty times as many
# hostile files. It runs the long cases of validation, which cargo ignores otherwise, and measures every figure of README.md again.
# --mutants runs no such tests: it puts small mistakes into the physics for an hour and says which of them no test notices; see
# tests/mutants/check.py. AGGLO_MUTANTS_MINUTES asks for more or less than 60.
# --wheel runs no such tests either: it builds the wheel for Python as it is given out, which takes minutes, and tries it on an
# emulated processor without AVX; see tests/wheel/check.py.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
case ${1:-} in
'' | --mutants | --wheel) ;;
--long) export AGGLO_STORMS=500 AGGLO_CASES=30 ;;
*)
    echo "error: $1 is not known; test.sh takes --long, --mutants, --wheel or nothing" >&2
    exit 2
    ;;
esac

venv=target/venv
log=target/test.log

say() { printf '\n== %s\n' "$*"; }

# Installs Debian packages, as root or through sudo.
install_debian() {
    say "installing Debian packages: $*"
    local as_root=()
    if [[ $(id -u) -ne 0 ]]; then
        if ! command -v sudo >/dev/null; then
            echo "error: $* must be installed by an administrator: apt-get install $*" >&2
            exit 1
        fi
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -q
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -q -y --no-install-recommends "$@"
}

need_command() {
    if ! command -v "$1" >/dev/null; then
        echo "error: $1 is not installed; $2" >&2
        exit 1
    fi
}

need_toolchain() {
    need_command cargo "see https://rustup.rs"
    need_command python3 "apt-get install python3"
    # Rust links with the C compiler.
    command -v cc >/dev/null || install_debian gcc libc6-dev
    mkdir -p target
}

prepare() {
    if ! "$venv/bin/python" -m pip --version >/dev/null 2>&1; then
        say "making the Python environment $venv"
        # Debian keeps what a virtual environment needs in a package of its own.
        python3 -c 'import ensurepip, venv' 2>/dev/null || install_debian python3-venv
        rm -rf "$venv"
        python3 -m venv "$venv"
    fi
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
        -r tests/python/requirements.txt -r docs/book/requirements.txt
    # VTK opens no window here, but some of its wheels want the libraries of one.
    "$venv/bin/python" -c 'import vtk' 2>/dev/null || install_debian libgl1 libx11-6 libxrender1
    "$venv/bin/python" -c 'import vtk'
}

# The browser is Debian's; what drives it is among the Python packages.
prepare_browser() {
    export CHROMIUM=${CHROMIUM:-/usr/bin/chromium}
    [[ -x $CHROMIUM ]] || install_debian chromium
}

# The package for Python, as the tests build everything else, so that nothing is built twice.
install_package() {
    local wheels=target/wheels-of-tests
    rm -rf "$wheels"
    RUSTFLAGS=$(python3 -c 'import tomllib; print(*tomllib.load(open(".cargo/config.toml", "rb"))["build"]["rustflags"])') \
        run "$venv/bin/maturin" build --quiet --profile dev --out "$wheels" --interpreter "$venv/bin/python"
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall "$wheels"/*.whl
}

# What makes movies; without it the test of movies would only see that it is missing.
prepare_ffmpeg() {
    command -v ffmpeg >/dev/null || install_debian ffmpeg
    export AGGLO_NEEDS_FFMPEG=1
}

# Each crate alone, and without what it can do without: what builds in the workspace may lean on another crate's features.
check_features() {
    run cargo check --locked --all-targets -p agglo-testing
    run cargo check --locked --all-targets -p agglo-core
    run cargo check --locked --all-targets -p agglo
    local features
    for features in "" render report render,report; do
        run cargo check --locked --all-targets -p agglo-view --no-default-features --features "$features"
    done
    # Built for this alone, and run for seconds: what is not optimized is built in half the time.
    run env CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo test --locked -p agglo-cli --no-default-features --test program
}

# What takes too long for every change.
run_long() {
    run cargo test --locked --release -p agglo --test val_hard val_ -- --ignored
    run cargo build --locked --release
    run python3 docs/measured/measure.py --check README
}

# Looks for mistakes that no test notices.
try_mutants() {
    local version=27.1.0
    export CARGO_MUTANTS=$PWD/target/tools/bin/cargo-mutants
    if [[ $("$CARGO_MUTANTS" mutants --version 2>/dev/null) != "cargo-mutants $version" ]]; then
        say "installing cargo-mutants $version into target/tools"
        cargo install --locked cargo-mutants --version "$version" --root target/tools
    fi
    say "mutants"
    exec python3 tests/mutants/check.py
}

# Builds the wheel that is given out, and tries it.
try_wheel() {
    command -v qemu-x86_64 >/dev/null || install_debian qemu-user
    command -v objdump >/dev/null || install_debian binutils
    say "wheel"
    exec "$venv/bin/python" tests/wheel/check.py
}

# Runs a command and keeps what it says, for the closing lines.
run() {
    say "$*"
    "$@" 2>&1 | tee -a "$log"
}

need_toolchain
if [[ ${1:-} == --mutants ]]; then
    try_mutants
fi
prepare
if [[ ${1:-} == --wheel ]]; then
    try_wheel
fi
prepare_browser
prepare_ffmpeg
: >"$log"
run cargo test --locked --workspace --lib --bins --tests --examples
run cargo test --locked --workspace --doc
check_features
# Fuzzers are not run here; their targets compile.
run cargo check --locked --manifest-path fuzz/Cargo.toml --no-default-features --bins --examples --target-dir target
install_package
run "$venv/bin/python" -m pytest -q tests/python
run "$venv/bin/python" -m mypy --strict crates/agglo-py/python/agglo
run "$venv/bin/python" -m pytest -q tests/browser

run docs/book/build.sh
if [[ ${1:-} == --long ]]; then
    run_long
fi

say "closing lines"
grep -E '^(     Running|   Doc-tests|test result:)|^[0-9]+ passed' "$log"
say "all tests passed"
