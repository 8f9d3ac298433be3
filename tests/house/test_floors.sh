# shellcheck shell=bash disable=SC1091
# Includes between folders follow the floors in src/README.md and gis/README.md downwards, and every folder is on a
# floor.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

for tree in src gis; do
    plan=$(floors $tree)
    [ -n "$plan" ] || say "$tree/README.md states no floors"
    held=$(sources $tree | grep / | sed 's#/[^/]*$##' | sort -u)
    for folder in $plan; do
        grep -qx "$folder" <<<"$held" || say "$tree/README.md: there is nothing in $folder"
    done
    for folder in $held; do
        grep -qx "$folder" <<<"$plan" || say "$tree/$folder is on no floor"
    done
    pairs=$(includes $tree)
    [ "$(wc -l <<<"$pairs")" -gt 20 ] || say "$tree: hardly any include was found"
    while read -r line; do
        say "$tree: $line"
    done < <(awk '
        NR == FNR { rank[$1] = NR; next }
        $1 == "." || $1 == $2 { next }
        $2 == "." || !($2 in rank) { print $3 " includes a header of no floor (" $2 ")"; next }
        rank[$2] >= rank[$1] { print $3 " includes a header of " $2 ", which is no lower than " $1 }
    ' <(echo "$plan") <(echo "$pairs"))
done
# The library does not use the program, GDAL or GEOS; the program uses the public headers only.
grep -rnE '# *include *[<"](gdal|ogr|cpl|geos)' "$root/src" && say "src/ includes a header of GDAL or GEOS"
for header in $(cd "$root/gis" && sources gis | xargs sed -n 's/^ *# *include "\([^"]*\)".*/\1/p' | sort -u); do
    [ -f "$root/src/$header" ] && [ "$header" = "${header##*/}" ] || [ -f "$root/gis/$header" ] || say "gis/ includes $header, which is not its own"
done
finish
