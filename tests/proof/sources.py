"""Layers as the command reads them. A table of a GeoPackage is read directly; for other formats, --sql, --bbox and
--input-crs ogr2ogr writes a GeoPackage first, with the same FIDs and coordinates. The drivers of GDAL are trusted,
by the command and by this checker."""
import os
import subprocess
import tempfile

import arcs
import geopackage
from form import NotRead


def is_geopackage(path):
    try:
        with open(path, "rb") as file:
            return path.lower().endswith(".gpkg") and file.read(16) == b"SQLite format 3\0"
    except OSError:
        return False


def converted(words, name):
    """The only layer of the GeoPackage that ogr2ogr makes with these arguments; under that name."""
    with tempfile.TemporaryDirectory() as directory:
        return table(write(words, name, directory), name)


def write(words, name, directory):
    """Makes a GeoPackage in the directory with ogr2ogr, and returns its path."""
    to = os.path.join(directory, "there.gpkg")
    words = ["ogr2ogr", "-q", "-f", "GPKG", "-preserve_fid", "-dim", "XY", *(["-nln", name] if name else []), to, *words]
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except OSError as why:
        raise NotRead(f"this is read by ogr2ogr, which does not run: {why}") from None
    if done.returncode:
        raise NotRead(f"ogr2ogr does not read {words[-1]}: {done.stderr.strip()}")
    return to


def table(path, name, where=None):
    """A layer of a GeoPackage, whose curves ogr2ogr makes polylines."""
    layer = geopackage.Layer(path, name, where)
    if layer.arcs:
        arcs.straighten(layer, converted(["-nlt", "CONVERT_TO_LINEAR", path, layer.name], layer.name), converted)
    return layer


class Source:
    """A data source and a selection from it: the layer's name, statement, dialect, box, CRS; None if they are not
    given."""

    def __init__(self, path, name=None, sql=None, dialect=None, bbox=None, crs=None):
        self.path, self.name, self.sql, self.dialect, self.bbox, self.crs = path, name, sql, dialect, bbox, crs
        self.is_table = is_geopackage(path) and not (sql or bbox or crs)

    def layer(self, where=None):
        if self.is_table:
            return table(self.path, self.name, where)
        if not os.path.exists(self.path) and not self.path.startswith("/vsi"):
            raise NotRead(f"No such file: {self.path}")
        words = [self.path]
        for option, value in (("-sql", self.sql), ("-dialect", self.dialect), ("-where", where), ("-a_srs", self.crs)):
            words += [option, value] if value else []
        words += ["-spat", *self.bbox.split(",")] if self.bbox else []
        return converted(words + ([self.name] if self.name and not self.sql else []), self.name_of_result())

    def name_of_result(self):
        """The layer name of a statement's result: the name of the dataset without directory and extension."""
        return os.path.splitext(os.path.basename(self.path))[0] if self.sql else self.name

    def fids(self, where):
        return set(self.layer(where).features) if where else set()
