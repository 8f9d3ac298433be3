#!/bin/bash
# SIGINT and SIGTERM end a command at its work: exit 1, a message, nothing left behind. That it hears the signal soon is
# asked by tests/watch, which counts steps; here nothing depends on time but that the work is longer than the wait.
source "$(dirname "$0")/lib.sh"

# Two ragged outlines of 12,000 vertices, deep in each other.
python3 - > pair.txt <<'PY'
import math, random
R = random.Random(5)
def ragged(n, dx):
    p = [(1000 * (1 + 0.3 * R.random()) * math.cos(2 * math.pi * i / n) + dx, 1000 * (1 + 0.3 * R.random()) * math.sin(2 * math.pi * i / n)) for i in range(n)]
    return 'POLYGON((' + ','.join('%.3f %.3f' % q for q in p + p[:1]) + '))'
print(ragged(12000, 0))
print(ragged(12000, 7))
PY
sed -n 1p pair.txt > p.wkt
sed -n 2p pair.txt > q.wkt

failures=0
for signal in INT TERM; do
    for what in "pair @p.wkt @q.wkt" "sum @p.wkt @q.wkt out.gpkg" "pair --gap 3 @p.wkt @q.wkt"; do
        python3 - "$SUNDER" "$signal" $what <<'PY' || failures=$((failures + 1))
import signal, subprocess, sys, time
run = subprocess.Popen([sys.argv[1]] + sys.argv[3:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
time.sleep(0.5)
run.send_signal(getattr(signal, 'SIG' + sys.argv[2]))
words = run.communicate()[1]
if run.returncode == 0:
    print('done before the signal came:', *sys.argv[3:])  # proves nothing, and fails nothing
elif run.returncode != 1 or 'sunder: error: ' not in words:
    print('status', run.returncode, words, *sys.argv[2:])
    sys.exit(1)
PY
        left=$(ls -A | grep -v -e '\.wkt$' -e pair.txt)
        [ -z "$left" ] || { echo "left behind: $left"; failures=$((failures + 1)); }
        rm -rf out.gpkg
    done
done
[ "$failures" = 0 ]
