/* A plain branch and bound. A place outside a convex piece is beyond one of its sides, or (if the piece is rounded) in
 * the sector of one of its corners and at least the radius away from it. The convex hull of a sector between directions
 * d and e is bounded by the chord: m.(u - corner) >= radius * min(m.d/|d|, m.e/|e|), m = d + e. So a node is a set of
 * half-planes, one to three for each piece that was branched on; its bound is that of optimum_dual.c. If the solution
 * of a node lies in pieces, the node branches on the deepest one: over all sides and sectors of a new piece, or over
 * the two halves of a sector whose chord the solution lies beyond. The children of a node cover it, and the distance of
 * a chord from its arc is quadratic in its length, so bounds converge. Limits are replaced by tangents, which are added
 * when a solution exceeds a limit.
 *
 * Constraints are valid in spite of rounding: normals of sides are exact, their distances are rounded down. The
 * directions that divide sectors may be any, as long as neighbours share them. */
#include "optimum.h"

#include "optimum_dual.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double MISSED = 1e-9; /* a place may violate a requirement by this much and still count as outside */

/* A piece that was branched on, and the chosen sector. */
typedef struct choice {
    size_t piece, corner;
    bool sector;
    double d[2], e[2];
} choice;

typedef struct search {
    const optimum_problem *m;
    double below, relative;
    optimum_answer answer;
    size_t most_nodes;
    optimum_row row[OPTIMUM_ROWS];
    choice choice[OPTIMUM_ROWS];
    size_t rows, choices;
} search;

static double dot(const double *p, const double *q) { return p[0] * q[0] + p[1] * q[1]; }

/* A lower bound of v, if some operations on numbers of that size were rounded. */
static double down(double v, double size) { return v - 8 * 0x1p-53 * (fabs(v) + size); }

/* ---- Rows ---- */

static void add_row(search *s, size_t a, size_t b, double nx, double ny, double h)
{
    if (s->rows == OPTIMUM_ROWS) abort();
    s->row[s->rows++] = (optimum_row){a, b, {nx, ny}, h};
}

/* The number of sides: the edges; for a shadow the incoming ray, its edges, the outgoing ray. */
static size_t side_count(const optimum_piece *p) { return p->shadow ? p->corners + 1 : p->corners; }

/* The outer normal, exact, and a point of the side; the rays of a shadow are on lines through the origin. */
static void side_of(const optimum_piece *p, size_t k, double n[2], double at[2])
{
    const double origin[2] = {0, 0}, *from, *to;
    if (p->shadow) {
        from = k == 0 ? p->xy : k == p->corners ? origin : p->xy + 2 * (k - 1);
        to = k == 0 ? origin : k == p->corners ? p->xy + 2 * (k - 1) : p->xy + 2 * k;
    } else {
        from = p->xy + 2 * k;
        to = p->xy + 2 * ((k + 1) % p->corners);
    }
    n[0] = to[1] - from[1];
    n[1] = from[0] - to[0];
    memcpy(at, from, 2 * sizeof *from);
}

static void add_side(search *s, const optimum_piece *p, size_t k)
{
    double n[2], at[2];
    side_of(p, k, n, at);
    const double size = fabs(n[0] * at[0]) + fabs(n[1] * at[1]) + fabs(p->radius) * hypot(n[0], n[1]);
    add_row(s, p->a, p->b, n[0], n[1], down(dot(n, at) + p->radius * hypot(n[0], n[1]), size));
}

static void add_sector(search *s, const optimum_piece *p, const choice *c)
{
    const double *v = p->xy + 2 * c->corner, *d = c->d, *e = c->e, m[2] = {d[0] + e[0], d[1] + e[1]};
    const double left[2] = {-d[1], d[0]}, right[2] = {e[1], -e[0]}, r = p->radius;
    const double size = fabs(v[0]) + fabs(v[1]), of_d = hypot(d[0], d[1]), of_e = hypot(e[0], e[1]);
    add_row(s, p->a, p->b, left[0], left[1], down(dot(left, v), size * of_d));
    add_row(s, p->a, p->b, right[0], right[1], down(dot(right, v), size * of_e));
    const double chord = dot(m, v) + r * fmin(dot(m, d) / of_d, dot(m, e) / of_e);
    add_row(s, p->a, p->b, m[0], m[1], down(chord, (size + r) * (of_d + of_e)));
}

/* ---- Violations by a place ---- */

/* The depth of u in the open piece; negative outside. */
static double depth_in_piece(const optimum_piece *p, const double u[2])
{
    double deepest = -INFINITY, nearest = INFINITY;
    for (size_t k = 0; k < side_count(p); k++) {
        double n[2], at[2];
        side_of(p, k, n, at);
        const double size = hypot(n[0], n[1]), off[2] = {u[0] - at[0], u[1] - at[1]};
        deepest = fmax(deepest, dot(n, off) / size);
        if (p->shadow) continue;
        const double *to = p->xy + 2 * ((k + 1) % p->corners), along[2] = {to[0] - at[0], to[1] - at[1]};
        const double part = fmin(1, fmax(0, dot(along, off) / dot(along, along)));
        nearest = fmin(nearest, hypot(off[0] - part * along[0], off[1] - part * along[1]));
    }
    return p->shadow || deepest <= 0 ? p->radius - deepest : p->radius - nearest;
}

static void relative_move(const optimum_piece *p, const optimum_solution *at, double u[2])
{
    for (size_t k = 0; k < 2; k++) u[k] = at->t[2 * p->b + k] - at->t[2 * p->a + k];
}

/* The piece in which the solution lies deepest, or NULL. */
static const optimum_piece *find_deepest(const search *s, const optimum_solution *at)
{
    const optimum_piece *worst = NULL;
    double most = MISSED;
    for (size_t k = 0; k < s->m->pieces; k++) {
        double u[2];
        relative_move(&s->m->piece[k], at, u);
        const double depth = depth_in_piece(&s->m->piece[k], u);
        if (depth > most) most = depth, worst = &s->m->piece[k];
    }
    return worst;
}

/* ---- Nodes ---- */

static double enough(const search *s)
{
    const double best = fmin(s->below, s->answer.high);
    return best - s->relative * best - 1e-10;
}

static void leave_open(search *s, double bound)
{
    s->answer.low = fmin(s->answer.low, bound);
    s->answer.open = true;
}

/* Solves the node, adding tangents of limits. Returns false if the node can be closed. */
static bool bound_node(search *s, optimum_solution *at)
{
    for (int cuts = 0; cuts < 60; cuts++) {
        const optimum_verdict verdict = optimum_solve(s->m, s->row, s->rows, fmax(1e-9, enough(s)), at);
        if (verdict == OPTIMUM_INFEASIBLE) return false;
        if (verdict == OPTIMUM_STUCK) {
            leave_open(s, at->bound);
            return false;
        }
        if (at->bound >= enough(s)) {
            s->answer.low = fmin(s->answer.low, at->bound);
            return false;
        }
        bool within = true;
        for (size_t i = 0; i < s->m->bodies; i++) {
            const double *t = at->t + 2 * i, limit = s->m->body[i].limit, long_ = hypot(t[0], t[1]);
            if (limit == 0 || long_ <= limit + MISSED / 4) continue;
            within = false;
            add_row(s, i, OPTIMUM_NOBODY, t[0], t[1], down(-limit * long_, limit * long_));
        }
        if (within) return true;
    }
    return true;
}

static void explore(search *s);

typedef struct child {
    choice choice;
    size_t side; /* SIZE_MAX: a sector */
    double bound;
} child;

static void enter(search *s, const child *c)
{
    const optimum_piece *p = &s->m->piece[c->choice.piece];
    if (c->side == SIZE_MAX)
        add_sector(s, p, &c->choice);
    else
        add_side(s, p, c->side);
    s->choice[s->choices++] = c->choice;
}

static int by_bound(const void *p, const void *q)
{
    const child *a = p, *b = q;
    return (a->bound > b->bound) - (a->bound < b->bound);
}

/* All sides of a piece, and all sectors, as children. */
static size_t list_children(const optimum_problem *m, size_t k, child *out)
{
    const optimum_piece *p = &m->piece[k];
    size_t n = 0;
    for (size_t side = 0; side < side_count(p); side++) {
        double before[2], normal[2], at[2];
        side_of(p, side, normal, at);
        out[n++] = (child){.choice = {.piece = k}, .side = side};
        if (p->radius <= 0 || p->shadow) continue;
        child corner = {.choice = {.piece = k, .corner = side, .sector = true}, .side = SIZE_MAX};
        side_of(p, (side + p->corners - 1) % p->corners, before, at);
        memcpy(corner.choice.d, before, sizeof before);
        memcpy(corner.choice.e, normal, sizeof normal);
        out[n++] = corner;
    }
    return n;
}

static size_t halve(const choice *c, child *out)
{
    const double of_d = hypot(c->d[0], c->d[1]), of_e = hypot(c->e[0], c->e[1]);
    const double middle[2] = {c->d[0] / of_d + c->e[0] / of_e, c->d[1] / of_d + c->e[1] / of_e};
    out[0] = out[1] = (child){.choice = *c, .side = SIZE_MAX};
    memcpy(out[0].choice.e, middle, sizeof middle);
    memcpy(out[1].choice.d, middle, sizeof middle);
    return 2;
}

static void branch(search *s, const optimum_piece *p, double bound)
{
    child list[3 * OPTIMUM_CORNERS + 4];
    const size_t piece = (size_t)(p - s->m->piece), rows = s->rows, choices = s->choices;
    const choice *taken = NULL;
    for (size_t k = 0; k < choices; k++)
        if (s->choice[k].piece == piece) taken = &s->choice[k];
    if (taken && !taken->sector) { /* beyond a side, up to the greatest rounding error */
        leave_open(s, bound);
        return;
    }
    const size_t n = taken ? halve(taken, list) : list_children(s->m, piece, list);
    size_t kept = 0;
    for (size_t k = 0; k < n; k++) {
        optimum_solution at;
        enter(s, &list[k]);
        if (bound_node(s, &at)) {
            list[kept] = list[k];
            list[kept++].bound = at.bound;
        }
        s->rows = rows;
        s->choices = choices;
    }
    qsort(list, kept, sizeof *list, by_bound);
    for (size_t k = 0; k < kept; k++) {
        enter(s, &list[k]);
        explore(s);
        s->rows = rows;
        s->choices = choices;
    }
}

static void explore(search *s)
{
    optimum_solution at;
    if (!bound_node(s, &at)) return;
    if (++s->answer.nodes > s->most_nodes || s->rows + 80 > OPTIMUM_ROWS) {
        leave_open(s, at.bound);
        return;
    }
    const optimum_piece *p = find_deepest(s, &at);
    if (p) {
        branch(s, p, at.bound);
        return;
    }
    s->answer.low = fmin(s->answer.low, at.bound);
    s->answer.high = fmin(s->answer.high, at.cost);
}

optimum_answer optimum_find(const optimum_problem *m, double below, double relative, size_t most_nodes)
{
    search *s = calloc(1, sizeof *s);
    if (!s) abort();
    s->m = m;
    s->below = below;
    s->relative = relative;
    s->most_nodes = most_nodes;
    s->answer = (optimum_answer){.low = INFINITY, .high = INFINITY};
    explore(s);
    const optimum_answer answer = s->answer;
    free(s);
    return answer;
}
