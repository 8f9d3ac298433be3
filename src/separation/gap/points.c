/* points.c: in the search with a gap, points that are not known to be covered are computed and tested exactly. */
#include "separation/gap/gap_search.h"

#include <math.h>

/* ---- Exact points ---- */

/* If the error of a point in doubles exceeds this multiple of s->error, the point is computed again from the exact
 * one. */
#define LOSS_MAX 4096

static bool solve_point(sunder_i_gap_state *s, sunder_i_gap_point *p)
{
    const sunder_i_surd_point *exact = sunder_i_gap_solve(s, p);
    if (!exact) return false;
    if (!(p->error <= LOSS_MAX * s->error)) {
        sunder_i_gap_doubles(s, exact, &p->x, &p->y);
        p->error = s->error;
    }
    return true;
}

/* ---- Subsums near a point ---- */

/* A tested point: exact, and in doubles with the error `doubt`; `of` (may be NULL) contains the curves that it was
 * computed from. */
typedef struct question {
    const sunder_i_surd_point *at;
    double x, y, doubt;
    const sunder_i_gap_point *of;
} question;

static bool same_point(const sunder_i_gap_state *s, sunder_i_point a, sunder_i_point b)
{
    return s->g->placed.lattice.narrow && a.x == b.x && a.y == b.y;
}

/* Returns whether the curve is the offset of side k, or, if `arc`, the circle about its first vertex. Returns false if
 * this is not easily decided. */
static bool is_curve(sunder_i_gap_state *s, const sunder_i_gap_curve *c, const sunder_i_subsum *m, uint32_t k, bool arc)
{
    if (c->arc != arc || !s->g->placed.lattice.narrow) return false;
    if (arc) return same_point(s, c->a, m->corner[k]);
    return sunder_i_narrow_cross(c->d, m->side[k]) == 0 && sunder_i_narrow_dot(c->d, m->side[k]) > 0 &&
           sunder_i_narrow_cross(c->d, sunder_i_narrow_sub(m->corner[k], c->a)) == 0;
}

/* Does the same as sunder_i_gap_cmp_side() for a point that is certainly outside. Doubles decide whether the vertex or
 * the side is nearest if the difference exceeds the error; if the point was computed from that curve, its distance is
 * exactly the gap. */
static int compare_side(sunder_i_gap_state *s, const sunder_i_subsum *m, const sunder_i_gap_subsum *r, uint32_t k,
                        const question *q, bool *flat)
{
    const double vx = q->x - r->cx[k], vy = q->y - r->cy[k], along = (r->sx[k] * vx + r->sy[k] * vy) / r->length[k];
    if (along > r->length[k] + q->doubt) return 1; /* the second end is the first vertex of the next side */
    const double most = s->gap + q->doubt;
    if (along < 0 && vx * vx + vy * vy > most * most) return 1;
    const bool arc = along < -q->doubt;
    if (q->of && (arc || (along > q->doubt && along < r->length[k] - q->doubt))) {
        *flat = !arc;
        if (is_curve(s, &q->of->c, m, k, arc) || (q->of->crossing && is_curve(s, &q->of->d, m, k, arc))) return 0;
    } else if (q->of && q->of->crossing && q->of->d.arc && is_curve(s, &q->of->c, m, k, false)) {
        /* if the side's line meets a circle about one of its ends, it touches the circle, and that end is nearest */
        *flat = false;
        if (is_curve(s, &q->of->d, m, k, true)) return 0;
        if (is_curve(s, &q->of->d, m, k + 1 < m->sides ? k + 1 : 0, true)) return 1;
    }
    bool inward;
    return sunder_i_gap_cmp_side(s->p, m, k, q->at, &inward, flat);
}

/* Returns -1 if the point is closer to the subsum than the gap, 1 if it is farther, and 0 if its distance is the gap,
 * at vertex or side *k. Sides that are certainly farther are not tested exactly. */
static int compare_subsum(sunder_i_gap_state *s, size_t of, const question *q, uint32_t *k, bool *flat)
{
    const sunder_i_subsum *m = s->g->subsum + of;
    const sunder_i_gap_subsum *r = sunder_i_gap_load(s, of);
    if (!r) return -1;
    if (r->vague) return sunder_i_gap_cmp(s->p, m, q->at, k, flat);
    const double reach = s->gap + q->doubt, distance = sunder_i_gap_distance(s, r, q->x, q->y);
    if (distance > reach) return 1;
    if (!(distance >= 2 * q->doubt)) return sunder_i_gap_cmp(s->p, m, q->at, k, flat); /* the point may be inside */
    int least = 1;
    for (uint32_t i = 0; i < r->n && least >= 0; i++) {
        /* the line of the side is closer than the gap; its second end is the first vertex of the next side */
        const double vx = q->x - r->cx[i], vy = q->y - r->cy[i], height = r->sy[i] * vx - r->sx[i] * vy;
        if (height > reach * r->length[i] || (height < -reach * r->length[i])) continue;
        bool is_flat = false;
        const int order = compare_side(s, m, r, i, q, &is_flat);
        if (order >= least) continue;
        least = order;
        *k = i;
        *flat = is_flat;
    }
    return least;
}

static long too_near(sunder_i_gap_state *s, const question *q, sunder_i_gap_contact *contact, size_t *contacts)
{
    if (contacts) *contacts = 0;
    size_t n;
    const uint32_t *near = sunder_i_gap_near(s, q->x, q->y, &n);
    s->failed = s->failed || !sunder_i_steps(n / 4);
    for (size_t i = 0; i < n && !s->failed; i++) {
        const size_t of = sunder_i_gap_nth(s, near, i);
        if (!sunder_i_gap_near_box(s, of, q->x, q->y, s->gap + q->doubt)) continue;
        uint32_t k = 0;
        bool flat = false;
        const int order = compare_subsum(s, of, q, &k, &flat);
        if (s->failed) break;
        if (order < 0) return (long)of;
        if (order > 0 || !contact) continue;
        const sunder_i_gap_subsum *r = s->pieces + of;
        const double nx = flat ? r->sy[k] : q->x - r->cx[k], ny = flat ? -r->sx[k] : q->y - r->cy[k];
        const double f = sunder_i_gap_length(nx, ny);
        contact[(*contacts)++] = (sunder_i_gap_contact){nx / f, ny / f, flat, k, of};
    }
    return -1;
}

bool sunder_i_gap_is_free(sunder_i_gap_state *s, const sunder_i_surd_point *at)
{
    question q = {.at = at, .doubt = s->margin + s->error};
    sunder_i_gap_doubles(s, at, &q.x, &q.y);
    return too_near(s, &q, NULL, NULL) < 0 && !s->failed;
}

/* ---- Free points ---- */

/* Compares two free points; doubles decide all but ties. */
static int point_order(sunder_i_gap_state *s, const sunder_i_gap_free_point *a, const sunder_i_gap_free_point *b)
{
    const double u = sunder_i_gap_length(a->x, a->y), v = sunder_i_gap_length(b->x, b->y);
    if (fabs(u - v) > a->error + b->error + s->error) return u < v ? -1 : 1;
    return sunder_i_surd_point_cmp(s->g, &a->exact, &b->exact);
}

static void offer_point(sunder_i_gap_state *s, const sunder_i_gap_free_point *f)
{
    if (s->found.any && point_order(s, f, &s->found) >= 0) return;
    s->found = *f;
    const double most = sunder_i_gap_length(f->x, f->y) + f->error + s->error;
    if (most < s->best) s->best = most;
}

/* Returns whether the walk along the curve c of q->of really leaves the subsum p->cover at the point, as doubles
 * estimated: the point lies on the boundary of that grown subsum, and c leaves the disc or half-plane that the curve d
 * bounds. near: a subsum that is closer to the point than the gap; -1: none is, and f has all contacts. */
static bool is_exit(sunder_i_gap_state *s, const question *q, const sunder_i_gap_free_point *f, long near)
{
    const sunder_i_gap_point *p = q->of;
    if (!p->d.arc) {
        const int turn = sunder_i_operands_cross(s->g, p->c.d, p->d.d);
        if (p->forwards ? turn <= 0 : turn >= 0) return false;
    }
    if (near < 0) {
        for (size_t i = 0; i < f->contacts; i++)
            if ((long)f->contact[i].of == p->cover) return true;
        return false;
    }
    uint32_t k;
    bool flat;
    return near != p->cover && compare_subsum(s, (size_t)p->cover, q, &k, &flat) == 0;
}

void sunder_i_gap_take_point(sunder_i_gap_state *s, size_t index)
{
    sunder_i_gap_point p = s->points[index];
    sunder_i_gap_free_point f = {.any = true};
    question q = {.of = &p};
    long near = p.cover;
    const bool solved = solve_point(s, &p);
    if (solved) {
        f = (sunder_i_gap_free_point){.any = true, .exact = *p.exact, .x = p.x, .y = p.y, .error = p.error};
        size_t most;
        (void)sunder_i_gap_near(s, p.x, p.y, &most);
        f.contact = sunder_i_arena_alloc(&s->g->placed.lattice.arena, most + 1, sizeof *f.contact);
        s->failed = s->failed || !f.contact;
        q = (question){p.exact, p.x, p.y, s->margin + p.error, &p};
        if (!s->failed) near = too_near(s, &q, f.contact, &f.contacts);
    }
    if (s->failed) return;
    if (p.cover >= 0 && (!solved || !is_exit(s, &q, &f, near)))
        sunder_i_gap_pass(s, &p, (size_t)p.cover, p.forwards);
    else if (near >= 0) {
        if (p.forwards) sunder_i_gap_pass(s, &p, (size_t)near, true);
        if (p.backwards) sunder_i_gap_pass(s, &p, (size_t)near, false);
    } else if (solved)
        offer_point(s, &f);
}
