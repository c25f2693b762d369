#!/usr/bin/env bash
# Feeds everything that reads bytes from outside with inputs made by libFuzzer, under the address and
# undefined-behavior sanitizers: saves, chunks, structures, block types, languages, path files, settings, bookmarks,
# textures, sounds, scripts of generators, content packs, files of other programs, messages of the network, what
# connections do to a server, targets of browsers, caches of maps. Inputs that reach new code are kept in
# build-fuzz/corpus; each run starts from them and from tests/fuzz/corpus.
#
#   tools/fuzz.sh [SECONDS] [NAME…]    10 seconds each by default, two at a time; 0: only the kept inputs. NAME as in
#                                      tests/fuzz/NAME_fuzz.cpp, all of them by default. Exits with an error if
#                                      one finds a fault
#   build-fuzz/fuzz_NAME FILE          runs one input again
#   FUZZ_BUILD=build-asan tools/fuzz.sh …   fuzzers that are built there: -DTERRANE_FUZZ=ON. Where the library is not
#                                      compiled for libFuzzer, it sees the fuzzers' own branches only
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

export BUILD_FOLDER=${FUZZ_BUILD:-build-fuzz}
export SECONDS_TO_RUN=${1:-10}
shift || true
names=("$@")
if [[ ${#names[@]} -eq 0 ]]; then
    for source in tests/fuzz/*_fuzz.cpp; do
        name=${source##*/}
        names+=("${name%_fuzz.cpp}")
    done
fi

build_fuzzers() {
    if ! command -v clang++ >/dev/null; then
        echo "fuzz: needs clang++: apt-get install clang libclang-rt-dev" >&2
        exit 2
    fi
    cmake -S . -B "$BUILD_FOLDER" -G Ninja --log-level=WARNING -DCMAKE_CXX_COMPILER=clang++ \
        -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS=-O1 -DCMAKE_UNITY_BUILD=ON -DTERRANE_FUZZ=ON \
        -DTERRANE_SANITIZE=fuzzer-no-link,address,undefined -DTERRANE_GRAPHICS=OFF -DTERRANE_TESTS=OFF -DTERRANE_BENCHMARKS=OFF
    cmake --build "$BUILD_FOLDER" --target "${names[@]/#/fuzz_}"
}
[[ -n ${FUZZ_BUILD:-} ]] || build_fuzzers

# Files that the library opens by name are in memory; a killed fuzzer leaves them there.
TMPDIR=$(mktemp -d "$([[ -d /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")/terrane-fuzz.XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# Runs one fuzzer for its time; prints its last lines if it found an error.
fuzz() {
    local name=$1 max_length=4096
    local log="$BUILD_FOLDER/$name.log" corpus="$BUILD_FOLDER/corpus/$name"
    # Large enough for chunks of many sections.
    [[ $name == chunk_codec || $name == region ]] && max_length=20000
    local folders=("$corpus") options=("-max_total_time=$SECONDS_TO_RUN")
    [[ $SECONDS_TO_RUN != 0 ]] || options=(-runs=0)  # for libFuzzer, 0 seconds have no end
    [[ -d tests/fuzz/seeds/$name ]] && folders+=("tests/fuzz/seeds/$name")
    [[ -f tests/fuzz/$name.dict ]] && options+=("-dict=tests/fuzz/$name.dict")
    # Inputs found by earlier runs, reduced to those that add coverage (libFuzzer's -merge=1).
    mkdir -p "$corpus"
    [[ ! -f tests/fuzz/corpus/$name.tar.gz ]] || tar -xf "tests/fuzz/corpus/$name.tar.gz" -C "$corpus"
    # A thread keeps up to 64 MiB for a chunk with that size in its header, and zstd as much; an image takes 256 MiB.
    if ! "$BUILD_FOLDER/fuzz_$name" -max_len="$max_length" -timeout=10 \
        -rss_limit_mb=1536 -artifact_prefix="$BUILD_FOLDER/$name-" -print_final_stats=1 "${options[@]}" \
        "${folders[@]}" >"$log" 2>&1; then
        grep -a -B 5 -A 25 -m 1 "ERROR: " "$log" || tail -n 20 "$log"
        echo "fuzz: $name: found a fault; $log has all of it" >&2
        return 1
    fi
    echo "fuzz: $name: $(grep -a -o 'DONE *cov: [0-9]*' "$log" | grep -o '[0-9]*') places reached by" \
        "$(grep -a -o 'number_of_executed_units: [0-9]*' "$log" | grep -o '[0-9]*') inputs"
}
export -f fuzz
printf '%s\n' "${names[@]}" | xargs -P 2 -I '{}' bash -c 'fuzz {}'
