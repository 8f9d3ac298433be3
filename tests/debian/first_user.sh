# Run in a clean root directory by test_first_user.sh, with bash -eu: each step as in the README and on the plug-in's
# page.
cd /root
echo "step: git clone, gis/demo.sh, the rest, install, the plug-in's zip (README, Install)"
. /root/install.sh
export PATH=/root/.local/bin:$PATH
cd /root
sunder --version

echo "step: Install from ZIP"
plugins=/root/.local/share/QGIS/QGIS3/profiles/default/python/plugins
mkdir -p "$plugins"
unzip -q /root/sunder/build/release/sunder-qgis-*.zip -d "$plugins"

echo "step: Separate features, roads as barriers"
export XDG_RUNTIME_DIR=/root/run
mkdir -m 700 "$XDG_RUNTIME_DIR"
qgis_process=$(command -v qgis_process.bin || command -v qgis_process)
town=/root/sunder/datasets-synthetic/town.gpkg
"$qgis_process" plugins enable sunder
"$qgis_process" run sunder:separate --INPUT="$town|layername=buildings" --GAP=3 --UNIT=1 --MAX_SHIFT=5 \
    --BARRIER="$town|layername=roads,6,,,," --OUTPUT=/root/moved.gpkg --CONFLICTS=/root/left.gpkg --REPORT=/root/moves.html

count() { ogrinfo -q -sql "SELECT COUNT(*) AS n FROM $2" "$1" | sed -n 's/.*n (Integer.*) = //p'; }
moved=$(count moved.gpkg "moved WHERE sunder_st = 'moved'") left=$(count left.gpkg left)
echo "step: $moved of the town's buildings have moved, $left conflicts are left, listed with their reasons"
[ "$moved" -gt 10 ]
[ -s moves.html ]

echo "step: the same by the program"
sunder separate --gap 3 --max-shift 5 --barrier "$town,layer=roads,width=6" --input-layer buildings --allow-conflicts "$town" same.gpkg
[ "$(count same.gpkg "buildings WHERE sunder_st = 'moved'")" = "$moved" ]
[ "$(count same.gpkg buildings_conflicts)" = "$left" ]
