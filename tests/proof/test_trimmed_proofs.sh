# shellcheck shell=bash disable=SC1091
# --proof with --trim: the checker verifies the smaller shapes, and each clause with the shapes of its levels; and it
# refuses every false statement about them (hide_mutations.py).
. "$SUNDER_SOURCE/tests/proof/room_runs.sh" || exit 1

# proved FILE WORDS OPTIONS...: the checker accepts the proof of this run, and says these words
proved() {
    local source=$1 words=$2
    shift 2
    checked "$source" "$@"
    grep -qF "$words" said || fail "$source $*: $(tail -1 said)"
    grep -o 'hidden [^;]*' said
}

make_town
trim=(--gap 0.5 --max-shift 0.5 --barrier roads.gpkg,width-field=w --trim --hide --hide-weight 1 --trim-keep 0.3)
for more in "" "--rows no --ease no" "--crossed hide --no-blocks" "--crossed trim --hierarchy-field class" "--min-size 3 --effort 0"; do
    # shellcheck disable=SC2086
    proved town.gpkg 'smaller shapes' "${trim[@]}" $more
done

# Every false statement about the last but two is refused.
proved town.gpkg 'smaller shapes' "${trim[@]}" --crossed hide --no-blocks
untrue town.gpkg 'larger shape;shape that keeps too little;shape twice;shape not taken;shape of a hidden feature;lesser level of a clause;shape that crosses itself;shape of nothing' \
    "${trim[@]}" --crossed hide --no-blocks
cut -c 1-90 kinds

# The proof of another run is refused, and so is a smaller shape of what never changes.
for words in '--trim-keep 0.95' '--rigid-where class>0' '--crossed trim'; do
    # shellcheck disable=SC2086
    python3 "$here/check_proof.py" p.jsonl town.gpkg --layer buildings --gap 0.5 --max-shift 0.5 --barrier roads.gpkg,width-field=w --trim --hide \
        --hide-weight 1 --no-blocks $words >said 2>&1
    case "$?$words" in 1* | *trim) ;; *) fail "accepted with $words: $(cat said)" ;; esac
done

# Without --hide there are smaller shapes and clauses, too.
proved town.gpkg 'hidden 0' "${trim[@]:0:7}" --trim-keep 0.3
finish
