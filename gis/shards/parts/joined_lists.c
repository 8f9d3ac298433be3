/* joined_lists.c: collects the results of worlds in lists sorted by feature, and in sums. Sums are exact, and are
 * rounded once. */
#include "base/disjoint_sets.h"
#include "shards/parts/border_chunks.h"
#include "shards/parts/join.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/resources.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct gathering {
    gis_joined *out;
    gis_part_result one;   /* a result with a single item */
    gis_part_result links; /* the links of all worlds */
    gis_part_file *file;   /* the files of all shards */
    size_t files;
    sunder_total proved, by_pairs, total, cost, shortfall, cost_shortfall, cost_alone;
    size_t block;     /* the place in out->block that was reached, while rows are visited in order */
    uint64_t last[2]; /* keys of the last item that was kept */
    bool any, more;   /* any: an item was kept; more: `rows` has a current row, while conflicts are visited */
} gathering;

/* ---- Items of a result, one by one ------------------------------------------------------------------------------- */

/* Second keys: if a feature has both a row and a still, the row comes first and is kept. */
enum { ROW, STILL };

static bool put_row(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    gis_part_result_empty(&g->one);
    return gis_part_copy_row(&g->one, r, k, error) &&
           gis_sorted_results_add(&g->out->rows, r->row[k].index, ROW, &g->one, error);
}

static bool put_still(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    gis_part_result_empty(&g->one);
    return gis_part_copy_still(&g->one, r, k, error) &&
           gis_sorted_results_add(&g->out->rows, r->still[k].index, STILL, &g->one, error);
}

static bool put_conflict(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    const sunder_conflict *c = &r->conflict[k].is;
    gis_part_result_empty(&g->one);
    return gis_part_copy_conflict(&g->one, r, k, error) &&
           gis_part_file_fetch(g->file, g->files, &g->one, &g->one.conflict->line, error) &&
           gis_sorted_results_add(&g->out->conflicts, c->a, c->b, &g->one, error);
}

static bool put_push(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    const sunder_push *p = &r->push[k].is;
    gis_part_result_empty(&g->one);
    return gis_part_copy_push(&g->one, r, k, error) &&
           gis_sorted_results_add(&g->out->pushes, p->a, p->b, &g->one, error);
}

static bool put_tree(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    gis_part_result_empty(&g->one);
    return gis_part_copy_tree(&g->one, r, k, error) &&
           gis_part_file_fetch(g->file, g->files, &g->one, &g->one.tree->line, error) &&
           gis_sorted_results_add(&g->out->trees, r->tree[k].first, r->tree[k].among, &g->one, error);
}

static bool put_hidden(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    gis_part_result_empty(&g->one);
    return gis_part_copy_hidden(&g->one, r, k, error) &&
           gis_sorted_results_add(&g->out->hidden, r->hidden[k].index, 0, &g->one, error);
}

static bool put_told(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    const gis_part_told *told = &r->told[k];
    gis_part_result_empty(&g->one);
    return gis_part_copy_told(&g->one, r, k, error) &&
           gis_part_file_fetch(g->file, g->files, &g->one, &g->one.told->line, error) &&
           gis_sorted_results_add(&g->out->told, gis_told_key(told->kind, told->first), told->among, &g->one, error);
}

static bool put_neighbours(gathering *g, const gis_part_result *r, size_t k, gis_error *error)
{
    const size_t *feature = r->neighbour[k].is.feature;
    gis_part_result_empty(&g->one);
    return gis_part_copy_neighbours(&g->one, r, k, error) &&
           gis_sorted_results_add(&g->out->neighbours, feature[0], feature[1], &g->one, error);
}

static void add_counts(sunder_conflict_counts *to, const sunder_conflict_counts *from)
{
    to->overlap += from->overlap;
    to->too_close += from->too_close;
    to->barrier += from->barrier;
    to->barrier_drawn += from->barrier_drawn;
    to->barrier_near += from->barrier_near;
    to->contained += from->contained;
    to->duplicate += from->duplicate;
    to->inside_blocks += from->inside_blocks;
}

/* ---- Sums of what is hidden -------------------------------------------------------------------------------------- */

/* Adds what a component hides of a class; classes are sorted, and few. */
static bool add_class(gis_joined *j, const sunder_hiding_class *from, gis_error *error)
{
    gis_hiding *to = &j->hiding;
    size_t at = 0;
    while (at < to->classes && j->class[at].hierarchy < from->hierarchy) at++;
    if (at == to->classes || j->class[at].hierarchy != from->hierarchy) {
        if (!gis_array_reserve(&j->class, &j->class_room, to->classes + 1, sizeof *j->class))
            return gis_no_memory(error);
        memmove(j->class + at + 1, j->class + at, (to->classes++ - at) * sizeof *j->class);
        j->class[at] = (sunder_hiding_class){.hierarchy = from->hierarchy};
        to->class = j->class;
    }
    j->class[at].hidden += from->hidden;
    j->class[at].weight += from->weight;
    j->class[at].least += from->least;
    to->sum.hidden += from->hidden;
    to->sum.weight += from->weight;
    to->sum.least += from->least;
    return true;
}

static bool put_world(gathering *g, const gis_part_result *r, const gis_part_world *w, gis_error *error)
{
    sunder_layer_summary *s = &g->out->summary;
    bool done = true;
    if (w->gone) return true;
    for (size_t k = 0; k < w->rows && done; k++) done = put_row(g, r, w->row + k, error);
    for (size_t k = 0; k < w->conflicts && done; k++) done = put_conflict(g, r, w->conflict + k, error);
    for (size_t k = 0; k < w->pushes && done; k++) done = put_push(g, r, w->push + k, error);
    for (size_t k = 0; k < w->trees && done; k++) done = put_tree(g, r, w->tree + k, error);
    for (size_t k = 0; k < w->hiddens && done; k++) done = put_hidden(g, r, w->hidden + k, error);
    for (size_t k = 0; k < w->tolds && done; k++) done = put_told(g, r, w->told + k, error);
    if (w->loose) return done;
    add_counts(&s->before, &w->before);
    add_counts(&s->after, &w->after);
    s->thin += w->thin;
    s->clusters += w->clusters;
    s->clusters_optimal += w->clusters_optimal;
    for (size_t k = 0; k < w->components; k++) sunder_hiding_add(&g->out->hiding.sum, &r->component[w->component + k]);
    for (size_t k = 0; k < w->classes && done; k++) done = add_class(g->out, &r->class[w->class + k], error);
    for (size_t k = w->bound; k < w->bound + w->bounds; k++) {
        sunder_total_add(&g->proved, r->bound[k].proved);
        sunder_total_add(&g->by_pairs, r->bound[k].by_pairs);
        s->short_pairs += r->bound[k].short_pairs;
        sunder_total_add(&g->shortfall, r->bound[k].shortfall);
        sunder_total_add(&g->cost_shortfall, r->bound[k].cost_shortfall);
        sunder_total_add(&g->cost_alone, r->bound[k].cost_alone);
    }
    return done;
}

static bool put_result(gathering *g, const gis_part_result *r, gis_error *error)
{
    bool done = true;
    for (size_t w = 0; w < r->worlds && done; w++) done = put_world(g, r, &r->world[w], error);
    for (size_t k = 0; k < r->stills && done; k++) done = put_still(g, r, k, error);
    for (size_t k = 0; k < r->links && done; k++) done = gis_part_copy_link(&g->links, r, k, error);
    for (size_t k = 0; k < r->neighbours && done; k++) done = put_neighbours(g, r, k, error);
    g->out->summary.verified = g->out->summary.verified && !r->unverified;
    return done && gis_go_on(error);
}

static bool put_everything(gathering *g, const gis_border_chunks *h, gis_part_result *held, gis_error *error)
{
    gis_part_result chunk = {0};
    bool done = true;
    for (size_t k = 0; k < h->chunks && done; k++)
        if (!h->chunk[k].held)
            done =
                gis_part_file_read(h->chunk[k].file, h->chunk[k].chunk, &chunk, error) && put_result(g, &chunk, error);
    gis_part_result_clear(&chunk);
    done = done && put_result(g, held, error);
    gis_part_result_clear(held); /* sorting needs the memory */
    gis_memory_back();
    return done;
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

static int by_number(const void *a, const void *b)
{
    const size_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

static size_t place_in(const size_t *sorted, size_t n, size_t index)
{
    return (size_t)((const size_t *)bsearch(&index, sorted, n, sizeof index, by_number) - sorted);
}

static int by_feature(const void *a, const void *b)
{
    const gis_part_link *p = a, *q = b;
    return (p->a > q->a) - (p->a < q->a);
}

const gis_part_link *gis_joined_block(const gis_joined *joined, size_t feature)
{
    const gis_part_link key = {feature, 0};
    return joined->blocks ? bsearch(&key, joined->block, joined->blocks, sizeof key, by_feature) : NULL;
}

/* Joins linked features to blocks; each block is identified by its first feature. */
static bool gather_blocks(gis_joined *j, const gis_part_result *r, gis_error *error)
{
    size_t n = 0, *index = malloc((2 * r->links + 1) * sizeof *index), *parent;
    if (!index) return gis_no_memory(error);
    for (size_t k = 0; k < r->links; k++) {
        index[n++] = r->link[k].a;
        index[n++] = r->link[k].b;
    }
    if (n) qsort(index, n, sizeof *index, by_number);
    size_t out = 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || index[k] != index[k - 1]) index[out++] = index[k];
    n = out;
    parent = malloc((n + 1) * sizeof *parent);
    j->block = malloc((n + 1) * sizeof *j->block);
    j->fixed = calloc(n + 1, sizeof *j->fixed);
    for (size_t k = 0; k < n && parent && j->block; k++) parent[k] = k;
    for (size_t k = 0; k < r->links && parent && j->block; k++)
        gis_set_join(parent, place_in(index, n, r->link[k].a), place_in(index, n, r->link[k].b));
    for (size_t k = 0; k < n && parent && j->block; k++) {
        const size_t root = gis_set_root(parent, k);
        j->block[j->blocks++] = (gis_part_link){index[k], index[root]};
        j->summary.blocks += root == k;
    }
    const bool done = parent && j->block && j->fixed;
    free(index);
    free(parent);
    return done || gis_no_memory(error);
}

/* ---- In sorted order --------------------------------------------------------------------------------------------- */

/* Was the last kept item one with the same keys? Stores the keys. */
static bool is_again(gathering *g, uint64_t first, uint64_t second)
{
    const bool again = g->any && g->last[0] == first && g->last[1] == second;
    g->last[0] = first;
    g->last[1] = second;
    g->any = true;
    return again;
}

static void sum_row(gathering *g, const gis_part_row *row)
{
    sunder_layer_summary *s = &g->out->summary;
    const double *t = row->move, length = hypot(t[0], t[1]);
    s->blocked += row->status == SUNDER_FEATURE_BLOCKED;
    g->out->hiding.on_rung[row->kind] += row->rung > 0;
    if (t[0] == 0 && t[1] == 0) return;
    s->moved += row->status == SUNDER_FEATURE_MOVED;
    s->blocked_moved += row->status == SUNDER_FEATURE_BLOCKED;
    s->rounded += row->rounded;
    sunder_total_add(&g->total, length);
    sunder_total_add(&g->cost, row->weight * (t[0] * t[0] + t[1] * t[1]));
    if (!(length > s->max)) return;
    s->max = length;
    s->max_feature = row->index;
    g->out->longest_fid = row->fid;
}

/* Counts conflicts inside the block, and marks the block as fixed if the feature is. A part may have known only some
 * features of the block. */
static void sum_still(gathering *g, const gis_part_still *still)
{
    gis_joined *j = g->out;
    j->summary.before.inside_blocks += still->inside;
    j->summary.after.inside_blocks += still->inside;
    while (g->block < j->blocks && j->block[g->block].a < still->index) g->block++;
    if (still->status == SUNDER_FEATURE_FIXED && g->block < j->blocks && j->block[g->block].a == still->index)
        j->fixed[gis_joined_block(j, j->block[g->block].b) - j->block] = true;
}

static bool keep_feature(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep,
                         gis_error *error)
{
    gathering *g = user;
    (void)error;
    *keep = !is_again(g, head->first, 0);
    if (*keep && one->rows) sum_row(g, one->row);
    if (*keep && one->stills) sum_still(g, one->still);
    return true;
}

/* Keeps each push, each tree, and each pair of neighbours once. */
static bool keep_once(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep, gis_error *error)
{
    (void)one;
    (void)error;
    *keep = !is_again(user, head->first, head->second);
    return true;
}

/* Keeps each line about what is hidden or smaller once, and counts them by kind. */
static bool keep_told(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep, gis_error *error)
{
    gathering *g = user;
    if (!keep_once(user, head, one, keep, error)) return false;
    g->out->tolds[one->told->kind] += *keep;
    return true;
}

static bool is_inside_overlap(const sunder_conflict *conflict)
{
    return conflict->inside_block && conflict->kind == SUNDER_CONFLICT_OVERLAP;
}

/* Keeps each conflict once. A loose conflict (inside a block that did not move in its part) is dropped if the feature
 * has a row, since then another part moved the block and reports the conflict. */
static bool keep_conflict(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep,
                          gis_error *error)
{
    gathering *g = user;
    gis_sorted_results *rows = &g->out->rows;
    *keep = false;
    if (one->conflict[0].loose) {
        while (g->more && (rows->head.first < head->first))
            if (!gis_sorted_results_next(rows, &g->more, error)) return false;
        if (g->more && rows->head.first == head->first && rows->one.rows) return true;
    }
    *keep = !is_again(g, head->first, head->second);
    if (!*keep) return true;
    g->out->summary.inside_overlaps += is_inside_overlap(&one->conflict[0].is);
    g->out->summary.tight += one->conflict[0].is.kind == SUNDER_CONFLICT_TIGHT;
    return true;
}

static bool sort_everything(gathering *g, gis_error *error)
{
    gis_joined *j = g->out;
    if (!gis_sorted_results_sort(&j->rows, keep_feature, g, error) ||
        !gis_sorted_results_next(&j->rows, &g->more, error))
        return false;
    g->any = false;
    if (!gis_sorted_results_sort(&j->conflicts, keep_conflict, g, error)) return false;
    g->any = false;
    if (!gis_sorted_results_sort(&j->pushes, keep_once, g, error)) return false;
    g->any = false;
    if (!gis_sorted_results_sort(&j->trees, keep_once, g, error)) return false;
    g->any = false;
    if (!gis_sorted_results_sort(&j->hidden, keep_once, g, error)) return false;
    g->any = false;
    if (!gis_sorted_results_sort(&j->told, keep_told, g, error)) return false;
    g->any = false;
    return gis_sorted_results_sort(&j->neighbours, keep_once, g, error);
}

/* ---- All lists --------------------------------------------------------------------------------------------------- */

static bool begin_lists(gis_joined *j, const char *directory, gis_error *error)
{
    j->longest_fid = -1;
    j->summary.max_feature = SIZE_MAX;
    j->summary.verified = true;
    return gis_sorted_results_begin(&j->rows, directory, "rows", error) &&
           gis_sorted_results_begin(&j->conflicts, directory, "conflicts", error) &&
           gis_sorted_results_begin(&j->pushes, directory, "pushes", error) &&
           gis_sorted_results_begin(&j->trees, directory, "trees", error) &&
           gis_sorted_results_begin(&j->hidden, directory, "hidden", error) &&
           gis_sorted_results_begin(&j->told, directory, "told", error) &&
           gis_sorted_results_begin(&j->neighbours, directory, "neighbours", error);
}

bool gis_joined_lists_make(gis_joined *out, gis_border_chunks *chunks, gis_part_result *held, const char *directory,
                           gis_error *error)
{
    gathering g = {.out = out, .file = chunks->file, .files = chunks->files};
    const bool done = begin_lists(out, directory, error) && put_everything(&g, chunks, held, error) &&
                      gather_blocks(out, &g.links, error) && sort_everything(&g, error);
    gis_part_result_clear(&g.one);
    gis_part_result_clear(&g.links);
    sunder_layer_summary *s = &out->summary;
    s->lower_bound = sunder_total_below(&g.proved);
    s->pair_bound = sunder_total_below(&g.by_pairs);
    s->total = sunder_total_nearest(&g.total);
    s->cost_moves = sunder_total_nearest(&g.cost);
    s->shortfall = sunder_total_nearest(&g.shortfall);
    s->cost_shortfall = sunder_total_nearest(&g.cost_shortfall);
    s->cost_alone = sunder_total_below(&g.cost_alone);
    s->cost = s->cost_moves + s->cost_shortfall; /* and that of rows: sunder_rows_make() */
    const size_t moved = s->moved + s->blocked_moved;
    if (moved) s->mean = s->total / (double)moved;
    return done;
}

sunder_feature_status gis_joined_status(const gis_joined *joined, const gis_part_still *still)
{
    const gis_part_link *own = still->status == SUNDER_FEATURE_UNMOVED ? gis_joined_block(joined, still->index) : NULL;
    return own && joined->fixed[gis_joined_block(joined, own->b) - joined->block] ? SUNDER_FEATURE_FIXED
                                                                                  : still->status;
}

void gis_joined_clear(gis_joined *joined)
{
    gis_sorted_results_clear(&joined->rows);
    gis_sorted_results_clear(&joined->conflicts);
    gis_sorted_results_clear(&joined->pushes);
    gis_sorted_results_clear(&joined->trees);
    gis_sorted_results_clear(&joined->hidden);
    gis_sorted_results_clear(&joined->told);
    gis_sorted_results_clear(&joined->larger);
    free(joined->class);
    gis_sorted_results_clear(&joined->neighbours);
    sunder_row_list_free(&joined->row_list);
    free(joined->row_place);
    free(joined->block);
    free(joined->fixed);
    *joined = (gis_joined){0};
}
