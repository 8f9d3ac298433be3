"""Converts the values of a dialog to arguments of the program. It uses neither QGIS nor files.

A value is what QGIS passes: a number, the index of a choice, a truth value, the name of a field, or a text; None means
that the dialog has no value. Numbers are written so that they read back as the same double.
"""
from .options import (BARRIER_LAYERS, BARRIER_LENGTH, BARRIERS, CHOICE, COUNT, EXPRESSION, FIELD, FILE, FLAG, LENGTH, NUMBER,
                      NUMERIC_FIELD, POINT, SCALE, SOURCE, TEXT, UNIT, UNITS, of_command)

BARRIER_COLUMNS = ("Layer", "Width or field", "Gap", "Least gap", "Filter", "Side (yes/no)", "As (area/boundary)")


class BadValue(Exception):
    """A value of the dialog has no meaning. The text of the exception is a message for the user."""


def number(value):
    """Returns the shortest decimal that reads back as this double; a whole number has no point."""
    value = float(value)
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def length(value, unit):
    return number(value) + unit


def unit_of(values):
    return UNITS[values.get(UNIT) or 0]


def _words_of(option, value, values):
    """Returns the arguments of one option: an empty list if the value is what the program does without the option."""
    if option.kind == FLAG:
        return [option.flag] if value else []
    if option.kind == COUNT and option.flag == "--threads" and not value:
        return []
    if option.kind == CHOICE:
        return [] if value == option.default else ["%s=%s" % (option.flag, option.choices[value])]
    if option.kind == LENGTH:
        return ["%s=%s" % (option.flag, length(value, unit_of(values)))]
    if option.kind in (NUMBER, COUNT, SCALE):
        return ["%s=%s" % (option.flag, number(value))]
    if option.kind == POINT:
        return ["%s=%s,%s" % (option.flag, number(value[0]), number(value[1]))]
    assert option.kind in (FIELD, NUMERIC_FIELD, EXPRESSION, TEXT, BARRIERS, SOURCE, FILE), option
    many = value if option.kind == BARRIERS else [value]
    return ["%s=%s" % (option.flag, each) for each in many]


def words(command, values):
    """Returns the options of a command as arguments of the program. values maps the names of parameters to the values
    that QGIS passes. The arguments for layers, barriers and expressions are made where these are copied
    (algorithm.py)."""
    found = []
    for option in of_command(command):
        value = values.get(option.name)
        if value is None or value == "" or option.kind in (BARRIER_LAYERS, BARRIER_LENGTH):
            continue
        if option.kind in (LENGTH, NUMBER, COUNT, SCALE) and value == option.default:
            continue
        found += _words_of(option, value, values)
    return found


# ---- Barriers --------------------------------------------------------------------------------------------------------


def row_of_layer(name, values):
    """Returns the row for a layer from the list of barriers; its width and gap are those of the dialog."""
    cells = [number(value) if value is not None else "" for value in
             (values.get("BARRIER_WIDTH"), values.get("BARRIER_GAP"))]
    return [name] + cells + [""] * (len(BARRIER_COLUMNS) - 3)


def _is_null(cell):
    """Returns whether the cell is None or a null value of QGIS."""
    return cell is None or getattr(cell, "isNull", lambda: False)()


def rows_of(flat):
    """Returns the rows of a matrix of QGIS, which passes the cells as one list. Empty rows are left out. Raises
    BadValue for a row that has cells but no layer."""
    width = len(BARRIER_COLUMNS)
    cells = ["" if _is_null(cell) else str(cell).strip() for cell in flat or []]
    cells += [""] * (-len(cells) % width)
    rows = [cells[i:i + width] for i in range(0, len(cells), width)]
    for row in rows:
        if not row[0] and any(row):
            raise BadValue("Barriers: a row has no layer.")
    return [row for row in rows if row[0]]


def _is_length(text):
    """Returns whether the text is a decimal with or without a unit."""
    for unit in sorted(UNITS, key=len, reverse=True):
        if text.endswith(unit):
            try:
                float(text[:len(text) - len(unit)])
                return True
            except ValueError:
                continue
    return False


def _length_of_cell(text, unit, column, layer):
    if not _is_length(text):
        raise BadValue("Barriers, %s: %s is no length (%s)." % (layer, text, column))
    return text if not text[-1].isdigit() and text[-1] != "." else length(text, unit)


def _escaped(text):
    return text.replace(",", "\\,")


def barrier(row, unit, dataset, layer, fields):
    """Returns the value of --barrier for a row. dataset and layer say where the program finds the barriers; fields are
    the names of the layer's fields. A width that is the name of a field means that field. Any other width is a length,
    with a unit of its own or in the unit of the dialog. The filter of the row was applied when the layer was copied.
    Raises BadValue for a cell that has no meaning."""
    name, width, gap, least, _, side, taken_as = row
    parts = [_escaped(dataset), "layer=" + _escaped(layer)]
    if width in fields:
        parts.append("width-field=" + width)
    elif width:
        if not _is_length(width):
            raise BadValue("Barriers, %s: %s is neither a width nor a field; its fields: %s." %
                           (name, width, ", ".join(fields) or "none"))
        parts.append("width=" + _length_of_cell(width, unit, "width", name))
    if gap:
        parts.append("gap=" + _length_of_cell(gap, unit, "gap", name))
    if least:
        parts.append("least=" + _length_of_cell(least, unit, "least gap", name))
    if side:
        if side.lower() not in ("yes", "no"):
            raise BadValue("Barriers, %s: side is yes or no, not %s." % (name, side))
        parts.append("side=" + side.lower())
    if taken_as:
        if taken_as.lower() not in ("area", "boundary"):
            raise BadValue("Barriers, %s: it is taken as area or boundary, not %s." % (name, taken_as))
        parts.append("as=" + taken_as.lower())
    return ",".join(parts)
