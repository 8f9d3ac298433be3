#!/usr/bin/env bash
# Common inputs on which geometry code is slow, at three sizes each: seconds, peak memory and growth.
#
#   hard.sh [--instructions] [ROW ...]     all rows unless some are named, as in the first column
#
# Seconds are processor time (user and system) of the whole command. With --instructions it prints millions of
# instructions instead, counted by callgrind, minus those of a command that has nothing to do: they are the same on
# every machine, loaded or not. Growth is the exponent in the size between a row and the one above it. `times` is the
# ratio to the row's plain twin: the same shapes without the defect, or the same layer without the feature that has to
# move far. hard_inputs.py makes the inputs and says what is hard about them.
#
#   SUNDER_BUILD             build directory (./build/release)
#   SUNDER_BENCH_LIMIT       seconds that a command may take (60; under callgrind 900)
#   SUNDER_BENCH_TIMES       factor of all sizes (1)
#   SUNDER_BENCH_HARD        a folder of further inputs, NAME.wkt with P and Q in two lines (../shared/hard beside the repository,
#                            if it is there): rows `file`
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_dir=$(cd "$here/../.." && pwd)
sunder=${SUNDER_BUILD:-$source_dir/build/release}/sunder
counting=false
if [[ ${1:-} == --instructions ]]; then counting=true; shift; fi
limit=${SUNDER_BENCH_LIMIT:-$($counting && echo 900 || echo 60)}
hard=${SUNDER_BENCH_HARD:-$source_dir/../shared/hard}
[[ -x $sunder ]] || { echo "hard.sh: no $sunder; set SUNDER_BUILD" >&2; exit 77; }
command -v python3 >/dev/null || { echo "hard.sh: python3 is not installed" >&2; exit 77; }
command -v ogr2ogr >/dev/null || { echo "hard.sh: ogr2ogr is not installed" >&2; exit 77; }
if $counting; then command -v valgrind >/dev/null || { echo "hard.sh: valgrind is not installed" >&2; exit 77; }; fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wanted=("$@")

# Runs a command; prints "seconds megabytes", or how it failed.
measure() {
  python3 - "$limit" "$@" <<'PYTHON'
import os, resource, subprocess, sys
limit = float(sys.argv[1])
child = subprocess.Popen(sys.argv[2:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30)))
try:
    child.wait(limit)
    status = child.returncode
except subprocess.TimeoutExpired:
    child.kill()
    child.wait()
    status = None
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print("%.3f" % (used.ru_utime + used.ru_stime), round(used.ru_maxrss / 1000),
      "" if status in (0, 3) else "stopped" if status is None else "status %d" % status)
PYTHON
}

# Runs a command and prints its millions of instructions minus those of an idle run, "-", and how it ended.
count() {
  local note='' status=0
  timeout "$limit" valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" >/dev/null 2>"$scratch/counted" || status=$?
  case $status in 0 | 3) ;; 124) note=stopped ;; *) note="status $status" ;; esac
  awk -v idle="${idle:-0}" -v note="$note" '/Collected/ { n = $NF } END { printf "%.1f - %s\n", n / 1e6 - idle, note }' "$scratch/counted"
}

# The input of a measurement: P and Q in files, or a layer in $scratch/in.gpkg.
prepare() {
  local kind=$1 size=$2
  rm -rf "$scratch"/in.* "$scratch"/[pq].wkt "$scratch"/out.*
  python3 "$here/hard_inputs.py" "$kind" "$size" >"$scratch/in.csv"
  if [[ $(head -c 3 "$scratch/in.csv") == WKT ]]; then
    ogr2ogr -f GPKG "$scratch/in.gpkg" "$scratch/in.csv" -a_srs EPSG:25832 -nln features -oo AUTODETECT_TYPE=YES \
      -oo KEEP_GEOM_COLUMNS=NO -nlt POLYGON
  else
    head -n 1 "$scratch/in.csv" >"$scratch/p.wkt"
    tail -n 1 "$scratch/in.csv" >"$scratch/q.wkt"
  fi
}

between_sizes() { awk -v a="$1" -v b="$2" -v m="$3" -v n="$4" 'BEGIN { if (a > 0 && b > 0 && m) printf "%.1f", log(b / a) / log(n / m); else printf "-" }'; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { if (a > 0) printf "%.1f", b / a; else printf "-" }'; }

# name | kind | its plain twin, or - | sizes | command, with IN for the layer, P and Q, OUT
rows() {
  cat <<'LIST'
bows-pair|bows|arcs|500 1000 2000|pair P Q
bows4-pair|bows4|arcs|500 1000 2000|pair P Q
bows-gap|bows|arcs|500 1000 2000|pair P Q --gap 3
bows4-gap|bows4|arcs|500 1000 2000|pair P Q --gap 3
scribble-sum|scribble|-|40 80 160|sum P Q --stats -
track-sum|track|-|500 1000 2000|sum P Q --stats -
bows-route|houses-bows|houses|3000 6000 11700|route IN --robot disc:2m --from=451220,5411220 --to=452000,5412000
versions-sum|versions|-|6 12 24|sum P Q --stats -
versions-disc|versions|-|6 12 24|sum P disc:5 --stats -
versions-dissolve|versions-layer|-|6 12 24|buffer IN OUT --dissolve --shape disc:5
slivers-sum|slivers|-|4 8 16|sum P Q --stats -
pile-sum|pile|-|70 139 278|sum P Q --stats -
heap-dilate|heap|-|70 139 278|buffer IN OUT --dissolve --shape square:4
heap-erode|heap|-|70 139 278|buffer IN OUT --dissolve --operation erode --shape square:4
heap-close|heap|-|70 139 278|buffer IN OUT --dissolve --operation close --shape square:4
far|pairs-far|pairs|1000 4000 16000|separate IN OUT
outline|outline|-|3000 12000 48000|separate IN OUT --gap 3 --max-shift 9 --contained ignore --touch-tolerance 0.1 --fixed-where fixed=1
crowd|crowd-full|crowd|400 1500 6000|separate IN OUT --gap 3 --max-shift 10 --fixed-where fixed=1
detail-sum|detail|-|4000 8000 16000|sum P Q --stats -
stairs-pair|stairs|-|4000 8000 16000|pair P Q
ragged-pair|ragged|-|4000 8000 16000|pair P Q
ragged-gap|ragged|-|4000 8000 16000|pair P Q --gap 3
rough-pair|rough|-|4000 8000 16000|pair P Q
even-pair|even|-|1000 2000 4000|pair P Q
round-pair|round|-|4000 8000 16000|pair P Q
even-round-pair|even-round|-|4000 8000 16000|pair P Q
coast-pair|coast|-|4000 8000 16000|pair P Q
hollow-pair|hollow|-|4000 8000 16000|pair P Q
combs-pair|combs|-|4000 8000 16000|pair P Q
spikes-box|spikes-box|-|4000 8000 16000|pair P Q
copies-pair|copies|-|2000 4000 8000 16000|pair P Q
LIST
}

run() { # kind, size, command
  local words word command=()
  prepare "$1" "$2"
  read -r -a words <<<"$3"
  for word in "${words[@]}"; do
    case $word in
    P) word=@$scratch/p.wkt ;; Q) word=@$scratch/q.wkt ;;
    IN) word=$scratch/in.gpkg ;; OUT) word=$scratch/out.gpkg ;;
    esac
    command+=("$word")
  done
  $figure "$sunder" "${command[0]}" --quiet "${command[@]:1}"
}

chosen() { [[ ${#wanted[@]} -eq 0 || " ${wanted[*]} " == *" $1 "* ]]; }

figure=measure unit=s
if $counting; then
  figure=count unit='million instructions'
  read -r idle _ <<<"$(count "$sunder" pair --quiet 'POLYGON((0 0,1 0,0 1,0 0))' 'POLYGON((9 9,10 9,9 10,9 9))')"
fi
echo "| row | size | $unit | MB | growth | times the plain one | |"
echo "|---|---|---|---|---|---|---|"
while IFS='|' read -r name kind twin sizes command; do
  chosen "$name" || continue
  before='' before_size=''
  for size in $sizes; do
    size=$((size * ${SUNDER_BENCH_TIMES:-1}))
    read -r seconds megabytes note <<<"$(run "$kind" "$size" "$command")"
    times=-
    if [[ $twin != - ]]; then
      read -r plain _ <<<"$(run "$twin" "$size" "$command")"
      times=$(ratio "$plain" "$seconds")
    fi
    echo "| $name | $size | $seconds | $megabytes | $(between_sizes "${before:-0}" "$seconds" "$before_size" "$size") | $times | $note |"
    before=$seconds before_size=$size
  done
done < <(rows)

chosen file || exit 0
for file in "$hard"/*.wkt; do
  [[ -f $file ]] || continue
  name=$(basename "$file" .wkt) options=()
  head -n 1 "$file" >"$scratch/p.wkt"
  tail -n 1 "$file" >"$scratch/q.wkt"
  case $name in
  arcs_* | stairs_* | copies_*) command=pair ;;
  gap_*) command=pair options=(--gap 32) ;;
  *) command=sum options=(--stats -) ;;
  esac
  read -r seconds megabytes note <<<"$($figure "$sunder" "$command" --quiet "${options[@]}" "@$scratch/p.wkt" "@$scratch/q.wkt")"
  echo "| file $name | - | $seconds | $megabytes | - | - | $note |"
done
