# shellcheck shell=bash disable=SC1091
# What a forger changes in a file of --proof is refused, or claims no more than is true (forgeries.py): of fifteen runs on layers of at
# most ten features, which together use every kind of line and member, 2,000 forgeries by seed (SUNDER_SEED), all of them with
# SUNDER_LAWS=all; and of three maps, where they are beside the repository, a thousand.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
. "$SUNDER_SOURCE/tests/proof/forged_runs.sh"

# refuted WORDS...: of forgeries.py, on all runs since the last time
refuted() {
    write_runs runs.json
    python3 "$here/forgeries.py" runs.json "$@" >said 2>&1 || fail "$(cat said)"
    tail -1 said
}

forge_generated
if [ "${SUNDER_LAWS:-}" = all ]; then
    refuted --need-all
else
    refuted --need-all --draw 2000 --seed "${SUNDER_SEED:-1}"
fi
data=$SUNDER_SOURCE/../shared/data
if [ ! -d "$data" ]; then
    echo "without $data: generated layers alone"
else # of each map 300 features
    for name in krems_2013 saint_jean_la_poterie neuss_2026; do
        ogr2ogr "$name.gpkg" "$data/$name.gpkg" buildings -nln buildings -limit 300 2>/dev/null || fail "ogr2ogr: $name"
        forged $name $name.gpkg --gap 3 --max-shift 1.5
    done
    refuted --own-alone --draw 1000 --seed "${SUNDER_SEED:-1}"
fi
finish
