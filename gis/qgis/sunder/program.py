"""Finds the program, runs it, and translates its messages for the user of a dialog. It does not use QGIS."""
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
PATIENCE = 5  # seconds from the request to end until the process is killed: the program removes unfinished files then


class ProgramMissing(Exception):
    """The program was not found. The text of the exception is a message for the user."""


def find(setting):
    """Returns the path of the program: that of the setting if it is not empty, otherwise sunder on the PATH. Raises
    ProgramMissing."""
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
    """Returns arguments of Popen that keep a console program from opening a window on Windows."""
    return {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}


def _read(pipe, name, lines):
    """Puts each line of a pipe into the queue `lines`, and None at the end. It runs in a thread of its own, so that the
    program never waits for a full pipe."""
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
    """Runs the program to its end. words are its path and arguments. progress(percent) is called for each line of
    progress, say(line) for each line on stdout, and cancelled() often, to ask whether the program should be ended. All
    three are called in the thread of the caller, since signals of QGIS require that.

    Returns the exit status, or None if the run was cancelled, and the list of lines of stderr that are not progress.
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
    """Returns the dictionary that --stats wrote; an empty one if it wrote none."""
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
    """Replaces an option that has a value, as in `--gap 3x`, or begins a line, by its label."""
    flag = found.group(1)
    return '"%s"' % _LABELS[flag] + found.group(2) if flag in _LABELS else found.group()


def _chosen(found):
    """Replaces an option with a choice, as in `--invalid skip`, by the labels of both."""
    flag, value = found.group(1), found.group(2)
    if value not in _CHOICES.get(flag, {}):
        return found.group()
    return '"%s" at "%s"' % (_CHOICES[flag][value], _LABELS[flag])


def _named(line):
    """Replaces the options in a sentence: the first time by the noun and the label, later by the noun alone. An article
    is added unless a word before the option takes its place, as in "give their --symbol"."""
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
    """Translates a message line of the program for the user of a dialog. Options are replaced by the labels of their
    parameters, or by a noun within a sentence. Paths of files are replaced by the names of their layers; names maps the
    paths to these names. The name of the program is removed. Commands between backticks are not changed."""
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
    """Returns the lines with tabs replaced by blanks, so that their cells form columns, two blanks apart. Lines
    without a tab are not changed."""
    rows = [line.split("\t") for line in lines]
    width = max((len(row) for row in rows), default=0)
    widths = [max((len(row[k]) for row in rows if k < len(row) - 1), default=0) for k in range(width)]
    return ["  ".join(cell if k == len(row) - 1 else cell.ljust(widths[k]) for k, cell in enumerate(row))
            for row in rows]


def unbroken(line):
    """Returns the line for a log that shows HTML. HTML shows several blanks as one, so the blanks of a line with
    columns are replaced by non-breaking ones."""
    return line.replace(" ", "\u00a0") if line.startswith(" ") or "  " in line else line


def is_warning(line):
    return line.startswith("sunder: warning:")


def is_error(line):
    return line.startswith("sunder: error:")


def conflicts_left(figures):
    """Returns the number of conflicts between blocks in the figures of --stats, after the moves if there were any."""
    counts = figures.get("conflicts", {})
    counts = counts.get("after", counts)
    return sum(count for kind, count in counts.items() if kind != "inside_blocks")
