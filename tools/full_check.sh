#!/usr/bin/env bash
# All checks at full depth, for a night: every seed, view, variant and fault, clang-tidy of all modules, a minute of each
# fuzzer, all tests under the sanitizers and on the second driver.
set -euo pipefail
TERRANE_DEPTH=all exec "$(dirname "${BASH_SOURCE[0]}")/../.ci/run"
