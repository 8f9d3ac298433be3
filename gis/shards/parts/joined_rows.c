/* joined_rows.c: see join.h. The pairs of neighbours that parts found are joined to rows of houses. A pair is the same
 * in each part; the moves of its features are those of the joined result. */
#include "shards/parts/join.h"

#include "base/core_error.h"

#include <stdlib.h>
#include <string.h>

/* The pairs of all parts. */
typedef struct all_pairs {
    sunder_row_pair *pair;
    size_t n;
} all_pairs;

static int by_feature(const void *a, const void *b)
{
    const gis_row_place *p = a, *q = b;
    return (p->index > q->index) - (p->index < q->index);
}

const gis_row_place *gis_joined_row_place(const gis_joined *joined, size_t feature)
{
    const gis_row_place key = {.index = feature};
    return bsearch(&key, joined->row_place, joined->row_places, sizeof key, by_feature);
}

/* Reads the pairs, and lists their features with their anchors before the moves, each once. */
static bool read_pairs(gis_joined *j, all_pairs *all, gis_error *error)
{
    bool any = true;
    size_t n = 0;
    all->pair = malloc((j->neighbours.n + 1) * sizeof *all->pair);
    j->row_place = malloc((2 * j->neighbours.n + 1) * sizeof *j->row_place);
    if (!all->pair || !j->row_place) return gis_no_memory(error);
    while (gis_sorted_results_next(&j->neighbours, &any, error) && any) {
        const gis_part_neighbours *one = j->neighbours.one.neighbour;
        if (one->hidden) continue;
        all->pair[all->n++] = one->is;
        for (int c = 0; c < 2; c++)
            j->row_place[n++] =
                (gis_row_place){one->is.feature[c], one->fid[c], {one->anchor[c][0], one->anchor[c][1]}};
    }
    if (n) qsort(j->row_place, n, sizeof *j->row_place, by_feature);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || by_feature(&j->row_place[k], &j->row_place[k - 1]) != 0)
            j->row_place[j->row_places++] = j->row_place[k];
    return !any;
}

/* Sets move[] to the moves of the features of pairs, which are in the order of the joined rows. */
static bool read_moves(gis_joined *j, double (*move)[2], gis_error *error)
{
    bool any = true;
    size_t k = 0;
    gis_sorted_results_rewind(&j->rows);
    while (k < j->row_places && gis_sorted_results_next(&j->rows, &any, error) && any) {
        while (k < j->row_places && j->row_place[k].index < j->rows.head.first) k++;
        if (k < j->row_places && j->row_place[k].index == j->rows.head.first && j->rows.one.rows)
            memcpy(move[k], j->rows.one.row->move, sizeof move[k]);
    }
    gis_sorted_results_rewind(&j->rows);
    return k == j->row_places || !any;
}

/* Gives the pairs the moves and the blocks of the joined result, and moves the anchors. */
static void apply_moves(gis_joined *j, all_pairs *all, const double (*move)[2])
{
    for (size_t k = 0; k < all->n; k++)
        for (int c = 0; c < 2; c++) {
            const size_t feature = all->pair[k].feature[c];
            const gis_part_link *own = gis_joined_block(j, feature);
            memcpy(all->pair[k].move[c], move[gis_joined_row_place(j, feature) - j->row_place], sizeof *move);
            all->pair[k].block[c] = own ? own->b : feature;
        }
    for (size_t k = 0; k < j->row_places; k++)
        for (int c = 0; c < 2; c++) j->row_place[k].at[c] += move[k][c];
}

bool gis_joined_rows_make(gis_joined *joined, const sunder_layer_options *how, gis_error *error)
{
    sunder_error why;
    all_pairs all = {0};
    if (!how->rows) return true;
    bool done = read_pairs(joined, &all, error);
    double(*move)[2] = calloc(joined->row_places + 1, sizeof *move);
    done = done && (move || gis_no_memory(error)) && read_moves(joined, move, error);
    if (done) apply_moves(joined, &all, (const double(*)[2])move);
    if (done && sunder_rows_make(all.pair, all.n, how, &joined->row_list, &joined->summary, &why) != SUNDER_OK)
        done = gis_core_failed(error, "rows", &why);
    free(move);
    free(all.pair);
    return done;
}
