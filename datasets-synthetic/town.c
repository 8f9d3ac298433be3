/* sunder-town: writes a synthetic town of any size, as a layer of buildings and a layer of roads.
 *
 * The town grows along a spiral of blocks from the market place until it has the number of buildings asked for. Blocks
 * are drawn one by one and forgotten, so memory does not grow with the town. The same number and seed give the same
 * features, vertex for vertex, on every machine, and the first features of a larger town are those of a smaller one. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "block.h"

/* The market place in EPSG:25832, in millimetres; coordinates are the doubles nearest to whole millimetres. */
static const int64_t MARKET_X = 451234567, MARKET_Y = 5411234567;

enum { COMMIT_EVERY = 100000 };

typedef struct town_settings {
    const char *output, *format;
    uint64_t buildings, seed;
    double trouble;
    bool overwrite;
} town_settings;

typedef struct town_writer {
    GDALDatasetH dataset;
    OGRLayerH buildings, roads;
    bool transactions;
    uint64_t n_buildings, n_roads;
} town_writer;

static const char usage[] = "usage: sunder-town [options] OUTPUT\n"
                            "Writes a synthetic town: layers \"buildings\" and \"roads\" in EPSG:25832.\n\n"
                            "  --buildings N   how many buildings (250)\n"
                            "  --seed N        which town (1)\n"
                            "  --trouble X     how often houses are pushed together, 0 to 1 (0.2)\n"
                            "  --of FORMAT     GDAL driver (GPKG)\n"
                            "  --overwrite     replace OUTPUT\n";

static double metres(int64_t millimetres) { return (double)millimetres / 1000; }

static void set_ring(OGRGeometryH ring, const int64_t *xy, size_t n)
{
    for (size_t i = 0; i <= n; ++i)
        OGR_G_AddPoint_2D(ring, metres(MARKET_X + xy[2 * (i % n)]), metres(MARKET_Y + xy[2 * (i % n) + 1]));
}

static OGRGeometryH building_geometry(const town_building *building)
{
    OGRGeometryH polygon = OGR_G_CreateGeometry(wkbPolygon);
    size_t start = 0;
    for (size_t r = 0; r < building->rings; ++r) {
        OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
        set_ring(ring, building->xy + 2 * start, building->ring_end[r] - start);
        OGR_G_AddGeometryDirectly(polygon, ring);
        start = building->ring_end[r];
    }
    return polygon;
}

/* Commits now and then: one transaction for millions of rows would need a journal as large as the file. */
static bool add_feature(town_writer *writer, OGRLayerH layer, OGRFeatureH feature, OGRGeometryH geometry)
{
    bool done = OGR_F_SetGeometryDirectly(feature, geometry) == OGRERR_NONE &&
                OGR_L_CreateFeature(layer, feature) == OGRERR_NONE;
    OGR_F_Destroy(feature);
    if (done && writer->transactions && (writer->n_buildings + writer->n_roads) % COMMIT_EVERY == COMMIT_EVERY - 1) {
        done = GDALDatasetCommitTransaction(writer->dataset) == OGRERR_NONE &&
               GDALDatasetStartTransaction(writer->dataset, FALSE) == OGRERR_NONE;
    }
    return done;
}

static bool write_building(town_writer *writer, const town_building *building)
{
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(writer->buildings));
    char id[24];
    snprintf(id, sizeof id, "B%07" PRIu64, writer->n_buildings + 1);
    OGR_F_SetFieldString(feature, 0, id);
    OGR_F_SetFieldString(feature, 1, building->kind);
    OGR_F_SetFieldDouble(feature, 2, building->height);
    if (building->name) OGR_F_SetFieldString(feature, 3, building->name);
    ++writer->n_buildings;
    return add_feature(writer, writer->buildings, feature, building_geometry(building));
}

static bool write_road(town_writer *writer, const town_street *street)
{
    enum { PIECES = 8 };
    int pieces = street->ground.bow == 0 ? 1 : PIECES;
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(writer->roads));
    OGRGeometryH line = OGR_G_CreateGeometry(wkbLineString);
    char id[24];
    for (int i = 0; i <= pieces; ++i) {
        town_building point;
        town_building_begin(&point, "", 0); /* rounds as buildings do */
        town_building_corner(&point, &street->ground, street->ground.length * i / pieces, 0);
        OGR_G_AddPoint_2D(line, metres(MARKET_X + point.xy[0]), metres(MARKET_Y + point.xy[1]));
    }
    snprintf(id, sizeof id, "R%07" PRIu64, writer->n_roads + 1);
    OGR_F_SetFieldString(feature, 0, id);
    OGR_F_SetFieldString(feature, 1, town_street_kind_string(street->kind));
    OGR_F_SetFieldDouble(feature, 2, 2 * street->half_width);
    OGR_F_SetFieldString(feature, 3, street->name);
    ++writer->n_roads;
    return add_feature(writer, writer->roads, feature, line);
}

static bool create_fields(OGRLayerH layer, const char *number)
{
    static const int width[4] = {12, 16, 0, 80};
    const char *names[4] = {"id", "kind", number, "name"};
    for (int i = 0; i < 4; ++i) {
        OGRFieldDefnH field = OGR_Fld_Create(names[i], i == 2 ? OFTReal : OFTString);
        OGR_Fld_SetWidth(field, width[i]);
        OGR_Fld_SetNullable(field, i > 1);
        bool done = OGR_L_CreateField(layer, field, TRUE) == OGRERR_NONE;
        OGR_Fld_Destroy(field);
        if (!done) return false;
    }
    return true;
}

static bool open_output(const town_settings *settings, town_writer *writer)
{
    GDALDriverH driver = GDALGetDriverByName(settings->format);
    VSILFILE *there;
    if (!driver) {
        fprintf(stderr, "sunder-town: error: no driver %s\n", settings->format);
        return false;
    }
    if ((there = VSIFOpenL(settings->output, "rb")) != NULL) {
        VSIFCloseL(there);
        if (!settings->overwrite) {
            fprintf(stderr, "sunder-town: error: %s exists; --overwrite replaces it\n", settings->output);
            return false;
        }
        GDALDeleteDataset(driver, settings->output);
    }
    OGRSpatialReferenceH crs = OSRNewSpatialReference(NULL);
    OSRImportFromEPSG(crs, 25832);
    OSRSetAxisMappingStrategy(crs, OAMS_TRADITIONAL_GIS_ORDER);
    writer->dataset = GDALCreate(driver, settings->output, 0, 0, 0, GDT_Unknown, NULL);
    if (writer->dataset) {
        writer->buildings = GDALDatasetCreateLayer(writer->dataset, "buildings", crs, wkbPolygon, NULL);
        writer->roads = GDALDatasetCreateLayer(writer->dataset, "roads", crs, wkbLineString, NULL);
    }
    OSRRelease(crs);
    if (!writer->buildings || !writer->roads || !create_fields(writer->buildings, "height") ||
        !create_fields(writer->roads, "width"))
        return false;
    writer->transactions = GDALDatasetTestCapability(writer->dataset, ODsCTransactions) &&
                           GDALDatasetStartTransaction(writer->dataset, FALSE) == OGRERR_NONE;
    return true;
}

/* A street between two blocks is drawn with the one that comes first. */
static bool write_block_roads(town_writer *writer, const town_block *block, uint64_t number, uint64_t blocks)
{
    static const int64_t across[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    for (size_t side = 0; side < 4; ++side) {
        uint64_t other = town_block_number(block->column + across[side][0], block->row + across[side][1]);
        if ((other > number || other >= blocks) && !write_road(writer, &block->streets[side])) return false;
    }
    for (size_t i = 0; i < block->n_lanes; ++i)
        if (!write_road(writer, &block->lanes[i])) return false;
    return true;
}

static bool write_town(const town_settings *settings, town_writer *writer, town_block *block)
{
    uint64_t blocks = 0;
    int64_t column, row;
    while (writer->n_buildings < settings->buildings) {
        town_block_place(blocks++, &column, &row);
        town_block_build(block, settings->seed, column, row, settings->trouble);
        for (size_t i = 0; i < block->n && writer->n_buildings < settings->buildings; ++i)
            if (!write_building(writer, &block->buildings[i])) return false;
    }
    for (uint64_t number = 0; number < blocks; ++number) {
        town_block_place(number, &column, &row);
        town_block_build(block, settings->seed, column, row, settings->trouble);
        if (!write_block_roads(writer, block, number, blocks)) return false;
    }
    return !writer->transactions || GDALDatasetCommitTransaction(writer->dataset) == OGRERR_NONE;
}

static bool parse_count(const char *text, uint64_t *out)
{
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    *out = value;
    return text[0] >= '0' && text[0] <= '9' && *end == '\0' && errno == 0;
}

static bool parse_share(const char *text, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && *end == '\0' && *out >= 0 && *out <= 1;
}

static bool parse_arguments(int argc, char **argv, town_settings *settings)
{
    for (int i = 1; i < argc; ++i) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--overwrite") == 0) {
            settings->overwrite = true;
        } else if (strncmp(argv[i], "--", 2) != 0) {
            if (settings->output) return false;
            settings->output = argv[i];
        } else if (!value) {
            return false;
        } else if (strcmp(argv[i], "--of") == 0) {
            settings->format = argv[++i];
        } else if (strcmp(argv[i], "--buildings") == 0 ? !parse_count(argv[++i], &settings->buildings)
                   : strcmp(argv[i], "--seed") == 0    ? !parse_count(argv[++i], &settings->seed)
                   : strcmp(argv[i], "--trouble") == 0 ? !parse_share(argv[++i], &settings->trouble)
                                                       : true) {
            return false;
        }
    }
    return settings->output != NULL;
}

int main(int argc, char **argv)
{
    town_settings settings = {.format = "GPKG", .buildings = 250, .seed = 1, .trouble = 0.2};
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        fputs(usage, stdout);
        return 0;
    }
    if (!parse_arguments(argc, argv, &settings)) {
        fputs(usage, stderr);
        return 2;
    }
    CPLSetConfigOption("OGR_CURRENT_DATE", "2024-01-01T00:00:00.000Z"); /* the same bytes on every day */
    GDALAllRegister();
    town_writer writer = {0};
    town_block *block = malloc(sizeof *block);
    bool done = block && open_output(&settings, &writer) && write_town(&settings, &writer, block);
    if (writer.dataset) {
        CPLErrorReset();
        GDALClose(writer.dataset);
        done = done && CPLGetLastErrorType() < CE_Failure;
    }
    free(block);
    if (!done) {
        fprintf(stderr, "sunder-town: error: %s was not written\n", settings.output);
        return 1;
    }
    printf("%s: %" PRIu64 " buildings, %" PRIu64 " roads\n", settings.output, writer.n_buildings, writer.n_roads);
    return 0;
}
