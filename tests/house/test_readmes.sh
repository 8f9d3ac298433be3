# shellcheck shell=bash disable=SC1091
# The READMEs name only things that exist: each function in the table of questions in src/README.md is defined in a file
# of its row, and the files and functions that a README names exist.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

# defines FUNCTION FILE...: is the function defined in one of the files?
defines() {
    local function=$1
    shift
    awk -v name="$function" '
        # A definition: the name in a line without indent, and no semicolon before the body opens.
        /^[A-Za-z#}]/ { open = 0 }
        $0 ~ "^[A-Za-z].*[ *]" name "\\(" { open = 1 }
        open && /;[ \t]*$/ && !/\{/ { open = 0 }
        open && /^\{|\{.*\}$|\{$/ { found = 1 }
        END { exit !found }' "$@"
}

# Rows "| question | `file`, ... | `function()`, ... |"; a file of gis/ begins with ../gis/.
asked=0
while IFS='|' read -r _ question column functions _; do
    asked=$((asked + 1))
    files=()
    for file in $(grep -oE '`[^`]+`' <<<"$column" | tr -d '`'); do
        if [ -f "$root/src/$file" ]; then files+=("$root/src/$file"); else
            say "src/README.md: $file, which is to answer \"$question\", is not there"
        fi
    done
    names=$(grep -oE '`[a-z_0-9]+\(\)`' <<<"$functions" | tr -d '`()')
    if [ ${#files[@]} = 0 ] || [ -z "$names" ]; then
        say "src/README.md: \"$question\" has no file or no function"
        continue
    fi
    for name in $names; do
        defines "$name" "${files[@]}" || say "src/README.md: $name() is not defined in $column"
    done
done < <(sed -n '/^| question | file | function |/,/^$/p' "$root/src/README.md" | sed 1,2d | grep '^|')
[ "$asked" -ge 60 ] || say "src/README.md: $asked questions are answered, not sixty"

# Files in the first column of a README's tables, or in `...`, that look like sources: they exist somewhere below that
# folder's tree.
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
# Functions and types that a README names exist in the sources; `name_*` stands for several.
known=$(grep -rhoE '\b(sunder|gis)_[a-z_0-9]+' --include='*.[ch]' "$root/src" "$root/gis" | sort -u)
for readme in "$root/README.md" "$root"/src/README.md "$root"/src/*/README.md "$root"/src/*/*/README.md \
    "$root"/src/*/*/*/README.md "$root"/gis/README.md "$root"/gis/*/README.md "$root"/gis/*/*/README.md; do
    [ -f "$readme" ] || continue
    while read -r name; do
        say "${readme#"$root"/}: there is no $name"
    done < <(grep -oE '\b(sunder|gis)_[a-z_0-9]+\b\*?' "$readme" | grep -v '_$\|\*$' | sort -u | comm -23 - <(echo "$known"))
done
finish
