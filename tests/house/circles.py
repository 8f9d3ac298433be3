"""Circular dependencies between files: which files of src/ and gis/ cannot be read, or tested, one after the other.

    circles.py SOURCE BUILD

A file depends on another if it uses a function or a variable that the other defines. This is read from the symbols of
the build's objects (nm), so that of a header with several implementing files only those count whose symbols are used.
A circle is a strongly connected component of more than one file. There must be none. Also, a file may not use a
symbol that is defined on a higher floor of its tree, whichever header declares it.
"""
import os
import subprocess
import sys

OBJECTS = {"src": "src/CMakeFiles/sunder_objects.dir", "gis": "gis/CMakeFiles/sunder_gis.dir"}
SKIPPED = 77


def objects(source, build, tree):
    """Object files by the path of their source below the tree; objects of deleted sources are left out."""
    top = os.path.join(build, OBJECTS[tree])
    found = {}
    for folder, _, names in os.walk(top):
        for name in names:
            path = os.path.relpath(os.path.join(folder, name), top)
            if path.endswith((".c.o", ".c.obj")) and os.path.exists(os.path.join(source, tree, path[: path.rindex(".")])):
                found[path[: path.rindex(".c.")]] = os.path.join(folder, name)
    return found


def symbols(paths):
    """Defined and undefined symbols of each object."""
    defined, wanted = {}, {file: set() for file in paths}
    file_of = {path: file for file, path in paths.items()}
    told = subprocess.run(["nm", "-A", "-P", *file_of], capture_output=True, text=True, check=True).stdout
    for line in told.splitlines():  # "PATH: NAME KIND ..."
        path, _, rest = line.partition(": ")
        name, kind = rest.split()[:2]
        if kind == "U":
            wanted[file_of[path]].add(name)
        elif kind in "TDBRVWC":
            defined[name] = file_of[path]
    return defined, wanted


def dependences(paths):
    """For each file the files that it uses, and by which symbols."""
    defined, wanted = symbols(paths)
    uses = {file: {} for file in paths}
    for file, names in wanted.items():
        for name in names:
            other = defined.get(name, file)
            if other != file:
                uses[file].setdefault(other, []).append(name)
    return uses


def circles(uses):
    """Strongly connected components of more than one file (Tarjan 1972, without recursion)."""
    index, low, stack, on_stack, found = {}, {}, [], set(), []
    for root in sorted(uses):
        work = [] if root in index else [(root, iter(sorted(uses[root])))]
        if work:
            index[root] = low[root] = len(index)
            stack.append(root)
            on_stack.add(root)
        while work:
            file, others = work[-1]
            for other in others:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    on_stack.add(other)
                    work.append((other, iter(sorted(uses[other]))))
                    break
                if other in on_stack:
                    low[file] = min(low[file], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[file])
                if low[file] == index[file]:
                    members = stack[stack.index(file) :]
                    del stack[len(stack) - len(members) :]
                    on_stack.difference_update(members)
                    if len(members) > 1:
                        found.append(sorted(members))
    return found


def floors(source, tree):
    """The rank of each folder, the lowest first, as the tree's README states them."""
    text = open(os.path.join(source, tree, "README.md"), encoding="utf-8").read()
    lines = text.split("```floors\n")[1].split("```")[0].splitlines()
    return {line.split()[0]: -number for number, line in enumerate(lines)}


def say_circle(tree, members, uses):
    print(f"{tree}: a circle of {len(members)} files")
    for file in members:
        for other in sorted(set(uses[file]) & set(members)):
            print(f"    {file} uses {', '.join(sorted(uses[file][other]))} of {other}")


def count_upward(source, tree, uses):
    rank, wrong = floors(source, tree), 0
    for file in sorted(uses):
        for other in sorted(uses[file]):
            here, there = os.path.dirname(file), os.path.dirname(other)
            if here in rank and there in rank and rank[there] > rank[here]:
                print(f"{tree}: {file} uses {', '.join(uses[file][other])} of {other}, which is on a higher floor")
                wrong += 1
    return wrong


def main(source, build):
    wrong = asked = 0
    for tree in OBJECTS:
        paths = objects(source, build, tree)
        if len(paths) < 20:
            print(f"{tree}: no objects in {build}")
            continue
        asked += 1
        uses = dependences(paths)
        found = circles(uses)
        for members in found:
            say_circle(tree, members, uses)
        wrong += len(found) + count_upward(source, tree, uses)
    return SKIPPED if asked == 0 else int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
