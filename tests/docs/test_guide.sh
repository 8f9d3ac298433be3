# shellcheck shell=bash
# The README, the tutorial and the pages of the guide are true: each is run as it is written, from a fresh home
# directory, and its output is compared (guide.py). With --record the output is written into the pages instead: bash
# tests/docs/test_guide.sh --record [PAGE ...], with SUNDER_BUILD.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
source=$(cd "$here/../.." && pwd -P)
build=$(cd "${SUNDER_BUILD:-$source/build/release}" && pwd -P)
for tool in python3 ogr2ogr; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
[ -x "$build/sunder" ] && [ -x "$build/sunder-town" ] || { echo "skipped: the program is not built"; exit 77; }
record=
if [ "${1-}" = --record ]; then record=--record && shift; fi
pages=("$@")
if [ $# -eq 0 ]; then
    while read -r page; do pages+=("$page"); done < <(cd "$source" && grep -rl '^```sh' README.md docs gis/*/README.md | sort | sed "s|^|$source/|")
fi

work=$(mktemp -d)
stop() { :; }
trap 'stop; rm -rf "$work"' EXIT
export LC_ALL=C.UTF-8 SUNDER_SOURCE=$source
unset PKG_CONFIG_PATH LD_LIBRARY_PATH SUNDER
# For pages of the guide the programs are on the PATH, as the guide's README says; the README and the tutorial set the
# PATH themselves.
found=$build:$source/gis/cluster:$PATH bare=$work/bin:$PATH
if [ "${SUNDER_WARM:-}" = yes ] && [ -x "$build/tests/warm/sunder" ]; then # tests/cli/warm.c
    export SUNDER_WARM_OWNER=$$
    found=$build/tests/warm:$found
fi

# What a page needs besides the programs: the installed library, a database server, a clone. Returns 1 and prints the
# reason if it is missing. `library` takes the page's home directory.
installable() {
    command -v pkg-config >/dev/null || { echo "pkg-config is not installed"; return 1; }
    ! grep -q '^SUNDER_SANITIZE:STRING=.' "$build/CMakeCache.txt" || { echo "the build carries a sanitizer"; return 1; }
}

library() {
    installable || return 1
    cmake --install "$build" --prefix "$1/.local" >"$work/install.log" 2>&1 || { cat "$work/install.log"; exit 1; }
}

# A page that needs a clone builds it itself. Since compiling takes minutes, CMake copies this build instead.
clone() {
    installable || return 1
    git -C "$source" rev-parse --git-dir >/dev/null 2>&1 || { echo "the sources are not a clone of a repository"; return 1; }
    mkdir -p "$work/bin"
    cat >"$work/bin/cmake" <<END
#!/usr/bin/env bash
set -eu
real=$(command -v cmake)
case \$1 in
    --build) case " \$* " in
        *" --target docs "* | *" --target qgis-plugin "*) exec "\$real" --build "$build" "\${@:3}" ;;
        *) mkdir -p "\$2" && ln -sf "$build/sunder" "$build/sunder-town" "\$2" ;;
        esac ;;
    --install) exec "\$real" --install "$build" "\${@:3}" ;;
    -S) ;;
    *) exec "\$real" "\$@" ;;
esac
END
    chmod +x "$work/bin/cmake"
}

server() {
    local bin as=()
    bin=$(find /usr/lib/postgresql -maxdepth 2 -name bin 2>/dev/null | sort -V | tail -n 1)
    [ -n "$bin" ] && [ -x "$bin/initdb" ] || { echo "PostgreSQL's server is not installed"; return 1; }
    [ -n "$(find /usr/share/postgresql -name postgis.control 2>/dev/null)" ] || { echo "PostGIS is not installed"; return 1; }
    ogrinfo --formats | grep -q PostgreSQL || { echo "GDAL has no PostgreSQL driver"; return 1; }
    if [ "$(id -u)" = 0 ]; then # the server refuses to run as root
        id postgres >/dev/null 2>&1 && command -v runuser >/dev/null || { echo "there is no user that may run a server"; return 1; }
        as=(runuser -u postgres --)
        chmod 755 "$work"
    fi
    mkdir -m 777 "$work/server"
    (
        cd "$work/server"
        "${as[@]}" "$bin/initdb" -D data -A trust -U postgres --no-sync -E UTF8 --locale=C.UTF-8 >/dev/null
        "${as[@]}" "$bin/pg_ctl" -D data -w -l log -o "-c listen_addresses='' -k $work/server -c fsync=off" start >/dev/null
    ) || { echo "no server could be started"; return 1; }
    stop() { (cd "$work/server" && "${as[@]}" "$bin/pg_ctl" -D data -m immediate stop) >/dev/null 2>&1 || true; }
    export PGHOST=$work/server PGUSER=postgres
}

run_page() { # page, home, path
    (export HOME=$2 PATH=$3 && python3 "$here/guide.py" "$1" "$2" $record)
}

trouble=0 ran=0
for page in "${pages[@]}"; do
    name=$(basename "$page" .md) path=$found
    home=$work/home/$name
    mkdir -p "$home"
    case $name in
        library) library "$home" || { echo "$name: left out"; continue; } ;;
        postgis) server || { echo "$name: left out"; continue; } ;;
        README | tutorial) clone || { echo "$name: left out"; continue; } && path=$bare ;;
    esac
    if run_page "$page" "$home" "$path"; then echo "$name: ok"; else trouble=1; fi
    ran=$((ran + 1))
done
[ "$ran" -gt 0 ] || trouble=1

# A page fails if an output is wrong, if a command fails, and if an output is longer than expected.
if [ -z "$record" ] && [ $# -eq 0 ]; then
    refused() { # description of the fault
        mkdir "$work/wrong-$1"
        if run_page "$work/$1.md" "$work/wrong-$1" "$found" >"$work/said" 2>&1; then
            echo "FAILED: a page with a wrong $1 passes"
            trouble=1
        fi
    }
    page=$source/docs/guide/pipeline.md
    awk '/^```text/ { inside = 1 } inside && !done && /[0-8]/ { done = sub(/[0-8]/, "9") } { print }' "$page" >"$work/figure.md"
    awk '/^```sh/ { print; print "false"; next } { print }' "$page" >"$work/command.md"
    awk '/^```sh/ { print; print "echo one line more"; next } { print }' "$page" >"$work/line.md"
    for wrong in figure command line; do
        ! cmp -s "$page" "$work/$wrong.md" || { echo "FAILED: the page is not changed"; trouble=1; }
        refused "$wrong"
    done
fi
exit $trouble
