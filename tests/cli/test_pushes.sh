# shellcheck shell=bash disable=SC1091
# LAYER_pushes: the forces are in equilibrium (pushes.py, which reads only the written layers).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg

# held OPTIONS...: at least nine tenths of all blocks that moved are in equilibrium. The forces of springs and of prices
# are not in the layer.
held() {
    run separate "$town" o.gpkg --overwrite -q -l buildings --rows no --ease no "$@"
    case $status in 0 | 3) ;; *) fail "$*: status $status" ;; esac
    python3 "$SUNDER_SOURCE/tests/cli/pushes.py" o.gpkg buildings 0.9 >said 2>&1 || fail "$*: $(cat said)"
    echo "$*: $(cat said)"
}
held --gap 3
held --gap 3 --barrier "$town,layer=roads,width=5"
held --gap 0 --no-blocks
[ "$(ogrinfo -so -al o.gpkg buildings_pushes | grep -c '^\(fid_a\|fid_b\|barr_fid\|barrier\|force\|nx\|ny\): ')" = 7 ] ||
    fail "columns of buildings_pushes"

# Two unit squares that overlap by half: each moves a quarter, and the force is twice the move, the gradient of the
# cost.
printf 'WKT,w\n"POLYGON((0 0,1 0,1 1,0 1))",1\n"POLYGON((0.5 0,1.5 0,1.5 1,0.5 1))",3\n' | layer two.gpkg two POLYGON
expect 0 separate two.gpkg two_out.gpkg --no-blocks -q
row=$(ogrinfo -q -al two_out.gpkg two_pushes | tr -d '\n')
case $row in *'fid_a (Integer64) = 1'*'fid_b (Integer64) = 2'*'force (Real) = 0.5'*'nx (Real) = 1 '*'ny (Real) = 0 '*) ;; *) fail "two squares: $row" ;; esac
case $row in *'barrier (String) = (null)'*'LINESTRING (0.25 0.5,1.25 0.5)'*) ;; *) fail "two squares: $row" ;; esac

# Against a wall: fid_b is null, and `barrier` has the name of the wall.
printf 'WKT,w\n"LINESTRING(0 -5,0 5)",1\n' | layer wall.gpkg wall LINESTRING
printf 'WKT,w\n"POLYGON((0.5 0,1.5 0,1.5 1,0.5 1))",1\n' | layer one.gpkg one POLYGON
expect 0 separate one.gpkg one_out.gpkg --barrier wall.gpkg,width=2 -q
row=$(ogrinfo -q -al one_out.gpkg one_pushes | tr -d '\n')
case $row in *'fid_b (Integer64) = (null)'*'barrier (String) = wall'*'barr_fid (Integer64) = 1'*'force (Real) = 1'*'nx (Real) = -1 '*) ;; *) fail "wall: $row" ;; esac

# Without the option the layer is not written.
expect 0 separate two.gpkg main.gpkg --no-blocks -q --layers main,conflicts
ogrinfo -q main.gpkg | grep -q pushes && fail "pushes, unasked"
expect 0 separate two.gpkg alone.gpkg --no-blocks -q --layers pushes
ogrinfo -q alone.gpkg | grep -q pushes || fail "the layer has no pushes"
finish
