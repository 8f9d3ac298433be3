# shellcheck shell=bash
# What the tests of the house share: where the sources are, what a plan states, and a tally of what is wrong.
root=$SUNDER_SOURCE
wrong=0

say() {
    echo "$*"
    wrong=$((wrong + 1))
}

# Every source of a tree, as a path below it.
sources() { (cd "$root/$1" && find . \( -name '*.c' -o -name '*.h' -o -name '*.inc' \) | sed 's#^\./##' | sort); }

# The folders of a tree's plan, from the lowest floor to the highest.
floors() { sed -n '/^```floors$/,/^```$/p' "$root/$1/README.md" | sed '/^```/d' | awk '{print $1}' | tac; }

# Lines "from to file" for each include of another folder's header.
includes() {
    sources "$1" | while read -r file; do
        sed -n 's/^ *# *include "\([^"]*\)".*/\1/p' "$root/$1/$file" | while read -r header; do
            [ "$header" = sunder.h ] || echo "$(dirname "$file") $(dirname "$header") $file"
        done
    done
}

finish() {
    [ "$wrong" -eq 0 ] || { echo "$wrong wrong"; exit 1; }
    exit 0
}
