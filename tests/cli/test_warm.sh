# shellcheck shell=bash disable=SC1091,SC2016
# Is a warm start (warm.c) like a start? A shell is called both ways: it tells its arguments, folder, variables, umask,
# ignored signals, open files and input, and ends with a status or by a signal. A start that would differ is not warm.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
client=$SUNDER_BUILD/tests/warm/sunder
[ -x "$client" ] || { echo "skipped: there is no warm start in this build"; exit 77; }
export SUNDER_WARM_OWNER=$$
real=$(command -v bash)
mkdir warm "a folder"
ln -s "$client" warm/bash
tell='pwd; umask; printf "<%s>" "$@"; echo " $told"; env | grep -v "^_=" | sort; grep -E "^Sig(Ign|Blk)" /proc/self/status
for k in 0 1 2 3 7 8 9; do [ ! -e /proc/self/fd/$k ] || echo "open $k"; done; read -r -u 7 line; echo "$line"; cat; echo error >&2; exit 7'
how() { # SHELL: tells how it was started
    local status=0
    (
        cd "a folder" || exit
        umask 027
        trap '' USR1
        export told='a  text
of two lines'
        "$1" -c "$tell" - one '' 'two  words' $'\xff' 7<<<'seven' <<<'input'
    ) >"$2" 2>"$2.err" || status=$?
    echo "status $status" >>"$2"
}
PATH=/usr/bin:/bin how "$real" cold
for _ in 1 2 3; do # the first call starts the server
    PATH=/usr/bin:/bin how "$PWD/warm/bash" warmed
    cmp cold warmed && cmp cold.err warmed.err || fail "a warm start differs: $(diff cold warmed | head -5)"
done
same "$(tail -n 1 cold)" 'status 7'
parent='tr "\0" " " </proc/$PPID/cmdline' # of a server: its name alone
same "$("$PWD/warm/bash" -c "$parent")" 'bash ' 'the parent of a warm start:'
[ "$(LD_BIND_NOW=1 "$PWD/warm/bash" -c "$parent")" != 'bash ' ] || fail "a start with a variable of the loader is warm"
[ "$(nice "$PWD/warm/bash" -c "$parent")" != 'bash ' ] || fail "a start with another priority is warm"
[ "$(ulimit -c 0; "$PWD/warm/bash" -c "$parent")" != 'bash ' ] || [ "$(ulimit -c)" = 0 ] || fail "a start with another limit is warm"

ended() { # STATUS WORDS: how a call ends
    local status=0
    "$PWD/warm/bash" -c "$2" 2>/dev/null || status=$?
    same $status "$1" "$2:"
}
ended 0 true
ended 3 'exit 3'
ended 143 'kill -TERM $$'
ended 137 'kill -KILL $$'

# A signal is passed on, and a call ends with its client.
"$PWD/warm/bash" -c 'trap "echo caught >signal; exit 5" TERM; echo $$ >ready; while :; do sleep 0.05; done' &
client=$!
until [ -s ready ]; do sleep 0.02; done
kill -TERM $client
wait $client
same "$? $(cat signal)" '5 caught' 'after a signal:'
rm ready
"$PWD/warm/bash" -c 'echo $$ >ready; while :; do sleep 0.05; done' &
client=$!
until [ -s ready ]; do sleep 0.02; done
kill -KILL $client
wait $client 2>/dev/null
for ((k = 0; k < 500; k++)); do
    [ -e "/proc/$(cat ready)" ] || break
    sleep 0.02
done
[ ! -e "/proc/$(cat ready)" ] || fail "a call outlives its client"
finish
