# shellcheck shell=bash
# The plug-in in a headless QGIS: by qgis_process, as a script would call it, and from QGIS's Python, where layers can
# be in memory, edited, selected and filtered (plugin.py). Its results are those of the program, to the last bit of each
# coordinate.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# The modules of QGIS are installed for the system's Python, which may not be the first python3 on the path.
python=/usr/bin/python3
"$python" -c 'import qgis.core' 2>/dev/null || { echo "skipped: QGIS's Python modules (python3-qgis) are not installed"; exit 77; }
# Debian's qgis_process is a wrapper that passes an option which the binary does not know.
process=$(command -v qgis_process.bin || command -v qgis_process) || { echo "skipped: qgis_process is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }

# A temporary profile, no screen; the plug-in from the sources, the program from this build.
mkdir -m 700 "$work/home" "$work/run" "$work/tmp"
export QT_QPA_PLATFORM=offscreen HOME=$work/home XDG_RUNTIME_DIR=$work/run QGIS_CUSTOM_CONFIG_PATH=$work/profile TMPDIR=$work/tmp
export QGIS_PLUGINPATH=$SUNDER_SOURCE/gis/qgis PYTHONDONTWRITEBYTECODE=1
PATH=$(dirname "$SUNDER"):$PATH
cd "$work"
cp "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" . # QGIS may change a GeoPackage by opening it
town=$work/town.gpkg

"$process" plugins enable sunder >log 2>&1 || { cat log; fail "the plug-in cannot be enabled"; }
"$process" list >log 2>/dev/null
for command in separate check specification buffer sum pair route; do
    grep -q "sunder:$command" log || fail "sunder:$command is not in the list"
done

# A call from a script: status 3 of the program is not a failure, and remaining conflicts are a warning.
"$process" run sunder:separate --INPUT="$town|layername=buildings" --GAP=3 --MAX_SHIFT=1 --OUTPUT="$work/moved.gpkg" \
    --CONFLICTS="$work/conflicts.gpkg" --REPORT="$work/moves.html" >log 2>&1 || { cat log; fail "separate failed"; }
grep -q 'WARNING:.* conflicts could not be solved' log || { cat log; fail "remaining conflicts are not reported"; }
[ -s moves.html ] && [ -s conflicts.gpkg ] || fail "the report or the layer of conflicts is missing"

# A wrong argument is a failure, with the program's message.
if "$process" run sunder:buffer --INPUT="$town|layername=buildings" --SHAPE=round:3 --OUTPUT="$work/x.gpkg" >log 2>&1; then
    fail "an invalid shape was accepted"
fi
grep -q 'round:3' log || { cat log; fail "the reason is not reported"; }

# Without the program the plug-in loads, and says what is missing.
without=$(mktemp -d -p "$work")
ln -s "$(command -v "$process")" "$without/qgis_process.bin"
if PATH=$without:/usr/bin:/bin "$process" run sunder:pair --P_SHAPE=square:2 --Q_SHAPE=square:2 --OUTPUT=x.gpkg >log 2>&1 &&
    [ ! -x /usr/bin/sunder ]; then
    fail "it ran without the program"
fi
[ -x /usr/bin/sunder ] || grep -q 'sunder was not found' log || { cat log; fail "a missing program is not reported"; }

# All other tests in one QGIS, since each start takes a second.
timeout 250 "$python" "$here/plugin.py" "$@" >log 2>&1 || { cat log; fail "plugin.py failed"; }
grep -E '^(Ran|OK|skipped|SKIP)' log || cat log
