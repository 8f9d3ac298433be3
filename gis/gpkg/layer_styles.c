/* layer_styles.c: rows of the table layer_styles, which QGIS reads when it opens a GeoPackage.
 *
 * What QGIS 3.22 requires of a row, found by experiment: f_table_catalog and f_table_schema are empty texts, not NULL
 * (with NULL the style is silently ignored); one row has useAsDefault = 1; categories use a plain column, not an
 * expression. */
#include "gpkg/layer_styles.h"

#include "base/path.h"
#include "gpkg/sql.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <string.h>

/* Name and owner of the rows that this program writes, which distinguish them from the user's. */
#define OURS "sunder"

static const char make_table[] =
    "CREATE TABLE IF NOT EXISTS layer_styles (id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, "
    "f_table_catalog TEXT(256), f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256), "
    "styleName TEXT(30), styleQML TEXT, styleSLD TEXT, useAsDefault BOOLEAN, description TEXT, owner TEXT(30), "
    "ui TEXT(30), update_time DATETIME DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')))";

static bool run_sql(GDALDatasetH dataset, const char *sql, gis_error *error)
{
    return gis_sql_run(dataset, sql, "the styles", error);
}

static char *quoted_text(const char *text)
{
    char *escaped = CPLEscapeString(text ? text : "", -1, CPLES_SQL);
    size_t length = strlen(escaped);
    char *with_quotes = CPLMalloc(length + 3);
    with_quotes[0] = '\'';
    memcpy(with_quotes + 1, escaped, length);
    memcpy(with_quotes + length + 1, "'", 2);
    CPLFree(escaped);
    return with_quotes;
}

/* An SQL expression for the time that GDAL itself would write, so that a fixed date makes the file reproducible. */
static char *time_expression(void)
{
    const char *fixed = CPLGetConfigOption("OGR_CURRENT_DATE", NULL);
    return fixed ? quoted_text(fixed) : CPLStrdup("strftime('%Y-%m-%dT%H:%M:%fZ','now')");
}

static bool prepare_table(GDALDatasetH dataset, gis_error *error)
{
    char *now = time_expression();
    char *enlist = gis_printed("INSERT OR IGNORE INTO gpkg_contents (table_name, data_type, identifier, "
                                        "description, last_change) VALUES ('layer_styles', 'attributes', "
                                        "'layer_styles', '', %s)",
                                        now);
    bool done = run_sql(dataset, make_table, error) && run_sql(dataset, enlist, error);
    CPLFree(enlist);
    CPLFree(now);
    return done;
}

typedef struct row {
    const char *name, *qml, *sld, *description, *owner;
    bool is_default;
} row;

static bool insert_style(GDALDatasetH dataset, OGRLayerH layer, const row *style, gis_error *error)
{
    const char *texts[] = {
        OGR_L_GetName(layer), OGR_L_GetGeometryColumn(layer), style->name, style->qml, style->sld, style->description,
        style->owner};
    char *values[sizeof texts / sizeof *texts];
    size_t length = 400, n = sizeof texts / sizeof *texts;
    for (size_t i = 0; i < n; i++) {
        values[i] = quoted_text(texts[i]);
        length += strlen(values[i]);
    }
    char *now = time_expression();
    char *sql = CPLMalloc(length);
    snprintf(sql, length,
             "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, styleName, "
             "styleQML, styleSLD, useAsDefault, description, owner, update_time) "
             "VALUES ('', '', %s, %s, %s, %s, %s, %d, %s, %s, %s)",
             values[0], values[1], values[2], values[3], values[4], style->is_default, values[5], values[6], now);
    bool done = run_sql(dataset, sql, error);
    CPLFree(sql);
    CPLFree(now);
    for (size_t i = 0; i < n; i++) CPLFree(values[i]);
    return done;
}

/* ---- The user's own styles --------------------------------------------------------------------------------------- */

static OGRLayerH own_styles(GDALDatasetH source, OGRLayerH layer)
{
    GDALDriverH driver = GDALGetDatasetDriver(source);
    if (!driver || !EQUAL(GDALGetDescription(driver), "GPKG")) return NULL;
    char *name = quoted_text(OGR_L_GetName(layer));
    char *sql = gis_printed("SELECT styleName, styleQML, styleSLD, description, owner FROM layer_styles "
                                     "WHERE f_table_name = %s AND owner IS NOT '" OURS "' ORDER BY id",
                                     name);
    gis_listener listener = {0}; /* most files have no such table, which GDAL reports as an error */
    gis_listen_begin(&listener);
    OGRLayerH result = GDALDatasetExecuteSQL(source, sql, NULL, NULL);
    gis_listen_end();
    gis_listener_clear(&listener);
    CPLFree(sql);
    CPLFree(name);
    return result;
}

static bool copy_styles(GDALDatasetH dataset, OGRLayerH layer, GDALDatasetH source, OGRLayerH source_layer,
                        bool *table_made, gis_error *error)
{
    OGRLayerH styles = own_styles(source, source_layer);
    bool done = true;
    for (OGRFeatureH each; done && styles && (each = OGR_L_GetNextFeature(styles)) != NULL; OGR_F_Destroy(each)) {
        char *texts[5];
        for (int i = 0; i < 5; i++) texts[i] = CPLStrdup(OGR_F_GetFieldAsString(each, i));
        row style = {texts[0], texts[1], texts[2], texts[3], texts[4], false};
        done = (*table_made || prepare_table(dataset, error)) && insert_style(dataset, layer, &style, error);
        *table_made = true;
        for (int i = 0; i < 5; i++) CPLFree(texts[i]);
    }
    if (styles) GDALDatasetReleaseResultSet(source, styles);
    return done;
}

bool gis_styles_write(GDALDatasetH dataset, OGRLayerH layer, gis_style style, GDALDatasetH source,
                      OGRLayerH source_layer, gis_error *error)
{
    gis_text qml = {0};
    bool table_made = false;
    gis_style_qml(&qml, style, OGR_L_GetGeomType(layer));
    bool done = !qml.failed || gis_no_memory(error);
    if (done && qml.length > 0) {
        row ours = {OURS, gis_text_get(&qml), "", "drawn for the results of sunder", OURS, true};
        done = prepare_table(dataset, error) && insert_style(dataset, layer, &ours, error);
        table_made = true;
    }
    gis_text_clear(&qml);
    return done && (!source || copy_styles(dataset, layer, source, source_layer, &table_made, error));
}

bool gis_styles_forget(GDALDatasetH dataset, const char *layer, gis_error *error)
{
    char *there = gis_sql_ask(dataset, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'layer_styles'");
    char *name = quoted_text(layer);
    char *sql = gis_printed("DELETE FROM layer_styles WHERE f_table_name = %s", name);
    bool done = !there || run_sql(dataset, sql, error);
    CPLFree(sql);
    CPLFree(name);
    CPLFree(there);
    return done;
}
