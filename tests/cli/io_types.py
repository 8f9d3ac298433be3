"""Layers of every declared type, with unusual names, FIDs, values and CRSs; and a comparison of their copies.

    python3 io_types.py make FILE.gpkg                     prints the names of the layers
    python3 io_types.py compare IN LAYER OUT [LAYER]       everything that has to survive a separation"""
import sys

from osgeo import gdal, ogr, osr

gdal.UseExceptions()
ogr.UseExceptions()
gdal.PushErrorHandler("CPLQuietErrorHandler")  # GDAL warns about types that are not in the GeoPackage standard

LAYERS = {  # declared type, CRS, geometries; the first two overlap if they have area
    "polygon z": (ogr.wkbPolygon25D, "EPSG:25832",
                  ["POLYGON Z ((0 0 1,4 0 2,4 4 3,0 0 1))", "POLYGON Z ((3 0 4,7 0 5,7 4 6,3 0 4))"]),
    "Polygon.M": (ogr.wkbPolygonM, "EPSG:31468",  # axes: northing, easting
                  ["POLYGON M ((0 0 1,4 0 2,4 4 3,0 0 1))", "POLYGON M ((3 0 4,7 0 5,7 4 6,3 0 4))"]),
    "select": (ogr.wkbMultiPolygonZM, "EPSG:2263",  # US survey feet
               ["MULTIPOLYGON ZM (((0 0 1 5,4 0 2 6,4 4 3 7,0 0 1 5)))", "MULTIPOLYGON ZM (((3 0 1 9,7 0 2 8,7 4 3 7,3 0 1 9)))"]),
    "Häuser": (ogr.wkbUnknown, "EPSG:25832",
               ["POLYGON ((0 0,4 0,4 4,0 0))", "MULTIPOLYGON (((3 0,7 0,7 4,3 0)))", "POINT Z (1 1 5)",
                "LINESTRING (0 0,9 9)", "GEOMETRYCOLLECTION EMPTY", "POLYGON Z ((30 0 7,40 0 7,40 4 7,30 0 7))", None]),
    "some \"quotes\" 'n': --": (
        ogr.wkbGeometryCollection, "+proj=tmerc +lat_0=0 +lon_0=9.1 +k=1 +x_0=500000 +ellps=bessel +units=m",
        ["GEOMETRYCOLLECTION (POLYGON ((0 0,4 0,4 4,0 0)),POINT (2 2))",
         "GEOMETRYCOLLECTION (MULTIPOLYGON (((3 0,7 0,7 4,3 0))))", "GEOMETRYCOLLECTION (LINESTRING (0 0,1 1))"]),
    "arcs": (ogr.wkbCurvePolygon, "EPSG:25832+7837",
             ["CURVEPOLYGON (CIRCULARSTRING (0 0,5 5,10 0,5 -5,0 0))",
              "CURVEPOLYGON (COMPOUNDCURVE (CIRCULARSTRING (9 0,14 5,19 0),(19 0,9 0)))"]),
    "surfaces": (ogr.wkbMultiSurface, None,
                 ["MULTISURFACE (CURVEPOLYGON (CIRCULARSTRING (0 0,5 5,10 0,5 -5,0 0)))", "MULTISURFACE (((9 0,19 0,19 9,9 0)))"]),
    "triangles": (ogr.wkbTriangle, "EPSG:25832", ["TRIANGLE ((0 0,4 0,4 4,0 0))", "TRIANGLE ((3 0,7 0,7 4,3 0))"]),
    "tin": (ogr.wkbTINZ, "EPSG:25832", ["TIN Z (((0 0 1,4 0 2,4 4 3,0 0 1)))", "TIN Z (((3 0 1,7 0 2,7 4 3,3 0 1)))"]),
}
FIDS = [0, -5, 2**62, 17, 18, 19, 20]
FIELDS = [  # name, type, subtype, width, and other properties
    ("txt", ogr.OFTString, 0, 0, {}), ("t10", ogr.OFTString, 0, 10, {"default": "'it''s'"}),
    ("i", ogr.OFTInteger, 0, 0, {"nullable": False, "default": "7"}), ("i16", ogr.OFTInteger, ogr.OFSTInt16, 0, {}),
    ("b", ogr.OFTInteger, ogr.OFSTBoolean, 0, {}), ("i64", ogr.OFTInteger64, 0, 0, {"unique": True}),
    ("r", ogr.OFTReal, 0, 0, {}), ("f32", ogr.OFTReal, ogr.OFSTFloat32, 0, {}), ("bin", ogr.OFTBinary, 0, 0, {}),
    ("d", ogr.OFTDate, 0, 0, {"default": "CURRENT_DATE"}), ("dt", ogr.OFTDateTime, 0, 0, {"default": "CURRENT_TIMESTAMP"}),
    ("js", ogr.OFTString, ogr.OFSTJSON, 0, {}), ("order", ogr.OFTString, 0, 0, {}), ("Ünï \"q\"", ogr.OFTString, 0, 0, {})]


def make_layer(dataset, name, declared, crs, geometries):
    srs = osr.SpatialReference()
    if crs:
        srs.SetFromUserInput(crs)
        srs.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    nullable = "YES" if None in geometries else "NO"
    layer = dataset.CreateLayer(name, srs if crs else None, declared, [
        "GEOMETRY_NAME=the geom", "FID=my id", "GEOMETRY_NULLABLE=" + nullable, "IDENTIFIER=all of " + name, "DESCRIPTION=a\nb"])
    for field, kind, subtype, width, more in FIELDS:
        definition = ogr.FieldDefn(field, kind)
        definition.SetSubType(subtype)
        definition.SetWidth(width)
        definition.SetNullable(more.get("nullable", True))
        definition.SetUnique(more.get("unique", False))
        if "default" in more:
            definition.SetDefault(more["default"])
        layer.CreateField(definition)
    for k, wkt in enumerate(geometries):
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetFID(FIDS[k])
        if wkt:
            feature.SetGeometryDirectly(ogr.CreateGeometryFromWkt(wkt))
        feature["txt"] = "x\ty\nz \"ä\" \U0001F3E0" if k == 0 else ""
        feature["t10"], feature["i"], feature["i16"], feature["b"] = "it", k, -32768, k % 2
        feature["i64"], feature["r"], feature["f32"] = 2**53 + 1 + k, 0.1 + 0.2, 0.1
        feature["d"], feature["dt"], feature["js"] = "2020/02/29", "2021/03/04 05:06:07.123+00", "{\"a\": [1, 2]}"
        feature.SetFieldBinaryFromHexString("bin", "0001FF")
        layer.CreateFeature(feature)


def make(path):
    dataset = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    for name, parts in LAYERS.items():
        make_layer(dataset, name, *parts)
        print(name)


trouble = []


def same(what, before, after):
    if before != after:
        trouble.append(f"{what}: {before!r} became {after!r}")


def compare_layers(a, b, moved_in_place):
    same("type", ogr.GeometryTypeToName(a.GetGeomType()), ogr.GeometryTypeToName(b.GetGeomType()))
    same("geometry column", a.GetGeometryColumn(), b.GetGeometryColumn())
    same("FID column", a.GetFIDColumn(), b.GetFIDColumn())
    metadata = a.GetMetadata()
    if moved_in_place:
        metadata.pop("IDENTIFIER")  # two layers of one file cannot have the same identifier
    same("metadata", metadata, b.GetMetadata())
    same("geometry may be null", a.GetLayerDefn().GetGeomFieldDefn(0).IsNullable(),
         b.GetLayerDefn().GetGeomFieldDefn(0).IsNullable())
    crs = [layer.GetSpatialRef() and layer.GetSpatialRef().ExportToWkt(["FORMAT=WKT2"]) for layer in (a, b)]
    same("CRS", *crs)
    for i in range(a.GetLayerDefn().GetFieldCount()):
        f, g = a.GetLayerDefn().GetFieldDefn(i), b.GetLayerDefn().GetFieldDefn(i)
        for ask in ("GetName", "GetType", "GetSubType", "GetWidth", "IsNullable", "IsUnique", "GetDefault", "GetDomainName"):
            same(f"{f.GetName()}.{ask}", getattr(f, ask)(), getattr(g, ask)())


def compare_geometries(p, q, dx, dy):
    same("geometry type", p.GetGeometryType(), q.GetGeometryType())
    same("parts", p.GetGeometryCount(), q.GetGeometryCount())
    if trouble:
        return
    for i in range(p.GetGeometryCount()):
        compare_geometries(p.GetGeometryRef(i), q.GetGeometryRef(i), dx, dy)
    if p.GetGeometryName() in ("POINT", "LINESTRING", "LINEARRING", "CIRCULARSTRING"):
        same("vertices", [(x[0] + dx, x[1] + dy, p.GetZ(i), p.GetM(i)) for i, x in enumerate(p.GetPoints() or [])],
             [(x[0], x[1], q.GetZ(i), q.GetM(i)) for i, x in enumerate(q.GetPoints() or [])])


def compare_features(f, g):
    for i in range(f.GetFieldCount()):
        name = f.GetFieldDefnRef(i).GetName()
        same(f"null {name}", f.IsFieldSetAndNotNull(i), g.IsFieldSetAndNotNull(i))
        same(name, f.GetFieldAsString(i), g.GetFieldAsString(i))
    p, q = f.GetGeometryRef(), g.GetGeometryRef()
    same("geometry is null", p is None, q is None)
    if p is not None and q is not None:
        dx, dy = (g[name] or 0 for name in ("sunder_dx", "sunder_dy"))
        compare_geometries(p, q, dx, dy)


def compare(before, name, after, new_name):
    one, two = gdal.OpenEx(before), gdal.OpenEx(after)
    a, b = one.GetLayerByName(name), two.GetLayerByName(new_name)
    compare_layers(a, b, name != new_name)
    old, new = {f.GetFID(): f for f in a}, {f.GetFID(): f for f in b}
    same("FIDs", sorted(old), sorted(new))
    for fid in sorted(old.keys() & new.keys()):
        compare_features(old[fid], new[fid])
    areas = [fid for fid, f in old.items() if f.GetGeometryRef() is not None and
             any(word in f.GetGeometryRef().ExportToWkt() for word in ("POLYGON", "SURFACE", "TRIANGLE", "TIN"))]
    moved = [fid for fid in areas if new[fid]["sunder_st"] == "moved"]
    same("features that moved", 2, len(moved))
    same("others", {"skipped"}, {f["sunder_st"] for fid, f in new.items() if fid not in areas} | {"skipped"})


if sys.argv[1] == "make":
    make(sys.argv[2])
else:
    compare(sys.argv[2], sys.argv[3], sys.argv[4], sys.argv[5] if len(sys.argv) > 5 else sys.argv[3])
    print("\n".join(trouble[:10]))
    sys.exit(1 if trouble else 0)
