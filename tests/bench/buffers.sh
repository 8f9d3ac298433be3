#!/usr/bin/env bash
# Buffers compared with other libraries in the same run: GEOS (buffer with 8 quadrant segments compared with our 32-gon,
# mitred buffers with the square; unary union) and CGAL (the best of its Minkowski sums; join), computation only. Then
# houses closed and opened by discs of 8 to 128 segments, whole programs, and opening and closing of a large outline.
#
#   buffers.sh [each] [dissolve] [huts] [programs] [coast]     all unless some are named
#
# Prints Markdown; BUFFERS.md summarises the record in buffers/, which is made by
#
#   buffers.sh | python3 tests/bench/record.py tests/bench/buffers buffers huts programs coast
#
# `cmake --build BUILD --target bench` builds what is needed. Times are CPU seconds of one thread, medians, from doubles
# in memory to the result as doubles, except for the programs (wall-clock time, from file to file). Sunder is measured
# before and after the other library, and the slower of the two counts.
#
#   SUNDER_BUILD           build directory (./build/release)
#   SUNDER_BENCH_DATA      folder of the layers (../shared/data beside the repository); if it is missing, copies of the
#                          small town in datasets-synthetic
#   SUNDER_BENCH_INPUT     folder of the families (../shared/families), for the coast
#   SUNDER_BENCH_SECONDS   seconds to spend on repetitions of one figure (1)
#   SUNDER_BENCH_METHODS   CGAL's methods that are tried (rc full; also ssab hm greene optimal vert tri)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${SUNDER_BUILD:-$source_dir/build/release}
data=${SUNDER_BENCH_DATA:-$source_dir/../shared/data}
families=${SUNDER_BENCH_INPUT:-$source_dir/../shared/families}
methods=${SUNDER_BENCH_METHODS:-rc full}
sunder=$build/sunder
what=" ${*:-each dissolve huts programs coast} "
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[[ -x $build/bench_buffer ]] || { echo "buffers.sh: no $build/bench_buffer; build the target bench, or set SUNDER_BUILD" >&2; exit 1; }
command -v ogr2ogr >/dev/null || { echo "buffers.sh: gdal-bin is not installed" >&2; exit 77; }

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" 2>/dev/null | head -n 1; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { if (a > 0 && b > 0) printf "%.1f", a / b; else print "-" }'; }
larger() { awk -v a="$1" -v b="$2" 'BEGIN { print (a + 0 > b + 0 ? a : b) }'; }

header() {
  local cc
  cc=$(cached CMAKE_C_COMPILER)
  echo "- machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores, $(uname -sr), load $(cut -d' ' -f1 /proc/loadavg)"
  echo "- compiler: $("${cc:-cc}" --version | head -n 1), $(cached CMAKE_BUILD_TYPE) $(cached CMAKE_C_FLAGS_RELEASE) $(cached CMAKE_C_FLAGS)"
  echo "- peers: GEOS $(geos-config --version 2>/dev/null || echo '(not installed)'); CGAL $([[ -x $build/cgal_buffer ]] && sed -n 's/^#define CGAL_VERSION //p' /usr/include/CGAL/version.h 2>/dev/null || echo '(not installed)')"
  echo "- commit: $(git -C "$source_dir" describe --always --dirty 2>/dev/null || echo unknown)"
}

head_of() { # COLUMN...: the head of a table
  printf '| %s ' "$@"
  printf '|\n'
  printf '|---%.0s' "$@"
  printf '|\n'
}

# Valid features only, since libraries that repair invalid ones compute something else.
tiles() { # SOURCE LAYER COPIES STEP OUT: copies of a layer side by side, as a GeoPackage and as lines of WKT
  local geometry=geom
  rm -f "$5.gpkg"
  ogr2ogr -q -f GPKG "$5.gpkg" "$1" -nln features -dialect SQLite -nlt MULTIPOLYGON -sql \
    "WITH RECURSIVE k(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM k WHERE i < $3 - 1)
     SELECT CastToMulti(ST_Translate($geometry, (i % 20) * $4.0, (i / 20) * $4.0, 0.0)) AS $geometry FROM \"$2\", k WHERE ST_IsValid($geometry)" 2>/dev/null
  ogr2ogr -q -f CSV /vsistdout/ "$5.gpkg" features -lco GEOMETRY=AS_WKT | sed -n 's/.*\(MULTIPOLYGON [^"]*\)".*/\1/p' >"$5.txt"
}

prepare() {
  if [[ -d $data ]]; then
    tiles "$data/liechtenstein_2015.gpkg" buildings 12 30000 "$scratch/liechtenstein_x12"
    tiles "$data/liechtenstein_2015.gpkg" buildings 1 0 "$scratch/liechtenstein"
    tiles "$data/paris_cite_2014.gpkg" buildings 1 0 "$scratch/paris"
    large=liechtenstein_x12 medium=liechtenstein dense=paris
  else
    echo "no $data: copies of the synthetic town instead"
    tiles "$source_dir/datasets-synthetic/town.gpkg" buildings 358 3000 "$scratch/town_x358"
    tiles "$source_dir/datasets-synthetic/town.gpkg" buildings 20 200 "$scratch/town_dense"
    large=town_x358 medium=town_dense dense=town_dense
  fi
  local name
  for name in $medium $dense; do # only what CGAL can do: it fails on some polygons with holes, and is slow
    awk 'index($0, "),(") == 0 && n++ < 2000' "$scratch/$name.txt" >"$scratch/${name}_2000.txt"
  done
}

# Sets best and best_method.
best_of_cgal() {
  local method line
  best='' best_method=-
  for method in $methods; do
    line=$(timeout 120 "$build/cgal_buffer" "$method" "$1" "$2" "$3" 2>/dev/null) || continue
    if [[ -z $best ]] || awk -v a="${line##* }" -v b="$best" 'BEGIN { exit !(a < b) }'; then
      best=${line##* } best_method=$method
    fi
  done
}

row() { # each|dissolve|close|open SHAPE NAME geos|cgal
  local file=$scratch/$3.txt first second ours theirs peer='GEOS'
  local -a fields
  [[ -x $build/$4_buffer ]] || return 0
  first=$("$build/bench_buffer" "$1" "$2" "$file")
  if [[ $4 == geos ]]; then
    theirs=$("$build/geos_buffer" "$1" "$2" "$file" 2>/dev/null) && theirs=${theirs##* } || theirs=failed
  else
    best_of_cgal "$1" "$2" "$file"
    theirs=${best:-failed} peer="CGAL $best_method"
  fi
  second=$("$build/bench_buffer" "$1" "$2" "$file")
  ours=$(larger "${first##* }" "${second##* }")
  read -r -a fields <<<"$first"
  printf '| %s | %s | %s | %s | %s | %s | %.3f | %s | %s | %s |\n' "$1" "$3" "$2" "${fields[0]}" "${fields[1]}" "${fields[2]}" "$ours" "$theirs" \
    "$(ratio "$theirs" "$ours")" "$peer"
}

compute() {
  local how=$1 shape name
  local -a layers=("$large" "$dense")
  if [[ $how == dissolve && $medium != "$dense" ]]; then layers=("$large" "$medium" "$dense"); fi
  for shape in disc:5:32 square:6; do
    for name in "${layers[@]}"; do row "$how" "$shape" "$name" geos; done
  done
  for shape in disc:5:32 square:6; do
    for name in $(printf "%s\n" "$medium" "$dense" | uniq); do row "$how" "$shape" "${name}_2000" cgal; done
  done
}

huts() {
  local operation segments
  python3 "$source_dir/tests/bench/huts.py" 6000 >"$scratch/huts.txt"
  for operation in close open; do
    for segments in 8 32 64 128; do row $operation disc:2:$segments huts geos; done
  done
}

wall() { # wall-clock seconds of a command
  local start=$EPOCHREALTIME
  "$@" >/dev/null 2>"$scratch/err" || { echo failed; return; }
  awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.2f", b - a }'
}

program_row() { # LABEL OPTIONS NAME SQL
  local first theirs second ours
  local -a options
  read -r -a options <<<"$2"
  first=$(wall "$sunder" buffer --quiet --overwrite --threads 1 "${options[@]}" "$scratch/$3.gpkg" "$scratch/ours.gpkg")
  rm -f "$scratch/theirs.gpkg"
  theirs=$(wall ogr2ogr -f GPKG "$scratch/theirs.gpkg" "$scratch/$3.gpkg" -nln grown -nlt MULTIPOLYGON -dialect SQLite -sql "$4")
  second=$(wall "$sunder" buffer --quiet --overwrite --threads 1 "${options[@]}" "$scratch/$3.gpkg" "$scratch/ours.gpkg")
  ours=$(larger "$first" "$second")
  echo "| $1 | $3 | $ours | $theirs | $(ratio "$theirs" "$ours") |"
}

programs() {
  printf '\nWhole programs, GeoPackage to GeoPackage, disc:5:32, seconds on the wall: sunder buffer --threads 1, ogr2ogr with SpatiaLite (GEOS)\n\n'
  head_of how layer 'sunder s' 'ogr2ogr s' ratio
  program_row each '--shape disc:5:32' "$large" 'SELECT CastToMulti(ST_Buffer(geom, 5, 8)) AS geom FROM features'
  program_row dissolve '--dissolve --shape disc:5:32' "$dense" 'SELECT CastToMulti(ST_Union(ST_Buffer(geom, 5, 8))) AS geom FROM features'
}

coast() {
  local size operation file
  printf '\nsunder buffer on one outline, by a 32-gon: user and system CPU seconds, files included, and peak memory\n\n'
  head_of outline operation s MB
  for size in 1000 10000 100000; do
    file=$families/coast32_$size.txt
    if [[ ! -r $file ]]; then echo "no $file"; continue; fi
    { echo 'WKT,id'; sed -n '1s/.*/"&",1/p' "$file"; } >"$scratch/coast.csv"
    sed -n 2p "$file" >"$scratch/brush.wkt"
    rm -f "$scratch/coast.gpkg"
    ogr2ogr -q -f GPKG "$scratch/coast.gpkg" "$scratch/coast.csv" -nln coast -nlt MULTIPOLYGON -a_srs EPSG:25832 2>/dev/null
    for operation in dilate erode open close; do
      /usr/bin/time -f '%U %S %M' -o "$scratch/time" "$sunder" buffer --quiet --overwrite --operation $operation --shape "@$scratch/brush.wkt" \
        "$scratch/coast.gpkg" "$scratch/ours.gpkg" || echo '0 0 0' >"$scratch/time"
      awk -v name="coast32_$size" -v what=$operation '{ printf "| %s | %s | %.2f | %.0f |\n", name, what, $1 + $2, $3 / 1000 }' "$scratch/time"
    done
  done
}

header
if [[ $what == *\ each\ * || $what == *\ dissolve\ * || $what == *\ programs\ * ]]; then prepare; fi
columns=(how layer shape features vertices out 'Sunder s' 'peer s' ratio peer)
if [[ $what == *\ each\ * || $what == *\ dissolve\ * ]]; then
  printf '\nGrown polygons; ratio: the time of the peer by that of Sunder\n\n'
  head_of "${columns[@]}"
  if [[ $what == *\ each\ * ]]; then compute each; fi
  if [[ $what == *\ dissolve\ * ]]; then compute dissolve; fi
fi
if [[ $what == *\ huts\ * ]]; then
  printf '\nHuts closed and opened\n\n'
  head_of "${columns[@]}"
  huts
fi
if [[ $what == *\ programs\ * ]]; then programs; fi
if [[ $what == *\ coast\ * ]]; then coast; fi
