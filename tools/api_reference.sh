#!/usr/bin/env bash
# Makes the reference of the public headers, out/api/html/index.html. Fails where a comment cannot be read. Needs doxygen.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p out/api
doxygen docs/Doxyfile
echo "$PWD/out/api/html/index.html"
