#!/usr/bin/env bash
# Runs clang-tidy with the rules of .clang-tidy over the library and the program. Several sources at a time (a unity
# build), so that their headers are parsed once. Exits with an error when a rule is broken.
#
#   tools/tidy.sh [MODULE …]    all modules unless told otherwise: tools/tidy.sh stream game app
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly BUILD_FOLDER=build-tidy

cmake -S . -B "$BUILD_FOLDER" -G Ninja --log-level=WARNING -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_UNITY_BUILD=ON -DTERRANE_TESTS=OFF -DTERRANE_BENCHMARKS=OFF
modules=("$@")
[[ $# -gt 0 ]] || modules=('*')
for module in "${modules[@]}"; do
    # Not the embedded files, which are generated.
    find "$BUILD_FOLDER" -path "*/terrane_$module.dir/Unity/*.cxx" ! -path '*terrane_shaders*' ! -path '*_files.dir*'
done | xargs --max-procs="$(nproc)" --max-args=1 clang-tidy --quiet -p "$BUILD_FOLDER" 2> >(grep -v 'warnings generated' >&2)
