"""Barriers in another CRS than the layer: their coordinates are those that ogr2ogr makes of them, in a file of its own."""
import os
import subprocess
import tempfile

import geopackage
from form import NotRead


def in_crs_of(crs, layer, path):
    """The features of the layer, with coordinates of the CRS. Nothing else changes: not the rings, nor how many corners they have."""
    with tempfile.TemporaryDirectory() as directory:
        to = os.path.join(directory, "there.gpkg")
        words = ["ogr2ogr", "-q", "-f", "GPKG", "-preserve_fid", "-dim", "XY", "-t_srs", target(crs), "-nln", layer.name, to, path,
                 layer.name]
        try:
            done = subprocess.run(words, capture_output=True, text=True, check=False)
        except OSError as why:
            raise NotRead(f"barriers in another CRS are read by ogr2ogr, which does not run: {why}") from None
        if done.returncode:
            raise NotRead(f"ogr2ogr does not bring {path} to {crs.name}: {done.stderr.strip()}")
        there = geopackage.Layer(to, layer.name).features
    for fid, (attributes, *chains) in layer.features.items():
        moved = there[fid][1:]
        if shape_of(moved) != shape_of(chains):
            raise NotRead(f"{layer.name}:{fid} has other corners in {crs.name}")
        yield fid, (attributes, *moved)


def target(crs):
    return crs.name if crs.name.startswith("EPSG:") else crs.definition


def shape_of(chains):
    """How many corners each ring and each line has."""
    polygons, lines = chains
    return [[len(ring) for ring in rings] for rings in polygons], [len(line) for line in lines]
