#!/usr/bin/env bash
# Runs every test: the Rust tests, the examples in the documentation, the Python tests that read our files with VTK and do
# what the tutorials say, and the tests that open reports in a browser. Then it builds the guide.
#
# Needs Rust (cargo), Python 3.11 or later and, for the browser, Node.js 20 or later. What else is missing is installed:
# Python packages into target/venv, npm packages into target/browser, and Debian packages only where something does not
# work without them (then it says which).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

venv=target/venv
browser=target/browser
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

prepare() {
    need_command cargo "see https://rustup.rs"
    need_command python3 "apt-get install python3"
    # Rust links with the C compiler.
    command -v cc >/dev/null || install_debian gcc libc6-dev
    mkdir -p target
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

# What drives the browser; the browser is Debian's.
prepare_browser() {
    command -v node >/dev/null || install_debian nodejs
    command -v npm >/dev/null || install_debian npm
    if [[ $(node -p 'process.versions.node.split(".")[0]') -lt 20 ]]; then
        echo "error: node is version $(node --version); the browser tests need 20 or later, see https://nodejs.org" >&2
        exit 1
    fi
    export CHROMIUM=${CHROMIUM:-/usr/bin/chromium}
    [[ -x $CHROMIUM ]] || install_debian chromium
    mkdir -p "$browser"
    rm -rf "$browser/runs"
    if ! cmp -s tests/browser/package-lock.json "$browser/package-lock.json" || [[ ! -d $browser/node_modules ]]; then
        say "installing npm packages into $browser"
        cp tests/browser/package.json tests/browser/package-lock.json "$browser"
        (cd "$browser" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
    fi
}

# Runs a command and keeps what it says, for the closing lines.
run() {
    say "$*"
    "$@" 2>&1 | tee -a "$log"
}

prepare
prepare_browser
: >"$log"
run cargo test --locked --workspace --lib --bins --tests --examples
run cargo test --locked --workspace --doc
run "$venv/bin/python" -m pytest -q tests/python
run node --test --test-reporter=tap --test-concurrency=1 tests/browser/*.test.mjs

run docs/book/build.sh

say "closing lines"
grep -E '^(     Running|   Doc-tests|test result:)|^[0-9]+ passed|^# (tests|pass|fail) [0-9]+' "$log"
say "all tests passed"
