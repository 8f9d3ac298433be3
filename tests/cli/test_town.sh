# shellcheck shell=bash
# The generator of towns: it reproduces the layer in the repository, larger towns begin with smaller ones, seeds differ,
# houses of a terrace share walls, and nothing is overwritten without the option for that.
set -eu
town=$SUNDER_BUILD/sunder-town
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v ogrinfo >/dev/null || { echo "skipped: ogrinfo is not installed"; exit 77; }

# Millimetres have 10 digits here, and ogrinfo prints 15: equal text means equal coordinates.
dump() { ogrinfo -q -ro "$1" buildings; ogrinfo -q -ro "$1" roads; }
features() { ogrinfo -q -ro "$1" buildings -where "fid <= $2"; }
fail() { echo "$1"; exit 1; }

"$town" --buildings 280 --seed 1 "$work/again.gpkg"
dump "$work/again.gpkg" >"$work/again.txt"
dump "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" >"$work/committed.txt"
[ "$(grep -c 'POLYGON' "$work/committed.txt")" -eq 280 ]
cmp "$work/committed.txt" "$work/again.txt" || fail "the committed town is not what the generator makes"

"$town" --buildings 3000 --seed 1 "$work/large.gpkg"
features "$work/large.gpkg" 280 >"$work/large.txt"
features "$work/again.gpkg" 280 >"$work/small.txt"
cmp "$work/small.txt" "$work/large.txt" || fail "a larger town does not begin with the smaller one"

"$town" --buildings 280 --seed 2 "$work/other.gpkg"
features "$work/other.gpkg" 280 >"$work/other.txt"
! cmp -s "$work/small.txt" "$work/other.txt" || fail "two seeds give one town"

# Another format, which writes a folder of files.
"$town" --buildings 50 --of "ESRI Shapefile" "$work/shapes"
[ "$(ogrinfo -ro -so "$work/shapes/buildings.shp" buildings | sed -n 's/^Feature Count: //p')" = 50 ]

# Corners that several houses share: in a town with terraces there is at least one for each two houses.
shared=$(grep -o '[0-9.]* [0-9.]*[,)]' "$work/small.txt" | tr -d ',)' | sort | uniq -c | awk '$1 > 2' | wc -l)
[ "$shared" -gt 100 ] || fail "only $shared corners are shared"

before=$(cksum <"$work/again.gpkg")
if "$town" --buildings 10 "$work/again.gpkg" 2>"$work/message"; then fail "an existing file was replaced"; fi
grep -q -- '--overwrite' "$work/message"
[ "$before" = "$(cksum <"$work/again.gpkg")" ] || fail "the existing file was touched"
for wrong in "--buildings -1 x.gpkg" "--seed" "--trouble 2 x.gpkg" "--nonsense 1 x.gpkg" "a.gpkg b.gpkg" ""; do
    status=0
    # shellcheck disable=SC2086 # words
    (cd "$work" && "$town" $wrong) 2>"$work/message" >&2 || status=$?
    [ "$status" -eq 2 ] && grep -q '^usage' "$work/message" || fail "'$wrong': status $status"
done
