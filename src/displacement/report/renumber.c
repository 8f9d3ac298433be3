/* Rewrites a report on the layer in its internal order for the numbers that the caller gave its features. Parts of
 * barriers become the barriers that they belong to. */
#include "displacement/report/report.h"

#include "base/invariant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A conflict and its proof, which are sorted together. */
typedef struct listed {
    sunder_conflict conflict;
    sunder_proof *proof;
} listed;

static int by_pair(const void *x, const void *y)
{
    const sunder_conflict *p = &((const listed *)x)->conflict, *q = &((const listed *)y)->conflict;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

static int by_number(const void *x, const void *y)
{
    const size_t a = *(const size_t *)x, b = *(const size_t *)y;
    return a < b ? -1 : a > b;
}

/* Exchanges the two features of a conflict. The link of two features that do not overlap leads from the first to the
 * second. If they overlap, it is a translation of the second feature, and its opposite is one of the first. */
static void turn_conflict(sunder_conflict *c)
{
    const size_t a = c->a;
    c->a = c->b;
    c->b = a;
    for (int k = 0; k < 2; k++) {
        const double from = c->from[k], to = c->to[k];
        c->from[k] = c->depth > 0 ? from : to;
        c->to[k] = c->depth > 0 ? from - (to - from) : from;
    }
}

void sunder_i_proof_number(sunder_proof *proof, const uint32_t *number)
{
    sunder_proof_node *node = (sunder_proof_node *)proof->node; /* the report owns it */
    for (size_t k = 0; k < proof->nodes; k++) {
        if (node[k].ways == 0) continue;
        node[k].a = number[node[k].a];
        node[k].b = number[node[k].b];
        if (node[k].chord) node[k].c = number[node[k].c];
    }
}

static sunder_status number_conflicts(sunder_report *report, const uint32_t *number, sunder_error *err)
{
    const size_t n = report->conflicts;
    listed *list = sunder_i_alloc(n, sizeof *list);
    if (!list) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n; k++) {
        list[k] = (listed){report->conflict[k], report->proof ? report->proof[k] : NULL};
        sunder_conflict *c = &list[k].conflict;
        size_t *blocker = c->n_blocked_by ? report->blocker + (c->blocked_by - report->blocker) : NULL;
        c->a = number[c->a];
        c->b = number[c->b];
        if (c->a > c->b) turn_conflict(c);
        for (size_t i = 0; i < c->n_blocked_by; i++) blocker[i] = number[blocker[i]];
        if (c->need_gone != SIZE_MAX) c->need_gone = number[c->need_gone];
        if (c->n_blocked_by) qsort(blocker, c->n_blocked_by, sizeof *blocker, by_number);
        if (list[k].proof) sunder_i_proof_number(list[k].proof, number);
    }
    if (n) qsort(list, n, sizeof *list, by_pair);
    for (size_t k = 0; k < n; k++) {
        SUNDER_I_ASSERT(list[k].conflict.a < list[k].conflict.b && (k == 0 || by_pair(&list[k - 1], &list[k]) < 0));
        report->conflict[k] = list[k].conflict;
        if (report->proof) report->proof[k] = list[k].proof;
    }
    sunder_i_free(list);
    return SUNDER_OK;
}

static void number_tree(sunder_bound_tree *tree, const uint32_t *number)
{
    sunder_bound_body *body = (sunder_bound_body *)tree->body; /* the report owns them */
    sunder_bound_piece *piece = (sunder_bound_piece *)tree->piece;
    for (size_t k = 0; k < tree->bodies; k++) body[k].thing = number[body[k].thing];
    for (size_t k = 0; k < tree->pieces; k++) {
        piece[k].a = number[piece[k].a];
        piece[k].b = number[piece[k].b];
    }
}

static bool is_same_pair(const sunder_push *p, const sunder_push *q) { return p->a == q->a && p->b == q->b; }

/* Orders pushes by pairs. Pushes of one pair are ordered by their values, so that sums do not depend on the order in
 * which they were found. */
static int by_push(const void *x, const void *y)
{
    const sunder_push *p = x, *q = y;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    if (p->b != q->b) return p->b < q->b ? -1 : 1;
    if (p->force != q->force) return p->force < q->force ? -1 : 1;
    if (p->n[0] != q->n[0]) return p->n[0] < q->n[0] ? -1 : 1;
    return p->n[1] < q->n[1] ? -1 : p->n[1] > q->n[1];
}

/* Renumbers the pushes so that a < b, sorts them, and replaces the pushes of one pair by a single one with the sum of
 * their forces. */
static void number_pushes(sunder_report *report, const uint32_t *number)
{
    sunder_push *push = report->push;
    size_t n = 0;
    for (size_t k = 0; k < report->pushes; k++) {
        const size_t a = number[push[k].a], b = number[push[k].b];
        push[k].a = a < b ? a : b;
        push[k].b = a < b ? b : a;
        for (int c = 0; a > b && c < 2; c++) push[k].n[c] = -push[k].n[c];
    }
    if (report->pushes) qsort(push, report->pushes, sizeof *push, by_push);
    for (size_t k = 0, end; k < report->pushes; k = end) {
        double sum[2] = {0, 0};
        for (end = k; end < report->pushes && is_same_pair(&push[k], &push[end]); end++)
            for (int c = 0; c < 2; c++) sum[c] += push[end].force * push[end].n[c];
        const double force = hypot(sum[0], sum[1]);
        if (!(force > 0)) continue;
        push[n++] = (sunder_push){push[k].a, push[k].b, force, {sum[0] / force, sum[1] / force}};
    }
    report->pushes = n;
}

/* Numbers blocks by their first members. */
static sunder_status number_blocks(int64_t *block, size_t n, sunder_error *err)
{
    int64_t *to = sunder_i_alloc(n, sizeof *to);
    if (!to) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n; k++) to[k] = -1;
    for (size_t f = 0; f < n; f++) {
        if (block[f] < 0) continue;
        if (to[block[f]] < 0) to[block[f]] = (int64_t)f;
        block[f] = to[block[f]];
    }
    sunder_i_free(to);
    return SUNDER_OK;
}

/* Sets max_feature; if several moves are the longest, it is the first feature with such a move. */
static void find_longest(sunder_report *report)
{
    const double most = report->summary.max;
    for (size_t f = report->n; f-- > 0 && most > 0;)
        if (hypot(report->move[2 * f], report->move[2 * f + 1]) == most) report->summary.max_feature = f;
}

/* Reorders n values of `size` bytes, one for each feature, by the features' original numbers: value k is moved to index
 * number[k]. `array` points to the pointer to the values; a new array replaces the old one, which is freed. Returns
 * false if memory is out. */
static bool number_values(void *array, size_t n, size_t size, const uint32_t *number)
{
    unsigned char *old, *fresh = sunder_i_alloc(n, size);
    if (!fresh) return false;
    memcpy(&old, array, sizeof old);
    for (size_t k = 0; k < n; k++) memcpy(fresh + number[k] * size, old + k * size, size);
    memcpy(array, &fresh, sizeof fresh);
    sunder_i_free(old);
    return true;
}

sunder_status sunder_i_report_renumber(sunder_report *report, const uint32_t *number, sunder_error *err)
{
    const size_t n = report->n;
    const bool ok = number_values(&report->move, n, 2 * sizeof *report->move, number) &&
                    number_values(&report->status, n, sizeof *report->status, number) &&
                    number_values(&report->block, n, sizeof *report->block, number);
    sunder_status status = ok ? number_blocks(report->block, n, err) : sunder_i_failure_cause(err);
    if (!status) status = number_conflicts(report, number, err);
    for (size_t k = 0; !status && k < report->bound_pairs; k++) {
        sunder_bound_pair *p = &report->bound_pair[k];
        const size_t a = number[p->a], b = number[p->b];
        p->a = a < b ? a : b;
        p->b = a < b ? b : a;
    }
    for (size_t k = 0; !status && k < report->bound_trees; k++) number_tree(&report->bound_tree[k], number);
    if (!status) number_pushes(report, number);
    if (!status) status = sunder_i_report_number_rows(report, number, err);
    if (!status) find_longest(report);
    return status;
}
