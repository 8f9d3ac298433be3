"""Separates the buildings of the small town, which comes with the sources, and shows and writes the moved GeoDataFrame.

    python3 docs/examples/town.py [OUTPUT.gpkg]
"""
import pathlib
import sys

import geopandas
import sunder

TOWN = pathlib.Path(__file__).resolve().parents[2] / "datasets-synthetic" / "town.gpkg"


def main():
    buildings = geopandas.read_file(TOWN, layer="buildings")
    roads = geopandas.read_file(TOWN, layer="roads")
    result = sunder.separate(buildings, gap=3, barriers=[sunder.Barrier(roads, width=6)], max_shift=5)
    print(result)
    print(result.frame[result.frame.sunder_st == "moved"][["id", "sunder_dx", "sunder_dy", "geometry"]].head())
    for conflict in result.conflicts:
        print(conflict.kind, conflict.a, conflict.b, conflict.reason)
    if len(sys.argv) > 1:
        result.frame.to_file(sys.argv[1], layer="buildings", driver="GPKG")


main()
