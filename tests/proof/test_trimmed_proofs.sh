# shellcheck shell=bash disable=SC1091
# --proof with --trim: the checker verifies the smaller shapes, and each clause with the shapes of its levels; and it
# refuses every false statement about them (hide_mutations.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
. "$here/layers.sh"

# proved FILE WORDS OPTIONS...: the checker accepts the proof of this run, and says these words
proved() {
    local source=$1 words=$2
    shift 2
    "$SUNDER" separate "$source" o.gpkg --overwrite -q -l buildings --layers main,displacement,conflicts --proof p.jsonl "$@" 2>err
    case $? in 0 | 3) ;; *) fail "$source: status $?: $(cat err)" ;; esac
    python3 "$here/check_proof.py" p.jsonl "$source" --layer buildings --result o.gpkg "$@" >said 2>&1 && grep -qF "$words" said ||
        fail "$source $*: $(tail -1 said)"
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
python3 "$here/mutations.py" p.jsonl town.gpkg --layer buildings --result o.gpkg "${trim[@]}" --crossed hide --no-blocks >said 2>kinds || fail "$(cat said)"
cut -c 1-90 kinds
for kind in 'larger shape' 'shape that keeps too little' 'shape twice' 'shape not taken' 'shape of a hidden feature' 'lesser level of a clause' 'shape that crosses itself' 'shape of nothing'; do
    grep -qF "$kind" kinds || fail "no $kind: $(cat kinds)"
done

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
