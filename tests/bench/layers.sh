#!/usr/bin/env bash
# Separates real layers at two gaps and prints a table; then checks each written layer and compares the counts. Seconds
# are CPU seconds of one thread, reading and writing included. LAYERS.md summarises the record in layers/, which is made
# by
#
#   layers.sh | python3 tests/bench/record.py tests/bench/layers layers
#
#   layers.sh [NAME ...]       all of the layers below unless some are named
#
#   SUNDER_BUILD          build directory (./build/release)
#   SUNDER_BENCH_DATA     folder of the layers (../shared/data beside the repository)
#   SUNDER_BENCH_GAPS     gaps in metres ("0 3")
#   SUNDER_BENCH_LIMIT    seconds a run may take (300)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sunder=${SUNDER_BUILD:-$source_dir/build/release}/sunder
data=${SUNDER_BENCH_DATA:-$source_dir/../shared/data}
read -r -a gaps <<<"${SUNDER_BENCH_GAPS:-0 3}"
limit=${SUNDER_BENCH_LIMIT:-300}
[[ -d $data ]] || { echo "layers.sh: no $data; set SUNDER_BENCH_DATA" >&2; exit 77; }
for tool in jq /usr/bin/time; do
  command -v $tool >/dev/null || { echo "layers.sh: no $tool" >&2; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# name, data source, layer, options
layers() {
  cat <<LIST
liechtenstein|$data/liechtenstein_2015.gpkg|buildings|
neuss|$data/neuss_2026.gpkg|buildings|
krems|$data/krems_2013.gpkg|buildings|
saint_jean|$data/saint_jean_la_poterie.gpkg|buildings|
baltimore|/vsizip/$data/baltimore_2015_shp.zip|buildings|
jakarta|/vsizip/$data/jakarta_2012_shp.zip|structures|
paris|$data/paris_cite_2014.gpkg|buildings|
jakarta_ignore|/vsizip/$data/jakarta_2012_shp.zip|buildings_overlapping|--contained ignore
jakarta_separate|/vsizip/$data/jakarta_2012_shp.zip|buildings_overlapping|--contained separate --max-shift 20
LIST
}

between='.conflicts.BLOCK | .overlap + .too_close + .barrier + .contained + .duplicate'
counts='[.overlap, .too_close, .barrier, .contained, .duplicate, .inside_blocks] | map(tostring) | join(" ")'

run() {
  local name=$1 input=$2 layer=$3 gap=$5 status=0 agrees
  local -a options
  read -r -a options <<<"$4"
  local out=$scratch/$name.gpkg stats=$scratch/$name.json check=$scratch/$name.check.json
  timeout "$limit" /usr/bin/time -q -f '%U %S' -o "$scratch/time" "$sunder" separate --quiet --overwrite --threads 1 \
    --gap "$gap" --input-layer "$layer" "${options[@]}" --stats "$stats" "$input" "$out" 2>"$scratch/err" || status=$?
  if [[ $status -ne 0 && $status -ne 3 ]]; then
    echo "| $name | $gap | failed with $status: $(tail -n 1 "$scratch/err") |"
    return
  fi
  timeout "$limit" "$sunder" check --quiet --gap "$gap" --input-layer "$layer" --no-blocks --block-field sunder_blk \
    $(printf '%s\n' "${options[@]}" | paste -sd' ' | sed 's/--max-shift [0-9.]*//') --stats "$check" "$out" >"$scratch/lines" 2>"$scratch/err" || true
  agrees=no
  [[ $(jq -r ".conflicts.after | $counts" "$stats") == $(jq -r ".conflicts | $counts" "$check") ]] && agrees=yes
  jq -r --arg name "$name" --arg options "$4" --arg gap "$gap" --arg agrees "$agrees" \
    --arg seconds "$(awk '{ print $1 + $2 }' "$scratch/time")" '
    def r(d): . * pow(10; d) | round / pow(10; d);
    "| \($name) | \($options) | \(.features) | \($gap) | \('"${between/BLOCK/before}"') | \('"${between/BLOCK/after}"') | \(.conflicts.after.inside_blocks) | \(.moved) | \(.blocked) | \(.displacement.total | r(1)) | \(.displacement.mean | r(3)) | \(.displacement.max | r(2)) | \(.displacement.cost | r(1)) | \(.displacement.lower_bound | r(1)) | \($agrees) | \($seconds) | \(.peak_rss_bytes / 1e6 | r(0)) |"' "$stats"
}

echo "| layer | options | features | gap m | conflicts before | left | inside blocks | moved | blocked | sum of moves m | mean m | longest m | cost m2 | bound m2 | check agrees | s | MB |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
while IFS='|' read -r name input layer options; do
  if [[ $# -gt 0 && " $* " != *" $name "* ]]; then continue; fi
  for gap in "${gaps[@]}"; do run "$name" "$input" "$layer" "$options" "$gap"; done
done < <(layers)
