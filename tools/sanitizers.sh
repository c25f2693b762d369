#!/usr/bin/env bash
# Builds the tests under Clang's sanitizers and runs them.
#
#   tools/sanitizers.sh [PART…]    both parts unless one is named
#
#   address    address, undefined behavior: all modules, also those that draw (in software); before them the fuzzers, on the
#              inputs that tests/fuzz keeps
#   threads    the thread sanitizer: base, store, stream, game, whose objects threads share
#
# TERRANE_DEPTH=all runs all cases, also the scripts that use the program without a window, and each fuzzer for a minute on new
# inputs; tools/fuzz.sh 600 runs longer, in a build that guides them. Needs clang, libclang-rt-dev, lld.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Cases (patterns of GoogleTest) that take long under a sanitizer and run no code that others do not: the character of
# generated land, searches of numbers, whole meshes and maps, images compared pixel by pixel,
# long ways through menus.
readonly LONG_ADDRESS=(
    'All/MixAndMethod*' 'AreaImageTest.EveryLevelHasOne*' 'Areas/Overworld*' 'ArenasTest*' 'BackgroundCompilerTest*' 'BatchLighter.DoesWhat*'
    'Catalogue.AVersion*' 'ChecksumTest.OneFlippedBit*' 'ClosedRoomTest*' 'CollisionTest.NeverTunnels*'
    'Downsample.WhatIsEqualStays*' 'EdgeExpansion*'
    'Effects*' 'Examples.HaveTheirBlocks*' 'ExprMath*' 'FaceSampling*' 'FarSamenessTest*' 'FarViewTest*' 'FarWalkTest*' 'FirstMinutesTest*' 'Flight*'
    'GeneratedSurface.IsThatOfTheWholeChunk*' 'Generators/ScriptEqualsCpp*' 'GpuGeneratorTest.LevelsEqualCpu*'
    'GpuGeneratorTest.Overworld*' 'GoldenProof*' 'GraphicsTest*' 'HudTest*' 'LandsLevels*' 'LandsWithSeas*' 'LightChunk.EqualsTheReferenceOfALarger*' 'LiquidProperty*'
    'MapPainter.AnEditChangesTheTiles*' 'MapPainter.FactsOfAColumn*' 'MapPainter.TilesFitTogether*' 'Overworld*'
    'Places/Lands*' 'PlayTest*' 'RayCast.Equals*' 'RelightRandom.Caves*' 'RelightRandom.Layers*'
    'RelightRandom.ScatteredBlocks*' 'RelightRandom.Sea*' 'RelightRandom.Solid*'
    'Seeds/Convergence.EverybodyHasTheServersWorld/1*' 'Shaders.ReferenceCompiler*' 'ShadowAcneTest*' 'ShapeSurface.CoversEachPart*'
    'SimulationTest.NothingIsLost*' 'Sites*' 'TallHolesTest*' 'TilesOfArea.Seen*' 'TitleTest*' 'Utf8.ExactlyTheCodes*'
    'Voronoi3D.EverySample*' 'Wilderness*'
)
# Also cases of objects that threads do not share.
readonly LONG_THREADS=(
    'Checksum*' 'ChunkCodec*' 'EditedTiles*' 'HostileSave*' 'LogCheck*' 'Sites*' 'SwollenSave*'
)
# Tests of CTest that do not run here: real windows, databases, kills and limits of memory; pictures of the program are the same
# without a sanitizer.
readonly ELSEWHERE='^(app[.](browser|bench|formats|hostile_save|memory|postgres|python|record|render|together|window)_test|app[.]random_player|.*kill_test|net_postgres|store_postgres|package|tools|docs|check_|compare)'
# And those that run only at full depth: scripts that start the program a hundred times.
readonly SCRIPTS='^app[.].*_test$'

fail() {
    echo "sanitizers: $*" >&2
    exit 1
}

# Clang builds these twice as fast as GCC does.
configure() {
    cmake --preset "$1" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld -DCMAKE_UNITY_BUILD=ON \
        --log-level=WARNING "${@:2}"
}

# "Suite.Case" of all cases of the programs in FOLDER.
list_cases() {
    local program
    for program in "$1"/*_tests; do
        "$program" --gtest_list_tests | awk '/^[^ ]/ { suite = $1; next } { print suite $1 }'
    done
}

# test_without FOLDER PATTERN… -- OPTION…: runs the tests that CTest's options select, without the cases that match a pattern.
test_without() {
    local folder=$1 patterns=() pattern cases
    shift
    while [[ $1 != -- ]]; do
        patterns+=("$1")
        shift
    done
    if [[ ${TERRANE_DEPTH:-} == all ]]; then
        patterns=()
    else
        cases=$(list_cases "$folder")
        for pattern in "${patterns[@]}"; do
            [[ $'\n'$cases == *$'\n'$pattern* ]] || fail "no case is named $pattern"
        done
    fi
    local IFS=:
    TERRANE_WITHOUT="${patterns[*]}" ctest --test-dir "$folder" --output-on-failure --no-tests=error --parallel 2 "${@:2}"
}

# The driver's own memory is not ours to free: tests/leaks.supp.
address() {
    local seconds=60 elsewhere=$ELSEWHERE
    [[ ${TERRANE_DEPTH:-} == all ]] || seconds=0 elsewhere+="|$SCRIPTS"
    configure asan -DTERRANE_FUZZ=ON -DTERRANE_PYTHON=OFF
    cmake --build build-asan
    FUZZ_BUILD=build-asan tools/fuzz.sh $seconds
    LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0" \
        test_without build-asan "${LONG_ADDRESS[@]}" -- --exclude-regex "$elsewhere"
}

threads() {
    configure tsan
    cmake --build build-tsan --target base_tests store_tests stream_tests game_tests
    test_without build-tsan "${LONG_THREADS[@]}" -- --tests-regex '^(base|store|stream|game)[.]' --exclude-regex "$ELSEWHERE"
}

parts=("$@")
[[ $# -gt 0 ]] || parts=(address threads)
for part in "${parts[@]}"; do
    [[ $part =~ ^(address|threads)$ ]] || fail "no part $part; there are address, threads"
done
for part in "${parts[@]}"; do
    echo "sanitizers: $part"
    "$part"
done
