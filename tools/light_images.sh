#!/bin/sh
# Draws the images of docs/light.md: tools/light_images.sh [BUILD_FOLDER [OUTPUT_FOLDER]]
# The build needs -DTERRANE_EXAMPLES=ON.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build}
out=${2:-$root/docs/images}

"$build/light_images" "$out"
"$build/terrane" render --scene landscape --time 0.815 --size 640x360 --view-distance 12 -o "$out/light_dusk.png"
"$build/terrane" render --generator overworld --at 992,1092,89 --look 176,5 --time 0.085 --size 640x360 --view-distance 12 \
    -o "$out/light_night.png"
