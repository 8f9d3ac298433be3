#!/usr/bin/env bash
# Draws a piece of a town as SVG, on standard output, with ogr2ogr and awk.
#
#   draw.sh TOWN.gpkg XMIN YMIN XMAX YMAX                    the buildings and roads as they are
#   draw.sh TOWN.gpkg XMIN YMIN XMAX YMAX SEPARATED.gpkg     beside them what `sunder separate` wrote: what moved, with
#                                                            arrows as long as the moves (ARROWS=N: N times as long)
set -euo pipefail
if [ $# -ne 5 ] && [ $# -ne 6 ]; then
    sed -n '2,6s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
town=$1 xmin=$2 ymin=$3 xmax=$4 ymax=$5 separated=${6-}

# Prints lines "TAG<tab>CLASS<tab>WIDTH<tab>WKT" for awk, for all features that reach into the picture.
layer() { # tag, file, layer, SQL for the class, SQL for the width
    ogr2ogr -f CSV /vsistdout/ "$2" -dialect SQLite -spat "$xmin" "$ymin" "$xmax" "$ymax" -lco GEOMETRY=AS_WKT \
        -lco SEPARATOR=TAB -lco STRING_QUOTING=IF_NEEDED -sql "SELECT $4 AS class, $5 AS width, * FROM \"$3\"" |
        awk -F'\t' -v tag="$1" 'NR > 1 { gsub(/"/, ""); print tag "\t" $2 "\t" $3 "\t" $1 }'
}

{
    layer road "$town" roads kind width
    if [ -z "$separated" ]; then
        layer old "$town" buildings kind 0
    else
        ogr2ogr -f CSV /vsistdout/ "$separated" -lco SEPARATOR=TAB -sql 'SELECT sunder_st, sunder_dx, sunder_dy FROM buildings' \
            >/dev/null # fails early, and with OGR's own words, where the fields are missing
        if ogrinfo -so "$separated" buildings | grep -q '^sunder_lvl'; then # written outlines may be smaller or larger
            layer old "$town" buildings kind "'0;0'"
            layer new "$separated" buildings \
                "CASE WHEN sunder_lvl > 0 THEN 'cut' WHEN sunder_cut < 0 THEN 'larger' ELSE sunder_st END" 0
        else
            # The old outlines: each written feature, moved back by its own move, in the colour of its status.
            layer old "$separated" buildings sunder_st "sunder_dx || ';' || sunder_dy"
            layer new "$separated" buildings sunder_st 0
        fi
        layer arrow "$separated" buildings_displacement "'moved'" 0
        layer conflict "$separated" buildings_conflicts kind 0
    fi
} | awk -F'\t' -v xmin="$xmin" -v ymin="$ymin" -v xmax="$xmax" -v ymax="$ymax" -v pair="${separated:+1}" \
    -v stretch="${ARROWS:-1}" '
function X(x) { return (x - xmin) * scale + shift }
function Y(y) { return (ymax - y) * scale }
function path(wkt, dx, dy,    rings, points, n, m, i, j, xy, d) { # every ring or line of a WKT as one path
    gsub(/^[A-Z ]*\(+|\)+$/, "", wkt)
    n = split(wkt, rings, /\)+, *\(+/)
    d = ""
    for (i = 1; i <= n; i++) {
        m = split(rings[i], points, ",")
        for (j = 1; j <= m; j++) {
            split(points[j], xy, " ")
            d = d sprintf("%s%.1f %.1f", j == 1 ? "M" : "L", X(xy[1] - dx), Y(xy[2] - dy))
        }
        if (closed) d = d "Z"
    }
    return d
}
function panel(which, title,    i, d, xy, ends, part, x0, y0, x1, y1) {
    printf "<svg class=\"%s\" x=\"%d\" width=\"%d\" height=\"%d\">\n<rect width=\"100%%\" height=\"100%%\" class=\"ground\"/>\n", which, at, width, height
    closed = 0
    for (i = 1; i <= n; i++) if (tag[i] == "road")
        printf "<path class=\"road\" stroke-width=\"%.1f\" d=\"%s\"/>\n", size[i] * scale, path(shape[i], 0, 0)
    closed = 1
    for (i = 1; i <= n; i++) if (tag[i] == which) {
        split(which == "old" && pair ? size[i] : "0;0", xy, ";")
        printf "<path class=\"b %s\" d=\"%s\"/>\n", class[i], path(shape[i], xy[1], xy[2])
    }
    if (which == "new") for (i = 1; i <= n; i++) if (tag[i] == "old" && class[i] ~ /^(moved|blocked)$/) { # where it stood
        split(size[i], xy, ";")
        printf "<path class=\"ghost\" d=\"%s\"/>\n", path(shape[i], xy[1], xy[2])
    }
    closed = 0
    if (which == "new") {
        for (i = 1; i <= n; i++) if (tag[i] == "conflict") printf "<path class=\"conflict\" d=\"%s\"/>\n", path(shape[i], 0, 0)
        for (i = 1; i <= n; i++) if (tag[i] == "arrow") {
            part = shape[i]; gsub(/^[A-Z ]*\(|\)$/, "", part); split(part, ends, ",")
            split(ends[1], xy, " "); x0 = X(xy[1]); y0 = Y(xy[2])
            split(ends[2], xy, " "); x1 = x0 + stretch * (X(xy[1]) - x0); y1 = y0 + stretch * (Y(xy[2]) - y0)
            arrow(x0, y0, x1, y1)
        }
    }
    printf "<text x=\"12\" y=\"26\">%s</text>\n</svg>\n", title
    at += width + 12
}
function arrow(x0, y0, x1, y1,    l, ux, uy, head) {
    l = sqrt((x1 - x0) ^ 2 + (y1 - y0) ^ 2)
    if (l < 0.5) return
    ux = (x1 - x0) / l; uy = (y1 - y0) / l
    head = l < 9 ? l * 0.6 : 5.4
    printf "<path class=\"arrow\" d=\"M%.1f %.1fL%.1f %.1f\"/>", x0, y0, x1 - ux * head, y1 - uy * head
    printf "<path class=\"head\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\"/>\n", x1, y1, x1 - ux * head - uy * head * 0.45,
        y1 - uy * head + ux * head * 0.45, x1 - ux * head + uy * head * 0.45, y1 - uy * head - ux * head * 0.45
}
{ n++; tag[n] = $1; class[n] = $2; size[n] = $3; shape[n] = $4 }
END {
    width = pair ? 560 : 900
    scale = width / (xmax - xmin); height = (ymax - ymin) * scale; shift = 0; at = 0
    all = pair ? 2 * width + 12 : width
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\">\n", all, height, all, height
    print "<style>.ground{fill:#f4f1ea}.road{fill:none;stroke:#fff;stroke-linecap:round}" \
        ".b{fill:#c9c4bb;stroke:#6d675e;stroke-width:.8;fill-rule:evenodd;fill-opacity:.85}" \
        ".moved{fill:#5aa899;stroke:#1f5f55}.blocked{fill:#d1495b;stroke:#7a1f2b}.old .moved,.old .blocked{fill:#e0a13e;stroke:#7d4f0c;fill-opacity:.7}" \
        ".cut{fill:#8f9bc7;stroke:#39477d}.larger{fill:#d9c25a;stroke:#6f5f12}.hidden{fill:none;stroke-dasharray:2.5 2}.ghost{fill:none;stroke:#7d4f0c;stroke-width:.8;stroke-dasharray:2.5 2}.fixed,.church,.town_hall,.monument{fill:#59636e;stroke:#2c3238}" \
        ".arrow{fill:none;stroke:#c2410c;stroke-width:1.6}.head{fill:#c2410c}.conflict{fill:none;stroke:#d0006f;stroke-width:2.5}" \
        "text{font:600 18px sans-serif;fill:#33302b;paint-order:stroke;stroke:#f4f1ea;stroke-width:4px}</style>"
    if (pair) { panel("old", "before"); panel("new", "after") } else panel("old", "")
    print "</svg>"
}'
