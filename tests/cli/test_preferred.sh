# shellcheck shell=bash disable=SC1091
# --prefer-dx and --prefer-dy: the places that features prefer. The moves of one result, preferred, are the next result,
# at no cost; null is 0; zeros are as good as none; limits and sides count from the layer. What is wrong is refused.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0

# Two streets of houses without enough room between them.
python3 - >houses.csv <<'X'
import random
random.seed(5)
print("id,WKT,px,py,text")
fid = 0
for street in range(2):
    x = 0
    for house in range(7):
        w, h, y = random.randint(4, 9), random.randint(7, 9), 30 * street + random.randint(0, 8) / 8
        fid += 1
        print('%d,"POLYGON((%g %g,%g %g,%g %g,%g %g,%g %g))",0,,%s' %
              (fid, x, y, x + w, y, x + w, y + h, x, y + h, x, y, "far" if fid == 9 else 1))
        x += w + random.randint(-1, 6) / 4
X
printf 'Integer,WKT,Real,Real,String\n' >houses.csvt
ogr2ogr houses.gpkg houses.csv -nln houses -nlt POLYGON -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=WKT \
    -oo KEEP_GEOM_COLUMNS=NO -oo EMPTY_STRING_AS_NULL=YES 2>/dev/null || fail "cannot make houses.gpkg"

# Replaces px and py by these SQL expressions over the fields of a result, r, and of the layer, h.
prefer() { # RESULT DX DY
    python3 - "$@" <<'X' || fail "cannot set the fields"
import sqlite3, sys
db = sqlite3.connect("houses.gpkg", isolation_level=None)
for name, in db.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
    db.execute('DROP TRIGGER "%s"' % name)
db.execute("ATTACH ? AS result", (sys.argv[1],))
db.execute("UPDATE main.houses AS h SET px = (SELECT %s FROM result.houses AS r WHERE r.fid = h.fid), "
           "py = (SELECT %s FROM result.houses AS r WHERE r.fid = h.fid)" % (sys.argv[2], sys.argv[3]))
X
}
of_stats() { python3 -c "import json,sys; s = json.load(open('$1')); print(*(s['displacement'][k] for k in sys.argv[1:]))" "${@:2}"; }
places() { ogrinfo -al -q "$1" houses | grep -E 'POLYGON|sunder_|id '; }
preferring=(--prefer-dx px --prefer-dy py) kept=0

for rules in "" "--no-blocks --allow-jumps --max-shift 8"; do
    # shellcheck disable=SC2086
    set -- --gap 2 --overwrite --no-styles $rules
    run separate houses.gpkg first.gpkg "$@" -q
    left=$status
    prefer first.gpkg 0 NULL
    expect 0 separate houses.gpkg plain.gpkg "$@" -q --allow-conflicts
    expect 0 separate houses.gpkg none.gpkg "$@" "${preferring[@]}" -q --allow-conflicts
    places plain.gpkg >plain
    places none.gpkg >none
    cmp -s plain none || fail "zeros are not as good as none: $rules"
    # What the layer got, preferred.
    if [ "$left" -eq 0 ]; then
        kept=$((kept + 1))
        prefer first.gpkg sunder_dx sunder_dy
        expect 0 separate houses.gpkg again.gpkg "$@" "${preferring[@]}" --stats again.json -q
        places first.gpkg >first
        places again.gpkg >again
        cmp -s first again || fail "a layout that is preferred is not kept: $rules"
        [ "$(of_stats again.json cost lower_bound)" = "0 0" ] || fail "it costs $(of_stats again.json cost lower_bound)"
    fi
    # Other places; run checks every result with check --before.
    prefer first.gpkg "r.sunder_dx + (r.fid % 5 - 2)" "r.sunder_dy - (r.fid % 3) * 0.7"
    expect 0 separate houses.gpkg other.gpkg "$@" "${preferring[@]}" --stats other.json -q --allow-conflicts
    of_stats other.json cost lower_bound optimality_gap |
        awk '{ exit !($1 > 0 && $2 > 0.5 * $1 && $2 <= $1) }' || fail "cost and bound: $(of_stats other.json cost lower_bound)"
    # The same for any number of threads.
    expect 0 separate houses.gpkg threads.gpkg "$@" "${preferring[@]}" -q --allow-conflicts --threads 3
    cmp -s other.gpkg threads.gpkg || fail "three threads give other bytes: $rules"
done
[ "$kept" -gt 1 ] || fail "$kept layouts were kept"

refused 1 'FID 9: the preferred move in text is far; it must be a finite number' separate houses.gpkg never.gpkg \
    --prefer-dx px --prefer-dy text
refused 1 'no field nothing' separate houses.gpkg never.gpkg --prefer-dx px --prefer-dy nothing
refused 2 '--prefer-dx' separate houses.gpkg never.gpkg --prefer-dx px
refused 2 'not with --proof' separate houses.gpkg never.gpkg "${preferring[@]}" --proof p.json
refused 2 'not with --max-memory' separate houses.gpkg never.gpkg "${preferring[@]}" --max-memory 100M
refused 2 '--prefer-dx' plan houses.gpkg never --shards 2 "${preferring[@]}"
finish
