/* even_odd.c: the set that a polygon's rings enclose, by the even-odd rule or where their winding number is positive.
 *
 * arcs.c converts the edges to arcs that meet at their ends only, each with odd multiplicity: so exactly one side of
 * each arc is inside. A sweep over the points in lexicographic order keeps the arcs that it crosses sorted from bottom
 * to top; the number of arcs below an arc determines its inner side. Arcs are then directed with the inside on the
 * left. Around a point inside and outside alternate:
 *
 *        \ in      / out        an arc that comes in has the inside next to it in clockwise direction, and the next
 *      o  \   i   /  o          arc clockwise goes out: the two bound one sector of the interior, and the boundary
 *           \   /               continues from one to the other. So rings touch in points only, and a vertex
 *             p                 represents one sector.
 *
 * The first arc of a ring, in the order by lo and then from the bottom, begins at the ring's smallest point. The ring
 * is an outer one if the inside is above this arc; else it is a hole of the polygon whose ring is next below.
 *
 * For winding numbers a first sweep determines the number of the face below each arc. The arcs with the number positive
 * on one side only bound the set, and of these, again, exactly one side is inside. */
#include "shape/even_odd.h"

#include <string.h>

typedef struct sweep {
    const sunder_i_rings *r;
    const sunder_i_arcs *in;
    uint32_t *status, active; /* the arcs that cross the sweep line, from bottom to top */
    uint32_t *under;          /* for each arc the one directly below its beginning, or NONE */
    uint32_t *follow;         /* for each directed arc the next one on its ring */
    uint32_t *around;         /* temporary: the arcs at a point, counterclockwise */
    bool *up;                 /* whether the inside is above the arc, so that it is directed from lo to hi */
    int32_t *below;           /* the winding number of the face below each arc; NULL: not asked for */
} sweep;

/* Returns whether point p is above the line of the arc (+1), below it (-1), or its right end (0). */
static int side_of_arc(const sweep *s, uint32_t arc, uint32_t p)
{
    const sunder_i_arc *a = &s->in->arc[arc];
    if (a->hi == p) return 0;
    const sunder_i_rings *r = s->r;
    uint32_t left = a->parent, right = r->next[left];
    if (sunder_i_rings_cmp(r, left, right) > 0) {
        left = right;
        right = a->parent;
    }
    const uint32_t node = s->in->node[p];
    if (node & SUNDER_I_MADE)
        return sunder_i_orient_hpoint(r->lattice, r->at[left], r->at[right], &s->in->made[node & ~SUNDER_I_MADE]);
    return sunder_i_rings_orient(r, left, right, node);
}

/* Returns the number of active arcs below p. */
static uint32_t rank_of_point(const sweep *s, uint32_t p)
{
    uint32_t lo = 0, hi = s->active;
    while (lo < hi) {
        const uint32_t mid = lo + (hi - lo) / 2;
        if (side_of_arc(s, s->status[mid], p) > 0)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

/* Returns the winding number of the face below the active arc number `rank`: above the arc below it, if there is one,
 * whose own face is known. */
static int32_t winding_below(const sweep *s, uint32_t rank)
{
    if (rank == 0) return 0;
    const uint32_t under = s->status[rank - 1];
    return s->below[under] + s->in->arc[under].turn;
}

/* Processes point p: removes the arcs that end there, and inserts the arcs first .. last that begin there. */
static void pass_point(sweep *s, uint32_t p, uint32_t first, uint32_t last)
{
    const uint32_t at = rank_of_point(s, p), starts = last - first;
    uint32_t ends = 0;
    while (at + ends < s->active && s->in->arc[s->status[at + ends]].hi == p) ends++;
    uint32_t n = 0;
    for (uint32_t i = 0; i < starts; i++) s->around[n++] = first + i;
    for (uint32_t i = ends; i-- > 0;) s->around[n++] = s->status[at + i];
    memmove(s->status + at + starts, s->status + at + ends, (s->active - at - ends) * sizeof *s->status);
    s->active += starts - ends;
    for (uint32_t i = 0; i < starts; i++) {
        s->status[at + i] = first + i;
        s->up[first + i] = !((at + i) & 1);
        s->under[first + i] = at + i ? s->status[at + i - 1] : SUNDER_I_NONE;
        if (s->below) s->below[first + i] = winding_below(s, at + i);
    }
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t arc = s->around[i];
        const bool comes_in = (s->in->arc[arc].hi == p) == s->up[arc];
        if (comes_in) s->follow[arc] = s->around[i ? i - 1 : n - 1];
    }
}

/* Processes the points in order; only those at the ends of arcs matter. Returns false if out of memory. */
static bool run_sweep(sweep *s, sunder_i_arena *arena)
{
    const uint32_t n = s->in->arcs;
    uint32_t *block = sunder_i_arena_alloc(arena, 4 * (size_t)n, sizeof *block);
    s->up = sunder_i_arena_alloc(arena, n, sizeof *s->up);
    bool *meets = sunder_i_arena_alloc(arena, s->in->points, sizeof *meets);
    if (arena->failed) return false;
    s->status = block;
    s->under = block + n;
    s->follow = s->under + n;
    s->around = s->follow + n;
    memset(meets, 0, s->in->points * sizeof *meets);
    for (uint32_t i = 0; i < n; i++) meets[s->in->arc[i].lo] = meets[s->in->arc[i].hi] = true;
    for (uint32_t p = 0, first = 0, last = 0; p < s->in->points; p++, first = last) {
        while (last < n && s->in->arc[last].lo == p) last++;
        if (meets[p]) pass_point(s, p, first, last);
    }
    return !s->r->lattice->arena.failed;
}

/* ---- Rings from the directed arcs ---- */

typedef struct ring {
    uint32_t first, owner; /* its first arc; the outer ring of its polygon, which may be this ring itself */
    uint32_t next_hole;
} ring;

/* Returns whether two consecutive arcs are collinear, so that there is no corner between them; they do not run back
 * along each other, since no two arcs coincide. */
static bool is_straight(const sweep *s, uint32_t arc, uint32_t then)
{
    const sunder_i_rings *r = s->r;
    const uint32_t e = s->in->arc[arc].parent, f = s->in->arc[then].parent;
    if (e == f) return true;
    return sunder_i_cross_sign(r->lattice, sunder_i_point_sub(r->lattice, r->at[r->next[e]], r->at[e]),
                               sunder_i_point_sub(r->lattice, r->at[r->next[f]], r->at[f])) == 0;
}

/* Appends the corners of the ring through arc `first`: the beginnings of arcs, without straight ones. */
static void write_ring(const sweep *s, uint32_t first, sunder_i_even_odd *out)
{
    uint32_t arc = first;
    do {
        const uint32_t then = s->follow[arc];
        if (!is_straight(s, arc, then))
            out->point[out->points++] = s->in->node[s->up[then] ? s->in->arc[then].lo : s->in->arc[then].hi];
        arc = then;
    } while (arc != first);
    out->ring_end[out->rings++] = out->points;
}

static bool collect_rings(const sweep *s, sunder_i_arena *arena, sunder_i_even_odd *out)
{
    const uint32_t n = s->in->arcs;
    uint32_t *of = sunder_i_arena_alloc(arena, n, sizeof *of); /* the ring of each arc */
    ring *rings = sunder_i_arena_alloc(arena, n, sizeof *rings);
    uint32_t *last_hole = sunder_i_arena_alloc(arena, n, sizeof *last_hole);
    out->point = sunder_i_arena_alloc(arena, n, sizeof *out->point);
    out->ring_end = sunder_i_arena_alloc(arena, n, sizeof *out->ring_end);
    out->poly_end = sunder_i_arena_alloc(arena, n, sizeof *out->poly_end);
    if (arena->failed) return false;
    memset(of, 0xff, n * sizeof *of);
    uint32_t count = 0;
    for (uint32_t first = 0; first < n; first++) {
        if (of[first] != SUNDER_I_NONE) continue;
        uint32_t arc = first;
        do {
            of[arc] = count;
            arc = s->follow[arc];
        } while (arc != first);
        ring *g = &rings[count];
        *g = (ring){first, count, SUNDER_I_NONE};
        last_hole[count] = count;
        if (!s->up[first]) {
            /* the arc below begins farther left, so that its ring is known */
            g->owner = rings[of[s->under[first]]].owner;
            rings[last_hole[g->owner]].next_hole = count;
            last_hole[g->owner] = count;
        }
        count++;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (rings[i].owner != i) continue;
        for (uint32_t h = i; h != SUNDER_I_NONE; h = rings[h].next_hole) write_ring(s, rings[h].first, out);
        out->poly_end[out->polygons++] = out->rings;
    }
    return true;
}

static bool trace_rings(const sunder_i_rings *r, const sunder_i_arcs *arcs, sunder_i_arena *arena,
                        sunder_i_even_odd *out)
{
    sweep s = {.r = r, .in = arcs};
    if (!run_sweep(&s, arena) || !collect_rings(&s, arena, out)) return false;
    out->made = arcs->made;
    out->makes = arcs->makes;
    return !r->lattice->arena.failed;
}

bool sunder_i_even_odd_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_even_odd *out)
{
    sunder_i_arcs arcs;
    memset(out, 0, sizeof *out);
    if (r->rings == 0) return true;
    return sunder_i_arcs_find(r, false, arena, &arcs) && trace_rings(r, &arcs, arena, out);
}

/* Keeps the arcs that bound the set of positive winding numbers. */
static bool keep_boundary(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_arcs *arcs)
{
    sweep s = {.r = r, .in = arcs, .below = sunder_i_arena_alloc(arena, arcs->arcs, sizeof *s.below)};
    if (!s.below || !run_sweep(&s, arena)) return false;
    uint32_t kept = 0;
    for (uint32_t k = 0; k < arcs->arcs; k++) {
        const int32_t below = s.below[k], above = below + arcs->arc[k].turn;
        if ((below > 0) != (above > 0)) arcs->arc[kept++] = arcs->arc[k];
    }
    arcs->arcs = kept;
    return true;
}

bool sunder_i_winding_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_even_odd *out,
                           const uint32_t **crossing_of)
{
    sunder_i_arcs arcs;
    memset(out, 0, sizeof *out);
    if (crossing_of) *crossing_of = NULL;
    if (r->rings == 0) return true;
    if (!sunder_i_arcs_find(r, true, arena, &arcs) || !keep_boundary(r, arena, &arcs)) return false;
    if (crossing_of) *crossing_of = arcs.made_on;
    return trace_rings(r, &arcs, arena, out);
}
