#!/usr/bin/env bash
# Builds the package for Python as a wheel and prints its path. The wheel is for the system's Python, and needs the
# libraries of the system.
#
#   tools/wheel.sh [OUT [BUILD]]    the folder of the wheel (out) and the build folder (build-wheel)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

python=/usr/bin/python3
[[ -x $python ]] || python=python3
exec "$python" -B python/build_backend.py "${1:-out}" "${2:-build-wheel}"
