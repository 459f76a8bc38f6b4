#!/usr/bin/env bash
# Builds the guide as a book that opens without a network: target/guide/index.html. A warning is an error.
#
# Needs Python 3.11 or later, and cargo: the program prints the pages of the laws. What else it needs goes into target/venv.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

venv=target/venv
if ! "$venv/bin/python" -m pip --version >/dev/null 2>&1; then
    rm -rf "$venv"
    python3 -m venv "$venv"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r docs/book/requirements.txt
# From scratch, so that no page stays behind that has been renamed.
rm -rf target/guide
"$venv/bin/python" -m sphinx -b html -c docs/book -d target/guide-pages --fresh-env --fail-on-warning --keep-going --quiet . target/guide
# It must open without a network: nothing that a page shows or runs may come from elsewhere.
if grep -rnoE '<(script|img|iframe|source)[^>]* src="(https?:)?//[^"]*"|<link[^>]* rel="(stylesheet|preload|icon)"[^>]* href="(https?:)?//[^"]*"|url\(["'"'"']?https?://[^)]*\)|@import[^;]*https?://[^;]*' \
    target/guide --include='*.html' --include='*.css'; then
    echo "error: the pages above load something from elsewhere" >&2
    exit 1
fi
echo "the guide is in target/guide/index.html"
