# shellcheck shell=bash disable=SC1091
# The program does not call GDAL's functions for paths, which return "" for paths longer than 2,047 bytes, or
# CPLSPrintf(), which cuts texts at 8,000 bytes; gis/base/path.h has functions in their place. Paths are not put
# together in arrays of a fixed size.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
functions='CPLSPrintf|CPLFormFilename|CPLFormCIFilename|CPLGetPath|CPLGetDirname|CPLGetFilename|CPLGetBasename|CPLGetExtension'
functions+='|CPLResetExtension|CPLGetCurrentDir|CPLProjectRelativeFilename|CPLExtractRelativePath|CPLCleanTrailingSlash'
functions+='|CPLCorrespondingPaths|CPLGenerateTempFilename|CPLExpandTilde|CPLGetHomeDir|CPLLaunderForFilename'
# without_comments FILE: prints its code.
without_comments() { sed 's#/\*.*\*/##; /\/\*/,/\*\//d' "$1"; }
looked=0
while read -r file; do
    looked=$((looked + 1))
    while read -r line; do
        say "gis/$file: $line"
    done < <(without_comments "$root/gis/$file" | grep -oE "($functions)(Safe)?\(.*|char [a-z_]+\[(4096|PATH_MAX)\].*")
done < <(sources gis)
[ "$looked" -gt 100 ] || say "only $looked sources were looked at"
finish
