# shellcheck shell=bash disable=SC1091
# --update into a database whose triggers remove or change the rows that register the new layer. Either the run fails
# and the file is unchanged, byte by byte, or a reader finds the layer with all its features, its type and its CRS.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v sqlite3 >/dev/null || { echo "skipped: no shell of SQLite"; exit 77; }
export SOURCE_DATE_EPOCH=1700000000

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
"$SUNDER" separate in.gpkg pristine.gpkg -q --layers main || fail "no GeoPackage"
ogr2ogr -f SQLite pristine.sqlite in.gpkg || fail "no SQLite database"
described() { ogrinfo -ro -so "$1" new 2>/dev/null | grep -E '^(Geometry:|Feature Count:|    ID\["EPSG",25832\])'; }
expect 0 separate in.gpkg plain.gpkg --layers main --output-layer new --gap 1
wanted=$(described plain.gpkg)
[ "$(wc -l <<<"$wanted")" -eq 3 ] || fail "described: $wanted"

# trigger TABLE COLUMN ACTION: prints SQL; COLUMN is the one with the name of the layer.
trigger() {
    local when=${3%%:*} what=${3#*:}
    echo "CREATE TRIGGER hostile $when ON $1 BEGIN $what; END"
}
refusals=0 updates=0
update() { # update PRISTINE TABLE COLUMN ACTION
    local file=o.${1##*.} before now
    rm -f o.* && cp "$1" "$file"
    sqlite3 "$file" "$(trigger "$2" "$3" "${4//TABLE/$2}")" || { fail "no trigger: $*"; return; }
    before=$(cksum "$file")
    run separate in.gpkg "$file" --update --output-layer new --layers main --gap 1
    updates=$((updates + 1))
    case $status in
    0)
        now=$(described "$file")
        if [ "${file##*.}" = sqlite ]; then [ "$(count "$file" new)" = 2 ]; else [ "$now" = "$wanted" ]; fi ||
            fail "$2, $4: done, and a reader finds '$now'"
        ;;
    1)
        refusals=$((refusals + 1))
        same "$(cksum "$file")" "$before" "$2, $4: refused, and the file"
        [ "$(grep -c '^sunder: error: ' err)" -eq 1 ] || fail "$2, $4: not exactly one error message"
        ;;
    *) fail "$2, $4: status $status" ;;
    esac
}

swallow='BEFORE INSERT:SELECT RAISE(IGNORE)'
remove='AFTER INSERT:DELETE FROM TABLE WHERE rowid = new.rowid'
for table in gpkg_contents gpkg_geometry_columns; do
    for action in "$swallow" "$remove" 'BEFORE UPDATE:SELECT RAISE(IGNORE)' \
        'AFTER INSERT:UPDATE TABLE SET srs_id = 4326 WHERE rowid = new.rowid' \
        "AFTER INSERT:UPDATE TABLE SET table_name = 'houses2' WHERE rowid = new.rowid" \
        'AFTER UPDATE:DELETE FROM TABLE WHERE rowid = new.rowid'; do
        update pristine.gpkg $table table_name "$action"
    done
done
update pristine.gpkg gpkg_contents table_name "AFTER INSERT:UPDATE TABLE SET data_type = 'tiles' WHERE rowid = new.rowid"
update pristine.gpkg gpkg_geometry_columns table_name \
    "AFTER INSERT:UPDATE TABLE SET geometry_type_name = 'POINT' WHERE rowid = new.rowid"
update pristine.gpkg gpkg_geometry_columns table_name \
    "AFTER INSERT:UPDATE TABLE SET column_name = 'fid' WHERE rowid = new.rowid"
update pristine.gpkg gpkg_spatial_ref_sys srs_id "$swallow"
update pristine.gpkg gpkg_extensions table_name "$swallow"
update pristine.sqlite geometry_columns f_table_name "$swallow"
update pristine.sqlite geometry_columns f_table_name "$remove"
[ "$refusals" -ge 12 ] || fail "only $refusals of $updates were refused: the test proves little"
echo "$updates databases, $refusals refused"
finish
