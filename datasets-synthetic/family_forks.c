/* Combs and forks: families whose sums are as large as sums get. */
#include "family.h"

/* comb + convex: order m n.
 *
 * Teeth three times as far apart as Q is wide, so that the sums of neighbouring tips stay apart; slender, so that each
 * tip shows nearly every vertex of Q's upper half. (m / 2) teeth times (n / 2) vertices. */
void family_comb(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    const size_t teeth = m / 2 - 1;
    family_convex_member(q, &streams->q, n, 0, 0, 500);
    int64_t radius = 0;
    for (size_t i = 0; i < 2 * q->vertices; i++)
        if (q->xy[i] > radius) radius = q->xy[i];
    const int64_t pitch = 6 * radius, height = 8 * pitch, width = (int64_t)teeth * pitch;
    family_vertex(p, 0, -pitch);
    family_vertex(p, width, -pitch);
    for (size_t i = teeth; i-- > 0;) {
        const int64_t tip = (int64_t)i * pitch + pitch / 2 + family_integer(&streams->p, -pitch / 20, pitch / 20);
        family_vertex(p, tip, height + family_integer(&streams->p, -pitch / 2, pitch / 2));
        if (i) family_vertex(p, (int64_t)i * pitch, family_integer(&streams->p, -pitch / 20, pitch / 20));
    }
    family_end_member(p);
}

/* A fork: an upright and a foot of unit thickness; `teeth` teeth stick out of the upright sideways, as many out of the
 * foot upwards. What P + Q must do (coordinates: x to the right, y upwards):
 *
 *   - sideways teeth at y = at + i pitch. With P's pitch p and Q's pitch p K (K: teeth of P) all sums of two are
 *     distinct, p apart: K L strips as long as two teeth. So for the teeth upwards. The strips cross and leave (K L -
 *     1)^2 holes: m^2 n^2 as K = m / 8, L = n / 8.
 *   - nothing else may cover the grid. P's teeth upwards are to the left of its upright, Q's far to the right, so that
 *     a sideways tooth of one + an upward tooth of the other (a solid rectangle) is right of the grid or left of it. */
typedef struct fork_plan {
    int64_t pitch, thick; /* of P's teeth; the thickness of a sum of two is below the pitch */
    int64_t extent;       /* of all the sums of teeth, across them */
    int64_t length, at;   /* of a tooth; where the sideways ones begin */
    int64_t left, right;  /* where the upward ones begin: P's at -left, Q's at right */
} fork_plan;

/* In either direction: four vertices each, three if pointed. */
static size_t fork_teeth(size_t n, bool slanted) { return n < 16 ? 1 : slanted ? n / 6 - 1 : n / 8; }

static fork_plan plan_fork(size_t m, size_t n, bool slanted)
{
    fork_plan f;
    f.pitch = slanted ? 48 : 8;
    f.thick = slanted ? 12 : 2;
    f.extent = f.pitch * (int64_t)(fork_teeth(m, slanted) * fork_teeth(n, slanted));
    f.length = f.extent + 4 * f.pitch;
    f.at = f.length / 2 + f.pitch;
    f.left = f.extent + f.pitch;
    f.right = f.left + f.length + 2 * f.pitch;
    return f;
}

/* Both kinds of tooth as (along, across): `along` runs out of the bar. A slanted tooth is a spike with its tip a little
 * off. */
typedef struct fork_pen {
    family_set *set;
    town_random *random;
    const fork_plan *plan;
    bool upwards, slanted;
} fork_pen;

static void put(const fork_pen *pen, int64_t along, int64_t across)
{
    if (pen->upwards)
        family_vertex(pen->set, across, along);
    else
        family_vertex(pen->set, along, across);
}

/* A tooth that occupies across..across + thick, walked in the order of increasing (forwards) or decreasing `across`. */
static void tooth(const fork_pen *pen, int64_t root, int64_t across, bool forwards)
{
    const int64_t thick = pen->plan->thick;
    const int64_t reach = pen->plan->length + (pen->slanted ? 0 : family_integer(pen->random, 0, 7));
    const int64_t a = forwards ? across : across + thick, b = forwards ? across + thick : across;
    put(pen, root, a);
    if (pen->slanted) {
        put(pen, reach, across + thick / 2 + family_integer(pen->random, -1, 1));
    } else {
        put(pen, reach, a);
        put(pen, reach, b);
    }
    put(pen, root, b);
}

/* P's fork: the upright is x = 0..4 with teeth to the right, the foot y = -4..0 runs to the left with teeth upwards. */
static void fork_p(family_set *set, town_random *random, size_t teeth, const fork_plan *f, bool slanted)
{
    fork_pen pen = {set, random, f, false, slanted};
    const int64_t pitch = f->pitch, top = f->at + (int64_t)teeth * pitch;
    family_vertex(set, -f->left - 4, -4);
    family_vertex(set, 4, -4);
    for (size_t i = 0; i < teeth; i++) tooth(&pen, 4, f->at + (int64_t)i * pitch, true);
    family_vertex(set, 4, top);
    family_vertex(set, 0, top);
    family_vertex(set, 0, 0);
    pen.upwards = true;
    for (size_t i = teeth; i-- > 0;) tooth(&pen, 0, -f->left + (int64_t)i * pitch, false);
    family_vertex(set, -f->left - 4, 0);
    family_end_member(set);
}

/* Q's: the upright is x = -4..0 with teeth to the right, the foot y = -4..0 runs to the right with its teeth at the far
 * end. */
static void fork_q(family_set *set, town_random *random, size_t teeth, const fork_plan *f, int64_t pitch, bool slanted)
{
    fork_pen pen = {set, random, f, true, slanted};
    const int64_t end = f->right + (int64_t)teeth * pitch, top = f->at + (int64_t)teeth * pitch;
    family_vertex(set, -4, -4);
    family_vertex(set, end, -4);
    family_vertex(set, end, 0);
    for (size_t i = teeth; i-- > 0;) tooth(&pen, 0, f->right + (int64_t)i * pitch, false);
    family_vertex(set, 0, 0);
    pen.upwards = false;
    for (size_t i = 0; i < teeth; i++) tooth(&pen, 0, f->at + (int64_t)i * pitch, true);
    family_vertex(set, 0, top);
    family_vertex(set, -4, top);
    family_end_member(set);
}

static void forks(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams, bool slanted)
{
    const fork_plan f = plan_fork(m, n, slanted);
    fork_p(p, &streams->p, fork_teeth(m, slanted), &f, slanted);
    fork_q(q, &streams->q, fork_teeth(n, slanted), &f, f.pitch * (int64_t)fork_teeth(m, slanted), slanted);
}

void family_fork(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    forks(p, q, m, n, streams, false);
}

/* The same with pointed teeth whose tips are a little off: hardly two edges are parallel. */
void family_slanted_fork(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    forks(p, q, m, n, streams, true);
}

/* The fork's grid, and over it the sum of a flat and a tall triangle: nearly a square that covers whatever two forks
 * can reach. The sum has order m + n vertices (forks peep out where the triangles' tips end), the arrangement beneath
 * it m^2 n^2. */
void family_covered_fork(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    const fork_plan f = plan_fork(m, n, false);
    const int64_t far = 2 * (f.right + f.extent + 2 * f.length), off = far / 4, thick = far / 96;
    forks(p, q, m, n, streams, false);
    family_vertex(p, -far, -off);
    family_vertex(p, far, -off);
    family_vertex(p, 0, thick - off);
    family_end_member(p);
    family_vertex(q, -off, -far);
    family_vertex(q, thick - off, 0);
    family_vertex(q, -off, far);
    family_end_member(q);
}
