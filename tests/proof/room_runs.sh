# shellcheck shell=bash disable=SC1091
# What the tests of --proof with --hide, --trim, --inset, --symbol-size and --enlarge share. Sourced first by each test.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
. "$here/layers.sh"

# checked FILE OPTIONS...: the checker accepts the proof of this run, p.jsonl. Its answer is in `said`.
checked() {
    local source=$1
    shift
    "$SUNDER" separate "$source" o.gpkg --overwrite -q -l buildings --layers main,displacement,conflicts --proof p.jsonl "$@" 2>err
    case $? in 0 | 3) ;; *) fail "$source: status $?: $(cat err)" ;; esac
    python3 "$here/check_proof.py" p.jsonl "$source" --layer buildings --result o.gpkg "$@" >said 2>&1 || fail "$source $*: $(tail -1 said)"
}

# untrue FILE KINDS OPTIONS...: changes the last run's proof; the checker refuses each change, and KINDS, separated by
# semicolons, are among the changes. All kinds, after their number, are in `kinds`.
untrue() {
    local source=$1 kind named=$2
    shift 2
    python3 "$here/mutations.py" p.jsonl "$source" --layer buildings --result o.gpkg "$@" >said 2>kinds || fail "$(cat said)"
    while read -r kind; do grep -qF "$kind" kinds || fail "no $kind: $(cat kinds)"; done <<<"${named//;/$'\n'}"
}
