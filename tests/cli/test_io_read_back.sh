# shellcheck shell=bash disable=SC1091
# A GeoPackage is read back past GDAL where its rows are plain, and by GDAL where they are not: one number that is not
# what was sent is found either way, and nothing appears.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
alter=$SUNDER_BUILD/tests/libalter.so
[ -e "$alter" ] || { echo "skipped: tests/libalter.so is not built"; exit 77; }

layer in.gpkg houses POLYGON <<'X'
id,size,name,WKT
1,1.5,one,"POLYGON((0 0,40 0,40 40,0 40,0 0))"
2,2.5,two,"POLYGON((3 3,7 3,7 4,3 4,3 3))"
3,,three,"POLYGON((13 3,17 3,17 4,13 4,13 3),(14.1 3.1,14.1 3.2,14.2 3.2,14.2 3.1,14.1 3.1))"
4,4.5,,"POLYGON((50 20,52 20,52 21,50 21,50 20))"
X
expect 0 separate in.gpkg plain.gpkg --gap 1 --allow-jumps
LD_PRELOAD=$alter "$SUNDER" --version >/dev/null 2>err && [ ! -s err ] || { echo "skipped: $(head -1 err)"; exit 77; }

# struck WHAT INPUT OPTION...: each of the numbers or geometries that are bound is altered in turn.
struck() {
    local what=$1 in=$2 at status
    shift 2
    for at in 1 2 3 4; do
        rm -f out.gpkg
        status=0
        ALTER=$what ALTER_AT=$at LD_PRELOAD=$alter "$SUNDER" separate "$in" out.gpkg --gap 1 --allow-jumps --layers main "$@" -q >said 2>&1 ||
            status=$?
        [ "$status" -eq 1 ] && [ ! -e out.gpkg ] && grep -q 'do not read back as they were written' said ||
            fail "$what $at of $in altered: status $status, $(head -1 said)"
    done
}

ogr2ogr -f GPKG high.gpkg in.gpkg -dim XYZ -nlt POLYGON25D 2>/dev/null
for in in in.gpkg high.gpkg; do
    struck geometry "$in"
    struck real "$in"
done
finish
