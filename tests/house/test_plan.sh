# shellcheck shell=bash disable=SC1091
# What the plan of the house says: the file that answers a question is there, and the function is defined in it; the files
# and functions that a README names are there.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

# Rows "| question | `file` | `function()` |" of src/README.md; a file of gis/ begins with ../gis/.
asked=0
while IFS='|' read -r _ question file name _; do
    file=$(tr -d '` ' <<<"$file")
    name=$(tr -d '`() ' <<<"$name")
    asked=$((asked + 1))
    if [ ! -f "$root/src/$file" ]; then
        say "src/README.md: $file, which is to answer \"$question\", is not there"
    elif ! awk -v name="$name" '
            # A definition: the name at the start of a line of no indent, and no semicolon before the body opens.
            /^[A-Za-z#}]/ { open = 0 }
            $0 ~ "^[A-Za-z].*[ *]" name "\\(" { open = 1 }
            open && /;[ \t]*$/ && !/\{/ { open = 0 }
            open && /^\{|\{.*\}$|\{$/ { found = 1 }
            END { exit !found }' "$root/src/$file"; then
        say "src/README.md: $name() is not defined in $file"
    fi
done < <(grep -E '^\| .* \| `[^`]+\.(c|h)` \| `[a-z_0-9]+\(\)` \|$' "$root/src/README.md")
[ "$asked" -ge 20 ] || say "src/README.md: $asked questions are answered; twenty should be"

# Files in the first column of a README's tables, or in `...`, that look like sources: somewhere below that folder's tree.
for readme in "$root"/src/*/README.md "$root"/src/*/*/README.md "$root"/src/*/*/*/README.md "$root"/gis/README.md \
    "$root"/gis/*/README.md "$root"/gis/*/*/README.md; do
    [ -f "$readme" ] || continue
    folder=$(dirname "$readme")
    for file in $(grep -oE '`[^` ]*[a-z_0-9*]+\.(c|h)`' "$readme" | tr -d '`' | sort -u); do
        compgen -G "$folder/$file" >/dev/null || compgen -G "$folder/*/$file" >/dev/null ||
            compgen -G "$root/src/$file" >/dev/null || compgen -G "$root/gis/$file" >/dev/null ||
            compgen -G "$root/$file" >/dev/null ||
            say "${readme#"$root"/}: there is no $file"
    done
done
# Functions and types that a README names are in the sources; `name_*` stands for several.
known=$(grep -rhoE '\b(sunder|gis)_[a-z_0-9]+' --include='*.[ch]' "$root/src" "$root/gis" | sort -u)
for readme in "$root/README.md" "$root"/src/README.md "$root"/src/*/README.md "$root"/src/*/*/README.md \
    "$root"/src/*/*/*/README.md "$root"/gis/README.md "$root"/gis/*/README.md "$root"/gis/*/*/README.md; do
    [ -f "$readme" ] || continue
    while read -r name; do
        say "${readme#"$root"/}: there is no $name"
    done < <(grep -oE '\b(sunder|gis)_[a-z_0-9]+\b\*?' "$readme" | grep -v '_$\|\*$' | sort -u | comm -23 - <(echo "$known"))
done
finish
