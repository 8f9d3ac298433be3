# shellcheck shell=bash disable=SC1091
# The READMEs name only things that exist: each function in the table of questions in src/README.md is defined in a file
# of its row, and the files and functions that a README names exist.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

# Lines "file:function" for the functions that are defined in the sources. A definition begins with the name in a line
# without indent, and no semicolon comes before its body opens. One process reads all files.
declare -A defined
while read -r line; do
    defined[$line]=1
done < <(cd "$root/src" && { sources src; sources gis | sed 's#^#../gis/#'; } | xargs awk '
    FNR == 1 || /^[A-Za-z#}]/ { names = "" }
    /^[A-Za-z]/ {
        for (rest = $0; match(rest, /[ *][a-z_0-9]+\(/); rest = substr(rest, RSTART + RLENGTH))
            names = names substr(rest, RSTART + 1, RLENGTH - 2) " "
    }
    names && /;[ \t]*$/ && !/\{/ { names = "" }
    names && /^\{|\{.*\}$|\{$/ {
        n = split(names, name, " ")
        for (k = 1; k <= n; k++) print FILENAME ":" name[k]
        names = ""
    }')

# quoted TEXT: sets `words` to the words of the text that stand between backquotes.
quoted() {
    local rest=$1
    words=()
    while [[ $rest =~ \`([^\`]+)\`(.*) ]]; do
        words+=("${BASH_REMATCH[1]}")
        rest=${BASH_REMATCH[2]}
    done
}

# defines FUNCTION FILE...: is the function defined in one of the files?
defines() {
    local file function=$1
    shift
    for file in "$@"; do
        [ -z "${defined[$file:$function]:-}" ] || return 0
    done
    return 1
}

# Rows "| question | `file`, ... | `function()`, ... |"; a file of gis/ begins with ../gis/.
asked=0
while IFS='|' read -r _ question column functions _; do
    asked=$((asked + 1))
    files=() names=()
    quoted "$column"
    for file in "${words[@]}"; do
        if [ -f "$root/src/$file" ]; then files+=("$file"); else
            say "src/README.md: $file, which is to answer \"$question\", is not there"
        fi
    done
    quoted "$functions"
    for name in "${words[@]}"; do
        if [[ $name =~ ^[a-z_0-9]+\(\)$ ]]; then names+=("${name%()}"); fi
    done
    if [ ${#files[@]} = 0 ] || [ ${#names[@]} = 0 ]; then
        say "src/README.md: \"$question\" has no file or no function"
        continue
    fi
    for name in "${names[@]}"; do
        defines "$name" "${files[@]}" || say "src/README.md: $name() is not defined in $column"
    done
done < <(sed -n '/^| question | file | function |/,/^$/p' "$root/src/README.md" | sed 1,2d | grep '^|')
[ "$asked" -ge 60 ] || say "src/README.md: $asked questions are answered, not sixty"

# Words in `...` that look like sources: they exist somewhere below that folder's tree. One process reads all READMEs.
cd "$root" || exit 1
readmes=()
for readme in src/*/README.md src/*/*/README.md src/*/*/*/README.md gis/README.md gis/*/README.md gis/*/*/README.md; do
    if [ -f "$readme" ]; then readmes+=("$readme"); fi
done
while IFS=: read -r readme file; do
    folder=${readme%/*}
    compgen -G "$folder/$file" >/dev/null || compgen -G "$folder/*/$file" >/dev/null ||
        compgen -G "src/$file" >/dev/null || compgen -G "gis/$file" >/dev/null || compgen -G "$file" >/dev/null ||
        say "$readme: there is no $file"
done < <(grep -oE '`[^` ]*[a-z_0-9*]+\.(c|h)`' "${readmes[@]}" | tr -d '`' | sort -u)
# Functions and types that a README names exist in the sources; `name_*` stands for several.
declare -A known
while read -r name; do
    known[$name]=1
done < <(grep -rhoE '\b(sunder|gis)_[a-z_0-9]+' --include='*.[ch]' src gis | sort -u)
while IFS=: read -r readme name; do
    [ -n "${known[$name]:-}" ] || say "$readme: there is no $name"
done < <(grep -oE '\b(sunder|gis)_[a-z_0-9]+\b\*?' README.md src/README.md "${readmes[@]}" | grep -v '_$\|\*$' | sort -u)
finish
