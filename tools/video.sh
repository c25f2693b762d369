#!/bin/sh
# Makes the video of the project: tools/video.sh [OUTPUT.mp4 [flags of terrane record…]]
# On a graphics card this takes minutes; a software renderer takes hours, there try:
#   tools/video.sh small.mp4 --size 320x180 --fps 10 --view-distance 12 --samples 1 --shadows near
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
output=${1:-tour.mp4}
[ $# -eq 0 ] || shift

"$root/run" build
cmake -S "$root" -B "$root/build" -G Ninja -DTERRANE_EXAMPLES=ON --log-level=WARNING
cmake --build "$root/build" --target village
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$root/build/village" "$folder/hamlet.sqlite" 3466,-1690
"$root/build/terrane" record --path "$root/examples/paths/tour.toml" --world "$folder/hamlet.sqlite" -o "$output" "$@"
