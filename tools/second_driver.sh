#!/usr/bin/env bash
# Runs the tests that use the GPU on a second driver: Mesa's zink, which is OpenGL on Vulkan, on lavapipe, which is
# Vulkan in software. `./run test` builds the tests and runs them on the driver of the machine.
#
#   tools/second_driver.sh [EVERY] [FOLDER]    every EVERY-th test and those below, 1 (all) unless told otherwise, of the
#                                              build in FOLDER (build)
#
# Exits with an error where the driver is missing: a test on another driver fails and is not skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly EVERY=${1:-1} FOLDER=${2:-build}
# Tests of what OpenGL leaves to the driver: they run always.
readonly ALWAYS='^(gpu\.PipelineStateTest|render\.EdgeExpansion\.Without|golden\.Effects\.OfLayers)'
# With the gallery's plain cubes, one sample and the usual options lavapipe of Mesa 22.3 overruns an array on its own stack
# (__stack_chk_fail in libvulkan_lvp.so); the first driver runs these.
readonly NEVER='^(render\.FramePassesTest|golden\.(Flight\.TheWorldIsTheSameFarAway|BackgroundCompilerTest))'

if ! compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' >/dev/null; then
    echo "second driver: lavapipe is missing: apt-get install mesa-vulkan-drivers" >&2
    exit 2
fi
if [[ ! -f $FOLDER/CTestTestfile.cmake ]]; then
    echo "second driver: $FOLDER has no tests: ./run test builds them" >&2
    exit 2
fi
if [[ -z ${XDG_RUNTIME_DIR:-} ]]; then  # the Vulkan loader complains without
    XDG_RUNTIME_DIR=$(mktemp -d)
    export XDG_RUNTIME_DIR
    trap 'rm -r "$XDG_RUNTIME_DIR"' EXIT
fi
export GALLIUM_DRIVER=zink LIBGL_ALWAYS_SOFTWARE=1 TERRANE_EXPECT_RENDERER=zink

run_tests() {
    ctest --test-dir "$FOLDER" --output-on-failure --no-tests=error --parallel 2 "$@"
}

[[ $EVERY == 1 ]] || run_tests --tests-regex "$ALWAYS"
run_tests --tests-regex '^(gpu|gen_gpu|light_gpu|mesh_gpu|render|golden)\.' --exclude-regex "$NEVER" --tests-information "$((EVERY / 2 + 1)),,$EVERY"
