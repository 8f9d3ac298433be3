#!/usr/bin/env bash
# Compares sums with CGAL's, exactly: the area of every golden case, of the cases and small families in ../shared if
# they are there, and of the families made by sunder-families, by CGAL's reduced convolution, and by all of our
# algorithms.
#
#   agree.sh            needs a build with cgal_sum, sunder, sunder-families and test_golden: SUNDER_BUILD (build/release)
#
# Degenerate holes have no area, and CGAL drops them. If areas differ, the oracle of tests/support decides, which shares
# no code with either library. Ends with 1 if the oracle contradicts our result, with 77 if CGAL is not installed.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${SUNDER_BUILD:-$source/build/release}
for tool in cgal_sum sunder sunder-families; do
  [[ -x $build/$tool ]] || { echo "agree.sh: no $build/$tool" >&2; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

inputs() {
  local family size seed file
  ls "$source"/tests/golden/*.wkt
  ls "$source"/../shared/cases/*.wkt 2>/dev/null || true
  ls "$source"/../shared/families/*_{10,20,50}.txt 2>/dev/null || true
  for family in convex comb fork slanted-fork covered-fork star random robot fat-grid fat-cover tight buildings coast overlap; do
    for size in 12 30; do
      for seed in 1 2 3; do
        file=$scratch/$family-$size-$seed.wkt
        "$build/sunder-families" "$family" --size $size --seed $seed >"$file"
        echo "$file"
      done
    done
  done
}

same=0 differ=0 unable=0 wrong=0
geometry='[.polygons, .degenerate_segments, .degenerate_points]'
while read -r file; do
  grep -v '^$' "$file" | sed -n 1p >"$scratch/p"
  grep -v '^$' "$file" | sed -n 2p >"$scratch/q"
  ours=$("$build/sunder" sum --exact "@$scratch/p" "@$scratch/q" | jq -r .result.area)
  for road in arrangement incremental divide; do
    area=$("$build/sunder" sum --exact --algorithm $road "@$scratch/p" "@$scratch/q" | jq -r .result.area)
    [[ $area == "$ours" ]] || { echo "$(basename "$file"): $road has area $area, convolution $ours"; wrong=$((wrong + 1)); }
  done
  if ! theirs=$(timeout 60 "$build/cgal_sum" rc "$file" area 2>/dev/null); then
    unable=$((unable + 1))
  elif [[ $theirs == "$ours" ]]; then
    same=$((same + 1))
  else
    differ=$((differ + 1))
    verdict='no oracle was built'
    if [[ -x $build/tests/test_golden ]]; then
      "$build/tests/test_golden" "$file" | grep '^{' | jq -c "$geometry" >"$scratch/oracle"
      "$build/sunder" sum --exact "@$scratch/p" "@$scratch/q" | jq -c "$geometry" >"$scratch/sunder"
      verdict='the oracle says as we do'
      cmp -s "$scratch/oracle" "$scratch/sunder" || { verdict='the oracle does not say as we do'; wrong=$((wrong + 1)); }
    fi
    echo "$(basename "$file"): area $ours, CGAL $theirs; $verdict"
  fi
done < <(inputs)
echo "$same areas equal, $differ not, $unable that CGAL could not do; $wrong of ours wrong"
((wrong == 0))
