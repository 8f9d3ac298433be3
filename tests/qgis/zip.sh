# shellcheck shell=bash
# QGIS installs the zip that `cmake --build . --target qgis-plugin` makes: unpacked into the plug-ins of a fresh
# profile, it is enabled and runs, and it contains only the plug-in.
set -eu
process=$(command -v qgis_process.bin || command -v qgis_process) || { echo "skipped: qgis_process is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; cat "$work/log" 2>/dev/null; exit 1; }

mkdir -m 700 "$work/home" "$work/run" "$work/tmp"
export QT_QPA_PLATFORM=offscreen HOME=$work/home XDG_RUNTIME_DIR=$work/run QGIS_CUSTOM_CONFIG_PATH=$work/profile TMPDIR=$work/tmp
unset QGIS_PLUGINPATH
cmake --build "$SUNDER_BUILD" --target qgis-plugin >"$work/log" 2>&1 || fail "the zip is not made"
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt")
zip=$SUNDER_BUILD/sunder-qgis-$version.zip
plugins=$work/profile/profiles/default/python/plugins
mkdir -p "$plugins"
(cd "$plugins" && cmake -E tar xf "$zip")
[ "$(ls "$plugins")" = sunder ] || fail "not one folder in the zip"
grep -qx "version=$version" "$plugins/sunder/metadata.txt" || fail "the version is not the project's"
grep -q '^qgisMaximumVersion=4' "$plugins/sunder/metadata.txt" || fail "not listed for QGIS 4"
[ -f "$plugins/sunder/LICENSE" ] || fail "no licence"
for file in "$SUNDER_SOURCE"/gis/qgis/sunder/*.py "$SUNDER_SOURCE"/gis/qgis/sunder/icons/*.svg; do
    cmp "$file" "$plugins/sunder/${file#"$SUNDER_SOURCE"/gis/qgis/sunder/}" || fail "$file is not in the zip as it is"
done
[ -z "$(find "$plugins" -name '__pycache__' -o -name '*.pyc')" ] || fail "compiled files are in the zip"

# The zip contains the addresses that the build was given, or none if none were given.
addresses=$work/addresses
cmake -S "$SUNDER_SOURCE" -B "$addresses" -D SUNDER_TESTS=OFF -D SUNDER_EMAIL=who@example.net -D SUNDER_HOMEPAGE=https://example.net/ \
    -D SUNDER_TRACKER=https://example.net/issues >"$work/log" 2>&1 || fail "no configuration with addresses"
for line in email=who@example.net homepage=https://example.net/ tracker=https://example.net/issues; do
    grep -qx "$line" "$addresses/gis/qgis/metadata.txt" || fail "not in the metadata: $line"
done
if grep -q '^repository=' "$addresses/gis/qgis/metadata.txt"; then fail "an address that was not given"; fi

"$process" plugins enable sunder >"$work/log" 2>&1 || fail "the plug-in cannot be enabled"
# The path of the program is in the settings of Processing; it is not on the PATH.
ini=$work/profile/profiles/default/QGIS/QGIS3.ini
printf '\n[Processing]\nConfiguration\\SUNDER_PROGRAM=%s\n' "$SUNDER" >>"$ini"
PATH=/usr/bin:/bin "$process" run sunder:pair --P_SHAPE=square:4 --Q_SHAPE=square:2 --OUTPUT="$work/pair.gpkg" >"$work/log" 2>&1 ||
    fail "sunder:pair does not run"
grep -q '^DISTANCE:.*3$' "$work/log" || fail "the distance is not 3"
