/* gather.c: what worlds tell, as lists by features, and as sums. Sums are exact until they are rounded once. */
#include "parts/join.h"
#include "parts/sets.h"

#include "base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Something of one or two features, and its place in a list. */
typedef struct keyed {
    size_t a, b, at;
} keyed;

static int by_key(const void *x, const void *y)
{
    const keyed *p = x, *q = y;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    if (p->b != q->b) return p->b < q->b ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

static bool push(keyed **list, size_t *n, size_t *room, keyed item, gis_error *error)
{
    if (!gis_array_reserve(list, room, *n + 1, sizeof **list)) return gis_no_memory(error);
    (*list)[(*n)++] = item;
    return true;
}

/* Sorted, and of several with the same key, found in several runs, the last. */
static size_t *places_of(keyed *list, size_t *n)
{
    size_t kept = 0, *place = malloc((*n + 1) * sizeof *place);
    if (*n) qsort(list, *n, sizeof *list, by_key);
    for (size_t k = 0; place && k < *n; k++)
        if (k + 1 == *n || list[k].a != list[k + 1].a || list[k].b != list[k + 1].b) place[kept++] = list[k].at;
    *n = kept;
    return place;
}

const gis_part_row *gis_joined_row(const gis_joined *j, size_t feature)
{
    size_t low = 0, high = j->rows;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        const gis_part_row *row = &j->parts->row[j->row[middle]];
        if (row->index == feature) return row;
        if (row->index < feature)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

static bool gather_rows(gis_joined *j, gis_error *error)
{
    keyed *list = NULL;
    size_t n = 0, room = 0;
    bool done = true;
    const gis_part_result *r = j->parts;
    for (size_t w = 0; w < r->worlds && done; w++)
        for (size_t k = 0; k < r->world[w].rows && !r->world[w].gone && done; k++)
            done = push(&list, &n, &room, (keyed){r->row[r->world[w].row + k].index, 0, r->world[w].row + k}, error);
    if (done) j->row = places_of(list, &n);
    j->rows = n;
    free(list);
    return done && (j->row || gis_no_memory(error));
}

static bool gather_pairs(gis_joined *j, bool pushes, gis_error *error)
{
    keyed *list = NULL;
    size_t n = 0, room = 0;
    bool done = true;
    const gis_part_result *r = j->parts;
    for (size_t w = 0; w < r->worlds && done; w++) {
        const gis_part_world *world = &r->world[w];
        if (world->gone || (world->loose && gis_joined_row(j, world->first))) continue;
        const size_t first = pushes ? world->push : world->conflict, count = pushes ? world->pushes : world->conflicts;
        for (size_t k = first; k < first + count && done; k++)
            done =
                push(&list, &n, &room,
                     pushes ? (keyed){r->push[k].a, r->push[k].b, k} : (keyed){r->conflict[k].a, r->conflict[k].b, k},
                     error);
    }
    size_t *place = done ? places_of(list, &n) : NULL;
    free(list);
    if (!place) return done ? gis_no_memory(error) : false;
    if (pushes) {
        j->push = place;
        j->pushes = n;
        return true;
    }
    j->conflict = place;
    j->conflicts = n;
    for (size_t k = 0; k < n; k++)
        j->parts->conflict[place[k]].blocked_by = j->parts->blocker + j->parts->blocked[place[k]];
    return true;
}

static int by_name(const void *a, const void *b)
{
    const gis_part_name *p = a, *q = b;
    return (p->index > q->index) - (p->index < q->index);
}

static bool gather_stills(gis_joined *j, gis_error *error)
{
    keyed *list = NULL;
    size_t n = 0, room = 0;
    bool done = true;
    const gis_part_result *r = j->parts;
    for (size_t k = 0; k < r->stills && done; k++)
        if (!gis_joined_row(j, r->still[k].index))
            done = push(&list, &n, &room, (keyed){r->still[k].index, 0, k}, error);
    size_t *place = done ? places_of(list, &n) : NULL;
    free(list);
    j->still = place ? malloc((n + 1) * sizeof *j->still) : NULL;
    for (size_t k = 0; j->still && k < n; k++) {
        const gis_part_still *s = &r->still[place[k]];
        j->summary.before.inside_blocks += s->inside;
        j->summary.after.inside_blocks += s->inside;
        j->still[j->stills++] = *s;
    }
    free(place);
    return done && (j->still || gis_no_memory(error));
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

const gis_part_link *gis_joined_block(const gis_joined *j, size_t feature)
{
    const gis_part_link key = {feature, 0};
    return j->blocks ? bsearch(&key, j->block, j->blocks, sizeof key, by_feature) : NULL;
}

/* One that is fixed fixes its block, of which no part may know both ends. j->block is complete. */
static bool fix_blocks(gis_joined *j, gis_error *error)
{
    bool *fixed = calloc(j->blocks + 1, sizeof *fixed); /* by the places of blocks' firsts */
    if (!fixed) return gis_no_memory(error);
    for (int again = 0; again < 2; again++)
        for (size_t k = 0, b = 0; k < j->stills; k++) {
            while (b < j->blocks && j->block[b].a < j->still[k].index) b++;
            if (b == j->blocks || j->block[b].a != j->still[k].index) continue;
            bool *own = &fixed[gis_joined_block(j, j->block[b].b) - j->block];
            *own = *own || j->still[k].status == SUNDER_FEATURE_FIXED;
            if (*own && j->still[k].status == SUNDER_FEATURE_UNMOVED) j->still[k].status = SUNDER_FEATURE_FIXED;
        }
    free(fixed);
    return true;
}

/* Whoever is linked is of one block, which is called by its first. */
static bool gather_blocks(gis_joined *j, gis_error *error)
{
    const gis_part_result *r = j->parts;
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
    for (size_t k = 0; k < n && parent && j->block; k++) parent[k] = k;
    for (size_t k = 0; k < r->links && parent && j->block; k++)
        gis_set_join(parent, place_in(index, n, r->link[k].a), place_in(index, n, r->link[k].b));
    for (size_t k = 0; k < n && parent && j->block; k++) {
        const size_t root = gis_set_root(parent, k);
        j->block[j->blocks++] = (gis_part_link){index[k], index[root]};
        j->summary.blocks += root == k;
    }
    const bool done = parent && j->block;
    free(index);
    free(parent);
    return done || gis_no_memory(error);
}

/* ---- Sums -------------------------------------------------------------------------------------------------------- */

static void add_counts(sunder_conflict_counts *to, const sunder_conflict_counts *from)
{
    to->overlap += from->overlap;
    to->too_close += from->too_close;
    to->barrier += from->barrier;
    to->barrier_near += from->barrier_near;
    to->contained += from->contained;
    to->duplicate += from->duplicate;
    to->inside_blocks += from->inside_blocks;
}

static void sum_worlds(gis_joined *j)
{
    sunder_total bound = {0};
    const gis_part_result *r = j->parts;
    for (size_t w = 0; w < r->worlds; w++) {
        const gis_part_world *world = &r->world[w];
        if (world->gone || world->loose) continue;
        add_counts(&j->summary.before, &world->before);
        add_counts(&j->summary.after, &world->after);
        j->summary.thin += world->thin;
        j->summary.clusters += world->clusters;
        j->summary.clusters_optimal += world->clusters_optimal;
        for (size_t k = 0; k < world->bounds; k++) sunder_total_add(&bound, r->bound[world->bound + k]);
    }
    j->summary.lower_bound = sunder_total_below(&bound);
    j->summary.verified = !r->unverified;
}

static void sum_rows(gis_joined *j)
{
    sunder_total total = {0}, cost = {0};
    sunder_layer_summary *s = &j->summary;
    s->max_feature = SIZE_MAX;
    for (size_t k = 0; k < j->rows; k++) {
        const gis_part_row *row = &j->parts->row[j->row[k]];
        const double *t = row->move, length = hypot(t[0], t[1]);
        s->blocked += row->status == SUNDER_FEATURE_BLOCKED;
        if (t[0] == 0 && t[1] == 0) continue;
        s->moved++;
        s->rounded += row->rounded;
        sunder_total_add(&total, length);
        sunder_total_add(&cost, row->weight * (t[0] * t[0] + t[1] * t[1]));
        if (length > s->max) {
            s->max = length;
            s->max_feature = row->index;
        }
    }
    s->total = sunder_total_nearest(&total);
    s->cost = sunder_total_nearest(&cost);
    if (s->moved) s->mean = s->total / (double)s->moved;
}

bool gis_joined_gather(gis_joined *j, gis_error *error)
{
    if (!gather_rows(j, error) || !gather_pairs(j, false, error) || !gather_pairs(j, true, error) ||
        !gather_stills(j, error) || !gather_blocks(j, error) || !fix_blocks(j, error))
        return false;
    sum_worlds(j);
    sum_rows(j);
    if (j->parts->names) qsort(j->parts->name, j->parts->names, sizeof *j->parts->name, by_name);
    return true;
}

void gis_joined_clear(gis_joined *j)
{
    free(j->row);
    free(j->conflict);
    free(j->push);
    free(j->block);
    free(j->still);
    *j = (gis_joined){0};
}
