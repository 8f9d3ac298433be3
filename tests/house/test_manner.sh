# shellcheck shell=bash disable=SC1091
# The conventions of the sources, as far as a script can check them: names that mean one thing, a comment at the top of
# each file, lines of at most 120 columns.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

# ---- No two headers have types of the same name, and no source file has a type with the name of one in a header ----
for tree in src gis; do
    defined=$(cd "$root/$tree" && sources $tree | xargs awk '
        /^typedef (struct|enum|union) [a-z_0-9]+ \{/ { print $3, FILENAME }
        /^(struct|enum|union) [a-z_0-9]+ \{/ { print $2, FILENAME }')
    while read -r name files; do
        say "$tree: $name is a type in $files"
    done < <(awk '$2 ~ /\.h$/ { n[$1]++; at[$1] = at[$1] " " $2 }
                  $2 !~ /\.h$/ && $1 ~ /^(sunder_i|gis)_/ { n[$1]++; at[$1] = at[$1] " " $2 }
                  END { for (t in n) if (n[t] > 1) print t at[t] }' <<<"$defined")
    [ "$(wc -l <<<"$defined")" -gt 20 ] || say "$tree: hardly any type was found"
done

# ---- Files ----
while read -r file; do
    say "$file does not open with a comment"
done < <(cd "$root" && find src gis -name '*.[ch]' | sort | xargs awk 'FNR == 1 && !/^\/\*/ { print FILENAME }'
    cd "$root" && find src gis -name '*.[ch]' -empty)
# Columns, not bytes: comments and strings contain characters of several bytes.
while read -r line; do
    say "$line is longer than 120 columns"
done < <(cd "$root" && find src gis tests datasets-synthetic -name '*.[ch]' | sort |
    LC_ALL=C.UTF-8 xargs grep -nE '^.{121,}' | cut -d: -f1,2)

# ---- No two sources share a base name: each is qualified by what it acts on; commands have the names that users type ----
while read -r name; do
    say "$name names several files: $(cd "$root" && find src gis -name "$name" | sort | tr '\n' ' ')"
done < <({ sources src; sources gis; } | grep '\.c$' | grep -v '^commands/' | sed 's#.*/##' | sort | uniq -d)

# ---- Public enumerators carry the name of their type ----
while read -r line; do
    say "src/$line"
done < <(cd "$root/src" && awk '
    /^typedef enum sunder_[a-z_]* \{.*\}/ { next } # a definition on one line, of three phases
    /^typedef enum sunder_/ { type = $3; open = 1; next }
    /^} sunder_/ { open = 0 }
    open && match($0, /^ *SUNDER_[A-Z_0-9]+/) {
        name = substr($0, RSTART, RLENGTH)
        sub(/^ */, "", name)
        word = toupper(type)
        sub(/_(STATUS|KIND)$/, "", word)
        if (word == "SUNDER" || index(name, word "_") == 1) next # the values of sunder_status do not have the prefix
        print FILENAME ": " name " does not carry the name of " type
    }' sunder*.h)
finish
