/* gpkg_rtree.c: fills a SQLite R-tree with packed nodes.
 *
 * The tree is three tables (SQLite's documentation of its R*Tree module, "Shadow Tables"): _node holds the nodes as
 * blobs, _rowid the leaf of each row, _parent the parent of each node except the root, which is node 1. A node is, in
 * big-endian order: two bytes of depth (in the root only), two bytes with the number of its cells, then cells of 24
 * bytes: the row or child in 8 bytes and four floats. Leaves are filled with consecutive boxes along a Hilbert curve
 * through their centres [KF93], the levels above with consecutive nodes. */
#include "gpkg/gpkg_rtree.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/keyed_sort.h"
#include "base/path.h"
#include "disk/external_sort.h"
#include "gpkg/sql.h"
#include "gpkg/sqlite_rows.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 4, CELL = 24 };

#define WHAT "the spatial index"

/* ---- SQL --------------------------------------------------------------------------------------------------------- */

static bool run_sql(GDALDatasetH dataset, const char *sql, gis_error *error)
{
    return gis_sql_run(dataset, sql, WHAT, error);
}

/* GDAL's handle of the database; NULL if GDAL uses another SQLite than this program finds. */
static void *handle_of(GDALDatasetH dataset)
{
    void *handle = GDALGetInternalHandle(dataset, "SQLITE_HANDLE");
    char *source_id = handle ? gis_sql_ask(dataset, "SELECT sqlite_source_id()") : NULL;
    if (!gis_sqlite_is_that_of(source_id)) handle = NULL;
    CPLFree(source_id);
    return handle;
}

/* "rtree_TABLE_COLUMN" followed by `suffix`, quoted with `quote`; quotes inside are doubled. CPLFree(). */
static char *tree_name(OGRLayerH layer, const char *suffix, char quote)
{
    char *plain = gis_printed("rtree_%s_%s%s", OGR_L_GetName(layer), OGR_L_GetGeometryColumn(layer), suffix);
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

/* ---- Collecting boxes -------------------------------------------------------------------------------------------- */

bool gis_rtree_begin(GDALDatasetH dataset, OGRLayerH layer, gis_rtree *tree, gis_error *error)
{
    const char *column = OGR_L_GetGeometryColumn(layer);
    if (!column || !column[0]) return true;
    if (!run_sql(dataset, "SELECT 1", error)) /* any SQL makes GDAL create deferred tables and indexes */
        return false;
    char *literal = tree_name(layer, "_insert", '\'');
    char *find = gis_printed("SELECT sql FROM sqlite_master WHERE type = 'trigger' AND name = %s", literal);
    tree->trigger = gis_sql_ask(dataset, find);
    CPLFree(find);
    CPLFree(literal);
    if (tree->trigger && !handle_of(dataset)) gis_rtree_clear(tree); /* then GDAL fills the tree */
    if (!tree->trigger) return true;
    char *name = tree_name(layer, "_insert", '"');
    char *drop = gis_printed("DROP TRIGGER %s", name);
    bool done = run_sql(dataset, drop, error);
    CPLFree(drop);
    CPLFree(name);
    return done;
}

bool gis_rtree_add(gis_rtree *tree, OGRFeatureH feature, gis_error *error)
{
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (!tree->trigger || !geometry || OGR_G_IsEmpty(geometry)) return true;
    OGREnvelope box;
    OGR_G_GetEnvelope(geometry, &box);
    return gis_rtree_add_box(tree, OGR_F_GetFID(feature), &box, error);
}

bool gis_rtree_add_box(gis_rtree *tree, GIntBig fid, const OGREnvelope *box, gis_error *error)
{
    return gis_index_boxes_add(&tree->boxes, fid, box, error);
}

void gis_rtree_clear(gis_rtree *tree)
{
    gis_index_boxes_clear(&tree->boxes);
    CPLFree(tree->trigger);
    tree->trigger = NULL;
}

/* ---- Nodes ------------------------------------------------------------------------------------------------------- */

/* Writes a number in big-endian order, which SQLite uses on every machine. */
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

/* A feature's FID or a node's number, and the number of the node that contains it. */
typedef int64_t row_of[2];

typedef struct packing {
    const char *scratch; /* directory in which rows of features are sorted; NULL: in memory */
    gis_sqlite_rows nodes;
    size_t capacity;     /* number of cells in a node */
    unsigned char *node; /* buffer for one node */
    gis_index_box *cell; /* [capacity] of the leaf being filled */
    size_t cells, features, taken;
    gis_keyed *leaf; /* the leaf of each feature, keyed by key_of(FID); if scratch is NULL */
    size_t leaves, leaf_room;
    gis_sorter *sorter; /* the same, in bounded memory; if scratch is given */
    row_of *parent;     /* of all nodes except the root, by number */
    size_t parents, parent_room;
    gis_index_box *level; /* the boxes of the nodes of one level */
    size_t in_level, level_room;
    GIntBig next; /* number for the next node */
} packing;

/* The FID as an unsigned number that sorts in the same order. */
static uint64_t key_of(int64_t fid) { return (uint64_t)fid ^ UINT64_C(1) << 63; }
static int64_t fid_of(uint64_t key) { return (int64_t)(key ^ UINT64_C(1) << 63); }

static bool note_leaf(packing *all, int64_t fid, int64_t node, gis_error *error)
{
    if (all->scratch) {
        const gis_sort_head one = {sizeof one, key_of(fid), (uint64_t)node};
        return gis_sorter_add(all->sorter, &one, error);
    }
    if (!gis_array_reserve(&all->leaf, &all->leaf_room, all->leaves + 1, sizeof *all->leaf))
        return gis_no_memory(error);
    all->leaf[all->leaves++] = (gis_keyed){key_of(fid), (uint64_t)node};
    return true;
}

static bool note_parent(packing *all, int64_t child, int64_t node, gis_error *error)
{
    if (!gis_array_reserve(&all->parent, &all->parent_room, all->parents + 1, sizeof *all->parent))
        return gis_no_memory(error);
    all->parent[all->parents][0] = child;
    all->parent[all->parents++][1] = node;
    return true;
}

/* Writes a node with n consecutive cells and sets *made to its number and box. root_depth: depth of the tree if the
 * node is the root (node 1); -1 otherwise. */
static bool write_node(packing *all, const gis_index_box *cells, size_t n, bool leaf, int root_depth,
                       gis_index_box *made, gis_error *error)
{
    const bool root = root_depth >= 0;
    bool done = gis_go_on(error);
    gis_index_box node = {.fid = root ? 1 : all->next++};
    memcpy(node.side, cells[0].side, sizeof node.side);
    memset(all->node, 0, HEADER + CELL * all->capacity);
    unsigned char *to = put_number(all->node, root ? (uint64_t)root_depth : 0, 2);
    to = put_number(to, n, 2);
    for (size_t i = 0; i < n && done; i++) {
        done = leaf ? note_leaf(all, cells[i].fid, node.fid, error) : note_parent(all, cells[i].fid, node.fid, error);
        to = put_number(to, (uint64_t)cells[i].fid, 8);
        for (int k = 0; k < 4; k++) {
            to = put_float(to, cells[i].side[k]);
            node.side[k] = k % 2 ? fmaxf(node.side[k], cells[i].side[k]) : fminf(node.side[k], cells[i].side[k]);
        }
    }
    *made = node; /* only now, since *made may be one of the cells */
    return done && gis_sqlite_rows_add_bytes(&all->nodes, node.fid, all->node, HEADER + CELL * all->capacity, error);
}

/* Adds the next box along the curve to the current leaf, and writes the leaf if it is full or the box is the last. */
static bool take_box(void *user, const gis_index_box *box, gis_error *error)
{
    packing *all = user;
    all->cell[all->cells++] = *box;
    all->taken++;
    if (all->cells < all->capacity && all->taken < all->features) return true;
    if (!gis_array_reserve(&all->level, &all->level_room, all->in_level + 1, sizeof *all->level))
        return gis_no_memory(error);
    const size_t n = all->cells;
    all->cells = 0;
    return write_node(all, all->cell, n, true, all->features <= all->capacity ? 0 : -1, &all->level[all->in_level++],
                      error);
}

/* Writes the levels above the leaves, up to the root. The boxes of one level's nodes become the cells of the next
 * level, in the same array. */
static bool write_levels(packing *all, gis_error *error)
{
    if (all->features <= all->capacity) return true;
    size_t n = all->in_level;
    for (int depth = 1;; depth++) {
        const bool top = n <= all->capacity;
        size_t made = 0;
        for (size_t first = 0; first < n; first += all->capacity) {
            const size_t count = n - first < all->capacity ? n - first : all->capacity;
            /* made <= first, so only cells that were written already are overwritten. */
            if (!write_node(all, all->level + first, count, false, top ? depth : -1, &all->level[made++], error))
                return false;
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
        char *sql = gis_printed("DELETE FROM %s", name);
        done = run_sql(dataset, sql, error);
        CPLFree(sql);
        CPLFree(name);
    }
    return done;
}

/* The number of cells in a node of this tree. SQLite chose the size of a node to suit the page size. */
static size_t node_capacity(GDALDatasetH dataset, OGRLayerH layer)
{
    char *name = tree_name(layer, "_node", '"');
    char *sql = gis_printed("SELECT length(data) FROM %s WHERE nodeno = 1", name);
    char *length = gis_sql_ask(dataset, sql);
    long bytes = length ? atol(length) : 0;
    CPLFree(length);
    CPLFree(sql);
    CPLFree(name);
    return bytes < HEADER + 2 * CELL ? 0 : (size_t)(bytes - HEADER) / CELL;
}

static bool begin_rows(gis_sqlite_rows *rows, GDALDatasetH dataset, OGRLayerH layer, const char *table,
                       const char *many, gis_error *error)
{
    char *name = tree_name(layer, table, '"');
    const bool done =
        gis_sqlite_rows_begin(rows, GDALGetInternalHandle(dataset, "SQLITE_HANDLE"), name, many, WHAT, error);
    CPLFree(name);
    return done;
}

/* STRETCH: number of rows written between two checks for signals. MANY_ROWS: from this number on, statements for
 * several rows at once are used. */
enum { STRETCH = 10000, MANY_ROWS = 100 };

/* Writes n rows in ascending order of their keys. */
static bool write_rows(gis_sqlite_rows *rows, row_of *row, size_t n, gis_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < n; i += STRETCH)
        done = gis_go_on(error) &&
               gis_sqlite_rows_add(rows, (const int64_t(*)[2])row + i, n - i < STRETCH ? n - i : STRETCH, error);
    return done;
}

static bool write_parents(GDALDatasetH dataset, OGRLayerH layer, packing *all, gis_error *error)
{
    gis_sqlite_rows rows = {0};
    const bool done =
        begin_rows(&rows, dataset, layer, "_parent", all->parents >= MANY_ROWS ? "parentnode" : NULL, error) &&
        write_rows(&rows, all->parent, all->parents, error);
    gis_sqlite_rows_end(&rows);
    return done;
}

/* A buffer of rows of features. */
typedef struct stretch {
    gis_sqlite_rows *rows;
    row_of row[STRETCH];
    size_t n;
} stretch;

static bool put_row(stretch *s, uint64_t key, uint64_t node, gis_error *error)
{
    s->row[s->n][0] = fid_of(key);
    s->row[s->n++][1] = (int64_t)node;
    if (s->n < STRETCH) return true;
    s->n = 0;
    return write_rows(s->rows, s->row, STRETCH, error);
}

static bool take_row(void *user, const unsigned char *bytes, gis_error *error)
{
    const gis_sort_head *one = (const void *)bytes;
    return put_row(user, one->first, one->second, error);
}

static bool write_from_memory(packing *all, stretch *s, gis_error *error)
{
    bool done = gis_keyed_sort(all->leaf, all->leaves) || gis_no_memory(error);
    for (size_t i = 0; i < all->leaves && done; i++) done = put_row(s, all->leaf[i].key, all->leaf[i].with, error);
    return done;
}

/* Writes the _rowid table in ascending order of FIDs, although the leaves are in the order of the curve. */
static bool write_leaves(GDALDatasetH dataset, OGRLayerH layer, packing *all, gis_error *error)
{
    gis_sqlite_rows rows = {0};
    stretch *s = malloc(sizeof *s);
    if (!s) return gis_no_memory(error);
    s->rows = &rows;
    s->n = 0;
    const bool done =
        begin_rows(&rows, dataset, layer, "_rowid", all->features >= MANY_ROWS ? "nodeno" : NULL, error) &&
        (all->scratch ? gis_sorter_take(all->sorter, take_row, s, error) : write_from_memory(all, s, error)) &&
        write_rows(&rows, s->row, s->n, error);
    free(s);
    gis_sqlite_rows_end(&rows);
    return done;
}

static void clear_packing(packing *all)
{
    CPLFree(all->node);
    free(all->cell);
    free(all->leaf);
    free(all->parent);
    free(all->level);
    gis_sorter_free(all->sorter);
}

static bool write_nodes(GDALDatasetH dataset, OGRLayerH layer, packing *all, gis_index_boxes *boxes, gis_error *error)
{
    const bool done = empty_tables(dataset, layer, error) &&
                      begin_rows(&all->nodes, dataset, layer, "_node", NULL, error) &&
                      gis_index_boxes_in_order(boxes, take_box, all, error) && write_levels(all, error);
    gis_sqlite_rows_end(&all->nodes);
    return done;
}

static bool fill_tree(GDALDatasetH dataset, OGRLayerH layer, gis_index_boxes *boxes, gis_error *error)
{
    const size_t capacity = node_capacity(dataset, layer);
    if (!capacity) return gis_fail(error, "the spatial index of layer %s is not as expected", OGR_L_GetName(layer));
    packing all = {.scratch = boxes->scratch,
                   .capacity = capacity,
                   .node = CPLMalloc(HEADER + CELL * capacity),
                   .cell = malloc(capacity * sizeof *all.cell),
                   .features = boxes->n,
                   .next = 2};
    bool done = all.cell || gis_no_memory(error);
    done = done && (!all.scratch || gis_sorter_new(all.scratch, "rows.XXXXXX", GIS_SORT_BYTES, &all.sorter, error)) &&
           write_nodes(dataset, layer, &all, boxes, error) && write_parents(dataset, layer, &all, error) &&
           write_leaves(dataset, layer, &all, error);
    clear_packing(&all);
    return done;
}

bool gis_rtree_end(GDALDatasetH dataset, OGRLayerH layer, gis_rtree *tree, gis_error *error)
{
    if (!tree->trigger) return true;
    bool done = (tree->boxes.n == 0 || fill_tree(dataset, layer, &tree->boxes, error)) &&
                run_sql(dataset, tree->trigger, error);
    gis_rtree_clear(tree);
    return done;
}
