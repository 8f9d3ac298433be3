# shellcheck shell=bash
# Functions shared by the tests of the house: the root of the sources, the list of floors, and a count of failures.
root=$SUNDER_SOURCE
wrong=0

say() {
    echo "$*"
    wrong=$((wrong + 1))
}

# Every source of a tree, as a path below it.
sources() { (cd "$root/$1" && find . \( -name '*.c' -o -name '*.h' -o -name '*.inc' \) | sed 's#^\./##' | sort); }

# The folders of a tree, from the lowest floor to the highest.
floors() { sed -n '/^```floors$/,/^```$/p' "$root/$1/README.md" | sed '/^```/d' | awk '{print $1}' | tac; }

# Lines "from to file" for each include of another folder's header. One process reads all files: a process for each file
# and line would take minutes on systems that start processes slowly.
includes() {
    (cd "$root/$1" && sources "$1" | xargs awk '
        function folder(path) { return sub("/[^/]*$", "", path) ? path : "." }
        FNR == 1 { from = folder(FILENAME) }
        match($0, /^ *# *include "[^"]*"/) {
            split(substr($0, RSTART, RLENGTH), part, "\"")
            if (part[2] !~ /^sunder(_[a-z]+)?\.h$/) print from, folder(part[2]), FILENAME
        }')
}

finish() {
    [ "$wrong" -eq 0 ] || { echo "$wrong failures"; exit 1; }
    exit 0
}
