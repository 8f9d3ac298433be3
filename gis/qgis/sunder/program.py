"""The program itself: where it is, how a run goes, what it says in words for the user of a dialog. No QGIS in here."""
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import threading

from .options import LEFT_OUT, LOG_LABEL, NOUNS, OPTIONS

DONE, FAILED, MISUSED, UNRESOLVED = 0, 1, 2, 3
PATIENCE = 5  # seconds from being asked to end to being ended: the program clears away what it had begun


class ProgramMissing(Exception):
    """There is no program, in words for the user."""


def find(setting):
    """The path of the program: the setting, where there is one, else sunder on the PATH."""
    if setting:
        found = shutil.which(os.path.expanduser(setting))
        if not found:
            raise ProgramMissing("The setting of Processing says that the program sunder is %s, but there is no "
                                 "program. Change it in Settings > Options > Processing > Providers > Sunder." %
                                 setting)
        return found
    found = shutil.which("sunder")
    if not found:
        raise ProgramMissing("The program sunder was not found. Install it, or say where it is in Settings > Options > "
                             "Processing > Providers > Sunder.")
    return found


def _hidden_window():
    """On Windows a console program would open a window."""
    return {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}


def _read(pipe, name, lines):
    """Reads a pipe to its end, so that the program never waits for us."""
    for line in pipe:
        lines.put((name, line.rstrip("\r\n")))
    pipe.close()
    lines.put((name, None))


def _end(process):
    process.terminate()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def run(words, progress, say, cancelled):
    """Runs the program to its end. progress(percent), say(line) for each line on stdout, cancelled() is asked often;
    all are called in the thread of the caller, as signals of QGIS want it.

    Returns the exit status, None if it was cancelled, and the lines of stderr that are no progress.
    """
    process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               encoding="utf-8", errors="replace", **_hidden_window())
    lines, told, ended = queue.Queue(), [], False
    reading = {"out": process.stdout, "err": process.stderr}
    for name, pipe in reading.items():
        threading.Thread(target=_read, args=(pipe, name, lines), daemon=True).start()
    while reading:
        if not ended and cancelled():
            _end(process)
            ended = True
        try:
            name, line = lines.get(timeout=0.1)
        except queue.Empty:
            continue
        if line is None:
            del reading[name]
        elif name == "out":
            say(line)
        elif re.fullmatch(r"\d{1,3}", line):
            progress(int(line))
        elif line:
            told.append(line)
    status = process.wait()
    return None if ended else status, told


def statistics(path):
    """What --stats wrote; empty where it wrote nothing."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


# ---- In plain words --------------------------------------------------------------------------------------------------


_FLAG = r"(?<![\w-])--[a-z]+(?:-[a-z]+)*"
_LABELS = {option.flag: option.label.split(" (")[0] for option in reversed(OPTIONS)}
_LABELS.update({"--log": LOG_LABEL, "--report": "Report", "--proof": "Proof"})
_CHOICES = {option.flag: dict(zip(option.choices, option.labels)) for option in OPTIONS if option.choices}


def _subject(found):
    """--gap 3x, with its value, or at the start of a line: the label of what was given."""
    flag = found.group(1)
    return '"%s"' % _LABELS[flag] + found.group(2) if flag in _LABELS else found.group()


def _chosen(found):
    """--invalid skip: a choice by its label."""
    flag, value = found.group(1), found.group(2)
    if value not in _CHOICES.get(flag, {}):
        return found.group()
    return '"%s" at "%s"' % (_CHOICES[flag][value], _LABELS[flag])


def _named(line):
    """Options within a sentence: the first time by noun and label, then by the noun. A word before it that belongs to
    the noun, as in "give their --symbol", stands in the place of an article."""
    seen = set()

    def name(found):
        article, flag = found.group(1) or "", found.group(2)
        if flag not in NOUNS:
            return found.group() + ("" if flag in seen or flag not in LEFT_OUT else " (in a terminal)")
        if article.lower() in ("a ", "an "):
            article = article[0] + ("n " if NOUNS[flag][0] in "aeiou" else " ")
        elif not article:
            article = "the "
        label = ' ("%s")' % _LABELS[flag] if flag in _LABELS and flag not in seen else ""
        seen.add(flag)
        return article + NOUNS[flag] + label

    return re.sub(r"(\b(?:[Aa]n?|[Tt]he|[Nn]o|their|its|another|this|each) )?(" + _FLAG + ")", name, line)


def plain(line, names):
    """A line of the program for the user of a dialog. Options are replaced by the labels of their parameters, or by a
    noun within a sentence. Files that the plug-in made are replaced by the names of their layers (names: path to name).
    The name of the program is removed. Commands for a terminal, between backticks, stay as they are."""
    line = re.sub(r"^sunder: (error: |warning: |note: )?", "", line)
    line = line.replace("(ogr2ogr -t_srs)", "(Reproject layer, in the toolbox)")
    for path in sorted(names, key=len, reverse=True):
        line = line.replace(path, names[path])
    line = re.sub("^(" + _FLAG + r")((?:[ =][^:]*)?: )", _subject, line)
    parts = line.split("`")
    for i in range(0, len(parts), 2):
        part = re.sub("as in " + _FLAG + "[ =]", "as in ", parts[i])
        part = re.sub("(" + _FLAG + r")[ =]([a-z-]+)\b", _chosen, part)
        part = re.sub("(" + _FLAG + r")([ =])(?=\d)", _subject, part)
        parts[i] = _named(part)
    return "`".join(parts)


def columns(lines):
    """Lines whose cells are separated by tabs, as a table; columns are two blanks apart. Other lines stay."""
    rows = [line.split("\t") for line in lines]
    width = max((len(row) for row in rows), default=0)
    widths = [max((len(row[k]) for row in rows if k < len(row) - 1), default=0) for k in range(width)]
    return ["  ".join(cell if k == len(row) - 1 else cell.ljust(widths[k]) for k, cell in enumerate(row))
            for row in rows]


def unbroken(line):
    """A line for a log that shows HTML, which makes one blank of several: blanks that do not break keep its columns."""
    return line.replace(" ", "\u00a0") if line.startswith(" ") or "  " in line else line


def is_warning(line):
    return line.startswith("sunder: warning:")


def is_error(line):
    return line.startswith("sunder: error:")


def conflicts_left(figures):
    """How many pairs of a statistics' conflicts stand between blocks."""
    counts = figures.get("conflicts", {})
    counts = counts.get("after", counts)
    return sum(count for kind, count in counts.items() if kind != "inside_blocks")
