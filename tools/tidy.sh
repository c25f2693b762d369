#!/usr/bin/env bash
# Runs clang-tidy with the rules of .clang-tidy over the library and the program. Several sources at a time (a unity
# build), so that their headers are parsed once. Exits with an error when a rule is broken.
#
#   tools/tidy.sh [MODULE …]            all modules unless told otherwise: tools/tidy.sh stream game app
#   tools/tidy.sh --changed [COMMIT]    modules with a file that changed since COMMIT; without one, in the half day before the
#                                       newest commit. All modules where that commit is missing (a shallow clone), or
#                                       TERRANE_DEPTH=all
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly BUILD_FOLDER=build-tidy

# Of library and program, as targets name them: stream, app.
changed_modules() {
    local newest base=${1:-}
    newest=$(git log -1 --format=%ct)
    [[ -n $base ]] || base=$(git rev-list -1 --before="$((newest - 43200))" HEAD)
    [[ -n $base ]] || { echo '*'; return; }  # a clone without that history
    git diff --name-only "$base" HEAD -- 'terrane/*.cpp' 'terrane/*.h' 'apps/*.cpp' 'apps/*.h' |
        sed -nE 's#^terrane/([^/]+)/.*#\1#p; s#^apps/terrane/.*#app#p' | sort -u
}

modules=("$@")
if [[ ${1:-} == --changed ]]; then
    modules=('*')
    if [[ ${TERRANE_DEPTH:-} != all ]]; then
        [[ -z ${2:-} ]] || git rev-parse --quiet --verify "$2^{commit}" >/dev/null || { echo "tidy: no commit $2" >&2; exit 2; }
        mapfile -t modules < <(changed_modules "${2:-}")
        [[ ${#modules[@]} -gt 0 ]] || { echo "tidy: no module changed"; exit 0; }
        echo "tidy: ${modules[*]}"
    fi
elif [[ $# -eq 0 ]]; then
    modules=('*')
fi

cmake -S . -B "$BUILD_FOLDER" -G Ninja --log-level=WARNING -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_UNITY_BUILD=ON -DTERRANE_TESTS=OFF -DTERRANE_BENCHMARKS=OFF
for module in "${modules[@]}"; do
    # Not the embedded files, which are generated.
    find "$BUILD_FOLDER" -path "*/terrane_$module.dir/Unity/*.cxx" ! -path '*terrane_shaders*' ! -path '*_files.dir*'
done | xargs --no-run-if-empty --max-procs="$(nproc)" --max-args=1 clang-tidy --quiet -p "$BUILD_FOLDER" 2> >(grep -v 'warnings generated' >&2)
