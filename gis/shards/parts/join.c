/* join.c: see join.h. */
#include "shards/parts/join.h"
#include "base/disjoint_sets.h"
#include "shards/parts/border_chunks.h"
#include "shards/parts/box_pairs.h"

#include "base/array.h"
#include "base/interrupt.h"

#include <stdlib.h>

/* ---- Which worlds stay ------------------------------------------------------------------------------------------- */

/* A feature, and a world that contains it. */
typedef struct holding {
    size_t index, world;
} holding;

static int by_holding(const void *a, const void *b)
{
    const holding *p = a, *q = b;
    if (p->index != q->index) return p->index < q->index ? -1 : 1;
    return (p->world > q->world) - (p->world < q->world);
}

typedef struct joining {
    const gis_layout *layout;
    gis_part_result *r; /* the results in memory */
    size_t *parent;     /* [worlds] disjoint sets of worlds that are separated again together */
    bool *again;        /* [worlds] the world is separated again */
    unsigned run;
} joining;

static void mark_together(joining *j, size_t a, size_t b)
{
    j->again[a] = j->again[b] = true;
    gis_set_join(j->parent, a, b);
}

static bool world_stays(const gis_part_world *w) { return !w->gone && !w->loose; }

/* All features of worlds that are neither gone nor loose, sorted by feature and world. */
static holding *list_holdings(const gis_part_result *r, size_t *n)
{
    holding *list = malloc((r->rows + 1) * sizeof *list);
    *n = 0;
    for (size_t w = 0; list && w < r->worlds; w++)
        for (size_t k = 0; k < r->world[w].rows && world_stays(&r->world[w]); k++)
            list[(*n)++] = (holding){r->row[r->world[w].row + k].index, w};
    if (list && *n) qsort(list, *n, sizeof *list, by_holding);
    return list;
}

static bool are_alike(const gis_part_result *r, const gis_part_world *a, const gis_part_world *b)
{
    if (a->rows != b->rows) return false;
    for (size_t k = 0; k < a->rows; k++)
        if (r->row[a->row + k].index != r->row[b->row + k].index) return false;
    return true;
}

/* Compares worlds that share a feature. If both are complete and have the same features, the second is a copy and is
 * dropped; otherwise the two are separated again together. */
static bool compare_holdings(joining *j, gis_error *error)
{
    size_t n;
    gis_part_result *r = j->r;
    holding *list = list_holdings(r, &n);
    if (!list) return gis_no_memory(error);
    for (size_t k = 1; k < n; k++) {
        if (list[k].index != list[k - 1].index) continue;
        gis_part_world *a = &r->world[list[k - 1].world], *b = &r->world[list[k].world];
        if (a->gone || b->gone) continue;
        if (a->complete && b->complete && are_alike(r, a, b)) {
            b->gone = true;
            list[k].world = list[k - 1].world;
        } else {
            mark_together(j, list[k - 1].world, list[k].world);
        }
    }
    free(list);
    return true;
}

static gis_box_pairs_next mark_if_met(void *user, const gis_paired_box *a, const gis_paired_box *b)
{
    joining *j = user;
    const gis_part_world *world = j->r->world;
    if (a->kind != b->kind && world[a->of].run != world[b->of].run) mark_together(j, a->of, b->of);
    return GIS_BOX_PAIRS_BOTH;
}

/* Marks worlds of different runs to be separated again together if one wrote where the other read. */
static bool compare_footprints(joining *j, gis_error *error)
{
    gis_box_pairs pairs = {0};
    const gis_part_result *r = j->r;
    bool done = true;
    for (size_t w = 0; w < r->worlds && done; w++)
        for (size_t k = 0; k < r->world[w].footprints && world_stays(&r->world[w]) && done; k++) {
            const sunder_footprint *f = &r->footprint[r->world[w].footprint + k];
            done = gis_box_pairs_add(&pairs, f->read, w, 0, error) && gis_box_pairs_add(&pairs, f->wrote, w, 1, error);
        }
    if (done) gis_box_pairs_visit(&pairs, mark_if_met, j);
    gis_box_pairs_clear(&pairs);
    return done;
}

/* ---- Separating again -------------------------------------------------------------------------------------------- */

typedef struct world_set {
    size_t *index, n; /* sorted by index */
} world_set;

static int by_size(const void *a, const void *b)
{
    const size_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

static bool is_of_set(const void *user, size_t cell, size_t index)
{
    const world_set *l = user;
    (void)cell;
    return l->n && bsearch(&index, l->index, l->n, sizeof index, by_size);
}

/* Separates all worlds of one set again as one part. The old worlds are marked as gone, and the worlds that are found
 * for their features are added. */
static bool separate_set(joining *j, size_t root, size_t worlds, gis_error *error)
{
    gis_part_result *r = j->r;
    world_set which = {0};
    gis_boxes_list boxes = {0};
    size_t room = 0;
    bool done = true;
    for (size_t w = root; w < worlds && done; w++) {
        gis_part_world *world = &r->world[w];
        if (!j->again[w] || world->gone || gis_set_root(j->parent, w) != root) continue;
        for (size_t k = 0; k < world->footprints && done; k++)
            done = gis_boxes_add(&boxes, r->footprint[world->footprint + k].seen, j->layout->halo, error);
        done = done && (gis_array_reserve(&which.index, &room, which.n + world->rows, sizeof *which.index) ||
                        gis_no_memory(error));
        for (size_t k = 0; k < world->rows && done; k++) which.index[which.n++] = r->row[world->row + k].index;
        world->gone = true;
    }
    if (done && which.n) qsort(which.index, which.n, sizeof *which.index, by_size);
    done = done && gis_part_separate(j->layout, &boxes, is_of_set, &which, j->run++, r, error);
    free(which.index);
    free(boxes.box);
    return done;
}

/* In the first rounds each set is separated by itself. From round APART on, all worlds that were ever separated again
 * are separated together; then no two of them belong to different runs, and each further round either includes more
 * worlds or is the last. */
enum { APART = 12 };

/* Joins all worlds that are or were separated again to one set, if there are any to be separated now. */
static void mark_all_together(joining *j)
{
    size_t first = SIZE_MAX;
    for (size_t w = 0; w < j->r->worlds && first == SIZE_MAX; w++)
        if (j->again[w]) first = w;
    for (size_t w = 0; w < j->r->worlds && first != SIZE_MAX; w++)
        if (world_stays(&j->r->world[w]) && (j->again[w] || j->r->world[w].run >= gis_spool_parts(j->layout->spool)))
            mark_together(j, first, w);
}

/* One round: finds the worlds to be separated again, and separates them. *any is set if there were some. */
static bool settle_round(joining *j, unsigned round, bool *any, gis_error *error)
{
    const size_t n = j->r->worlds;
    bool done = true;
    *any = false;
    j->parent = malloc((n + 1) * sizeof *j->parent);
    j->again = calloc(n + 1, sizeof *j->again);
    if (!j->parent || !j->again) done = gis_no_memory(error);
    for (size_t w = 0; w < n && done; w++) j->parent[w] = w;
    done = done && compare_holdings(j, error) && compare_footprints(j, error);
    for (size_t w = 0; w < n && done; w++)
        if (world_stays(&j->r->world[w]) && !j->r->world[w].complete) j->again[w] = true;
    if (done && round >= APART) mark_all_together(j);
    for (size_t w = 0; w < n && done; w++) {
        if (!j->again[w] || j->r->world[w].gone || gis_set_root(j->parent, w) != w) continue;
        *any = true;
        done = separate_set(j, w, n, error);
    }
    free(j->parent);
    free(j->again);
    return done;
}

bool gis_parts_join(const gis_layout *layout, gis_part_file *file, size_t files, const char *directory, gis_joined *out,
                    gis_error *error)
{
    gis_part_result held = {0};
    gis_border_chunks chunks = {.file = file, .files = files, .runs = gis_spool_parts(layout->spool)};
    joining j = {.layout = layout, .r = &held, .run = gis_spool_parts(layout->spool)};
    bool any = true;
    *out = (gis_joined){0};
    bool done = gis_border_chunks_load(&chunks, &held, error);
    for (unsigned round = 0; any && done; round++)
        done = gis_go_on(error) && settle_round(&j, round, &any, error) &&
               gis_border_chunks_load_new(&chunks, &held, error);
    out->runs = j.run;
    done = done && gis_joined_lists_make(out, &chunks, &held, directory, error) &&
           gis_joined_rows_make(out, &layout->how, error);
    gis_border_chunks_clear(&chunks);
    gis_part_result_clear(&held);
    return done;
}
