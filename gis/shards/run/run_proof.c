/* run_proof.c: writes the file of --proof for a layer that was separated in parts; its lines are in sorted order on
 * disk. */
#include "shards/run/run_proof.h"
#include "layer/proof.h"

#include <stdlib.h>

/* Writes the lines of blocks. next[k] is the next member of the same block, by places in joined.block. */
static bool put_blocks(const gis_shard_run *p, gis_json *json, FILE *to, gis_error *error)
{
    const gis_joined *j = &p->joined;
    const size_t n = j->blocks;
    size_t *next = malloc((n + 1) * sizeof *next), *last = malloc((n + 1) * sizeof *last);
    bool done = (next && last) || gis_no_memory(error);
    for (size_t k = 0; k < n && done; k++) {
        const size_t first = (size_t)(gis_joined_block(j, j->block[k].b) - j->block);
        next[k] = n;
        if (first != k) next[last[first]] = k;
        last[first] = k;
    }
    for (size_t k = 0; k < n && done; k++) {
        if (j->block[k].a != j->block[k].b) continue;
        gis_proof_block_begins(json);
        for (size_t m = k; m < n; m = next[m])
            gis_json_signed(json, p->facts.source.fids_unique ? (int64_t)p->block_fid[m] : (int64_t)j->block[m].a);
        gis_proof_block_ends(json);
        done = gis_proof_print(json, to, error);
    }
    free(next);
    free(last);
    return done;
}

/* Writes the pairs of neighbours with a hidden end, or those without; *number counts them. */
static bool put_pairs(gis_shard_run *p, bool hidden, size_t *number, gis_json *json, FILE *to, gis_error *error)
{
    gis_sorted_results *pairs = &p->joined.neighbours;
    bool any = true;
    gis_sorted_results_rewind(pairs);
    while (gis_sorted_results_next(pairs, &any, error) && any) {
        const gis_part_neighbours *one = pairs->one.neighbour;
        int64_t name[2];
        if (one->hidden != hidden) continue;
        for (int c = 0; c < 2; c++) name[c] = p->facts.source.fids_unique ? one->fid[c] : (int64_t)one->is.feature[c];
        gis_proof_row_line(json, (*number)++, name, &one->is);
        if (!gis_proof_print(json, to, error)) return false;
    }
    return !any;
}

static bool put_rows(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error)
{
    size_t number = 0;
    return put_pairs(p, false, &number, json, to, error) && put_pairs(p, true, &number, json, to, error);
}

static bool put_conflicts(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error)
{
    gis_sorted_results *conflicts = &p->joined.conflicts;
    bool any = true;
    gis_sorted_results_rewind(conflicts);
    for (size_t k = 0; gis_sorted_results_next(conflicts, &any, error) && any; k++) {
        gis_proof_line(json, "conflict", k, gis_part_line_of(&conflicts->one, &conflicts->one.conflict->line));
        if (!gis_proof_print(json, to, error)) return false;
    }
    return !any;
}

static bool put_trees(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error)
{
    gis_sorted_results *trees = &p->joined.trees;
    bool any = true;
    size_t group = SIZE_MAX;
    uint64_t first = UINT64_MAX;
    gis_sorted_results_rewind(trees);
    while (gis_sorted_results_next(trees, &any, error) && any) {
        group += first != trees->head.first;
        first = trees->head.first;
        gis_proof_line(json, "group", group, gis_part_line_of(&trees->one, &trees->one.tree->line));
        if (!gis_proof_print(json, to, error)) return false;
    }
    return !any;
}

static gis_proof_head head_of(const gis_shard_run *p, const gis_layer_input *input, const sunder_layer_summary *summary)
{
    const gis_joined *j = &p->joined;
    gis_proof_head head = gis_proof_head_of(input, summary);
    head.conflicts = j->conflicts.n;
    head.trees = j->trees.n;
    head.hide = p->request->rules.hide || gis_levels_asked(&p->request->rules);
    head.hidden = j->hidden.n;
    head.enlarge = p->request->rules.enlarge;
    head.larger = p->facts.enlarged;
    head.shapes = j->tolds[GIS_TOLD_SHAPE];
    head.clauses = j->tolds[GIS_TOLD_CLAUSE];
    head.choices = j->tolds[GIS_TOLD_CHOICE];
    head.class = j->hiding.class;
    head.classes = j->hiding.classes;
    return head;
}

bool gis_shard_run_proof(gis_shard_run *parts, const gis_layer_input *input, const sunder_layer_summary *summary,
                         FILE *to, gis_error *error)
{
    gis_json json = {0};
    gis_telling t = {0};
    const gis_proof_head head = head_of(parts, input, summary);
    gis_proof_head_line(&json, &head);
    const bool done = gis_telling_begin(parts, &t, error) && gis_proof_print(&json, to, error) &&
                      put_blocks(parts, &json, to, error) && gis_run_proof_larger(parts, &json, to, error) &&
                      gis_run_proof_hidden(parts, &json, to, error) &&
                      gis_run_proof_told(&t, GIS_TOLD_SHAPE, &json, to, error) && put_rows(parts, &json, to, error) &&
                      put_conflicts(parts, &json, to, error) && put_trees(parts, &json, to, error) &&
                      gis_run_proof_told(&t, GIS_TOLD_CLAUSE, &json, to, error) &&
                      gis_run_proof_told(&t, GIS_TOLD_CHOICE, &json, to, error);
    free(t.first);
    gis_json_clear(&json);
    return done;
}
