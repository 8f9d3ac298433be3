# shellcheck shell=bash disable=SC1091
# Runs whose files of --proof are forged, on layers of at most ten features; together they have every member of the
# format and make every kind of statement (statements.py). Sourced after tests/cli/lib.sh.
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
. "$here/layers.sh"
runs=()

# forged NAME SOURCE OPTIONS...: adds a run whose file of --proof will be forged. only=TEXT: the lines with this text are
# forged; small=yes: lines are chosen by forgeries.py.
forged() {
    local name=$1 source=$2
    shift 2
    [[ " $* " == *" --rows "* ]] || set -- --rows no "$@"
    [[ " $* " == *" --ease "* ]] || set -- --ease no "$@"
    "$SUNDER" separate "$source" "$name.o.gpkg" --overwrite -q -l buildings --layers main,displacement,conflicts --proof "$name.jsonl" "$@" 2>err
    case $? in 0 | 3) ;; *) fail "$name: status $?" ;; esac
    runs+=("$(python3 -c 'import json, sys; print(json.dumps({"only": sys.argv[1], "small": sys.argv[2], "proof": sys.argv[3], "words": sys.argv[4:]}))' \
        "${only:-}" "${small:-}" "$name.jsonl" "$source" --layer buildings --result "$name.o.gpkg" "$@")")
}

# small_worlds SEED...: runs of small_worlds.py; ease=KAPPA: with prices.
small_worlds() {
    local seed
    local -a words
    for seed in "$@"; do
        mapfile -t words < <(python3 "$here/small_worlds.py" "$seed")
        layer "world$seed.gpkg" buildings POLYGON <"$seed.csv"
        small=yes forged "world$seed" "world$seed.gpkg" "${words[@]}" ${ease:+--ease "$ease"}
    done
}

# write_runs FILE: writes the runs that were added since the last call.
write_runs() {
    (IFS=,; echo "[${runs[*]}]") >"$1"
    runs=()
}

forge_generated() {
    make_side
    make_wedge wedge 2006.4 2001.95 1996.4 2000.85
    make_wedge bow 2005.4 2001.844 1997.4 2000.956
    make_bend
    make_lane
    make_pierced
    make_well
    make_halves
    make_three
    make_crowd
    make_pile 6 0.5
    make_mixed
    make_squares 3 2
    make_houses
    make_through
    make_short
    make_row
    make_bays
    make_shut
    make_front
    make_hidden
    forged through houses.gpkg --gap 1 --max-shift 1 --no-blocks --barrier through.gpkg
    forged free houses.gpkg --gap 2 --no-blocks
    forged side wall.gpkg --no-blocks --fixed-where 'w = 1 AND fid = 2' --barrier side.gpkg
    forged pressed pressed.gpkg --no-blocks --max-shift 5 --fixed-where 'fid = 2' --barrier pressing.gpkg
    forged wedge wedged.gpkg --max-shift 5 --barrier wedge.gpkg
    forged aside wedged.gpkg --max-shift 1 --barrier bow.gpkg
    forged bend bent.gpkg --gap 1 --max-shift 1 --barrier bend.gpkg,side=no --barrier edge.gpkg,side=no
    local -a lane=(--gap 3 --max-shift 2 --no-blocks --block-field k --fixed-where 'w = 2' --allow-jumps --barrier lane.gpkg,width=5,gap=0,side=no)
    only='"still"' forged lane lanes.gpkg "${lane[@]}"
    forged pierced pierced.gpkg "${lane[@]}"
    forged well well.gpkg --no-blocks --contained separate
    forged leap well.gpkg --no-blocks --contained separate --allow-jumps --gap 1
    forged halves halves.gpkg --gap 1 --max-shift 25
    forged three three.gpkg --gap 0.5 --no-blocks --contained separate
    only='"crowded"' forged crowd crowd.gpkg --gap 0.5 --no-blocks --max-shift 2 --allow-jumps --contained separate --effort 0
    forged pile pile.gpkg --symbol square:6
    forged mixed mixed.gpkg --gap 1 --max-shift-field m --fixed-where 'w = 3' --weight sqrt-area --weight-field w --block-field k --contained ignore
    forged apart mixed.gpkg --gap 1 --max-shift-field m --fixed-where 'w = 3' --block-field k --contained separate
    forged short short.gpkg --gap 1 --no-blocks --max-shift-field m
    forged row row.gpkg --gap 3 --rows auto --fixed-where 'w = 3' --weight-field w
    only='"row"' forged named row.gpkg --gap 3 --rows w --fixed-where 'w = 3'
    forged bays bays.gpkg --gap 5 --max-shift 1 --rows auto
    forged front front.gpkg --gap 4 --max-shift 4.5 --rows auto --ease 30 --barrier drawn.gpkg,width=6
    forged between row.gpkg --gap 3 --least-gap 1 --max-shift 2 --ease 30 --rows auto --fixed-where 'w = 3' --weight-field w
    forged squeezed squeezed.gpkg --gap 5 --max-shift 20 --fixed-where 'w = 3' --rows auto
    only='"within"' forged shut shut.gpkg --barrier shut_in.gpkg,as=boundary --barrier shut_by.gpkg --barrier shut_off.gpkg,side=no
    forged hidden hidden.gpkg --gap 0.5 --max-shift 3 --no-blocks --block-field k --contained separate --barrier walls.gpkg --hide --crossed hide --hide-weight area \
        --hierarchy-field class
    make_town
    only='"shape"' forged trimmed town.gpkg --gap 0.5 --max-shift 0.5 --no-blocks --barrier roads.gpkg,width-field=w --trim --trim-keep 0.3 --hide --crossed hide \
        --hide-weight 1
    only='"shape"' forged rungs town.gpkg --gap 0.5 --max-shift 0.5 --barrier roads.gpkg,width-field=w --inset 0.5,1 --symbol-size 4 --hide --hide-weight 1
    make_sheds
    only='"larger"' forged larger sheds.gpkg --gap 3 --max-shift 3 --enlarge --min-size 10 --barrier lanes_by.gpkg,width-field=w
    forged shares squares.gpkg --gap 3 --effort 0
    small_worlds 30 41 55 112 135 156 200 226 261 386 518 549 618 634 652 655 663 673 692 705 755 980 1047 1129 1136 1171 1228 1466 3063 3192 3231
    ease=30 small_worlds 85 188 196 228
}
