# shellcheck shell=bash disable=SC1091
# A forged file of --proof is refused, or all its claims are still true (forgeries.py). Runs on layers of at most ten
# features use together every kind of line and member, and make every kind of statement (statements.py). The seed
# (SUNDER_SEED) draws 400 forgeries, and 400 times another layer or other options, each kind at least once. With
# SUNDER_LAWS=all everything is tried, in about 20 minutes. 200 are of three maps, if these are beside the repository.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
. "$SUNDER_SOURCE/tests/proof/forged_runs.sh"

# refuted WORDS...: calls forgeries.py with these options, on all runs since the last call
refuted() {
    write_runs runs.json
    python3 "$here/forgeries.py" runs.json "$@" >said 2>&1 || fail "$(cat said)"
    tail -1 said
}

forge_generated
if [ "${SUNDER_LAWS:-}" = all ]; then
    refuted --need-all
else
    refuted --need-all --draw 400 --seed "${SUNDER_SEED:-1}"
fi
data=$SUNDER_SOURCE/../shared/data
if [ ! -d "$data" ]; then
    echo "without $data: generated layers alone"
else # 300 features of each map
    for name in krems_2013 saint_jean_la_poterie neuss_2026; do
        ogr2ogr "$name.gpkg" "$data/$name.gpkg" buildings -nln buildings -limit 300 2>/dev/null || fail "ogr2ogr: $name"
        forged $name $name.gpkg --gap 3 --max-shift 1.5
    done
    refuted --own-alone --draw 200 --seed "${SUNDER_SEED:-1}"
fi
finish
