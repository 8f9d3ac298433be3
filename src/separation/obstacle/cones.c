/* cones.c: see cones.h. An edge meets a vertex if its direction lies between those of the vertex's two edges.
 * Directions are converted to integers and a vertex to a range of them, and an edge meets the vertex if its number is
 * in the range. With many vertices, directions are divided into sectors, and an edge is tested only against the
 * vertices that meet its sector: one or two for a round outline. */
#include "separation/obstacle/cones.h"

#include <math.h>
#include <string.h>

#define SECTORS_FROM 64 /* fewer vertices are tested one by one */
#define SECTORS_MOST 65536
#define LISTED_MOST 4 /* the number of sectors that a vertex may be listed in, on average */
#define HALF_TURN 0x80000000u
/* The error of a direction: numbers are truncated, which is an error below 1, and the errors of doubles are far less
 * than another 1. */
#define CUT_OFF 2
/* The largest error of the direction of a difference of inexact coordinates; if it may be larger the direction is
 * vague. */
#define COARSE_SLACK 1024

/* Returns the largest error of the direction of an edge. */
static inline uint32_t slack_of(const sunder_i_operands *g)
{
    return g->coarse == 0 ? CUT_OFF : COARSE_SLACK + CUT_OFF;
}

/* Converts a vector to the number of its direction, without branches, since the quadrant cannot be predicted. The
 * quotient, in [-1, 1], increases with the angle in the right half-plane and decreases in the left one (as in
 * predicate/turn.h). */
static inline uint32_t direction_number(double dx, double dy, double size)
{
    const uint32_t t = (uint32_t)(int32_t)(dy / size * 0x1p30), left = -(uint32_t)(dx < 0);
    return (t ^ left) - left + (left & HALF_TURN);
}

sunder_i_direction sunder_i_direction_of(const sunder_i_operands *operands, double dx, double dy)
{
    const double size = fabs(dx) + fabs(dy);
    /* a point has no direction; that of an edge is unknown if the error of its ends may be as large as its length */
    if (!(size > 0) || (operands->coarse > 0 && !(4 * operands->coarse * 0x1p30 < COARSE_SLACK * size)))
        return (sunder_i_direction){0, true};
    return (sunder_i_direction){direction_number(dx, dy, size), false};
}

static sunder_i_direction edge_direction(const sunder_i_operands *g, int side, uint32_t v)
{
    const double *xy = g->xy[side], *a = xy + 2 * (size_t)v,
                 *b = xy + 2 * (size_t)g->shape[side]->form->cleaned.next[v];
    return sunder_i_direction_of(g, b[0] - a[0], b[1] - a[1]);
}

/* Computes the cone between the edges that arrive at a vertex and leave it, neither vague. Returns false if it is
 * certainly more than half a turn. */
static inline bool cone_between(uint32_t in, uint32_t out, uint32_t slack, sunder_i_cone *cone)
{
    const uint32_t turn = out - in + 2 * slack; /* at a straight angle the difference may be negative */
    *cone = (sunder_i_cone){in - 2 * slack, turn + 2 * slack};
    return turn <= HALF_TURN + 4 * slack;
}

bool sunder_i_cone_of(const sunder_i_operands *operands, int side, uint32_t vertex, sunder_i_cone *out)
{
    const sunder_i_direction a = edge_direction(operands, side, operands->shape[side]->form->cleaned.prev[vertex]),
                             b = edge_direction(operands, side, vertex);
    if (!a.vague && !b.vague) return cone_between(a.at, b.at, slack_of(operands), out);
    *out = (sunder_i_cone){0, UINT32_MAX};
    return true;
}

static bool make_room(sunder_i_operands *g, uint32_t n, sunder_i_cones *c)
{
    const size_t room = (size_t)n + SUNDER_I_LANES - 1;
    uint32_t *block = sunder_i_arena_alloc(&g->placed.lattice.arena, room, 4 * sizeof *block);
    if (!block) return false;
    *c =
        (sunder_i_cones){.direction = block, .vertex = block + room, .at = block + 2 * room, .width = block + 3 * room};
    for (uint32_t k = n; k < room; k++) c->at[k] = c->width[k] = 0;
    return true;
}

static inline sunder_i_cone cone_at(const sunder_i_cones *c, uint32_t k)
{
    return (sunder_i_cone){c->at[k], c->width[k]};
}

/* Stores cone number c->n; unless `has` is true the next one replaces it. */
static inline void put_cone(sunder_i_cones *c, uint32_t v, sunder_i_cone cone, bool has)
{
    c->vertex[c->n] = v;
    c->at[c->n] = cone.at;
    c->width[c->n] = cone.width;
    c->n += has;
}

/* ---- Sectors ---- */

/* Returns the first of the *n sectors that the cone meets, cyclically. */
static uint32_t sectors_of(sunder_i_cone cone, int shift, uint32_t *n)
{
    const uint32_t first = cone.at >> shift, all = (uint32_t)1 << (32 - shift);
    *n = (uint32_t)(((uint64_t)cone.at + cone.width) >> shift) - first + 1;
    if (*n > all) *n = all;
    return first;
}

/* Chooses the number of sectors, a power of two, such that a cone meets at most LISTED_MOST sectors on average. Returns
 * the shift that converts a direction to its sector, or 0 if sectors are not worth their cost. */
static int choose_sectors(const sunder_i_cones *c)
{
    if (c->n < SECTORS_FROM) return 0;
    int shift = 16;
    for (uint32_t sectors = SECTORS_MOST; sectors > 2 * c->n; sectors /= 2) shift++;
    for (; shift <= 28; shift += 2) {
        uint64_t listed = 0;
        for (uint32_t k = 0, n; k < c->n && listed <= (uint64_t)LISTED_MOST * c->n; k++) {
            sectors_of(cone_at(c, k), shift, &n);
            listed += n;
        }
        if (listed <= (uint64_t)LISTED_MOST * c->n) return shift;
        if (!sunder_i_steps(c->n / 16)) return 0;
    }
    return 0;
}

static bool list_sectors(sunder_i_operands *g, sunder_i_cones *c)
{
    const int shift = choose_sectors(c);
    if (!shift) return !g->placed.lattice.arena.failed;
    const uint32_t sectors = (uint32_t)1 << (32 - shift);
    uint32_t *end = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)sectors + 1, sizeof *end);
    if (!end) return false;
    memset(end, 0, ((size_t)sectors + 1) * sizeof *end);
    for (uint32_t k = 0; k < c->n; k++) {
        uint32_t n, at = sectors_of(cone_at(c, k), shift, &n);
        for (; n > 0; n--, at = (at + 1) % sectors) end[at + 1]++;
    }
    for (uint32_t i = 0; i < sectors; i++) end[i + 1] += end[i];
    c->sector = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)end[sectors] + 1, sizeof *c->sector);
    if (!c->sector) return false;
    for (uint32_t k = 0; k < c->n; k++) {
        uint32_t n, at = sectors_of(cone_at(c, k), shift, &n);
        for (; n > 0; n--, at = (at + 1) % sectors) c->sector[end[at]++] = k;
    }
    c->sector_end = end; /* here end[i] is the end of sector i */
    c->sectors = sectors;
    c->shift = shift;
    return true;
}

/* Computes all cones if the coordinates of the operand are exact in doubles, as on most lattices. Returns false if an
 * edge has no length. */
static bool find_exact(sunder_i_operands *g, int side, sunder_i_cones *c)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side];
    uint32_t *direction = c->direction;
    for (uint32_t v = 0; v < s->vertices; v++) {
        const double *a = xy + 2 * (size_t)v, *b = xy + 2 * (size_t)s->form->cleaned.next[v];
        const double dx = b[0] - a[0], dy = b[1] - a[1], size = fabs(dx) + fabs(dy);
        if (size == 0) return false;
        direction[v] = direction_number(dx, dy, size);
    }
    for (uint32_t v = 0; v < s->vertices; v++) {
        sunder_i_cone cone;
        const bool has = cone_between(direction[s->form->cleaned.prev[v]], direction[v], CUT_OFF, &cone);
        put_cone(c, v, cone, has);
    }
    return true;
}

static bool find_coarse(sunder_i_operands *g, int side, sunder_i_cones *c)
{
    const uint32_t vertices = g->shape[side]->vertices;
    c->vague = sunder_i_arena_alloc(&g->placed.lattice.arena, vertices, sizeof *c->vague);
    if (!c->vague) return false;
    c->n = 0;
    for (uint32_t v = 0; v < vertices; v++) {
        const sunder_i_direction d = edge_direction(g, side, v);
        c->direction[v] = d.at;
        c->vague[v] = d.vague;
        sunder_i_cone cone;
        const bool has = sunder_i_cone_of(g, side, v, &cone);
        put_cone(c, v, cone, has);
    }
    return true;
}

bool sunder_i_cones_find(sunder_i_operands *operands, int side, sunder_i_cones *cones)
{
    const uint32_t vertices = operands->shape[side]->vertices;
    if (!make_room(operands, vertices, cones) || !sunder_i_steps(vertices)) return false;
    if ((operands->coarse > 0 || !find_exact(operands, side, cones)) && !find_coarse(operands, side, cones))
        return false;
    return list_sectors(operands, cones);
}

/* ---- Queries ---- */

uint32_t sunder_i_cones_met(const sunder_i_cones *cones, sunder_i_direction edge, uint32_t *met, uint32_t *looked_at)
{
    uint32_t n = 0;
    /* without branches, since it cannot be predicted which vertices are met */
    if (cones->sectors && !edge.vague) {
        const uint32_t at = edge.at >> cones->shift;
        const uint32_t first = at ? cones->sector_end[at - 1] : 0, last = cones->sector_end[at];
        for (uint32_t i = first; i < last; i++) {
            met[n] = cones->sector[i];
            n += sunder_i_cone_meets(cone_at(cones, cones->sector[i]), edge);
        }
        *looked_at = last - first;
        return n;
    }
    const uint32_t all = *looked_at = cones->n;
    for (uint32_t k = 0; k < all; k++) {
        met[n] = k;
        n += sunder_i_cone_meets(cone_at(cones, k), edge);
    }
    return n;
}
