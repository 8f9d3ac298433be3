# shellcheck shell=bash disable=SC1091
# The program does not call GDAL's functions for paths, which return "" for paths longer than 2,047 bytes, or
# CPLSPrintf(), which cuts texts at 8,000 bytes; gis/base/path.h has functions in their place. Paths are not put
# together in arrays of a fixed size.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
functions='CPLSPrintf|CPLFormFilename|CPLFormCIFilename|CPLGetPath|CPLGetDirname|CPLGetFilename|CPLGetBasename|CPLGetExtension'
functions+='|CPLResetExtension|CPLGetCurrentDir|CPLProjectRelativeFilename|CPLExtractRelativePath|CPLCleanTrailingSlash'
functions+='|CPLCorrespondingPaths|CPLGenerateTempFilename|CPLExpandTilde|CPLGetHomeDir|CPLLaunderForFilename'
# One process reads all files: a process for each would take minutes on systems that start processes slowly.
while read -r line; do
    say "gis/$line"
done < <(cd "$root/gis" && sources gis | xargs awk -v functions="$functions" '
    FNR == 1 { comment = 0 }
    { sub(/\/\*.*\*\//, "") }
    /\/\*/ { comment = 1 }
    comment { if (/\*\//) comment = 0; next }
    match($0, "(" functions ")(Safe)?\\(.*|char [a-z_]+\\[(4096|PATH_MAX)\\].*") { print FILENAME ": " substr($0, RSTART) }')
looked=$(sources gis | wc -l)
[ "$looked" -gt 100 ] || say "only $looked sources were looked at"
finish
