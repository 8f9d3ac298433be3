"""Barriers in another CRS than the layer: their coordinates are those that ogr2ogr writes to a file. Their arcs become polylines
before that, in their own CRS."""
import tempfile

from form import NotRead
from sources import converted, write


def in_crs_of(crs, layer, source):
    """The features of the layer, with coordinates in the CRS. The rings and their numbers of corners may not
    change."""
    with tempfile.TemporaryDirectory() as directory:
        path = write(["-nlt", "CONVERT_TO_LINEAR", source.path, layer.name], layer.name, directory) if layer.arcs else source.path
        there = converted(["-t_srs", target(crs), path, layer.name], layer.name).features
    for fid, (attributes, *chains) in layer.features.items():
        moved = there[fid][1:]
        if shape_of(moved) != shape_of(chains):
            raise NotRead(f"{layer.name}:{fid} has other corners in {crs.name}")
        yield fid, (attributes, *moved)


def target(crs):
    return crs.name if crs.name.startswith("EPSG:") else crs.definition


def shape_of(chains):
    """The number of corners of each ring and each line."""
    polygons, lines = chains
    return [[len(ring) for ring in rings] for rings in polygons], [len(line) for line in lines]
