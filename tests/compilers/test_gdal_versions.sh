#!/usr/bin/env bash
# Does the program compile with the headers of GDAL 3.13? The installed headers are changed as in its migration guide:
# GDALGetMetadata() returns a list of constants, OGR_G_SetPoint() and similar functions return an error, and the macros
# MIN, MAX, ABS and M_PI are gone. In C a list of constants is still of type char **; here it gets the type that it has
# in C++, so that the compiler warns if a list that GDAL owns is stored in, or passed to, something that may change it.
set -euo pipefail
build=${SUNDER_BUILD:?}
source=${SUNDER_SOURCE:?}
skip() { echo "skipped: $1"; exit 77; }
command -v gcc >/dev/null || skip "gcc, whose messages are read, is not installed"
command -v gdal-config >/dev/null || skip "gdal-config is not installed"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir "$work/include"
for folder in $(gdal-config --cflags | tr ' ' '\n' | sed -n 's/^-I//p'); do
    if [[ -f $folder/gdal.h ]]; then cp "$folder"/*.h "$work/include"; fi
done
cd "$work/include"
sed -i 's/^char CPL_DLL \*\*\(CPL_STDCALL \)\?GDALGetMetadata(/CSLConstList CPL_DLL \1GDALGetMetadata(/' gdal.h
sed -i -E 's/^void +CPL_DLL +(OGR_G_(SetPoint|AddPoint)[A-Za-z0-9_]*\()/OGRErr CPL_DLL \1/' ogr_api.h
sed -i 's/^typedef char \*\*CSLConstList;/typedef const char *const *CSLConstList;/' cpl_port.h
printf '#undef MIN\n#undef MAX\n#undef ABS\n#undef M_PI\n' >>cpl_port.h
grep -qE '^CSLConstList CPL_DLL (CPL_STDCALL )?GDALGetMetadata\(' gdal.h || skip "gdal.h is not as it is known here"
grep -qE '^OGRErr CPL_DLL OGR_G_SetPoint_2D\(' ogr_api.h || skip "ogr_api.h is not as it is known here"

cd "$source/gis"
grep -lE '\b(GDAL|OGR|CPL|CSL|VSI|cpl_|ogr_|gdal)' ./*.c ./*/*.c >"$work/files"
files=$(wc -l <"$work/files")
((files > 50)) || { echo "FAILED: the sources of the program were not found"; exit 1; }
status=0
LC_ALL=C xargs -P "$(nproc 2>/dev/null || echo 2)" -n 20 gcc -fsyntax-only -std=c17 -D_XOPEN_SOURCE=700 -Wall -Wextra \
    -Wpedantic -Werror -Wno-error=incompatible-pointer-types -I. -I"$source/src" -isystem "$work/include" \
    <"$work/files" >"$work/said" 2>&1 || status=1
# Passing a list of the program's own to a function that takes a list of constants is right.
if grep -E "'char \*\*' from incompatible pointer type 'CSLConstList'|expected 'char \*\*' but argument is of type 'CSLConstList'" \
    "$work/said"; then
    status=1
fi
if ((status)); then
    echo "FAILED:"
    grep -E '(error|warning): ' -A 2 "$work/said" | head -n 40
    exit 1
fi
echo "$files files compile"
