# shellcheck shell=bash disable=SC1091
# Every feature that is reported as written is in the file: on a disk that becomes full at any byte, and with streams
# and formats that cannot be read back.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
strike=$SUNDER_BUILD/tests/strike

# ---- a small file system: FlatGeobuf's header counts features that did not fit
small() {
    mkdir -p disk && mount -t tmpfs -o size="$1" tmpfs disk || exit 77
    shift
    "$SUNDER" "$@"
    local status=$?
    ls -A disk >left
    umount disk
    return $status
}
if unshare -m true 2>/dev/null && (export -f small; unshare -m bash -c 'small 64k --version') >/dev/null 2>&1; then
    export -f small
    for size in 100k 152k; do
        status=0
        unshare -m bash -c 'small "$@"' small "$size" separate --gap 3 --layers main -q "$town" disk/o.fgb 2>err || status=$?
        [ "$status" -eq 1 ] && [ ! -s left ] || fail "FlatGeobuf in $size: status $status, $(cat left)"
    done
else
    echo "not tried: no file system can be mounted here"
fi

# ---- the same by a write that fails, at places throughout the file and at its end
if [ -x "$strike" ] && "$strike" list 0 true 3>report 2>/dev/null; then
    export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
    for each in fgb shp geojson; do
        mkdir -p at && rm -rf at/*
        STRIKE_UNDER=at "$strike" list 0 "$SUNDER" separate --layers main -q "$town" "at/o.$each" 3>report 2>err
        read -r _ bytes status _ <report
        [ "$status" -eq 0 ] || fail "$each is not written, even without a limit"
        # The list of the files to be put in place contains their inode numbers and times, whose length varies between
        # runs. A run that writes a byte less than the measured one may end before the last bytes are reached; this
        # cannot happen at earlier places.
        for place in $((bytes / 3)) $((bytes - 64)) $((bytes - 8)) $((bytes - 1)); do
            rm -rf at/*
            STRIKE_UNDER=at "$strike" full "$place" "$SUNDER" separate --layers main -q "$town" "at/o.$each" 3>report 2>err
            read -r _ _ status struck _ <report
            [ "$struck" = - ] && [ "$place" -ge $((bytes - 8)) ] && continue
            [ "$status" -eq 1 ] && [ -z "$(ls -A at)" ] || fail "$each on a disk full at byte $place: status $status, $(ls -A at)"
        done
    done
else
    echo "not tried: no process can be traced here"
fi

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X

# ---- a stream: success depends on its writes, and a message says that it was not read back
expect 0 separate in.gpkg /vsistdout/ --of GeoJSON --stats s.json
says s.json 'standard output is read back in memory, not from there'
expect 0 separate in.gpkg /vsistdout/ --of GeoJSON --strict --stats s.json --layers main
# ---- the same for a format that GDAL can only write
if ogrinfo --formats | grep -q PGDUMP; then
    refused 1 'GDAL cannot read PGDUMP' separate in.gpkg o.sql --of PGDUMP
    expect 0 separate in.gpkg o.sql --of PGDUMP --allow-inexact-output --stats s.json --layers main
    says s.json '"verified": false'
    says s.json 'was not read back: PGDUMP is only written'
    same "$(grep -c '^INSERT INTO' o.sql)" 2 'features in o.sql'
    if [ -x "$strike" ] && [ -s report ]; then
        mkdir -p at && rm -rf at/*
        STRIKE_UNDER=at "$strike" full 300 "$SUNDER" separate in.gpkg at/o.sql --of PGDUMP --allow-inexact-output 3>report 2>err
        read -r _ _ status _ <report
        [ "$status" -eq 1 ] && [ -z "$(ls -A at)" ] || fail "PGDUMP on a full disk: status $status, $(ls -A at)"
    fi
fi
finish
