/* proof_choices.c: see proof_lines.h. Components of clauses do not depend on what else the layer has, and neither does
 * the order in which the clauses of one are found; so parts of the layer list them alike. */
#include "layer/proof_lines.h"

#include "base/disjoint_sets.h"

#include <stdlib.h>

static int by_place(const void *a, const void *b)
{
    const gis_proof_place *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return (p->tree > q->tree) - (p->tree < q->tree);
}

/* Sorts the places by component, and numbers those of each. */
static void order_places(gis_proof_place *place, size_t n)
{
    if (n) qsort(place, n, sizeof *place, by_place);
    for (size_t k = 0; k < n; k++)
        place[k].among = k && place[k].first == place[k - 1].first ? place[k - 1].among + 1 : 0;
}

static bool make_room(const gis_proof_lines *lines, size_t clauses, gis_proof_choices *out, gis_error *error)
{
    const size_t n = lines->things.n, trees = sunder_report_hiding_trees(lines->report)->trees;
    out->root = malloc((n + 1) * sizeof *out->root);
    out->told = calloc(n + 1, sizeof *out->told);
    out->clause = malloc((clauses + 1) * sizeof *out->clause);
    out->tree = malloc((trees + 1) * sizeof *out->tree);
    out->number = calloc(clauses + 1, sizeof *out->number);
    if (!out->root || !out->told || !out->clause || !out->tree || !out->number) return gis_no_memory(error);
    for (size_t i = 0; i < n; i++) out->root[i] = i;
    return true;
}

/* Marks all features of each block that has a feature named by a clause. */
static void mark_told(const gis_proof_lines *lines, const sunder_clause *clause, size_t n, bool *told)
{
    const size_t features = lines->things.n;
    for (size_t k = 0; k < n; k++)
        for (size_t t = 0; t < clause[k].things && clause[k].thing[t] < features; t++)
            told[gis_proof_block(lines, clause[k].thing[t])] = true;
    for (size_t i = 0; i < features; i++) told[i] = told[gis_proof_block(lines, i)];
}

/* The least feature of the clause's component; of a clause without members, the first feature of its conflict. */
static size_t root_of(const gis_proof_choices *choices, const sunder_clause *clause)
{
    return choices->root[clause->members ? clause->member[0] : clause->a];
}

bool gis_proof_choices_make(const gis_proof_lines *lines, gis_proof_choices *out, gis_error *error)
{
    size_t n;
    const sunder_clause *clause = sunder_report_clauses(lines->report, &n);
    const sunder_hiding_trees *trees = sunder_report_hiding_trees(lines->report);
    *out = (gis_proof_choices){0};
    if (!make_room(lines, n, out, error)) return false;
    for (size_t k = 0; k < n; k++)
        for (size_t m = 1; m < clause[k].members; m++)
            gis_set_join(out->root, clause[k].member[0], clause[k].member[m]);
    for (size_t i = 0; i < lines->things.n; i++) out->root[i] = gis_set_root(out->root, i);
    for (size_t k = 0; k < n; k++)
        if (clause[k].proved) out->clause[out->clauses++] = (gis_proof_place){root_of(out, &clause[k]), 0, k};
    for (size_t k = 0; k < trees->trees; k++)
        out->tree[out->trees++] = (gis_proof_place){out->root[trees->tree[k].feature], 0, k};
    order_places(out->clause, out->clauses);
    order_places(out->tree, out->trees);
    for (size_t k = 0; k < out->clauses; k++) out->number[out->clause[k].tree] = out->clause[k].among;
    mark_told(lines, clause, n, out->told);
    return true;
}

void gis_proof_choices_clear(gis_proof_choices *choices)
{
    free(choices->root);
    free(choices->told);
    free(choices->clause);
    free(choices->tree);
    free(choices->number);
    *choices = (gis_proof_choices){0};
}
