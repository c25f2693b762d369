#!/bin/sh
# Makes the video of the project: tools/video.sh [OUTPUT.mp4 [flags of terrane record…]]
# On a graphics card this takes minutes; a software renderer takes hours, there try:
#   tools/video.sh small.mp4 --size 320x180 --fps 10 --view-distance 12 --samples 1 --shadows 1024
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
output=${1:-tour.mp4}
[ $# -eq 0 ] || shift

"$root/run" build
exec "$root/build/terrane" record --path "$root/examples/paths/tour.toml" -o "$output" "$@"
