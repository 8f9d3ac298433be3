#!/usr/bin/env bash
# Draws layers as SVG, on standard output, with ogr2ogr and awk: panels side by side, layers one on the other.
#
#   draw.sh XMIN YMIN XMAX YMAX WIDTH PANEL...
#
# in the coordinates of the layers, each panel WIDTH pixels wide. A PANEL is TITLE=LAYER;LAYER..., and a LAYER is CLASS,FILE,NAME
# with a class of the style sheet below: road, building, block, robot, route, robot2, route2.
set -euo pipefail
if [ $# -lt 6 ]; then
    sed -n '2,7s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
xmin=$1 ymin=$2 xmax=$3 ymax=$4 width=$5
shift 5

# What is cut off is cut off outside the picture, so that no such edge is seen.
around=$(awk -v a="$xmin" -v b="$ymin" -v c="$xmax" -v d="$ymax" 'BEGIN { m = (c - a) / 20; printf "%.3f %.3f %.3f %.3f", a - m, b - m, c + m, d + m }')

# "CLASS<tab>WKT", a line for each feature that reaches into the picture.
layer() { # class, file, name
    # shellcheck disable=SC2086 # four numbers
    ogr2ogr -f CSV /vsistdout/ "$2" "$3" -clipsrc $around -select '' -lco GEOMETRY=AS_WKT -lco SEPARATOR=TAB |
        awk -F'\t' -v class="$1" 'NR > 1 { gsub(/"/, "", $1); print class "\t" $1 }'
}

for panel; do
    printf 'panel\t%s\n' "${panel%%=*}"
    IFS=';' read -ra layers <<<"${panel#*=}"
    for entry in "${layers[@]}"; do
        IFS=, read -r class file name <<<"$entry"
        layer "$class" "$file" "$name"
    done
done | awk -F'\t' -v xmin="$xmin" -v ymin="$ymin" -v xmax="$xmax" -v ymax="$ymax" -v width="$width" -v panels=$# '
function path(wkt, closed,    rings, points, n, m, i, j, xy, d) { # every ring or line of a WKT as one path
    gsub(/^[A-Z ]*\(+|\)+$/, "", wkt)
    n = split(wkt, rings, /\)+, *\(+/)
    d = ""
    for (i = 1; i <= n; i++) {
        m = split(rings[i], points, ",")
        for (j = 1; j <= m; j++) {
            split(points[j], xy, " ")
            d = d sprintf("%s%.1f %.1f", j == 1 ? "M" : "L", (xy[1] - xmin) * scale, (ymax - xy[2]) * scale)
        }
        if (closed) d = d "Z"
    }
    return d
}
function end_panel() { if (at >= 0) printf "<text x=\"12\" y=\"26\">%s</text>\n</svg>\n", title }
BEGIN {
    scale = width / (xmax - xmin); height = (ymax - ymin) * scale; gutter = 12; at = -1
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\">\n", panels * (width + gutter) - gutter, height
    print "<style>.ground{fill:#f4f1ea}.road{fill:none;stroke:#fff;stroke-width:2.5}" \
        ".building{fill:#c9c4bb;stroke:#6d675e;stroke-width:.6;fill-rule:evenodd}" \
        ".block{fill:#5aa899;fill-opacity:.35;stroke:#1f5f55;stroke-width:1.4;fill-rule:evenodd}" \
        ".robot{fill:#e0a13e;stroke:#7d4f0c;stroke-width:.6}.robot2{fill:#5aa899;stroke:#1f5f55;stroke-width:.6}" \
        ".route{fill:none;stroke:#c2410c;stroke-width:1.6}.route2{fill:none;stroke:#1f5f55;stroke-width:1.6}" \
        "text{font:600 18px sans-serif;fill:#33302b;paint-order:stroke;stroke:#f4f1ea;stroke-width:4px}</style>"
}
$1 == "panel" {
    end_panel()
    at = at < 0 ? 0 : at + width + gutter
    title = $2
    printf "<svg x=\"%d\" width=\"%d\" height=\"%d\">\n<rect width=\"100%%\" height=\"100%%\" class=\"ground\"/>\n", at, width, height
    next
}
$2 != "" { printf "<path class=\"%s\" d=\"%s\"/>\n", $1, path($2, $2 ~ /POLYGON/) }
END { end_panel(); print "</svg>" }'
