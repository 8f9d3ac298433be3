/* Is a solution the cheapest of all, whatever the sides?
 *
 * Let some constraints n.u >= d be such that every solution that costs at most C keeps them, f forces on them, x the
 * moves that these cause, and V = sum f d - sum w |x|^2, the value of the dual; all moves count from the preferred ones
 * here. The cost of any moves t is V plus that of t - x plus sum f (n.u - d), and no term of the sum is negative for a
 * solution. So if a pair with the relative move u, inverse masses m and force f has a solution that costs at most C, u
 * lies in the disc
 *     |u - x_u|^2 + 2 m f (n.u - d) <= 2 m (C - V),   and n.u >= d.
 * If the obstacles of their pieces cover all of that part which lies before another line, every such solution keeps to
 * the other side of it; with that constraint V grows, and the discs shrink. It begins without constraints, x = 0 and
 * V = 0. If V reaches the cost of the given solution, no other sides are better.
 *
 * Candidate lines have the normals of the constraints that are active in the solution, and lie no farther out than
 * these. On the side of an obstacle that is a single edge within the disc the line is the constraint itself; about a
 * round corner it lies the closer to it, the smaller the disc is. All of it is in doubles: it saves work, and proves
 * nothing in the report. Its cost is not counted as work, so that it takes nothing from a search that goes on. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* An active constraint, and the pair of pieces that it is about. */
typedef struct acting {
    const sunder_i_constraint *constraint;
    uint32_t i, j; /* indices of the two bodies in the search */
    double fixed;  /* the part of d that is due to a body that does not move */
    double force;  /* force of the constraint in the bounding program */
    double d;      /* every cheaper solution keeps n.u >= d; -INFINITY: nothing is known yet */
    double radius; /* radius of the disc for which that was found; INFINITY: none yet */
} acting;

typedef struct disc {
    double centre[2], radius;
} disc;

/* A disc, and the obstacles of the pieces of two bodies near it. */
typedef struct covering {
    sunder_i_obstacle_edge *edge;
    size_t edges, capacity, first[MOST_COVERING + 1], n; /* [edges] edges of all obstacles, one after the other */
    double gap[MOST_COVERING];                           /* [n] distance by which each is grown */
    size_t last;                                         /* the obstacle that covered the last place tested */
    disc disc;
} covering;

typedef struct bounding {
    sunder_i_search *s;
    acting *acting; /* [n] */
    size_t n;
    sunder_i_quadratic program; /* the program of the known constraints */
    double cost, least;         /* cost of the solution; lower bound of the cost of any solution */
    covering about;
} bounding;

/* ---- What acts --------------------------------------------------------------------------------------------------- */

/* The index in the search of the body that owns a piece. Constraints name the body, unless it does not move. */
static uint32_t owner_of(const sunder_i_search *s, uint32_t named, uint32_t piece)
{
    const uint32_t owner =
        named == SUNDER_I_GROUND ? sunder_i_search_place_of(s, sunder_i_body_of_piece(s->model, piece)) : named;
    SUNDER_I_ASSERT(owner == SUNDER_I_NOBODY ||
                    piece - s->model->body[s->body[owner]].piece < s->model->body[s->body[owner]].pieces);
    return owner;
}

/* Finds the bodies of the constraint's two pieces. False for a wall or a shadow, or if the bodies are relaxed. */
static bool find_part(const sunder_i_search *s, acting *a)
{
    const sunder_i_constraint *c = a->constraint;
    if (c->key >> 60) return false;
    double reach;
    a->i = owner_of(s, c->i, (uint32_t)(c->key >> 32));
    a->j = owner_of(s, c->j, (uint32_t)c->key);
    if (a->i == SUNDER_I_NOBODY || a->j == SUNDER_I_NOBODY) return false;
    if (sunder_i_search_is_relaxed(s, s->body[a->i], s->body[a->j], &reach)) return false;
    a->fixed = 0;
    if (c->i == SUNDER_I_GROUND) a->fixed += c->n[0] * s->t[2 * a->i] + c->n[1] * s->t[2 * a->i + 1];
    if (c->j == SUNDER_I_GROUND) a->fixed -= c->n[0] * s->t[2 * a->j] + c->n[1] * s->t[2 * a->j + 1];
    return true;
}

/* Lists the active constraints. False if one is of a kind that this test does not handle, or if there are too many. */
static bool find_acting(bounding *b)
{
    const sunder_i_quadratic *program = &b->s->program;
    for (size_t k = 0; k < program->n; k++) {
        const sunder_i_constraint *c = &program->constraint[k];
        if (!(c->force > 0)) continue;
        if (b->n == MOST_FORCED) return false;
        acting *a = &b->acting[b->n++];
        a->constraint = c;
        a->radius = INFINITY;
        a->force = 0;
        a->d = sunder_i_is_tangent(c) ? c->d : -INFINITY; /* a limit holds for every solution */
        if (!sunder_i_is_tangent(c) && !find_part(b->s, a)) return false;
    }
    return true;
}

/* ---- One line ---------------------------------------------------------------------------------------------------- */

/* The distance of `at` from the corner where edge e begins (along < 0) or ends. */
static double beyond_corner(const sunder_i_obstacle_edge *edge, size_t n, size_t e, double along, const double at[2])
{
    const double *c = along < 0 ? edge[e].from : edge[e + 1 < n ? e + 1 : 0].from;
    return sqrt((at[0] - c[0]) * (at[0] - c[0]) + (at[1] - c[1]) * (at[1] - c[1]));
}

/* Is the point within the gap of obstacle k, in the sense of sunder_i_support_at()? It is if no edge line is farther
 * away, and the point projects onto an edge, or is near enough to a corner. */
static bool is_covered(const covering *o, size_t k, const double at[2])
{
    const sunder_i_obstacle_edge *edge = o->edge + o->first[k];
    const size_t n = o->first[k + 1] - o->first[k];
    double corner = INFINITY;
    bool beside = false, faces = false;
    for (size_t e = 0; e < n; e++) {
        const double wx = at[0] - edge[e].from[0], wy = at[1] - edge[e].from[1];
        const double s = edge[e].n[0] * wx + edge[e].n[1] * wy;
        if (!(s <= o->gap[k])) return false;
        if (!(s >= 0) || beside) continue;
        const double along = wy * edge[e].n[0] - wx * edge[e].n[1];
        faces = faces || s > 0;
        beside = along >= 0 && along <= edge[e].length;
        if (!beside) corner = sunder_i_min(corner, beyond_corner(edge, n, e, along, at));
    }
    return beside || !faces || corner <= o->gap[k] || sunder_i_support_at(edge, n, at).distance <= o->gap[k];
}

static bool is_covered_by_any(covering *o, const double at[2])
{
    for (size_t k = 0; k < o->n; k++) {
        const size_t obstacle = o->last + k < o->n ? o->last + k : o->last + k - o->n;
        if (!is_covered(o, obstacle, at)) continue;
        o->last = obstacle;
        return true;
    }
    return false;
}

/* The part of a disc between two parallel lines. `out`: distance from the centre along n; `across`: to the left of
 * n. */
typedef struct between {
    const disc *disc;
    const double *n; /* normal of the lines */
    double low, out;
} between;

static void place_at(const between *b, double across, double out, double place[2])
{
    place[0] = b->disc->centre[0] + out * b->n[0] - across * b->n[1];
    place[1] = b->disc->centre[1] + out * b->n[1] + across * b->n[0];
}

static bool is_covered_at(const covering *o, size_t obstacle, const between *b, double across, double out)
{
    double place[2];
    for (int side = -1; side <= 1; side += 2) {
        place_at(b, side * across, out, place);
        if (!is_covered(o, obstacle, place)) return false;
    }
    return true;
}

/* Does one obstacle cover the whole part? Obstacles are convex, so it does if it covers the corners of a polygon around
 * the part: the ends of the chords, and corners of tangents to the arcs between them. */
static bool is_covered_by_one(const covering *o, size_t obstacle, const between *b)
{
    const double radius = b->disc->radius;
    const double begin = acos(sunder_i_min(1, b->out / radius)), end = acos(sunder_i_max(-1, b->low / radius));
    const double half = (end - begin) / (2 * ARC_SIDES), turn[2] = {cos(half), sin(half)};
    double out = radius * cos(begin), across = radius * sin(begin);
    if (!is_covered_at(o, obstacle, b, across, out)) return false;
    if (!is_covered_at(o, obstacle, b, radius * sin(end), radius * cos(end))) return false;
    /* Follows an arc from one end, by half a side each time; every second point is below a corner, where two tangents
     * meet. */
    for (int k = 0; k < 2 * ARC_SIDES - 1; k++) {
        const double next = turn[0] * out - turn[1] * across;
        across = turn[0] * across + turn[1] * out;
        out = next;
        if (k % 2 == 0 && !is_covered_at(o, obstacle, b, across / turn[0], out / turn[0])) return false;
    }
    return true;
}

/* The corners of a strip of the part, from `left` to `right`: it ends at the tangents of the arcs above its middle, or
 * at a line of the part if the tangent passes that line, which makes the strip larger. */
static void find_strip(const between *b, double left, double right, double corner[4][2])
{
    const double radius = b->disc->radius, middle = (left + right) / 2;
    const double height = sqrt(sunder_i_max(radius * radius - middle * middle, 0x1p-20 * radius * radius));
    const double slope = middle / height, begin = height - slope * (left - middle),
                 end = height - slope * (right - middle);
    const bool cut = sunder_i_max(begin, end) > b->out, low = sunder_i_max(-begin, -end) < b->low;
    place_at(b, left, low ? b->low : -begin, corner[0]);
    place_at(b, right, low ? b->low : -end, corner[1]);
    place_at(b, left, cut ? b->out : begin, corner[2]);
    place_at(b, right, cut ? b->out : end, corner[3]);
}

/* Is the strip covered by one obstacle, or are its halves, `halvings` times over? */
static bool cover_strip(covering *o, const between *b, double left, double right, int halvings)
{
    double corner[4][2];
    find_strip(b, left, right, corner);
    for (size_t k = 0; k < o->n; k++) {
        const size_t obstacle = o->last + k < o->n ? o->last + k : o->last + k - o->n;
        int covered = 0;
        while (covered < 4 && is_covered(o, obstacle, corner[covered])) covered++;
        if (covered < 4) continue;
        o->last = obstacle;
        return true;
    }
    const double middle = (left + right) / 2;
    return halvings > 0 && cover_strip(o, b, left, middle, halvings - 1) &&
           cover_strip(o, b, middle, right, halvings - 1);
}

static double half_chord(const between *b, double out)
{
    return sqrt(sunder_i_max(0, b->disc->radius * b->disc->radius - out * out));
}

/* Is the part covered? The ends of the outer chord are tested first, since most often they are not. */
static bool is_segment_covered(covering *o, const between *b)
{
    const double radius = b->disc->radius;
    if (b->out <= sunder_i_max(b->low, -radius) || b->low >= radius) return true;
    const double out = sunder_i_min(radius, b->out);
    for (int side = -1; side <= 1; side += 2) {
        double end[2];
        place_at(b, side * half_chord(b, out), out, end);
        if (!is_covered_by_any(o, end)) return false;
    }
    if (is_covered_by_one(o, o->last, b)) return true;
    const double across = half_chord(b, out < 0 ? out : sunder_i_max(0, b->low));
    return o->n > 1 && cover_strip(o, b, -across, 0, STRIP_HALVINGS) && cover_strip(o, b, 0, across, STRIP_HALVINGS);
}

/* Given that every solution keeps n.u >= known: a greater lower bound d' of n.u, for free relative moves u in the disc.
 * Obstacles cover the part of the disc between the lines n.u = known and n.u = d'. d' is at most d - hair, and found by
 * bisecting its distance from d in powers of two, so it may be smaller than necessary. It is `known` if nothing better
 * is found. */
static double find_line(covering *o, const double n[2], double known, double d, double hair)
{
    const disc *about = &o->disc;
    const double centre = n[0] * about->centre[0] + n[1] * about->centre[1];
    const double nothing = sunder_i_max(known, centre - about->radius);
    between b = {about, n, known - centre, d - hair - centre};
    if (is_segment_covered(o, &b)) return d - hair;
    int near = 0, far = LINE_HALVINGS;
    while (far - near > 1) {
        const int k = (near + far) / 2;
        b.out = d - ldexp(d - nothing, -k) - centre;
        if (is_segment_covered(o, &b))
            near = k;
        else
            far = k;
    }
    return near ? d - ldexp(d - nothing, -near) : known;
}

/* ---- The obstacles of a pair ------------------------------------------------------------------------------------- */

static void add_obstacle(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    covering *o = context;
    size_t n;
    double gap;
    if (pair->shadow || pair->inclusion != SUNDER_I_LAPSED || o->n == MOST_COVERING) return;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge || sunder_i_support_at(edge, n, o->disc.centre).distance > gap + o->disc.radius) return;
    if (!sunder_i_reserve(&o->edge, &o->capacity, o->edges + n, sizeof *o->edge)) {
        s->failed = true;
        return;
    }
    memcpy(o->edge + o->edges, edge, n * sizeof *edge);
    o->edges += n;
    o->gap[o->n++] = gap;
    o->first[o->n] = o->edges;
}

static const double *place_of_body(const bounding *b, uint32_t i)
{
    return b->s->mass[i] > 0 ? b->program.t + 2 * i : b->s->t + 2 * i;
}

/* Raises a->d if obstacles show that cheaper solutions keep a farther line. Returns whether it was raised. */
static bool raise_line(bounding *b, acting *a)
{
    sunder_i_search *s = b->s;
    const sunder_i_constraint *c = a->constraint;
    if (sunder_i_is_tangent(c) || a->d >= c->d - 2 * s->tolerance) return false;
    const double *p = place_of_body(b, a->i), *q = place_of_body(b, a->j);
    const double mass = s->mass[a->i] + s->mass[a->j], back = mass * a->force;
    const double radius = sqrt(2 * mass * sunder_i_max(0, b->cost - b->least));
    covering *o = &b->about;
    if (!(radius > 0) || !(radius < SHRUNK * a->radius)) return false;
    a->radius = radius;
    o->n = o->edges = o->last = 0;
    o->disc.centre[0] = q[0] - p[0] - back * c->n[0];
    o->disc.centre[1] = q[1] - p[1] - back * c->n[1];
    /* The disc around the point of the line n.u = d that is nearest to the free optimum; forces that are not solved to
     * the end leave it slightly off. */
    const double slack = a->force > 0 ? sunder_i_stretch(c, b->program.t) - a->d : 0;
    o->disc.radius = sqrt(sunder_i_max(0, radius * radius + back * back - 2 * back * slack));
    sunder_i_search_piece_pairs(s, a->i, a->j, o->disc.centre, s->gap + o->disc.radius, false, add_obstacle, o);
    if (s->failed || o->n == 0) return false;
    const double known = find_line(o, c->n, a->d - a->fixed, c->d - a->fixed, s->tolerance) + a->fixed;
    if (!(known > a->d)) return false;
    a->d = known;
    return true;
}

/* ---- All of them ------------------------------------------------------------------------------------------------- */

/* Solves the program of the known constraints, and computes the lower bound from its forces. By weak duality the bound
 * holds for any forces. */
static bool solve_bound(bounding *b)
{
    sunder_i_quadratic *p = &b->program;
    p->n = 0;
    for (size_t k = 0; k < b->n; k++) {
        if (!(b->acting[k].d > -INFINITY)) continue;
        p->constraint[p->n] = *b->acting[k].constraint;
        p->constraint[p->n++].d = b->acting[k].d;
    }
    if (sunder_i_quadratic_solve(p, 0, b->s->tolerance / SOLVED_TO, b->s->extent) < 0) return false;
    b->least = -sunder_i_search_cost(b->s, p->t);
    for (size_t k = 0, n = 0; k < b->n; k++) {
        acting *a = &b->acting[k];
        a->force = a->d > -INFINITY ? p->constraint[n++].force : 0;
        if (a->force > 0) b->least += a->force * (a->d - sunder_i_stretch(a->constraint, b->s->preferred));
    }
    return true;
}

/* Alternates between raising lines and solving, until no solution can be cheaper by more than the share `enough`.
 * Returns the share. */
static double raise_bound(bounding *b, double enough)
{
    double left = 1;
    for (int round = 0; round < FORCED_ROUNDS && left > enough && !b->s->failed; round++) {
        bool any = false;
        for (size_t k = 0; k < b->n; k++) any = raise_line(b, &b->acting[k]) || any;
        if (!any) break;
        if (!solve_bound(b)) b->s->failed = true;
        left = sunder_i_max(0, 1 - b->least / b->cost);
    }
    return left;
}

/* An upper bound of the share of its cost by which any solution may be cheaper than s->t; it is not computed more
 * closely than to `enough`. */
static double find_left(sunder_i_search *s, double enough)
{
    const uint64_t steps = s->steps;
    bounding b = {.s = s, .cost = sunder_i_search_cost(s, s->t)};
    const size_t room = s->program.n < MOST_FORCED ? s->program.n : MOST_FORCED;
    if (b.cost == 0) return 0;
    b.acting = sunder_i_alloc(room, sizeof *b.acting);
    b.program = (sunder_i_quadratic){.bodies = s->n, .mass = s->mass, .preferred = s->program.preferred};
    b.program.constraint = sunder_i_alloc(room, sizeof *b.program.constraint);
    b.program.t = sunder_i_calloc(2 * s->n, sizeof *b.program.t);
    const bool ok = b.acting && b.program.constraint && b.program.t;
    if (!ok) s->failed = true;
    if (ok) memcpy(b.program.t, s->preferred, 2 * s->n * sizeof *b.program.t);
    const double left = ok && find_acting(&b) ? raise_bound(&b, enough) : 1;
    sunder_i_free_all(b.about.edge, b.acting, b.program.constraint, b.program.t);
    s->steps = steps;
    return left;
}

/* Computes s->t to the last digits and asks again. If it is still not known to be the cheapest, the search returns to
 * its former state, including the work counted. */
static bool is_cheapest_below(sunder_i_search *s)
{
    const sunder_i_quadratic *p = &s->program;
    const uint64_t steps = s->steps, work = p->work;
    const uint32_t tangents = s->tangents;
    const double settled = s->settled;
    const size_t n = p->n;
    double *stood = sunder_i_alloc(2 * s->n, sizeof *stood);
    sunder_i_constraint *constraint = sunder_i_alloc(n, sizeof *constraint);
    bool cheapest = false;
    if (!stood || !constraint) {
        s->failed = true;
    } else {
        memcpy(stood, s->t, 2 * s->n * sizeof *stood);
        if (n) memcpy(constraint, p->constraint, n * sizeof *constraint);
        s->settled = SETTLED_BEST;
        cheapest = sunder_i_search_descend(s) && find_left(s, CHEAPEST) <= CHEAPEST;
        s->settled = settled;
        if (!cheapest && !s->failed) {
            memcpy(s->t, stood, 2 * s->n * sizeof *stood);
            s->program.n = 0;
            for (size_t k = 0; k < n && !s->failed; k++) sunder_i_search_add_constraint(s, k, &constraint[k]);
            s->steps = steps;
            s->program.work = work;
            s->tangents = tangents;
        }
    }
    sunder_i_free_all(stood, constraint);
    return cheapest;
}

bool sunder_i_search_is_cheapest(sunder_i_search *search)
{
    const bool down = sunder_i_search_runs_without_proofs(search);
    const double enough = down ? NEARLY_CHEAPEST : CHEAPEST, left = find_left(search, enough);
    if (search->failed || left > enough) return false;
    return left <= CHEAPEST || is_cheapest_below(search);
}
