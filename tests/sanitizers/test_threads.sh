#!/usr/bin/env bash
# Are there data races? All multi-threaded work runs in a build with gcc's thread sanitizer (build/thread): the commands
# with 2 and 4 threads on a synthetic town. GDAL, SQLite and GMP are the installed ones: races inside them are not
# detected, and reports that concern only their internals are suppressed in threads.supp, with reasons.
set -eu
skip() { echo "skipped: $1"; exit 77; }
echo 'int main(void) { return 0; }' | cc -x c -fsanitize=thread - -o /dev/null 2>/dev/null || skip "no thread sanitizer"
command -v ogr2ogr >/dev/null || skip "gdal-bin is not installed"
build=$SUNDER_SOURCE/build/thread
(cd "$SUNDER_SOURCE" && cmake --preset thread) >/dev/null
cmake --build "$build" -j "$(nproc)" --target sunder sunder-town >"$build/build.log" 2>&1 || { tail -n 30 "$build/build.log"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export TSAN_OPTIONS="suppressions=$SUNDER_SOURCE/tests/sanitizers/threads.supp exitcode=66"
trouble=0

# The sanitizer works: it reports a race.
cat >race.c <<'C'
#include <pthread.h>
static int shared;
static void *add(void *nothing) { return shared++, nothing; }
int main(void)
{
    pthread_t thread;
    pthread_create(&thread, 0, add, 0);
    add(0);
    return pthread_join(thread, 0);
}
C
cc -g -fsanitize=thread race.c -o race
if ./race 2>/dev/null; then echo "FAILED: a race was not seen"; exit 1; fi

ask() { # accepted STATUSES, then the arguments of the program: runs it with 2 threads and with 4
    local fine=$1 threads status
    shift
    for threads in 2 4; do
        status=0
        "$build/sunder" "$@" --threads $threads >out 2>err || status=$?
        [[ " $fine " == *" $status "* ]] && continue
        echo "FAILED: sunder $* --threads $threads: status $status"
        head -n 60 err
        trouble=1
    done
}

"$build/sunder-town" --buildings 400 --seed 7 town.gpkg >/dev/null
separate="separate town.gpkg o.gpkg -l buildings --overwrite -q"
ask "0 3" $separate --gap 2
ask "0 3" $separate --gap 3 --max-shift 5 --barrier town.gpkg,layer=roads,width=5
ask "0 3" $separate --gap 4 --max-shift 6 --effort 3 --proof o.proof --report o.html --stats o.json --allow-jumps
ask "0 3" $separate --gap 1 --contained separate --no-blocks --invalid skip
ask "0 3" $separate --gap 1 --messages json --log o.log
# enough rows that two connections read back one half each
"$build/sunder-town" --buildings 6000 --seed 7 large.gpkg >/dev/null
ask "0 3" separate large.gpkg o.gpkg -l buildings --gap 0.1 --effort 0 --overwrite -q
ogr2ogr -q -dialect SQLite -sql 'SELECT ST_Centroid(geom) AS geom FROM buildings LIMIT 100' -nln points points.gpkg town.gpkg
ask "0 3" separate points.gpkg o.gpkg --symbol disc:3:8 --gap 0.5 --max-shift 4 --overwrite -q
ask "0 3" check town.gpkg -l buildings --gap 3
ask "0 3" check town.gpkg c.gpkg -l buildings --gap 3 --list-inside --overwrite -q --barrier town.gpkg,layer=roads,width=5
ask "0 3" check o.gpkg --before points.gpkg --symbol disc:3:8 --gap 0.5
for operation in dilate erode open close; do
    ask 0 buffer town.gpkg o.gpkg -l buildings --shape disc:2:16 --operation $operation --overwrite -q
    ask 0 buffer town.gpkg o.gpkg -l buildings --shape square:3 --operation $operation --dissolve --explode --overwrite -q
done
ask 0 buffer town.gpkg o.gpkg -l buildings --shape square:4 --operation close --align --dissolve --overwrite -q
ask 0 buffer town.gpkg o.gpkg -l buildings --shape square:4 --operation open --align --degenerate --overwrite -q
# Sums, pairs and routes use one thread for every value of --threads.
for algorithm in convolution arrangement; do
    ask 0 sum 'POLYGON ((0 0, 9 0, 9 9, 6 9, 6 3, 3 3, 3 9, 0 9))' disc:1 --algorithm $algorithm
    ask 0 sum town.gpkg disc:1:8 o.gpkg --input-layer buildings --algorithm $algorithm --overwrite -q
done

# If one part fails, the others are stopped.
printf 'WKT\n"POLYGON((0 0,2 0,2 2,0 0))"\n"POLYGON((1.7e308 0,1.79e308 0,1.79e308 1e307,1.7e308 0))"\n"POLYGON((0 0,1 0,1 1,0 0))"\n' >far.csv
ask 1 buffer far.csv o.gpkg --shape square:1e308 --overwrite -q
exit $trouble
