#!/usr/bin/env bash
# Flies 20 s at full speed at view distances 16 and 32, once while the world is generated and once from a save, and plots
# what each frame took, beside frames from the same places with nothing left to load. Usage: tools/flight_trace.sh [PROGRAM [FOLDER]]   (build/terrane, out/flight)
# Offscreen at 320x180, so that drawing in software does not decide. Needs gnuplot.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=$(realpath "${1:-build/terrane}")
folder=${2:-out/flight}
mkdir -p "$folder"
cd "$folder"
rm -f {standing,generating,filling,from_disk}_{16,32}.csv
export XDG_DATA_HOME=$PWD

fly() {
    local name=$1 distance=$2
    shift 2
    echo "$name" >&2
    "$program" fly --size 320x180 --preset low --view-distance "$distance" --trace "$name.json" -o "$name.csv" "$@"
}

# What the land alone takes to draw where the flight is after 0, 2, … 20 s.
stand() {
    local distance=$1 at frame
    for second in {0..20..2}; do
        at=$((8 + 424 * second / 10))
        frame=$("$program" render --at "$at,$at,120" --look 45,0 --time 0.4 --size 320x180 --preset low \
            --view-distance "$distance" --frames 9 --json -o place.png | grep -o '"frame":[0-9.]*')
        echo "$second,${frame#*:}"
    done >"standing_$distance.csv"
}

for distance in 16 32; do
    echo "standing, view distance $distance" >&2
    stand "$distance"
    fly "generating_$distance" "$distance"
    # The first flight fills the save; the second one reads the same chunks.
    fly "filling_$distance" "$distance" --world "flight_$distance" --recreate --for 25
    fly "from_disk_$distance" "$distance" --world "flight_$distance"
done

gnuplot <<'PLOT'
set terminal svg size 1000,760 font "sans,12" background "white"
set output "flight.svg"
set datafile separator ","
set multiplot layout 2,2
set xlabel "s"
set ylabel "ms"
set key top left Left reverse samplen 2
set xrange [0:20]
do for [name in "generating_16 from_disk_16 generating_32 from_disk_32"] {
    set autoscale y  # stats leaves out what is not in the range
    stats name.".csv" using 2 every ::1 name "F" nooutput
    set yrange [0:1.6*F_max]  # with room for the key
    distance = name[strlen(name)-1:strlen(name)]
    set title (name[1:4] eq "from" ? "from a save" : "generating").", view distance ".distance
    plot name.".csv" using 1:2 every ::1 with impulses lc rgb "#9db8d2" title "frame", \
         "" using 1:($6+$7) every ::1 with impulses lc rgb "#c0392b" title "of it loading (processor time)", \
         "standing_".distance.".csv" using 1:2 with lines lw 2 lc rgb "#2e7d32" title "the same place, nothing to load", \
         2*F_median with lines dt 2 lc rgb "#555555" title "twice the median"
}
PLOT
echo "$PWD/flight.svg"
