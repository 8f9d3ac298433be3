/* rtree.c: packing a SQLite R-tree.
 *
 * The tree is three tables (SQLite's documentation of its R*Tree module, "Shadow Tables"): _node holds the nodes as
 * blobs, _rowid tells the leaf of each row, _parent the parent of each node but the root, which is node 1. A node is,
 * big-endian: two bytes of depth (in the root only), two bytes that count its cells, then cells of 24 bytes: the row or
 * child in 8 and four floats. Leaves are filled with consecutive boxes along a Hilbert curve through their centres
 * [KF93], the levels above with consecutive nodes. */
#include "write/rtree.h"

#include "base/array.h"
#include "base/curve.h"
#include "base/interrupt.h"
#include "sqlite/rows.h"
#include "write/sql.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 4, CELL = 24 };

#define WHAT "the spatial index"

/* ---- SQL --------------------------------------------------------------------------------------------------------- */

static bool run(GDALDatasetH dataset, const char *sql, gis_error *error)
{
    return gis_sql_run(dataset, sql, WHAT, error);
}

/* GDAL's handle of the database; NULL where rows cannot be handed to SQLite past GDAL. */
static void *handle_of(GDALDatasetH dataset)
{
    void *handle = GDALGetInternalHandle(dataset, "SQLITE_HANDLE");
    char *source_id = handle ? gis_sql_ask(dataset, "SELECT sqlite_source_id()") : NULL;
    if (!gis_sqlite_is_that_of(source_id)) handle = NULL;
    CPLFree(source_id);
    return handle;
}

/* "rtree_TABLE_COLUMN" and a suffix, with quotes doubled and around; CPLFree(). */
static char *tree_name(OGRLayerH layer, const char *suffix, char quote)
{
    char *plain = CPLStrdup(CPLSPrintf("rtree_%s_%s%s", OGR_L_GetName(layer), OGR_L_GetGeometryColumn(layer), suffix));
    char *quoted = CPLMalloc(2 * strlen(plain) + 3), *to = quoted;
    *to++ = quote;
    for (const char *from = plain; *from; from++) {
        if (*from == quote) *to++ = quote;
        *to++ = *from;
    }
    *to++ = quote;
    *to = '\0';
    CPLFree(plain);
    return quoted;
}

/* ---- Gathering --------------------------------------------------------------------------------------------------- */

bool gis_rtree_begin(GDALDatasetH dataset, OGRLayerH layer, gis_boxes *boxes, gis_error *error)
{
    const char *column = OGR_L_GetGeometryColumn(layer);
    if (!column || !column[0]) return true;
    if (!run(dataset, "SELECT 1", error)) /* any SQL makes GDAL create tables and indexes that it had put off */
        return false;
    char *literal = tree_name(layer, "_insert", '\'');
    char *find = CPLStrdup(CPLSPrintf("SELECT sql FROM sqlite_master WHERE type = 'trigger' AND name = %s", literal));
    boxes->trigger = gis_sql_ask(dataset, find);
    CPLFree(find);
    CPLFree(literal);
    if (boxes->trigger && !handle_of(dataset)) gis_boxes_clear(boxes); /* GDAL fills it */
    if (!boxes->trigger) return true;
    char *name = tree_name(layer, "_insert", '"');
    char *drop = CPLStrdup(CPLSPrintf("DROP TRIGGER %s", name));
    bool done = run(dataset, drop, error);
    CPLFree(drop);
    CPLFree(name);
    return done;
}

static float below(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

static float above(double x)
{
    float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

bool gis_rtree_add(gis_boxes *boxes, OGRFeatureH feature, gis_error *error)
{
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (!boxes->trigger || !geometry || OGR_G_IsEmpty(geometry)) return true;
    OGREnvelope box;
    OGR_G_GetEnvelope(geometry, &box);
    return gis_rtree_add_box(boxes, OGR_F_GetFID(feature), &box, error);
}

bool gis_rtree_add_box(gis_boxes *boxes, GIntBig fid, const OGREnvelope *box, gis_error *error)
{
    if (!gis_array_reserve(&boxes->at, &boxes->capacity, boxes->n + 1, sizeof *boxes->at)) return gis_no_memory(error);
    boxes->at[boxes->n++] =
        (struct gis_box){fid, {below(box->MinX), above(box->MaxX), below(box->MinY), above(box->MaxY)}};
    return true;
}

void gis_boxes_clear(gis_boxes *boxes)
{
    free(boxes->at);
    CPLFree(boxes->trigger);
    *boxes = (gis_boxes){0};
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

typedef struct place {
    uint32_t along; /* position of the centre on the Hilbert curve of a 65536 x 65536 grid */
    uint32_t at;    /* which box */
} place;

/* The curve's grid is finer than the boxes of any layer need to be told apart. */
enum { CURVE_BITS = 16 };

static int compare_places(const void *a, const void *b)
{
    const place *p = a, *q = b;
    if (p->along != q->along) return p->along < q->along ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

/* Puts box places[i].at at i, cycle by cycle. */
static void arrange(struct gis_box *box, place *places, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const struct gis_box first = box[i];
        size_t to = i;
        for (size_t from; (from = places[to].at) != i; to = from) {
            box[to] = box[from];
            places[to].at = (uint32_t)to;
        }
        box[to] = first;
        places[to].at = (uint32_t)to;
    }
}

/* Sorts the boxes along the curve; false if memory is out. */
static bool sort_boxes(gis_boxes *boxes)
{
    place *places = boxes->n <= UINT32_MAX ? malloc(boxes->n * sizeof *places) : NULL;
    if (!places) return false;
    double around[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (size_t i = 0; i < boxes->n; i++)
        for (int k = 0; k < 4; k++)
            around[k] = k % 2 ? fmax(around[k], boxes->at[i].side[k]) : fmin(around[k], boxes->at[i].side[k]);
    for (size_t i = 0; i < boxes->n; i++) {
        const float *side = boxes->at[i].side;
        const uint32_t x = gis_curve_cell(((double)side[0] + side[1]) / 2, around[0], around[1], CURVE_BITS);
        const uint32_t y = gis_curve_cell(((double)side[2] + side[3]) / 2, around[2], around[3], CURVE_BITS);
        places[i] = (place){(uint32_t)gis_curve_position(x, y, CURVE_BITS), (uint32_t)i};
    }
    qsort(places, boxes->n, sizeof *places, compare_places);
    arrange(boxes->at, places, boxes->n);
    free(places);
    return true;
}

/* ---- Nodes ------------------------------------------------------------------------------------------------------- */

/* Big-endian, as SQLite has it on every machine. */
static unsigned char *put_number(unsigned char *to, uint64_t value, int bytes)
{
    for (int shift = 8 * bytes - 8; shift >= 0; shift -= 8) *to++ = (unsigned char)(value >> shift);
    return to;
}

static unsigned char *put_float(unsigned char *to, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put_number(to, bits, 4);
}

/* A feature, or a node, and the node that it is in. */
typedef int64_t row_of[2];

typedef struct packing {
    gis_sqlite_rows nodes;
    size_t capacity;       /* cells in a node */
    unsigned char *node;   /* room for one */
    row_of *leaf, *parent; /* of all features, and of all nodes but the root */
    size_t leaves, parents;
    GIntBig next; /* number of the next node */
} packing;

static int compare_rows(const void *a, const void *b)
{
    const row_of *p = a, *q = b;
    return ((*p)[0] > (*q)[0]) - ((*p)[0] < (*q)[0]);
}

/* One node of consecutive cells; gives its number and box in *made. root_depth < 0: it is not the root, which is
 * node 1. */
static bool write_node(packing *all, const struct gis_box *cells, size_t n, bool leaf, int root_depth,
                       struct gis_box *made, gis_error *error)
{
    bool root = root_depth >= 0;
    if (!gis_go_on(error)) return false;
    made->fid = root ? 1 : all->next++;
    memcpy(made->side, cells[0].side, sizeof made->side);
    memset(all->node, 0, HEADER + CELL * all->capacity);
    unsigned char *to = put_number(all->node, root ? (uint64_t)root_depth : 0, 2);
    to = put_number(to, n, 2);
    for (size_t i = 0; i < n; i++) {
        int64_t *row = leaf ? all->leaf[all->leaves++] : all->parent[all->parents++];
        row[0] = cells[i].fid;
        row[1] = made->fid;
        to = put_number(to, (uint64_t)cells[i].fid, 8);
        for (int k = 0; k < 4; k++) {
            to = put_float(to, cells[i].side[k]);
            made->side[k] = k % 2 ? fmaxf(made->side[k], cells[i].side[k]) : fminf(made->side[k], cells[i].side[k]);
        }
    }
    return gis_sqlite_rows_add_bytes(&all->nodes, made->fid, all->node, HEADER + CELL * all->capacity, error);
}

/* Level upon level, in place: the boxes of a level's nodes become the cells of the next. */
static bool write_levels(packing *all, gis_boxes *boxes, gis_error *error)
{
    size_t n = boxes->n;
    for (int depth = 0;; depth++) {
        bool top = n <= all->capacity;
        size_t made = 0;
        for (size_t first = 0; first < n; first += all->capacity) {
            size_t count = n - first < all->capacity ? n - first : all->capacity;
            struct gis_box node;
            if (!write_node(all, boxes->at + first, count, depth == 0, top ? depth : -1, &node, error)) return false;
            boxes->at[made++] = node; /* made <= first: these cells are written already */
        }
        if (top) return true;
        n = made;
    }
}

static bool empty_tables(GDALDatasetH dataset, OGRLayerH layer, gis_error *error)
{
    static const char *const tables[] = {"_node", "_parent", "_rowid"};
    bool done = true;
    for (size_t i = 0; done && i < sizeof tables / sizeof *tables; i++) {
        char *name = tree_name(layer, tables[i], '"');
        char *sql = CPLStrdup(CPLSPrintf("DELETE FROM %s", name));
        done = run(dataset, sql, error);
        CPLFree(sql);
        CPLFree(name);
    }
    return done;
}

/* Cells in a node of this tree: SQLite chose the size of a node by the size of a page. */
static size_t node_capacity(GDALDatasetH dataset, OGRLayerH layer)
{
    char *name = tree_name(layer, "_node", '"');
    char *sql = CPLStrdup(CPLSPrintf("SELECT length(data) FROM %s WHERE nodeno = 1", name));
    char *length = gis_sql_ask(dataset, sql);
    long bytes = length ? atol(length) : 0;
    CPLFree(length);
    CPLFree(sql);
    CPLFree(name);
    return bytes < HEADER + 2 * CELL ? 0 : (size_t)(bytes - HEADER) / CELL;
}

static bool begin_rows(gis_sqlite_rows *rows, GDALDatasetH dataset, OGRLayerH layer, const char *table, bool many,
                       gis_error *error)
{
    char *name = tree_name(layer, table, '"');
    const bool done =
        gis_sqlite_rows_begin(rows, GDALGetInternalHandle(dataset, "SQLITE_HANDLE"), name, many, WHAT, error);
    CPLFree(name);
    return done;
}

/* Rows at a time, between which the user may stop; and how many are many. */
enum { STRETCH = 10000, MANY_ROWS = 100 };

/* By rising keys, though the tree has them along the curve. */
static bool write_rows(GDALDatasetH dataset, OGRLayerH layer, const char *table, row_of *row, size_t n,
                       gis_error *error)
{
    gis_sqlite_rows rows = {0};
    if (n) qsort(row, n, sizeof *row, compare_rows);
    bool done = begin_rows(&rows, dataset, layer, table, n >= MANY_ROWS, error);
    for (size_t i = 0; done && i < n; i += STRETCH)
        done = gis_go_on(error) &&
               gis_sqlite_rows_add(&rows, (const int64_t(*)[2])row + i, n - i < STRETCH ? n - i : STRETCH, error);
    gis_sqlite_rows_end(&rows);
    return done;
}

static bool fill(GDALDatasetH dataset, OGRLayerH layer, gis_boxes *boxes, gis_error *error)
{
    size_t capacity = node_capacity(dataset, layer);
    if (!capacity) return gis_fail(error, "the spatial index of layer %s is not as expected", OGR_L_GetName(layer));
    if (!sort_boxes(boxes)) return gis_no_memory(error);
    packing all = {.capacity = capacity,
                   .node = CPLMalloc(HEADER + CELL * capacity),
                   .leaf = malloc(boxes->n * sizeof *all.leaf),
                   .parent = malloc(boxes->n * sizeof *all.parent), /* fewer than that */
                   .next = 2};
    bool done = (all.leaf && all.parent) || gis_no_memory(error);
    done = done && empty_tables(dataset, layer, error) &&
           begin_rows(&all.nodes, dataset, layer, "_node", false, error) && write_levels(&all, boxes, error);
    gis_sqlite_rows_end(&all.nodes);
    free(boxes->at); /* sorting needs as much */
    boxes->at = NULL;
    done = done && write_rows(dataset, layer, "_parent", all.parent, all.parents, error) &&
           write_rows(dataset, layer, "_rowid", all.leaf, all.leaves, error);
    CPLFree(all.node);
    free(all.leaf);
    free(all.parent);
    return done;
}

bool gis_rtree_end(GDALDatasetH dataset, OGRLayerH layer, gis_boxes *boxes, gis_error *error)
{
    if (!boxes->trigger) return true;
    bool done = (boxes->n == 0 || fill(dataset, layer, boxes, error)) && run(dataset, boxes->trigger, error);
    gis_boxes_clear(boxes);
    return done;
}
