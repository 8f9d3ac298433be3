# shellcheck shell=bash disable=SC1091
# The written GeoPackage is read back and compared without GDAL if its rows are plain, and by GDAL otherwise. In both
# cases one changed number is detected, and no output appears.
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

# struck WHAT "WHICH..." INPUT LAYERS [OPTION...]: changes each of these values (numbers or geometries, counted as they
# are bound to statements) in a run of its own.
struck() {
    local what=$1 in=$3 at status
    for at in $2; do
        rm -f out.gpkg
        status=0
        ALTER=$what ALTER_AT=$at LD_PRELOAD=$alter "$SUNDER" separate "$in" out.gpkg --gap 1 --allow-jumps --layers "$4" -q "${@:5}" >said 2>&1 ||
            status=$?
        [ "$status" -eq 1 ] && [ ! -e out.gpkg ] && grep -q 'do not read back as they were written' said ||
            fail "$what $at of $in altered: status $status, $(head -1 said)"
    done
}

ogr2ogr -f GPKG high.gpkg in.gpkg -dim XYZ -nlt POLYGON25D 2>/dev/null
for in in in.gpkg high.gpkg; do
    struck geometry "1 2 3 4" "$in" main
    struck real "1 2 3 4" "$in" main
done

# Four pairs; the last two lie within the extent of the first two. The lines of the displacement layer bypass GDAL, too.
# There are eight features with three numbers each, then eight lines with as many.
layer pairs.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 1,8 1,8 5,3 5,3 1))"
3,"POLYGON((100 100,104 100,104 104,100 104,100 100))"
4,"POLYGON((103 101,108 101,108 105,103 105,103 101))"
5,"POLYGON((50 50,54 50,54 54,50 54,50 50))"
6,"POLYGON((53 51,58 51,58 55,53 55,53 51))"
7,"POLYGON((70 40,74 40,74 44,70 44,70 40))"
8,"POLYGON((73 41,78 41,78 45,73 45,73 41))"
X
for layers in main,displacement main,displacement,pushes main,pushes; do
    rm -f out.gpkg
    expect 0 separate pairs.gpkg out.gpkg --gap 1 --layers "$layers"
done
struck geometry "8 9 13 16" pairs.gpkg main,displacement
struck real "24 25 37 48" pairs.gpkg main,displacement

# With two threads each half of the rows is read back by a thread of its own, with one thread they are read in order.
"$SUNDER_BUILD/sunder-town" --buildings 6000 --seed 1 town.gpkg >/dev/null
for threads in 1 2; do
    expect 0 separate town.gpkg plain.gpkg --overwrite --gap 1 --layers main --input-layer buildings --allow-conflicts --threads $threads
    struck geometry "2 2999 3001 6000" town.gpkg main --input-layer buildings --allow-conflicts --threads $threads
done

# GDAL knows the extent only of rows that went through it. A registered extent that differs from the file's features is
# detected.
rm -f out.gpkg
status=0
ALTER=extent ALTER_AT=1 LD_PRELOAD=$alter "$SUNDER" separate town.gpkg out.gpkg --input-layer buildings --gap 1 --allow-conflicts -q >said 2>&1 ||
    status=$?
[ "$status" -eq 1 ] && [ ! -e out.gpkg ] && grep -q 'layer buildings: its registered extent leaves features out' said ||
    fail "an extent that is too small: status $status, $(head -1 said)"
finish
