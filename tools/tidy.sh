#!/usr/bin/env bash
# Runs clang-tidy with .clang-tidy over the library and the program: all sources, or those given.
#
#   tools/tidy.sh [FILE.cpp …]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly BUILD_FOLDER=build-tidy

cmake -S . -B "$BUILD_FOLDER" -G Ninja --log-level=WARNING -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
    -DTERRANE_WERROR=OFF -DTERRANE_TESTS=OFF -DTERRANE_BENCHMARKS=OFF
if [[ $# -gt 0 ]]; then
    files=("$@")
else
    mapfile -t files < <(find terrane apps -name '*.cpp')
fi
printf '%s\n' "${files[@]}" |
    xargs --max-procs="$(nproc)" --max-args=4 clang-tidy --quiet -p "$BUILD_FOLDER" 2> >(grep -v 'warnings generated' >&2)
