#!/usr/bin/env bash
# Installs what is missing, builds, separates the little town that comes with the source, and says where the result is.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$source/build/release out=$source/build/demo
# shellcheck source=setup.sh
. "$source/gis/setup.sh"

setup_toolchain
setup_install
setup_build "$source" "$build" sunder sunder-town

town=$source/datasets-synthetic/town.gpkg
separated=$out/town_separated.gpkg
mkdir -p "$out"
# 3 m between buildings, no move longer than 5 m, church, town hall and monuments stay where they are.
options=(--gap 3 --max-shift 5 --fixed-where "kind IN ('church', 'town_hall', 'monument')" --id-field id
         --allow-conflicts --stats "$out/summary.json" --overwrite)
printf '\nsunder separate'
for word in "${options[@]}" "$town" "$separated"; do
    case $word in *[!-A-Za-z0-9_./]*) printf ' "%s"' "$word" ;; *) printf ' %s' "$word" ;; esac
done
echo
"$build/sunder" separate "${options[@]}" "$town" "$separated"
bash "$source/datasets-synthetic/draw.sh" "$town" 451222 5411190 451385 5411300 "$separated" >"$out/before_after.svg"
cat <<END

The separated town, styled for QGIS:    $separated
The summary, as JSON:                   $out/summary.json
Before and after, for a web browser:    $out/before_after.svg
END
