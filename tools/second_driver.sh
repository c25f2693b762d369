#!/usr/bin/env bash
# Runs the tests that use the GPU on a second driver: Mesa's zink, which is OpenGL on Vulkan, on lavapipe, which is
# Vulkan in software. `./run test` builds the tests and runs them on the driver of the machine.
#
#   tools/second_driver.sh [FOLDER]    of the build in FOLDER (build)
#
# At the gate's depth, without the cases that compare long sequences of images, which depend on our code more than on a
# driver. Exits with an error where the driver is missing: a test on another driver fails and is not skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly FOLDER=${1:-build}
# In these, lavapipe of Mesa 22.3 overruns an array on its own stack (__stack_chk_fail in libvulkan_lvp.so): in the gallery if
# there are layers of blended faces, shadows and one sample a pixel. The first driver runs them.
readonly CRASH=('FramePassesTest.*' 'Flight.TheWorldIsTheSameFarAway*' 'BackgroundCompilerTest.*'
    'ArenasTest.ManyArenas*' 'ShadowMapTest.ShadowsStandStill*' 'DrawMethodTest.TheLoopDrawsTheSameImagesOfOneSample')
readonly LONG=('Tour.AnyOptions*' 'Flight.Hidden*' 'ClosedRoomTest.*' 'ShadowAcneTest.*' 'ShadowCrawlTest.*' 'EdgeExpansionOnCoarseGrid.*'
    'GpuGeneratorTest.LevelsEqualCpu*' 'GpuGeneratorTest.Overworld*')

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
without=("${CRASH[@]}")
[[ ${TERRANE_DEPTH:-} == all ]] || without+=("${LONG[@]}")
TERRANE_WITHOUT=$(IFS=:; echo "${without[*]}")
export TERRANE_WITHOUT GALLIUM_DRIVER=zink LIBGL_ALWAYS_SOFTWARE=1 TERRANE_EXPECT_RENDERER=zink
ctest --test-dir "$FOLDER" --output-on-failure --no-tests=error --parallel 2 --tests-regex '^(gpu|gen_gpu|light_gpu|mesh_gpu|render|golden)\.'
