#!/usr/bin/env bash
# Feeds the reader of chunks with bytes that libFuzzer thinks up, under the address and undefined-behavior
# sanitizers. What it finds interesting stays in build-fuzz/ for the next time.
#
#   tools/fuzz.sh [SECONDS]    10 seconds unless told otherwise; exits with an error when it finds a fault
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly BUILD_FOLDER=build-fuzz
readonly SECONDS_TO_RUN=${1:-10}

if ! command -v clang++ >/dev/null; then
    echo "fuzz: needs clang++: apt-get install clang libclang-rt-dev" >&2
    exit 2
fi
cmake -S . -B "$BUILD_FOLDER" -G Ninja --log-level=WARNING -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS=-O1 -DCMAKE_UNITY_BUILD=ON -DTERRANE_WERROR=OFF -DTERRANE_FUZZ=ON \
    -DTERRANE_SANITIZE=fuzzer-no-link,address,undefined -DTERRANE_GRAPHICS=OFF -DTERRANE_TESTS=OFF -DTERRANE_BENCHMARKS=OFF
cmake --build "$BUILD_FOLDER" --target fuzz_chunk_codec
mkdir -p "$BUILD_FOLDER/corpus"
# A thread keeps up to 64 MiB for a chunk that says it is that large, and zstd as much.
"$BUILD_FOLDER/fuzz_chunk_codec" -max_total_time="$SECONDS_TO_RUN" -max_len=20000 -timeout=10 -rss_limit_mb=1024 \
    -artifact_prefix="$BUILD_FOLDER/" -print_final_stats=1 "$BUILD_FOLDER/corpus" tests/fuzz/seeds
