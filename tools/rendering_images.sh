#!/usr/bin/env bash
# Draws the images of docs/rendering.md but that of layers: tools/rendering_images.sh [PROGRAM [FOLDER]]
# (build/terrane, docs/images). Needs ImageMagick.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$(realpath "${1:-$root/build/terrane}")
folder=$(realpath "${2:-$root/docs/images}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

draw() {
    local name=$1
    shift
    "$program" render --generator overworld --preset high --view-distance 24 --size 960x540 --seconds 3 "$@" -o "$name.png"
}
save() {
    convert "$1.png" -quality 88 "$folder/render_$1.jpg"
}
beside() {
    montage "$2.png" "$3.png" -tile 2x -geometry 640x360+2+2 "$1.png"
    save "$1"
}

draw glade --at -87.5,-87.5,88.6 --look 180,-3 --time 0.36
save glade
draw mountain --at -1160,-70,140 --look 120,9 --time 0.66
save mountain
draw desert --at 530,340,110 --look -50,-12 --time 0.5
save desert
draw river --at -180,60,120 --look 152,-28 --time 0.42
save river
draw cave --at -120,206,108 --look 88,-8 --time 0.5
save cave
draw ocean --scene ocean --time 0.79
save ocean

"$program" render --generator continents --preset high --view-distance 16 --size 960x540 --at=3650,-2100,200 --look=62,-9 --time 0.225 -o dawn.png
save dawn

# The hamlet by the sea of the example program, if it was built.
village=$(dirname "$program")/village
if [[ -x "$village" ]]; then
    "$village" hamlet.sqlite 3466,-1690
    "$program" render --world hamlet.sqlite --preset high --view-distance 8 --size 960x540 --at=3395,-1712,92 --look=30,-14 \
        --time 0.81 -o village.png
    save village
fi

for time in 0.215 0.5 0.79 0.93; do draw "at_$time" --at -625,128,98 --look 12,6 --time "$time"; done
montage at_*.png -tile 2x -geometry 640x360+2+2 times.png
save times

draw horizon --horizon 1024 --detail 24 --at -1160,-70,200 --look 120,-7 --time 0.3
save horizon

draw rays --at 975,1104,87.5 --look 176,4 --time 0.235
save rays

draw open --at -120,206,108 --look 88,-8 --time 0.5 --ssao off
draw occluded --at -120,206,108 --look 88,-8 --time 0.5 --ssao on
beside ssao open occluded
draw sharp --at -1125,35,168 --look 60,-8 --time 0.4 --depth-of-field off
draw blurred --at -1125,35,168 --look 60,-8 --time 0.4 --depth-of-field on
beside depth_of_field sharp blurred
