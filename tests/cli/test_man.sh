# shellcheck shell=bash disable=SC1091
# The manual page, --help and the parser have the same options, with the same values, spellings and defaults, and so
# have the pages of the commands, which are made from it. The examples of the manual page run.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
page=$SUNDER_SOURCE/gis/sunder.1

# Prints "--gap LENGTH [0]", "--of FORMAT (-f, -of, --format) [by name]", one per line, in the form of a page.
headings() { sed -n '/^\.SH OPTIONS/,/^\.SH [A-Z]/ s/^\.B \(\\-.*\)/\1/p' "$1" | sed 's/\\//g' | sort; }
sed -n '/^\.SH OPTIONS/,$ p' "$page" | sed '1! { /^\.SH/,$ d }' >options
headings options >page.txt
for command in separate check sum pair buffer route plan merge follow; do
    # a group of options on one line stands behind its title
    "$SUNDER" $command --help | sed 's/^\([A-Z][^:]*:\) --/\1\n  --/' >help
    # Either one option per line, with its explanation after two blanks or more, or several per line, with commas.
    sed -n '/^Options/,/^Preferred\|^Features\|^Which/ p' help | sed -n 's/^  \(--[a-z-]*\( [^ ]*\)\{0,1\}\)  *.*$/\1/p' | sed 's/ *$//' >own
    while read -r option; do
        fallback=$(grep -F -- "  $option " help | sed -n 's/.*\( \[[^]]*\]\)$/\1/p')
        echo "$option$fallback"
    done <own
    # Commas separate options, but not within the brackets that contain other spellings.
    sed -n '/^Preferred\|^Features\|^Which\|^Running/,/^P, Q\|^OBSTACLES\|^SHAPE\|^Lengths\|^Exit/ p' help | grep '^  ' | sed 's/^ *//; s/,$//' | awk '{
        depth = 0; entry = ""
        for (i = 1; i <= length($0); i++) {
            c = substr($0, i, 1)
            depth += (c == "(") - (c == ")")
            if (c == "," && !depth && substr($0, i + 1, 3) == " --") { print entry; entry = ""; i++ } else entry = entry c
        }
        print entry }'
done >all
sort -u all >help.txt
cmp -s page.txt help.txt || fail "manual page and --help differ: $(diff page.txt help.txt | head -8)"
[ "$(wc -l <page.txt)" -gt 40 ] || fail "only $(wc -l <page.txt) options were compared"

# Every spelling that a command lists is accepted by its parser.
for command in separate check sum pair buffer route plan merge follow; do
    "$SUNDER" $command --help | tr ' ,()' '\n\n\n\n' | sed -n 's/^\(-[a-z_][a-z_-]*\|--[a-z-]*\)\(\[=plain\]\)\{0,1\}$/\1/p' |
        grep -vxE -- '--help|-h' | sort -u | sed "s/^/$command /"
done >spellings
[ "$(wc -l <spellings)" -gt 300 ] || fail "only $(wc -l <spellings) spellings were tested"
"$SUNDER_BUILD/tests/calls" <spellings | paste - spellings >asked
while IFS=$'\t' read -r status said spelling; do
    [ "$status" -eq 2 ] && [[ $said != *'unknown option'* ]] || fail "$spelling is not known: status $status, $said"
done <asked
same "$(wc -l <asked)" "$(wc -l <spellings)" 'answers to all spellings:'

# The page of each command has the options of its --help.
pages=$SUNDER_BUILD/gis/manual
for command in separate check sum pair buffer route plan merge follow; do
    [ -d "$pages" ] || continue # in a cross-compiled build there are no pages
    "$SUNDER" --options-json | json ".commands[] | select(.name == \"$command\") | .options[] | select(.group != \"hidden\") |
        .name + (if .metavar == null then \"\" elif .kind == \"flag_or_enum\" then \"[=\" + .metavar + \"]\" else \" \" + .metavar end) +
        (if .aliases == [] then \"\" else \" (\" + (.aliases | join(\", \")) + \")\" end) +
        (if .default_text == null then \"\" else \" [\" + .default_text + \"]\" end)" - | sort >table.txt
    headings "$pages/sunder-$command.1" >page.txt
    [ "$(wc -l <table.txt)" -ge 30 ] || [ $command = merge ] || fail "only $(wc -l <table.txt) options of $command"
    cmp -s page.txt table.txt || fail "page of $command and table differ: $(diff page.txt table.txt | head -8)"
    for section in NAME SYNOPSIS DESCRIPTION OPTIONS MESSAGES 'EXIT STATUS' EXAMPLES 'SEE ALSO'; do
        grep -q "^\.SH $section" "$pages/sunder-$command.1" || fail "no section $section in the page of $command"
    done
    grep -q "^sunder $command " "$pages/sunder-$command.1" || fail "no example in the page of $command"
    grep -q "^\.TH .*\"sunder $("$SUNDER" --version | sed -n 's/^sunder //p')\"" "$pages/sunder-$command.1" || fail "no version in the page of $command"
    if command -v man >/dev/null; then
        same "$(man --warnings -l "$pages/sunder-$command.1" 2>&1 >/dev/null)" '' "troff says of $command"
    fi
done

for section in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLES; do
    grep -q "^\.SH $section" "$page" || fail "no section $section"
done
if command -v man >/dev/null; then
    same "$(man --warnings -l "$page" 2>&1 >/dev/null)" '' "troff says"
fi

cp "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" .
ogr2ogr addresses.gpkg town.gpkg -nln addresses -dialect SQLite -sql 'SELECT ST_PointOnSurface(geom) FROM buildings'
PATH=$work/bin:$PATH
mkdir bin
ln -s "$SUNDER" bin/sunder
sed -n '/^\.SH EXAMPLES/,/^\.SH SEE/ p' "$page" | sed 's/\\//g' | grep '^sunder ' >examples
[ "$(wc -l <examples)" -ge 5 ] || fail "only $(wc -l <examples) examples"
while read -r line; do
    status=0
    bash -c "$line" >out 2>err || status=$?
    case "$status $line" in
    0\ * | "3 sunder separate"* | "3 sunder check"* | "3 sunder merge"*) ;;
    *) fail "example with status $status: $line" ;;
    esac
done <examples
[ -s separated.gpkg ] && [ -s conflicts.gpkg ] || fail "examples without results"
finish
