# shellcheck shell=bash disable=SC1091
# The reason `row`, the field `by_row`, and need_shift, need_gap and need_gone with --rows, compared with brute force on random rows of
# houses (rows_verdicts.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} worlds=10
[ "${SUNDER_LAWS:-}" = all ] && worlds=300
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/rows_verdicts.py" "$SUNDER" "$seed" "$worlds" || trouble=1

# Two houses whose bays do not face each other stand 4 m apart, and 2 m along the row. With 5 m between them the row has to become 3 m
# longer, which two limits of 1 m do not allow; without the row 1 m suffices.
printf '%s\n' WKT,w '"POLYGON((0 0,10 0,10 8,12 8,12 10,0 10))",1' '"POLYGON((14 0,26 0,26 10,16 10,16 2,14 2))",1' \
    '"POLYGON((33 0,43 0,43 10,33 10))",1' | layer bays.gpkg bays POLYGON
fields() { ogrinfo -q -al -geom=NO "$1" "$2" | sed -n "s/^  \($3\) .*= //p" | tr '\n' ' '; }
expect 3 separate bays.gpkg o.gpkg --gap 5 --max-shift 1 --rows auto --ease no
[ "$(fields o.gpkg bays_conflicts 'reason\|by_row')" = "row 0 " ] || fail "bays: $(fields o.gpkg bays_conflicts 'reason\|by_row')"
case $(fields o.gpkg bays_conflicts need_shift) in 1.5*) ;; *) fail "need_shift: $(fields o.gpkg bays_conflicts need_shift)" ;; esac
expect 0 separate bays.gpkg free.gpkg --gap 5 --max-shift 1 --rows no
ogrinfo -q -al -geom=NO free.gpkg bays_conflicts | grep -q by_row && fail "by_row, though no rows are wanted"

# A house between two that do not move: it would have to go both ways along the row.
printf 'WKT,w\n"POLYGON((0 0,10 0,10 10,0 10))",1\n"POLYGON((12 0,22 0,22 10,12 10))",2\n"POLYGON((24 0,34 0,34 10,24 10))",1\n' |
    layer between.gpkg between POLYGON
expect 3 separate between.gpkg o.gpkg --overwrite --gap 5 --max-shift 20 --fixed-where 'w = 1' --rows auto --ease no
[ "$(fields o.gpkg between_conflicts 'reason\|by_row')" = "no_room 1 no_room 1 " ] ||
    fail "between: $(fields o.gpkg between_conflicts 'reason\|by_row')"
[ "$(fields o.gpkg between_conflicts 'need_shift\|need_gone')" = "(null) 3 (null) 1 " ] ||
    fail "needs between: $(fields o.gpkg between_conflicts 'need_shift\|need_gone')"
finish
