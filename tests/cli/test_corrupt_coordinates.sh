# shellcheck shell=bash disable=SC1091
# One corrupt vertex, from 1.4e8 (more than 2^27, beyond the Earth) to the greatest double. A feature that can only be moved by multiples of its last place
# is first tried as fixed, so that its valid neighbours move no farther than beside a fixed one. A warning names
# features that move very far.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export SUNDER
python3 "$SUNDER_SOURCE/tests/cli/corrupt_coordinates.py" || fail "see above"

# If the neighbour may not move, the corrupt feature is not fixed: it moves, and a warning is printed.
cat >wild.csv <<'X'
id,WKT
1,"POLYGON ((500000 5300000,500010 5300000,500010 5300100,500000 5300100,500000 5300000))"
2,"POLYGON ((500008 5300000,1e20 1e20,500008 5300100,500008 5300000))"
3,"POLYGON ((500000 5300500,500010 5300500,500010 5300600,500000 5300500))"
X
expect 0 separate wild.csv wild.gpkg --fixed-where "id = '1'" --oo GEOM_POSSIBLE_NAMES=WKT
grep -q 'FID 2: it moves by .*are its own coordinates corrupt' err || fail "the warning is missing"

# The same warning is printed for a layer of two features, for a layer in parts, and for one merged from shards; it is
# never printed for a layer without corrupt coordinates.
told() { # WORDS: expected in the message of separate, as text and as JSON, for the layer as a whole and in parts
    local messages
    for messages in text json; do
        rm -rf plan
        expect 0 separate in.gpkg whole.gpkg --overwrite --messages $messages --fixed-where "id = '1'"
        mv err whole
        expect 0 separate in.gpkg parts.gpkg --overwrite --messages $messages --fixed-where "id = '1'" --max-memory 300M
        same "$(cat err)" "$(cat whole)" "$1, in parts"
        expect 0 plan in.gpkg plan --shards 2 --quiet --fixed-where "id = '1'"
        for k in 1 2; do expect 0 separate --shard $k plan --quiet; done
        rm -f merged.gpkg
        expect 0 merge plan merged.gpkg --messages $messages
        same "$(cat err)" "$(cat whole)" "$1, merged"
        same "$(grep -c 'FID 2: it moves by 16384, which is more than the extent of the features with plausible coordinates' whole)" "$2" "$1"
    done
}
ogr2ogr -q in.gpkg wild.csv -nln h -oo GEOM_POSSIBLE_NAMES=WKT
told 'three features' 1
head -3 wild.csv >two.csv
rm in.gpkg && ogr2ogr -q in.gpkg two.csv -nln h -oo GEOM_POSSIBLE_NAMES=WKT
told 'two features' 1
sed 's/1e20 1e20/600000 5300050/' two.csv >near.csv
rm in.gpkg && ogr2ogr -q in.gpkg near.csv -nln h -oo GEOM_POSSIBLE_NAMES=WKT
told 'sound ones' 0
finish
