"""A road network around a town, for displacement_rows.py: many polylines, a few of them near the town."""
import math
import os
import random

from osgeo import gdal, ogr

STEP = 20.0  # metres between two vertices
WIDTHS = (3.0, 5.0, 7.5)


def write(path, around, polylines, extent, corners=12, index=True, step=STEP, seed=1):
    """Polylines that begin at random places in a square of that extent around the centre of the layer `around`, which
    gives the CRS, and bend a little at each vertex; layer roads, field width."""
    rng = random.Random(seed)
    x0, x1, y0, y1 = around.GetExtent()
    if os.path.exists(path):
        os.remove(path)
    gdal.SetConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF")
    source = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    layer = source.CreateLayer("roads", around.GetSpatialRef(), ogr.wkbLineString,
                               [] if index else ["SPATIAL_INDEX=NO"])
    layer.CreateField(ogr.FieldDefn("width", ogr.OFTReal))
    layer.StartTransaction()
    for _ in range(polylines):
        x = (x0 + x1 - extent) / 2 + rng.uniform(0, extent)
        y = (y0 + y1 - extent) / 2 + rng.uniform(0, extent)
        turn = rng.uniform(0, 2 * math.pi)
        line = ogr.Geometry(ogr.wkbLineString)
        for _ in range(corners):
            line.AddPoint_2D(x, y)
            turn += rng.uniform(-0.3, 0.3)
            x, y = x + step * math.cos(turn), y + step * math.sin(turn)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetField("width", rng.choice(WIDTHS))
        feature.SetGeometryDirectly(line)
        layer.CreateFeature(feature)
    layer.CommitTransaction()


def write_places(path, around, away):
    """The layer, and two copies of its first thirty features, shifted by `away` to either side."""
    if os.path.exists(path):
        os.remove(path)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    layer = source.CreateLayer("buildings", around.GetSpatialRef(), ogr.wkbUnknown)
    layer.StartTransaction()
    for k, feature in enumerate(around):
        for by in (0, away, -away) if k < 30 else (0,):
            geometry = feature.GetGeometryRef().Clone()
            shift(geometry, by)
            copy = ogr.Feature(layer.GetLayerDefn())
            copy.SetGeometryDirectly(geometry)
            layer.CreateFeature(copy)
    layer.CommitTransaction()


def shift(geometry, by):
    for i in range(geometry.GetGeometryCount()):
        shift(geometry.GetGeometryRef(i), by)
    for i in range(geometry.GetPointCount() if geometry.GetGeometryCount() == 0 else 0):
        geometry.SetPoint_2D(i, geometry.GetX(i) + by, geometry.GetY(i) + by)
