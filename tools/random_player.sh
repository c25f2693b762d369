#!/usr/bin/env bash
# Builds the program with address and undefined-behavior sanitizers and lets a random player at it.
# Usage: tools/random_player.sh [MINUTES [SEED]]   (15 minutes, seed 1)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset asan -DCMAKE_UNITY_BUILD=ON --log-level=WARNING
cmake --build build-asan --target terrane
exec python3 tools/random_player.py build-asan/terrane "${1:-15}" --seed "${2:-1}"
