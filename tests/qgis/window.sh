# shellcheck shell=bash
# The plug-in in the real window of QGIS, on a virtual screen (Xvfb): its dialog is filled and run, results appear with
# their styles, the report is written. The pictures stay in the build folder; gis/pictures/qgis_*.png were taken by this
# test.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
qgis=$(command -v qgis.bin || command -v qgis) || { echo "skipped: QGIS is not installed"; exit 77; }
process=$(command -v qgis_process.bin || command -v qgis_process) || { echo "skipped: qgis_process is not installed"; exit 77; }
command -v Xvfb >/dev/null && command -v xvfb-run >/dev/null && command -v xauth >/dev/null ||
    { echo "skipped: Xvfb (xvfb, xauth) is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; cat "$work/report.txt" "$work/log" 2>/dev/null; exit 1; }

mkdir -m 700 "$work/home" "$work/run" "$work/tmp"
export HOME=$work/home XDG_RUNTIME_DIR=$work/run QGIS_CUSTOM_CONFIG_PATH=$work/profile TMPDIR=$work/tmp
export QGIS_PLUGINPATH=$SUNDER_SOURCE/gis/qgis PYTHONDONTWRITEBYTECODE=1 WINDOW_FOLDER=$work BROWSER=true
PATH=$(dirname "$SUNDER"):$PATH
cp "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" "$work"
QT_QPA_PLATFORM=offscreen "$process" plugins enable sunder >"$work/log" 2>&1 || fail "the plug-in cannot be enabled"

# The window closes by itself; the timeout only ends a hanging run.
timeout 240 xvfb-run -a -s "-screen 0 1280x860x24 -nolisten tcp" "$qgis" --noversioncheck --nologo \
    --code "$here/window.py" >"$work/log" 2>&1 || fail "QGIS ended with status $?"
for wanted in '^done$' '^Houses: Separated: 280 features, categorizedSymbol' '^Houses: Moves: [0-9]* features, singleSymbol' \
    '^Houses: Conflicts that remain: [0-9]* features, RuleRenderer' \
    '^log:   inside blocks  *[0-9]\{1,\}   *[0-9]\{1,\}'; do # columns of the log keep their alignment
    grep -q "$wanted" "$work/report.txt" || fail "missing in the report: $wanted"
done
[ -s "$work/moves.html" ] || fail "there is no report"
cp "$work"/dialog.png "$work"/window.png "$work"/log.png "${SUNDER_BUILD:-/tmp}/" 2>/dev/null || true
