/* The program `sunder` with another command `separate`, which writes clusters of its layer into a corpus and ends
 * there.
 *
 *   SUNDER_CORPUS=FILE SUNDER_CORPUS_NAME=krems SUNDER_CORPUS_ITEMS=20 sunder_ablation separate ...
 *
 * A cluster is a connected set of conflicts in the input layer, blocks included: so the corpus does not depend on how a
 * layer is separated. Everything near is written with it, since the bodies of a cluster run into others. Clusters are
 * selected by size, more of the large ones, without random numbers.
 *
 * Without SUNDER_CORPUS it is the program, with constants and stages as set by SUNDER_TUNING (tuning.h). */
#include "corpus.h"
#include "tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "displacement/layer/layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int sunder_main(int argc, char **argv); /* main() of gis/main.c, which is compiled under this name */

/* What gis/commands/separate.c, compiled for this program, calls in place of sunder_layer_separate(). */
sunder_status ablation_layer_separate(const sunder_layer *layer, const sunder_layer_options *options,
                                      sunder_report **out, sunder_error *err);

/* Larger neighbourhoods are left out, so that all items together run in seconds. */
#define MOST_FEATURES 120
#define MOST_VERTICES 3000

static void give_up(const char *what)
{
    fprintf(stderr, "write_corpus: %s\n", what);
    exit(1);
}

static void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n ? n : 1, size);
    if (!memory) give_up("out of memory");
    return memory;
}

/* ---- Clusters ---------------------------------------------------------------------------------------------------- */

typedef struct cluster {
    uint32_t root;
    size_t features;
} cluster;

static bool is_there(const sunder_layer *layer, size_t f)
{
    const sunder_feature feature = sunder_i_given_feature(layer, f);
    return sunder_i_is_present(&feature);
}

/* The connected sets of features, by conflicts and blocks; *in_conflict: those that have a conflict. */
static uint32_t *find_sets(const sunder_layer *layer, const sunder_report *report, bool *in_conflict)
{
    uint32_t *parent = allocate(layer->n, sizeof *parent);
    size_t conflicts;
    const sunder_conflict *c = sunder_report_conflicts(report, &conflicts);
    sunder_i_union_init(parent, layer->n);
    for (size_t f = 0; f < layer->n; f++) {
        const int64_t block = sunder_report_block(report, f);
        if (block >= 0) sunder_i_union_join(parent, (uint32_t)f, (uint32_t)block);
    }
    for (size_t k = 0; k < conflicts; k++) {
        in_conflict[c[k].a] = true;
        if (c[k].b < layer->n) sunder_i_union_join(parent, (uint32_t)c[k].a, (uint32_t)c[k].b);
    }
    return parent;
}

/* Larger clusters first; of equal ones the one whose first feature comes first. */
static int compare(const void *p, const void *q)
{
    const cluster *a = p, *b = q;
    if (a->features != b->features) return a->features < b->features ? 1 : -1;
    return (a->root > b->root) - (a->root < b->root);
}

static cluster *find_clusters(const sunder_layer *layer, uint32_t *parent, const bool *in_conflict, size_t *n)
{
    cluster *found = allocate(layer->n, sizeof *found);
    bool *asked = allocate(layer->n, sizeof *asked);
    size_t *size = allocate(layer->n, sizeof *size);
    for (size_t f = 0; f < layer->n; f++) {
        const uint32_t root = sunder_i_union_find(parent, (uint32_t)f);
        size[root] += is_there(layer, f);
        asked[root] = asked[root] || in_conflict[f];
    }
    *n = 0;
    for (uint32_t f = 0; f < layer->n; f++)
        if (asked[f]) found[(*n)++] = (cluster){f, size[f]};
    qsort(found, *n, sizeof *found, compare);
    free(size);
    free(asked);
    return found;
}

/* ---- Items ------------------------------------------------------------------------------------------------------- */

typedef struct box {
    double min[2], max[2];
} box;

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static void include(box *b, const double *xy, size_t points)
{
    for (size_t k = 0; k < 2 * points; k++) {
        b->min[k % 2] = sunder_i_min(b->min[k % 2], xy[k]);
        b->max[k % 2] = sunder_i_max(b->max[k % 2], xy[k]);
    }
}

static box box_of(const sunder_shape *shape)
{
    box b = nothing;
    double sides[4];
    if (!shape || sunder_shape_is_empty(shape)) return b;
    sunder_shape_box(shape, sides);
    include(&b, sides, 2);
    return b;
}

static box grown(box b, double by)
{
    for (int k = 0; k < 2; k++) {
        b.min[k] -= by;
        b.max[k] += by;
    }
    return b;
}

static bool meet(const box *a, const box *b)
{
    return a->min[0] <= b->max[0] && b->min[0] <= a->max[0] && a->min[1] <= b->max[1] && b->min[1] <= a->max[1];
}

static double extent(const box *b) { return sunder_i_max(b->max[0] - b->min[0], b->max[1] - b->min[1]); }

/* The part of a barrier near a place: its shape, and the lines that come near. False if there is no such part. */
static bool barrier_near(const sunder_barrier *barrier, const box *place, sunder_barrier *out)
{
    const sunder_obstacle *g = &barrier->geometry;
    const box shape = box_of(g->shape);
    size_t *end = allocate(g->lines, sizeof *end), lines = 0, points = 0;
    double *xy = allocate(g->lines ? 2 * g->line_end[g->lines - 1] : 0, sizeof *xy);
    for (size_t k = 0, first = 0; k < g->lines; first = g->line_end[k++]) {
        box line = nothing;
        include(&line, g->xy + 2 * first, g->line_end[k] - first);
        if (!meet(&line, place)) continue;
        memcpy(xy + 2 * points, g->xy + 2 * first, 2 * (g->line_end[k] - first) * sizeof *xy);
        points += g->line_end[k] - first;
        end[lines++] = points;
    }
    *out = *barrier;
    out->geometry =
        (sunder_obstacle){.shape = meet(&shape, place) ? g->shape : NULL, .xy = xy, .line_end = end, .lines = lines};
    if (lines || out->geometry.shape) return true;
    free(xy);
    free(end);
    return false;
}

/* The distance from a cluster within which others may matter: its bodies may run into them, and these move
 * themselves. */
static double reach_of(const sunder_layer *layer, uint32_t *parent, const cluster *c, double gap, box *place)
{
    double sum = 0, limit = 0;
    for (size_t f = 0; f < layer->n; f++) {
        if (sunder_i_union_find(parent, (uint32_t)f) != c->root || !is_there(layer, f)) continue;
        const box b = box_of(layer->shape[f]);
        include(place, b.min, 1);
        include(place, b.max, 1);
        sum += extent(&b);
        if (isfinite(sunder_i_demands(layer, f)->max_shift))
            limit = sunder_i_max(limit, sunder_i_demands(layer, f)->max_shift);
    }
    return 2 * gap + 2 * limit + 2 * sum / (double)c->features;
}

/* The features near a place. False if there are too many. */
static bool add_features(const sunder_layer *layer, const box *place, corpus_item *item, double *side_reach)
{
    size_t vertices = 0;
    for (size_t f = 0; f < layer->n; f++) {
        const box b = box_of(layer->shape[f]);
        if (!is_there(layer, f) || !meet(&b, place)) continue;
        vertices += sunder_shape_vertices(layer->shape[f]);
        if (item->features == MOST_FEATURES || vertices > MOST_VERTICES) return false;
        const double sides[4] = {b.min[0], b.min[1], b.max[0], b.max[1]};
        *side_reach = sunder_i_max(*side_reach, sunder_side_reach(sides));
        double *at = item->side_anchor + 2 * item->features;
        at[0] = layer->side_anchor ? layer->side_anchor[2 * f] : NAN;
        at[1] = layer->side_anchor ? layer->side_anchor[2 * f + 1] : NAN;
        item->feature[item->features++] = sunder_i_given_feature(layer, f);
    }
    return true;
}

static void add_barriers(const sunder_layer *layer, const box *place, double reach, corpus_item *item)
{
    const double further = isfinite(item->options.barrier_reach) ? item->options.barrier_reach : 0;
    item->barrier = allocate(layer->barriers, sizeof *item->barrier);
    for (size_t k = 0; k < layer->barriers; k++) {
        const sunder_barrier *b = &layer->barrier[k];
        const double gap = b->gap < 0 ? item->options.gap : b->gap;
        const box about = grown(*place, reach + further + gap + b->width / 2);
        if (barrier_near(b, &about, &item->barrier[item->barriers])) item->barriers++;
    }
}

/* False if it is too large. */
static bool write_item(FILE *to, const sunder_layer *layer, const sunder_layer_options *options, uint32_t *parent,
                       const cluster *c, const char *name)
{
    corpus_item item = {.options = *options};
    box place = nothing;
    double side_reach = 0;
    const double reach = reach_of(layer, parent, c, options->gap, &place);
    const box about = grown(place, reach);
    item.feature = allocate(MOST_FEATURES, sizeof *item.feature);
    item.side_anchor = allocate(2 * MOST_FEATURES, sizeof *item.side_anchor);
    snprintf(item.name, sizeof item.name, "%s/%u", name, c->root);
    const bool small = add_features(layer, &about, &item, &side_reach);
    if (small) {
        add_barriers(layer, &about, side_reach, &item);
        corpus_write(to, &item);
    }
    for (size_t k = 0; k < item.barriers; k++) {
        free((double *)item.barrier[k].geometry.xy);
        free((size_t *)item.barrier[k].geometry.line_end);
    }
    free(item.barrier);
    free(item.feature);
    free(item.side_anchor);
    return small;
}

/* The k-th of `items`, of n clusters: the rank grows with the square of k. */
static size_t rank(size_t k, size_t items, size_t n)
{
    const double share = items > 1 ? (double)k / (double)(items - 1) : 0;
    return (size_t)((double)(n - 1) * share * share);
}

/* Returns the number of items written. A cluster that is too large is replaced by the next smaller one. */
static size_t write_clusters(FILE *to, const sunder_layer *layer, const sunder_layer_options *options,
                             const sunder_report *report, const char *name, size_t items)
{
    bool *in_conflict = allocate(layer->n, sizeof *in_conflict);
    uint32_t *parent = find_sets(layer, report, in_conflict);
    size_t n, written = 0, next = 0;
    cluster *found = find_clusters(layer, parent, in_conflict, &n);
    for (size_t k = 0; k < items && n; k++) {
        next = rank(k, items, n) > next ? rank(k, items, n) : next;
        while (next < n && !write_item(to, layer, options, parent, &found[next], name)) next++;
        if (next == n) break;
        written++;
        next++;
    }
    free(found);
    free(parent);
    free(in_conflict);
    return written;
}

sunder_status ablation_layer_separate(const sunder_layer *layer, const sunder_layer_options *options,
                                      sunder_report **out, sunder_error *err)
{
    const char *path = getenv("SUNDER_CORPUS"), *name = getenv("SUNDER_CORPUS_NAME"),
               *items = getenv("SUNDER_CORPUS_ITEMS");
    if (!path) return sunder_layer_separate(layer, options, out, err);
    sunder_report *report;
    if (sunder_layer_check(layer, options, &report, err)) give_up(err->message);
    FILE *to = fopen(path, "a");
    if (!to) give_up(path);
    const size_t n =
        write_clusters(to, layer, options, report, name ? name : "cluster", items ? strtoul(items, NULL, 10) : 20);
    sunder_report_free(report);
    if (fclose(to)) give_up(path);
    printf("%s: %zu clusters\n", name ? name : path, n);
    exit(0);
}

int main(int argc, char **argv)
{
    const char *wrong = tuning_change(getenv("SUNDER_TUNING"));
    if (wrong) give_up(wrong);
    return sunder_main(argc, argv);
}
