#!/usr/bin/env bash
# Builds Terrane twice, with and without graphics, makes its four Debian packages and prints their paths: terrane,
# terrane-server, libterrane-dev, python3-terrane.
#
#   tools/packages.sh [OUT]    the folder of the packages (out/packages)
#
# Needs what ./run build installs, and: apt install dpkg-dev file pybind11-dev python3-dev python3-numpy
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly OUT=${1:-out/packages}

# build_packages FOLDER PACKAGES OPTION…: builds into FOLDER; the packages of these names are there afterwards.
build_packages() {
    local folder=$1 names=$2 name made
    cmake -S . -B "$folder" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
        -DTERRANE_ASSERTIONS=OFF -DTERRANE_TESTS=OFF -DTERRANE_BENCHMARKS=OFF "${@:3}"
    cmake --build "$folder"
    rm -f "$folder"/*.deb
    (cd "$folder" && cpack -G DEB >cpack.log) || { cat "$folder/cpack.log" >&2; exit 1; }
    for name in $names; do
        made=$(compgen -G "$folder/${name}_*.deb") || { echo "packages: $name was not made: see $folder/cpack.log" >&2; exit 1; }
        cp "$made" "$OUT/"
        echo "$OUT/${made##*/}"
    done
}

mkdir -p "$OUT"
build_packages build-packages 'terrane libterrane-dev python3-terrane'
build_packages build-packages-server terrane-server -DTERRANE_GRAPHICS=OFF -DTERRANE_PYTHON=OFF
