/* Follows the tree of a proof from its root, and checks what each node requires. */
#include "proof_check.h"

#include "proof_checking.h"
#include "standing.h"

#include <stdlib.h>

/* ---- Requirements ---- */

/* The listed conflict of the two, for which less than the full distance is required; for a crowded pair the full
 * distance is. */
static const sunder_conflict *find_listed(const checking *c, size_t a, size_t b)
{
    if (c->listed[c->conflict].crowded) return NULL;
    for (size_t k = 0; k < c->listed_n; k++)
        if ((c->listed[k].a == a && c->listed[k].b == b) || (c->listed[k].a == b && c->listed[k].b == a))
            return &c->listed[k];
    return NULL;
}

bool proof_find_standing(const proof_feature *a, const proof_feature *b, bool *meet, mpq_t square)
{
    if (b->line) {
        *meet = proof_line_meets(b, a);
        if (*meet) return proof_line_least(square, b, a);
        proof_line_square(square, b, a);
        return true;
    }
    polyset p, q;
    standing was;
    polyset_init(&p), polyset_init(&q);
    polyset_polygon(&p, a->xy, a->corners);
    polyset_polygon(&q, b->xy, b->corners);
    standing_of(&was, &p, &q);
    *meet = was.meet;
    mpq_set(square, was.square);
    standing_clear(&was);
    polyset_free(&p), polyset_free(&q);
    return true;
}

/* May the clearance be required of two listed features, given their state at the start? If they were disjoint or
 * touched, up to their distance. Otherwise by the least translation out of the overlap, which must not be longer. */
static bool stood_so(const proof_feature *a, const proof_feature *b, double clearance)
{
    mpq_t square, was;
    bool meet;
    mpq_inits(square, was, NULL);
    mpq_set_d(square, clearance);
    mpq_mul(square, square, square);
    bool so = proof_find_standing(a, b, &meet, was);
    if (so) so = meet ? clearance <= 0 && mpq_cmp(was, square) <= 0 : clearance <= 0 || mpq_cmp(square, was) <= 0;
    mpq_clears(square, was, NULL);
    return so;
}

/* Is one of the features contained in the other? Only tested for convex ones. */
static bool are_contained(const checking *c, const sunder_proof_node *node)
{
    const proof_feature *a = &c->feature[node->a], *b = &c->feature[node->b];
    return (!b->line && is_convex_part(a->xy, a->corners) && is_part_of(a->xy, a->corners, b)) ||
           (node->b < c->n && is_convex_part(b->xy, b->corners) && is_part_of(b->xy, b->corners, a));
}

/* The requirement on a held pair: to remain inside, or to keep a distance whose square is `square`. */
static const char *check_held(const checking *c, const sunder_proof_node *node, bool *inside, mpq_t square)
{
    const sunder_conflict *listed = find_listed(c, node->a, node->b);
    if (!listed || listed == &c->listed[c->conflict]) return "a held pair that is not another pair of the list";
    if (are_contained(c, node)) return "a requirement on a contained pair, which may stay as it is";
    if (!proof_find_standing(&c->feature[node->a], &c->feature[node->b], inside, square))
        return "held to an unknown distance";
    const double owed = node->b >= c->n ? c->feature[node->b].owed : c->gap;
    mpq_t most;
    mpq_init(most);
    mpq_set_d(most, owed);
    mpq_mul(most, most, most);
    const bool more = !*inside && mpq_cmp(square, most) > 0;
    mpq_clear(most);
    return more ? "a clearance of a listed pair is greater than the required distance" : NULL;
}

static const char *check_clearance(const checking *c, const sunder_proof_node *node, bool *inside, mpq_t square)
{
    const sunder_conflict *own = &c->listed[c->conflict], *listed = find_listed(c, node->a, node->b);
    const proof_feature *a = &c->feature[node->a], *b = &c->feature[node->b];
    const double owed = node->b >= c->n ? b->owed : c->gap;
    if (node->held && !node->slack) return check_held(c, node, inside, square);
    if (node->slack && (!listed || listed == own || node->clearance >= 0))
        return "slack of a pair without a reduced requirement";
    *inside = !node->slack && node->clearance < 0;
    mpq_set_d(square, node->slack ? 0 : node->clearance); /* with its slack the pair is disjoint */
    mpq_mul(square, square, square);
    if (!listed || listed == own)
        return node->clearance <= owed ? NULL : "a clearance is greater than the required distance";
    if (node->clearance > owed) return "a clearance of a listed pair is greater than the required distance";
    if (are_contained(c, node)) return "a requirement on a contained pair, which may stay as it is";
    return stood_so(a, b, node->clearance) ? NULL
                                           : "a clearance of a listed pair is greater than its distance at the start";
}

/* ---- The tree ---- */

static bool is_part(const checking *c, size_t thing, const double *part, size_t corners)
{
    const proof_feature *f = &c->feature[thing];
    return f->line ? is_part_of_line(part, corners, f) : is_convex_part(part, corners) && is_part_of(part, corners, f);
}

/* Is the node about parts of its two features, is its distance required, and do its ways cover all cases? */
static const char *check_question(const checking *c, const sunder_proof_node *node)
{
    const double *a = c->proof->corner + 2 * node->part_a, *b = c->proof->corner + 2 * node->part_b;
    if (proof_same_block(c, node->a, node->b)) return "a node is about two members of one block";
    if (node->a >= c->n) return "the first member of a node is a barrier";
    if (node->shadow) return proof_check_shadow(c, node);
    if (!is_part(c, node->a, a, node->corners_a) || !is_part(c, node->b, b, node->corners_b))
        return "a part is not convex, or not inside its feature";
    bool inside = false;
    mpq_t most;
    mpq_init(most);
    const char *wrong = check_clearance(c, node, &inside, most);
    if (!wrong) wrong = proof_check_ways(c, node, inside, most);
    mpq_clear(most);
    return wrong;
}

static const char *check_node(checking *c, size_t at, size_t depth)
{
    const sunder_proof *p = c->proof;
    if (at >= p->nodes || c->seen[at]) return "a node is missing, or has two parents";
    c->seen[at] = true;
    const sunder_proof_node *node = &p->node[at];
    if (node->ways == 0) return proof_check_leaf(c, node, depth);
    const char *wrong = check_question(c, node);
    for (size_t k = 0; k < node->ways && !wrong; k++) {
        c->path_node[depth] = at;
        c->path_way[depth] = node->way + k;
        wrong = check_node(c, p->way[node->way + k].next, depth + 1);
    }
    return wrong;
}

static const char *check_blockers(const checking *c)
{
    const sunder_conflict *own = &c->listed[c->conflict];
    bool *used = calloc(c->things, sizeof *used);
    for (size_t k = 0; k < c->proof->nodes; k++)
        if (c->proof->node[k].ways) {
            used[c->proof->node[k].a] = used[c->proof->node[k].b] = true;
            if (c->proof->node[k].chord) used[c->proof->node[k].c] = true;
        }
    used[own->a] = used[own->b] = false;
    size_t n = 0;
    bool same = true;
    for (size_t f = 0; f < c->things; f++)
        if (used[f]) {
            same = same && n < own->n_blocked_by && own->blocked_by[n] == f;
            n++;
        }
    free(used);
    return same && n == own->n_blocked_by ? NULL : "blocked_by does not name the features of the proof";
}

const char *proof_check(const proof_feature *thing, size_t n, size_t things, double gap, const sunder_report *report,
                        size_t k)
{
    checking c = {.feature = thing, .n = n, .things = things, .conflict = k, .gap = gap, .report = report};
    c.listed = sunder_report_conflicts(report, &c.listed_n);
    c.proof = sunder_report_proof(report, k);
    if (!c.proof || c.proof->nodes == 0) return "there is no proof";
    c.path_node = calloc(c.proof->nodes, sizeof *c.path_node);
    c.path_way = calloc(c.proof->nodes, sizeof *c.path_way);
    c.seen = calloc(c.proof->nodes, sizeof *c.seen);
    proof_list_slacks(&c);
    const char *wrong = check_node(&c, 0, 0);
    if (!wrong) wrong = check_blockers(&c);
    free(c.path_node);
    free(c.path_way);
    free(c.seen);
    free(c.slack);
    return wrong;
}
