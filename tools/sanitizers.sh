#!/usr/bin/env bash
# Builds the tests without graphics under Clang's sanitizers and runs them.
#
#   tools/sanitizers.sh [PART…]    all parts unless some are named
#
#   blocks     address, undefined behavior: base, shared, world, content, sound, store, light, mesh, stream, faults
#   land       the same: gen, lua, map, volume, formats, pack
#   servers    the same: game, net, databases, web, and the program without graphics with its scripts
#   threads    the thread sanitizer: base, store, stream, game, whose objects threads share
#
# Each part of the address sanitizer also runs the fuzzers of its modules for three seconds on the inputs that tests/fuzz
# keeps and on new ones; tools/fuzz.sh 600 runs longer, in a build that guides them. Needs clang, libclang-rt-dev, lld.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Tests that take long under a sanitizer and run no code that other tests do not: the character of generated land,
# searches of numbers, whole meshes and maps, shares of what is built, long random plays, database servers and scripts
# about them.
readonly LONG_BLOCKS=(
    base.Utf8.ExactlyTheCodes faults.SimulationTest.NothingIsLost light.BatchLighter.DoesWhat
    light.LightChunk.EqualsTheReferenceOfALarger light.RelightRandom.Caves light.RelightRandom.Layers
    light.RelightRandom.ScatteredBlocks light.RelightRandom.Sea light.RelightRandom.Solid mesh.All/MixAndMethod
    store.ChecksumTest.OneFlippedBit stream.Sites world.CollisionTest.NeverTunnels world.Downsample.WhatIsEqualStays
    world.LiquidProperty world.RayCast.Equals world.ShapeSurface.CoversEachPart
)
readonly LONG_LAND=(
    gen.Areas/Overworld gen.Catalogue.AVersion gen.ContinentsLand.IsWhereWorldsBegin gen.ContinentsLevels gen.ExprMath
    gen.Overworld gen.Places/Continents gen.Voronoi3D.EverySample lua.Examples.HaveTheirBlocks
    lua.Generators/ScriptEqualsCpp map.AreaImageTest.EveryLevelHasOne map.GeneratedSurface.IsThatOfTheWholeChunk
    map.MapPainter.AnEditChangesTheTiles map.MapPainter.FactsOfAColumn map.MapPainter.TilesFitTogether
    map.TilesOfArea.Seen
)
readonly LONG_SERVERS=(
    app.formats_test app.postgres_test net_postgres net.Seeds/Convergence.EverybodyHasTheServersWorld/1
    net.Seeds/Convergence.EverybodyHasTheServersWorld/2 net.server_kill_test store_postgres.work_kill_test
)
# Also tests of objects that threads do not share.
readonly LONG_THREADS=(
    store.ChunkCodec store.Checksum store.HostileSave store.LogCheck store.SwollenSave store.kill_test stream.Sites
    stream.EditedTiles
)

fail() {
    echo "sanitizers: $*" >&2
    exit 1
}

# Clang builds these twice as fast as GCC does.
configure() {
    cmake --preset "$1" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld -DCMAKE_UNITY_BUILD=ON \
        --log-level=WARNING "${@:2}"
}

# test_without FOLDER NAME… -- OPTION…: runs the tests that CTest's options select, without those whose names begin with
# one of NAME. CTest ignores a pattern that it does not understand (one with more than nine groups, for example), so the
# patterns have no groups, and each is tried.
test_without() {
    local folder=$1 name pattern=''
    shift
    while [[ $1 != -- ]]; do
        name="^${1//./[.]}"
        ctest --test-dir "$folder" --show-only --tests-regex "$name" | grep -q 'Total Tests: [1-9]' || fail "no test is named $1…"
        pattern+="${pattern:+|}$name"
        shift
    done
    ctest --test-dir "$folder" --output-on-failure --no-tests=error --parallel 2 --exclude-regex "$pattern" "${@:2}"
}

# address PATTERN TARGETS FUZZERS NAME…: builds and runs fuzzers and the tests whose names match, without those whose names
# begin with NAME.
address() {
    local pattern=$1 targets=($2) fuzzers=($3)
    configure asan -DTERRANE_FUZZ=ON
    cmake --build build-asan --target "${targets[@]}" "${fuzzers[@]/#/fuzz_}"
    FUZZ_BUILD=build-asan tools/fuzz.sh 3 "${fuzzers[@]}"
    test_without build-asan "${@:4}" -- --label-regex unit --tests-regex "$pattern"
}

# Scripts that kill programs belong to the part that builds the program.
blocks() {
    address '^(base|shared|world|content|sound|store|light|mesh|stream|faults)[.]' \
        'base_tests shared_tests world_tests content_tests sound_tests store_tests light_tests mesh_tests stream_tests faults_tests' \
        'blocks bookmarks chunk_codec languages path_file save_pages save_rows settings structure_file textures waves' \
        "${LONG_BLOCKS[@]}" store.kill_test
}

land() {
    address '^(gen|lua|map|volume|formats|pack)[.]' 'gen_tests lua_tests map_tests volume_tests formats_tests pack_tests' \
        'lua nbt pack region schem surface_codec vox' "${LONG_LAND[@]}"
}

servers() {
    address '^(app|game|net|web|maps|store_postgres|net_postgres)($|[.])|^store[.]kill_test' \
        'terrane save_loop game_tests net_tests web_tests maps_tests store_postgres_tests' \
        'messages server_session target' "${LONG_SERVERS[@]}"
}

threads() {
    configure tsan
    cmake --build build-tsan --target base_tests store_tests stream_tests game_tests
    test_without build-tsan "${LONG_THREADS[@]}" -- --tests-regex '^(base|store|stream|game)[.]'
}

parts=("$@")
[[ $# -gt 0 ]] || parts=(blocks land servers threads)
for part in "${parts[@]}"; do
    [[ $part =~ ^(blocks|land|servers|threads)$ ]] || fail "no part $part; there are blocks, land, servers, threads"
done
for part in "${parts[@]}"; do
    echo "sanitizers: $part"
    "$part"
done
