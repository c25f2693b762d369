#!/usr/bin/env bash
# Draws maps of twelve seeds at three scales, one sheet a scale, to look for patterns, straight borders and rings:
# tools/map_sheets.sh [PROGRAM [FOLDER [GENERATOR]]] (build/terrane, out/maps, wilderness). Needs ImageMagick.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$(realpath "${1:-$root/build/terrane}")
folder=${2:-$root/out/maps}
generator=${3:-wilderness}
mkdir -p "$folder"

# Kilometers across, chunks around 0, 0, and the level at which a map is 384 pixels wide.
while read -r kilometers radius level; do
    maps=()
    for seed in 1 2 3 4 5 6 7 8 9 10 11 12; do
        map=$folder/$kilometers-km-$seed.png
        "$program" map --generator "$generator" --seed "$seed" --area="-$radius,-$radius,$radius,$radius" --level "$level" -o "$map"
        maps+=("$map")
    done
    montage "${maps[@]}" -tile 4x -geometry +4+4 "$folder/$kilometers-km.png"
done <<< "49 1536 7
12 384 5
3 96 3"
