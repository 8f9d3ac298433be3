#!/usr/bin/env bash
# Makes the documentation as plain HTML pages, from the pages of this folder and the READMEs, by pandoc; the manual by
# pandoc, too, and the reference of the C library from its headers by Doxygen.
#
#   site.sh FOLDER [MANUAL]      replaces FOLDER; MANUAL has the manual pages of single commands, which a build makes;
#                                `cmake --build build/release --target docs` calls it
#
# Links from page to page become links to .html. Linked files that are no pages (pictures, scripts, sources) are copied
# to the place that they have in the repository. tests/docs/test_site.sh looks for links that lead nowhere.
set -euo pipefail
[ $# -eq 1 ] || [ $# -eq 2 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
missing=
for tool in pandoc doxygen; do command -v "$tool" >/dev/null || missing="$missing $tool"; done
if [ "$missing" ]; then
    echo "the documentation is made by pandoc and doxygen; not installed:$missing (on Debian and Ubuntu: apt-get install$missing)" >&2
    exit 1
fi
mkdir -p "$(dirname "$1")"
site=$(cd "$(dirname "$1")" && pwd -P)/$(basename "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
manual=${2:+$(cd "$2" && pwd -P)}
cd "$source"

# ---- What belongs to the site: the front page, docs/, and every page that one of these leads to ----
declare -A known
pages=()
found=(README.md docs/*.md docs/guide/*.md)
while [ "${#found[@]}" -gt 0 ]; do
    page=${found[0]}
    found=("${found[@]:1}")
    [ -z "${known[$page]-}" ] || continue
    known[$page]=page
    pages+=("$page")
    while IFS= read -r target; do
        target=${target%%#*}
        case $target in '' | *://* | mailto:*) continue ;; esac
        path=$(realpath -m --relative-to=. "$(dirname "$page")/$target")
        case $path in ../*) continue ;; esac
            [ -f "$path" ] || continue
        case $path in
            *.md) found+=("$path") ;;
            *) known[$path]=file ;;
        esac
    done < <(grep -o '](\([^)]*\))' "$page" | sed 's/^](\(.*\))$/\1/')
done

# ---- How a page is made ----
cat >"$work/links.lua" <<'LUA'
-- README.md is the page of its folder: index.html. Manual pages are pages, too.
function Link(link)
  if not link.target:match("^%a[%w+.-]*:") then
    local path, part = link.target:match("^([^#]*)(.*)$")
    path = path:gsub("README%.md$", "index.html"):gsub("%.md$", ".html"):gsub("(sunder[%w-]*%.1)$", "%1.html")
    link.target = path .. part
  end
  return link
end
LUA
cat >"$work/page.html" <<'HTML'
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$pagetitle$</title>
<link rel="stylesheet" href="$root$site.css">
</head>
<body>
<nav><a href="$root$index.html">Sunder</a> <a href="$root$docs/tutorial.html">Tutorial</a> <a href="$root$docs/guide/index.html">Guide</a>
<a href="$root$docs/displacement.html">How it decides</a> <a href="$root$docs/guarantees.html">Guarantees</a>
<a href="$root$manual/index.html">Manual</a> <a href="$root$gis/qgis/index.html">QGIS</a> <a href="$root$reference/index.html">In C</a></nav>
<main>
$body$
</main>
</body>
</html>
HTML
mkdir "$work/site"
cat >"$work/site/site.css" <<'CSS'
body { margin: 0; font: 16px/1.55 sans-serif; color: #33302b; background: #fdfcf9; }
nav { padding: .6em 1.2em; background: #1f5f55; }
nav a { color: #fff; margin-right: 1.1em; text-decoration: none; }
nav a:hover { text-decoration: underline; }
main { max-width: 62em; margin: 0 auto; padding: 1em 1.2em 4em; }
a { color: #1f5f55; }
img, svg { max-width: 100%; height: auto; }
pre { padding: .7em 1em; background: #f4f1ea; overflow-x: auto; font-size: 14px; line-height: 1.4; }
code { font-family: monospace; background: #f4f1ea; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { padding: .3em .7em; border: 1px solid #d8d2c4; text-align: left; vertical-align: top; }
h1, h2, h3 { line-height: 1.25; }
CSS

make_page() { # source, format, page of the site
    local root title
    root=$(realpath -m --relative-to="$(dirname "$3")" .)/
    title=$(grep -m 1 '^# ' "$1" | sed 's/^# //; s/`//g') || title=$(basename "$1")
    mkdir -p "$work/site/$(dirname "$3")"
    pandoc --from="$2" --to=html5 --template="$work/page.html" --lua-filter="$work/links.lua" --no-highlight \
        --variable="root:${root#./}" --variable="pagetitle:$title" --output="$work/site/$3" "$1"
}
for page in "${pages[@]}"; do
    make_page "$page" gfm+gfm_auto_identifiers "$(printf '%s' "${page%.md}.html" | sed 's|README\.html$|index.html|')"
done
for path in "${!known[@]}"; do
    [ "${known[$path]}" = file ] || continue
    case $path in
        *.1) ;;
        *) mkdir -p "$work/site/$(dirname "$path")" && cp "$path" "$work/site/$path" ;;
    esac
done
make_page gis/sunder.1 man gis/sunder.1.html
{
    printf '# The manual\n\n- [sunder, all commands](../gis/sunder.1)\n'
    for page in ${manual:+"$manual"/sunder-*.1}; do
        [ -f "$page" ] || continue
        name=$(basename "$page")
        make_page "$page" man "manual/$name.html"
        printf -- '- [%s](%s)\n' "${name%.1}" "$name"
    done
} >"$work/manual.md"
make_page "$work/manual.md" gfm manual/index.html

# ---- The reference of the library ----
# Comments of the headers are plain ones: a filter has Doxygen read those before a declaration as its description.
version=$(sed -n 's/^#define SUNDER_VERSION "\(.*\)"/\1/p' src/sunder.h)
cat >"$work/comments.awk" <<'AWK'
/^\/\* ----/ { gsub(/^\/\* -+ | -+ \*\/$/, ""); print "/** @name " $0 " */"; next }
/^#ifndef SUNDER_.*H$/ { body = 1 }
body { sub(/^\/\* /, "/** "); sub(/\/\* ([^\/]|\/[^*])*$/, "&") }
body && /[;,{] +\/\* / { sub(/\/\* /, "/**< ") }
{ print }
AWK
cat >"$work/Doxyfile" <<DOXY
PROJECT_NAME = "libsunder"
PROJECT_NUMBER = $version
PROJECT_BRIEF = "Exact Minkowski sums, least separating translations, displacement of map layers"
INPUT = $(echo src/sunder*.h)
INPUT_FILTER = "awk -f $work/comments.awk"
FILTER_SOURCE_FILES = NO
OUTPUT_DIRECTORY = $work
HTML_OUTPUT = site/reference
GENERATE_LATEX = NO
OPTIMIZE_OUTPUT_FOR_C = YES
EXTRACT_ALL = YES
EXTRACT_STATIC = YES
TYPEDEF_HIDES_STRUCT = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = SUNDER_API= SUNDER_EXPERIMENTAL=
MARKDOWN_SUPPORT = NO
HTML_TIMESTAMP = NO
SEARCHENGINE = NO
SORT_MEMBER_DOCS = NO
QUIET = YES
WARNINGS = NO
HAVE_DOT = NO
STRIP_FROM_PATH = $source
DOXY
doxygen "$work/Doxyfile"

rm -rf "$site"
mv "$work/site" "$site"
echo "$site/index.html"
