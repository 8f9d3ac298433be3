# shellcheck shell=bash
# Sourced by the tests of this folder: a private Slurm with two nodes on this machine's loopback interface, in a
# directory.
#
#   slurm_wants              prints what is missing, status 1
#   slurm_begin DIRECTORY    munge, the controller and the nodes n1 and n2; no other Slurm is touched
#   slurm_kill_node n2       as in a power failure: kills the daemon, its steps, their processes
#   slurm_node n2            starts a node (again)
#   slurm_end                stops all of it
slurm_wants() {
    local tool
    export PATH=$PATH:/usr/sbin
    for tool in sbatch squeue slurmctld slurmd munged; do
        command -v "$tool" >/dev/null || { echo "$tool is not installed (slurm-wlm, munge)"; return 1; }
    done
    [ "$(id -u)" = 0 ] || { echo "starting a Slurm needs root"; return 1; }
    [ -r /proc/self/stat ] || { echo "there is no /proc"; return 1; }
}

slurm_begin() {
    slurm=$1
    local host port
    host=$(hostname -s)
    mkdir -p "$slurm"/{state,spool,log,munge}
    chmod 755 "$slurm/munge"
    (umask 277 && head -c 1024 /dev/urandom >"$slurm/munge/key")
    munged --force --socket="$slurm/munge/sock" --key-file="$slurm/munge/key" --pid-file="$slurm/munge/pid" \
        --log-file="$slurm/munge/log" --seed-file="$slurm/munge/seed" 2>"$slurm/munge/said" || { cat "$slurm/munge/said"; return 1; }
    # Ports that no process listens on.
    port=$((20000 + $$ % 10000))
    while (exec 3<>"/dev/tcp/127.0.0.1/$port" || exec 3<>"/dev/tcp/127.0.0.1/$((port + 1))" ||
        exec 3<>"/dev/tcp/127.0.0.1/$((port + 2))") 2>/dev/null; do port=$((port + 3)); done
    cat >"$slurm/slurm.conf" <<EOF
ClusterName=sunder
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm/munge/sock,cred_expire=5
CredType=cred/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmctldPort=$port
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool/%n
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd-%n.pid
SlurmctldLogFile=$slurm/log/slurmctld.log
SlurmdLogFile=$slurm/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
KillWait=2
JobRequeue=1
SlurmdParameters=config_overrides
NodeName=n[1-2] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=2 RealMemory=16000
PartitionName=p Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
EOF
    export SLURM_CONF=$slurm/slurm.conf
    slurmctld || return 1
    sleep 1
    slurm_node n1 && slurm_node n2 || return 1
    local _
    for _ in $(seq 60); do
        [ "$(sinfo --noheader --Node --format=%T 2>/dev/null | sort | uniq -c | tr -s ' ')" != ' 2 idle' ] || return 0
        sleep 0.5
    done
    echo "the nodes do not come up"
    tail -n 20 "$slurm"/log/*.log
    return 1
}

slurm_node() { slurmd -N "$1"; }

# The processes of a node's jobs, found by their environment, and their parents, the daemons of the steps.
slurm_of_node() {
    local process words parent
    for process in /proc/[0-9]*; do
        words=$(tr '\0' '\n' 2>/dev/null <"$process/environ") || continue
        grep -qx "SLURM_CONF=$slurm/slurm.conf" <<<"$words" || continue
        grep -qx "SLURMD_NODENAME=$1" <<<"$words" || continue
        echo "${process#/proc/}"
        parent=$(awk '/^PPid:/ { print $2 }' "$process/status" 2>/dev/null)
        [ "$(cat "/proc/${parent:-none}/comm" 2>/dev/null)" != slurmstepd ] || echo "$parent"
    done 2>/dev/null | sort -un
}

slurm_kill_node() {
    local processes
    kill -KILL "$(cat "$slurm/slurmd-$1.pid")"
    processes=$(slurm_of_node "$1")
    # shellcheck disable=SC2086 # words
    [ -z "$processes" ] || kill -KILL $processes 2>/dev/null
    rm -f "$slurm/slurmd-$1.pid"
}

slurm_end() {
    local file _
    [ -n "${slurm-}" ] || return 0
    scancel --user=root 2>/dev/null
    for file in "$slurm"/slurmctld.pid "$slurm"/slurmd-n*.pid "$slurm"/munge/pid; do
        [ ! -f "$file" ] || kill "$(cat "$file")" 2>/dev/null
    done
    for _ in $(seq 40); do # The controller would write its state into a directory that is about to be deleted.
        [ -n "$(compgen -G "$slurm/*.pid")" ] || break
        sleep 0.25
    done
}
