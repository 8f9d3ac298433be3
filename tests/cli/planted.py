"""Directories that look like the remains of a killed run beside its output, of every owner, mode, kind and choice of
names.

    planted.py make DIR      makes them in DIR, and a file beside DIR that must not change; prints a list of them in JSON
    planted.py judge DIR     after a run that wrote DIR/out.gpkg: prints what is not as it should be, a line each

A stage is accepted only if it belongs to the effective user, has the mode 0700 and names only entries of DIR. A user
other than root cannot give files away; then only stages of that user are made."""

import json
import os
import sys

NOBODY = 65534
MODES = {"0700": 0o700, "02700": 0o2700, "0755": 0o755, "0770": 0o770, "0777": 0o777, "01700": 0o1700, "0500": 0o500}
# The name of a replaced file in a planted record; {k} is the number of the stage.
NAMES = {
    "plain": "mine{k}",
    "up": "../victim",
    "far up": "../../../../../../../../{victim}",
    "absolute": "{victim}",
    "below": "below/mine{k}",
    "dot": ".",
    "dots": "..",
    "empty": "",
    "escaped": "..\\/victim",
}
KINDS = ("directory", "link", "record is a link", "superseded is a link", "record is a directory", "record is a pipe")


def variants():
    """Every mode, every name and every kind, each with all owners and with valid values of the other two."""
    owners = ("own", "nobody") if os.geteuid() == 0 else ("own",)
    for owner in owners:
        for mode in MODES:
            yield owner, mode, "plain", "directory"
        for name in NAMES:
            yield owner, "0700", name, "directory"
        for kind in KINDS:
            yield owner, "0700", "plain", kind
        yield owner, "0777", "up", "directory"
        yield owner, "0700", "plain", "empty"
        yield owner, "0755", "plain", "empty"


def letters(k):
    return "".join("abcdefghijklmnopqrstuvwxyz"[k // 26**i % 26] for i in range(6))


def make_stage(place, k, owner, mode, name, kind, victim):
    at = f"{place}/.sunder-{letters(k)}"
    inside = at if kind != "link" else f"{os.path.dirname(place)}/elsewhere{k}"
    old = NAMES[name].format(k=k, victim=victim)
    os.mkdir(inside)
    if kind == "link":
        os.symlink(inside, at)
    if kind != "empty":
        fill(inside, k, old, kind)
    if owner == "nobody":
        for root, directories, files in os.walk(inside):
            for entry in directories + files:
                os.chown(f"{root}/{entry}", NOBODY, NOBODY, follow_symlinks=False)
        os.chown(inside, NOBODY, NOBODY)
        os.chown(at, NOBODY, NOBODY, follow_symlinks=False)
    os.chmod(inside, MODES[mode])
    believed = owner == "own" and mode in ("0700", "02700") and name == "plain" and kind == "directory"
    swept = owner == "own" and mode == "0700" and kind == "empty"
    return {"at": at, "what": [owner, mode, name, kind], "believed": believed, "swept": swept, "k": k,
            "before": listing(inside), "inside": inside}


def fill(inside, k, old, kind):
    record = f"main out.gpkg\nold {old}\nnew 1-2-3.4 fresh{k}\n"
    aside = f"{inside}/superseded~"
    if kind == "superseded is a link":
        os.mkdir(f"{inside}/other")
        os.symlink(f"{inside}/other", aside)
    else:
        os.mkdir(aside)
    for name in {f"mine{k}", "victim"}:
        with open(f"{aside}/{name}", "w") as file:
            file.write("planted\n")
    with open(f"{inside}/fresh{k}", "w") as file:
        file.write("planted\n")
    with open(f"{inside}/victim", "w") as file: # the file that "../victim" in superseded~ names
        file.write("planted\n")
    if kind == "record is a directory":
        os.mkdir(f"{inside}/record~")
    elif kind == "record is a pipe":
        os.mkfifo(f"{inside}/record~", 0o600)
    else:
        real = f"{inside}/a_record" if kind == "record is a link" else f"{inside}/record~"
        with open(real, "w") as file:
            file.write(record)
        if kind == "record is a link":
            os.symlink(real, f"{inside}/record~")


def listing(path):
    """Everything below the path, with owner, mode and content."""
    found = []
    for root, directories, files in os.walk(path):
        for entry in sorted(directories + files):
            whole = f"{root}/{entry}"
            status = os.lstat(whole)
            content = open(whole).read() if os.path.isfile(whole) and not os.path.islink(whole) else None
            found.append([whole, status.st_uid, status.st_mode, content])
    return sorted(found)


def make(place):
    victim = f"{os.path.dirname(place)}/victim"
    with open(victim, "w") as file:
        file.write("the victim's own\n")
    os.mkdir(place)
    os.mkdir(f"{place}/below")
    os.chmod(place, 0o1777)
    made = [make_stage(place, k, *variant, victim) for k, variant in enumerate(variants())]
    with open(f"{place}.json", "w") as file:
        json.dump(made, file)
    print(len(made))


def judge(place):
    with open(f"{os.path.dirname(place)}/victim") as file:
        if file.read() != "the victim's own\n":
            print("the victim's file was replaced")
    with open(f"{place}.json") as file:
        made = json.load(file)
    for stage in made:
        there, what, k = os.path.lexists(stage["at"]), ", ".join(stage["what"]), stage["k"]
        brought = os.path.exists(f"{place}/mine{k}") or os.path.exists(f"{place}/below/mine{k}")
        if stage["believed"]:
            if there or not brought:
                print(f"{what}: a stage of a killed run was not settled")
        elif brought:
            print(f"{what}: a file was taken from it")
        elif stage["swept"]:
            if there:
                print(f"{what}: it was not swept")
        elif what == "own, 0700, plain, superseded is a link":
            continue # this stage is accepted and removed; the link in it leads nowhere
        elif not there or listing(stage["inside"]) != stage["before"]:
            print(f"{what}: it was touched")


if __name__ == "__main__":
    {"make": make, "judge": judge}[sys.argv[1]](os.path.abspath(sys.argv[2]))
