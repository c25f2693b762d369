#!/usr/bin/env bash
# Flies 20 s at full speed at view distances 16 and 32, once while the world is generated and once from a save, and plots
# the time of each frame, next to frames from the same places with everything loaded. Usage: tools/flight_trace.sh [PROGRAM [FOLDER [tall]]]
# (build/terrane, out/flight). With "tall" it flies from the ground of a tall world to 1,400 and from there down into the ground instead, without a plot.
# Offscreen at 320x180, so that software rendering does not dominate. tools/flight_plot.py draws the plot.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=$(realpath "${1:-build/terrane}")
plot=$PWD/tools/flight_plot.py
examples=$PWD/examples/lua
folder=${2:-out/flight}
mkdir -p "$folder"
cd "$folder"
rm -f {standing,generating,filling,from_disk}_{16,32}.csv
export XDG_DATA_HOME=$PWD

fly() {
    local name=$1 distance=$2
    shift 2
    echo "$name" >&2
    "$program" flight-bench --generator overworld --size 320x180 --preset low --view-distance "$distance" --trace "$name.json" -o "$name.csv" "$@"
}

# Measures frames without loading at the positions of the flight after 0, 2, … 20 s.
stand() {
    local distance=$1 at frame
    for second in {0..20..2}; do
        at=$((8 + 424 * second / 10))
        frame=$("$program" render --generator overworld --at "$at,$at,120" --look 45,0 --time 0.4 --size 320x180 --preset low \
            --view-distance "$distance" --frames 9 --json -o place.png | grep -o '"frame":[0-9.]*')
        echo "$second,${frame#*:}"
    done >"standing_$distance.csv"
}

# At 60 blocks per second: 1,250 blocks up, and 1,500 down, of which the last hundreds are caves and stone.
if [[ "${3:-}" == tall ]]; then
    for distance in 8 16; do
        for way in up down; do
            height=150 seconds=21
            [[ $way == down ]] && height=1400 seconds=25
            echo "$way, view distance $distance" >&2
            "$program" flight-bench --generator examples:tall --content "$examples" --at "0,0,$height" --look 45,-20 --way "$way" \
                --duration "$seconds" --size 320x180 --preset low --view-distance "$distance" -o "tall_${way}_$distance.csv"
        done
    done
    exit
fi

for distance in 16 32; do
    echo "standing, view distance $distance" >&2
    stand "$distance"
    fly "generating_$distance" "$distance"
    # The first flight fills the save; the second one reads the same chunks.
    fly "filling_$distance" "$distance" --world "flight_$distance" --recreate --duration 25
    fly "from_disk_$distance" "$distance" --world "flight_$distance"
done

"$plot" .
echo "$PWD/flight.svg"
