"""Plans with one number changed and valid checksums, as anyone with write access to a plan can make them.

    forged_plan.py CALLS PLAN SCRATCH [COUNT SEED]

CALLS: tests/calls. PLAN: a plan all of whose shards are done. Each aligned number of 8 and of 4 bytes in each of its
files is replaced by 0, by all ones (-1, NAN), and by a huge number; COUNT of these changes, drawn by SEED, or all.
Each plan is given to merge and to a shard. No run may end by a signal, allocate memory that its files do not account
for, or run without end. Failures are printed."""

import os
import random
import resource
import shutil
import struct
import subprocess
import sys

MASK = (1 << 64) - 1
MARK, CELLS_HEAD, ENTRY, PLAN_HEAD, PLAN_NUMBERS, STAMP, CHUNK, END = 16, 16, 80, 32, 48, 56, 80, 24


def checksum_of(checksum, data):
    """The checksum of gis_checksum_of()."""
    for at in range(0, len(data), 8):
        word = int.from_bytes(data[at:at + 8], "little")
        checksum = (checksum ^ word) * 0x9E3779B97F4A7C15 & MASK
        checksum ^= checksum >> 29
    checksum = (checksum ^ len(data)) * 0xBF58476D1CE4E5B9 & MASK
    return checksum ^ checksum >> 32


def put(data, at, number):
    data[at:at + 8] = struct.pack("<Q", number)


def get(data, at):
    return struct.unpack_from("<Q", data, at)[0]


def seal_spool(cells, features):
    """Corrects the checksums of the cells, and of the list of cells; returns the latter."""
    for at in range(MARK + CELLS_HEAD, len(cells) - 8 - ENTRY + 1, ENTRY):
        start, size = get(cells, at + 56), get(cells, at + 64)
        if start + size <= len(features):
            put(cells, at + 72, checksum_of(0, features[start:start + size]))
    checksum = checksum_of(0, cells[MARK:MARK + CELLS_HEAD])
    for at in range(MARK + CELLS_HEAD, len(cells) - 8 - ENTRY + 1, ENTRY):
        checksum = checksum_of(checksum, cells[at:at + ENTRY])
    put(cells, len(cells) - 8, checksum)
    return checksum


def seal_shard(data, stamp, spool):
    put(data, MARK + 24, stamp)
    put(data, MARK + 32, spool)
    where = get(data, len(data) - END + 8)
    if not MARK + STAMP <= where <= len(data) - END:
        where = len(data) - END
    for at in range(where, len(data) - END - CHUNK + 1, CHUNK):
        start, size, lines = get(data, at + 32), get(data, at + 40), get(data, at + 56)
        if start + size <= len(data):
            put(data, at + 48, checksum_of(0, data[start:start + size]))
        if lines <= start <= len(data):
            put(data, at + 64, checksum_of(0, data[start - lines:start]))
    checksum = checksum_of(0, data[MARK:MARK + STAMP])
    put(data, len(data) - 8, checksum_of(checksum, data[where:len(data) - END]))


def seal(files):
    """Corrects all checksums, as if the forged number had been written by the program."""
    spool = seal_spool(files["cells"], files["features"])
    of_shards = spool
    if "barriers/cells" in files:
        seal_spool(files["barriers/everywhere/cells"], files["barriers/everywhere/features"])
        of_shards = (spool * 31 + seal_spool(files["barriers/cells"], files["barriers/features"])) & MASK
    plan, status = files["plan"], 0
    for at in range(0, len(files["status"]), 1 << 16):
        status = checksum_of(status, files["status"][at:at + (1 << 16)])
    put(plan, PLAN_HEAD + 16, spool)
    put(plan, PLAN_HEAD + 24, status)
    stamp = checksum_of(0, plan[:-8])
    put(plan, len(plan) - 8, stamp)
    for name, data in files.items():
        if name.startswith("shard-"):
            seal_shard(data, stamp, of_shards)


def read(plan):
    files = {}
    for where, _, names in os.walk(plan):
        for name in names:
            path = os.path.join(where, name)
            if name != "plan.json":
                with open(path, "rb") as file:
                    files[os.path.relpath(path, plan)] = bytearray(file.read())
    return files


def write(files, where):
    for name, data in files.items():
        path = os.path.join(where, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data)


def forgeries(files):
    for name, data in sorted(files.items()):
        for size in (8, 4):
            for at in range(0, len(data) - size + 1, size):
                for value in (0, (1 << 8 * size) - 1, 1 << 8 * size - 2, 0x7FE0000000000000 >> 64 - 8 * size):
                    new = value.to_bytes(size, "little")
                    if data[at:at + size] != new:
                        yield name, at, new


def main(calls, plan, scratch, count=None, seed="0"):
    files = read(plan)
    again = {name: bytearray(data) for name, data in files.items()}
    seal(again)
    assert again == files, "the checksums of a plan are not understood"
    chosen = list(forgeries(files))
    if count:
        chosen = random.Random(int(seed)).sample(chosen, int(count))
    resource.setrlimit(resource.RLIMIT_AS, (3 << 29, 3 << 29))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    process = subprocess.Popen([calls], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, errors="replace",
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (20, 40)))
    ends = {}
    for n, (name, at, new) in enumerate(chosen):
        forged = {other: bytearray(data) for other, data in files.items()}
        forged[name][at:at + len(new)] = new
        seal(forged)
        directory = f"{scratch}/f{n}"
        write(forged, directory)
        for call in (f"merge {directory} {directory}/o.gpkg --quiet", f"separate --shard 1 {directory} --quiet"):
            if call.startswith("separate") and os.path.exists(f"{directory}/shard-1"):
                os.remove(f"{directory}/shard-1")
            process.stdin.write(call + "\n")
            process.stdin.flush()
            status, said = process.stdout.readline().rstrip("\n").split("\t", 1)
            ends[status] = ends.get(status, 0) + 1
            what = f"{name} at {at} is {new.hex()}, {call.split()[0]}: status {status}: {said[:200]}"
            if status not in ("0", "1", "2", "3") or "interrupted" in said or "out of memory" in said:
                print(what, flush=True)
            elif status in ("1", "2") and said.count("sunder: error: ") != 1:
                print(what, flush=True)
        shutil.rmtree(directory)
    process.stdin.close()
    print(f"{len(chosen)} forgeries of {sum(len(data) for data in files.values())} bytes: {ends}", file=sys.stderr)


if __name__ == "__main__":
    main(*sys.argv[1:])
