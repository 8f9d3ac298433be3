/* ray_shooting.c: rays and visibility in a triangulated polygon, exactly: every test is the side of a vertex with
 * respect to a line through two lattice points (degree 2).
 *
 * A ray crosses one triangle after the other until it reaches a side without a neighbour. Visibility from one vertex:
 * each triangle around it has a window, its far side; beyond a window there is an apex, which is visible if it is
 * strictly between the two vertices that bound the view; it divides the view. The vertices that bound a view hide the
 * points behind them in the same direction. In a polygon without holes each triangle is entered once; with holes a
 * triangle may be entered through several windows. */
#include "decomposition/maker.h"

#include "base/watch.h"

#include <string.h>

/* The part of the plane that is visible from a vertex through half-edge h: the part between the rays to the vertices
 * right and left. The origin of h is on the viewer's right. */
typedef struct sunder_i_window {
    uint32_t h, right, left;
} sunder_i_window;

bool sunder_i_ray_shooting_init(sunder_i_ray_shooting *s, const sunder_i_rings *r, const sunder_i_member *member,
                                sunder_i_arena *arena)
{
    memset(s, 0, sizeof *s);
    s->r = r;
    s->first = member->first;
    s->n = member->n;
    s->start = sunder_i_arena_alloc(arena, member->n, sizeof *s->start);
    if (!s->start || !sunder_i_triangulate(r, member->ring_lo, member->ring_hi, arena, &s->mesh)) return false;
    for (uint32_t h = 0; h < s->mesh.halves; h++)
        if (s->mesh.twin[h] == SUNDER_I_NONE) s->start[s->mesh.origin[h] - s->first] = h;
    return true;
}

void sunder_i_ray_shooting_free(sunder_i_ray_shooting *s)
{
    sunder_i_free_all(s->seen, s->stack);
    s->seen = NULL;
    s->stack = NULL;
    s->seen_room = s->stack_room = 0;
}

/* Returns the next half-edge that leaves the same vertex, counterclockwise; SUNDER_I_NONE after the last triangle. */
static uint32_t turn_left(const sunder_i_mesh *m, uint32_t h) { return m->twin[m->prev[h]]; }

sunder_i_hit sunder_i_ray_shooting_shoot(const sunder_i_ray_shooting *s, uint32_t v, sunder_i_point toward)
{
    const sunder_i_mesh *m = &s->mesh;
    const sunder_i_rings *r = s->r;
    sunder_i_lattice *l = r->lattice;
    const sunder_i_point from = r->at[v];
    uint32_t h = s->start[v - s->first];
    for (; h != SUNDER_I_NONE; h = turn_left(m, h)) {
        const uint32_t b = m->origin[m->next[h]], c = m->origin[m->prev[h]];
        const int right = sunder_i_orient(l, from, toward, r->at[b]);
        if (right > 0 || sunder_i_orient(l, from, toward, r->at[c]) <= 0) continue;
        if (right == 0) return (sunder_i_hit){true, b};
        break;
    }
    if (h == SUNDER_I_NONE) return (sunder_i_hit){true, SUNDER_I_NONE};
    for (h = m->next[h];;) {
        const uint32_t g = m->twin[h];
        if (g == SUNDER_I_NONE) return (sunder_i_hit){false, m->origin[h]};
        const uint32_t apex = m->origin[m->prev[g]];
        const int side = sunder_i_orient(l, from, toward, r->at[apex]);
        if (side == 0) return (sunder_i_hit){true, apex};
        h = side > 0 ? m->next[g] : m->prev[g];
    }
}

static bool see_vertex(sunder_i_ray_shooting *s, uint32_t w)
{
    if (!sunder_i_reserve(&s->seen, &s->seen_room, (size_t)s->seen_n + 1, sizeof *s->seen)) return false;
    s->seen[s->seen_n++] = w;
    return true;
}

/* Returns true if everything between `right` and `left` is outside the cone. Each of the cone's two half-planes is
 * tested alone. */
static bool is_outside(const sunder_i_rings *r, uint32_t v, const sunder_i_window *w, const sunder_i_point *cone)
{
    sunder_i_lattice *l = r->lattice;
    const sunder_i_point a = sunder_i_point_sub(l, r->at[w->right], r->at[v]);
    const sunder_i_point b = sunder_i_point_sub(l, r->at[w->left], r->at[v]);
    if (sunder_i_cross_sign(l, cone[0], a) < 0 && sunder_i_cross_sign(l, cone[0], b) < 0) return true;
    return sunder_i_cross_sign(l, a, cone[1]) < 0 && sunder_i_cross_sign(l, b, cone[1]) < 0;
}

static bool push_window(sunder_i_ray_shooting *s, size_t *depth, uint32_t v, const sunder_i_point *cone,
                        sunder_i_window w)
{
    if (s->mesh.twin[w.h] == SUNDER_I_NONE || (cone && is_outside(s->r, v, &w, cone))) return true;
    if (!sunder_i_reserve(&s->stack, &s->stack_room, *depth + 1, sizeof *s->stack)) return false;
    s->stack[(*depth)++] = w;
    return true;
}

/* Processes the apex beyond a window: adds it to the visible vertices if it is one, and pushes the windows of its
 * triangle. Returns false if out of memory. */
static bool look_through(sunder_i_ray_shooting *s, size_t *depth, uint32_t v, const sunder_i_point *cone,
                         sunder_i_window w)
{
    const sunder_i_mesh *m = &s->mesh;
    const sunder_i_rings *r = s->r;
    sunder_i_lattice *l = r->lattice;
    const uint32_t g = m->twin[w.h], apex = m->origin[m->prev[g]];
    const int from_right = sunder_i_orient(l, r->at[v], r->at[w.right], r->at[apex]);
    const int from_left = sunder_i_orient(l, r->at[v], r->at[w.left], r->at[apex]);
    sunder_i_window right = {m->next[g], w.right, w.left}, left = {m->prev[g], w.right, w.left};
    if (from_right <= 0) return push_window(s, depth, v, cone, left);
    if (from_left >= 0) return push_window(s, depth, v, cone, right);
    right.left = left.right = apex;
    return see_vertex(s, apex) && push_window(s, depth, v, cone, left) && push_window(s, depth, v, cone, right);
}

bool sunder_i_ray_shooting_visible(sunder_i_ray_shooting *s, uint32_t v, const sunder_i_point *cone)
{
    const sunder_i_mesh *m = &s->mesh;
    size_t depth = 0;
    s->seen_n = 0;
    for (uint32_t h = s->start[v - s->first]; h != SUNDER_I_NONE; h = turn_left(m, h)) {
        const uint32_t b = m->origin[m->next[h]], c = m->origin[m->prev[h]];
        if (!see_vertex(s, b) || !push_window(s, &depth, v, cone, (sunder_i_window){m->next[h], b, c})) return false;
    }
    if (!see_vertex(s, s->r->prev[v])) return false;
    while (depth && !s->r->lattice->arena.failed)
        if (!sunder_i_step() || !look_through(s, &depth, v, cone, s->stack[--depth])) return false;
    return !s->r->lattice->arena.failed;
}
