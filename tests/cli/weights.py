"""Layers of boxes with weights of any size, drawn by SUNDER_SEED: half of the layers use accepted weights, the others
all doubles. Each run gives a result whose cost is a finite number and no less than its bound, or an error that names
a feature and its weight; if all weights are accepted, a result."""
import json
import os
import random
import struct
import subprocess
import sys

SEED = int(os.environ.get("SUNDER_SEED", "1"))
COUNT = 36 * int(os.environ.get("SUNDER_TEST_SCALE", "1"))
LEAST, GREATEST = 1e-100, 1e100


def any_double(r):
    """Positive and finite: its bits are drawn, so that all exponents are equally frequent and subnormals occur."""
    edge = [5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, LEAST, GREATEST]
    return r.choice(edge) if r.random() < 0.2 else struct.unpack("<d", struct.pack("<Q", r.randrange(1, 0x7FF << 52)))[0]


def in_range(r):
    return 10 ** r.uniform(-100, 100)


def draw(r, weight, areas):
    """Overlapping boxes. If areas are weights, boxes have very different sizes, and positions scale with the size."""
    rows = ["w,b,WKT"]
    for k in range(r.randint(2, 12)):
        x, y = r.uniform(0, 20), r.uniform(0, 8)
        w, h = r.uniform(2, 6), r.uniform(2, 6)
        if areas:
            size = 10 ** r.uniform(-20, 20)
            x, y, w, h = x * size, y * size, w * size, h * size
        ring = ",".join(f"{a!r} {b!r}" for a, b in ((x, y), (x + w, y), (x + w, y + h), (x, y + h), (x, y)))
        rows.append(f'{weight(r)!r},{r.randint(0, 3) if r.random() < 0.3 else ""},"POLYGON (({ring}))"')
    return "\n".join(rows) + "\n"


def options(r, areas):
    out = ["--weight-field", "w"]
    if areas:
        out += ["--weight", r.choice(["area", "sqrt-area"])]
    out += r.choice([["--no-blocks"], ["--no-blocks", "--block-field", "b"], []])
    out += r.choice([[], ["--max-shift", "10"], ["--allow-jumps"], ["--effort", "0"]])
    return out


def run(name, extra):
    done = subprocess.run([os.environ["SUNDER"], "separate", name, "weights.gpkg", "--overwrite", "--gap", "0.5", "--contained",
                           "separate", "--oo", "GEOM_POSSIBLE_NAMES=WKT", "--oo", "AUTODETECT_TYPE=YES", "--stats", "-"] + extra,
                          capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def fault(case, status, out, error, must):
    if status == 1 and "FID" in error and "weight" in error:
        return "refused, though all weights are in the range" if must else None
    if status not in (0, 3):
        return f"status {status}: {error}"
    d = json.loads(out)["displacement"]
    for key in ("total", "mean", "max", "cost", "lower_bound", "optimality_gap"):
        if not isinstance(d[key], (int, float)):
            return f"{key} is {d[key]}"
    return None if d["lower_bound"] <= d["cost"] * (1 + 1e-9) else f"cost {d['cost']} below the bound {d['lower_bound']}"


def main():
    seen = [0, 0]
    for case in range(COUNT):
        r = random.Random(SEED * 1000003 + case)
        wide, areas = case % 2 == 1, case % 3 == 2
        with open("weights.csv", "w", encoding="ascii") as f:
            f.write(draw(r, any_double if wide else in_range, areas))
        extra = options(r, areas)
        status, out, error = run("weights.csv", extra)
        wrong = fault(case, status, out, error, not wide and not areas)
        if wrong:
            sys.exit(f"seed {SEED}, case {case}: {wrong}\noptions {' '.join(extra)}\n{open('weights.csv').read()}")
        seen[status == 1] += 1
    print(f"{seen[0]} results, {seen[1]} errors")
    if not all(seen):
        sys.exit("the generator does not reach both")


main()
