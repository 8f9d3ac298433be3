/* A vertex is met by the edges whose directions lie between those of its two edges. Where there are many, directions
 * are put into sectors first, by a number that grows with the angle, so that an edge is asked of those vertices only
 * that meet some edge of its sector: of a round outline one or two. */
#include "separation/obstacle/cones.h"

#include "predicate/turn.h"

#include <math.h>
#include <string.h>

#define SECTORS_FROM 64 /* fewer are asked one by one */
#define SECTORS_MOST 65536
#define LISTED_MOST 4 /* times, on average, one may be listed */
/* Where a whole turn is 4. The number of an edge is rounded by less; an edge so short that its direction is uncertain
 * by more asks them all. */
#define TURN_SLACK 0x1p-20

static inline bool cone_of(const sunder_i_operands *g, int side, uint32_t v, sunder_i_cone *out)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], *a = xy + 2 * s->prev[v], *b = xy + 2 * v, *d = xy + 2 * s->next[v];
    const double in_x = b[0] - a[0], in_y = b[1] - a[1], out_x = d[0] - b[0], out_y = d[1] - b[1];
    const double bound = (fabs(in_x) + fabs(in_y)) * g->error + 8 * g->magnitude * g->coarse;
    /* A point by itself is its own neighbour: all edges meet it. */
    if (in_x * out_y - in_y * out_x <= -bound && s->next[v] != v) return false;
    *out = (sunder_i_cone){b[0], b[1], in_x, in_y, out_x, out_y};
    return true;
}

bool sunder_i_cone_of(const sunder_i_operands *g, int side, uint32_t vertex, sunder_i_cone *out)
{
    return cone_of(g, side, vertex, out);
}

static bool make_room(sunder_i_operands *g, uint32_t n, sunder_i_cones *c)
{
    double *block = sunder_i_arena_alloc(&g->placed.lattice.arena, n, 6 * sizeof *block + sizeof *c->vertex);
    if (!block) return false;
    *c = (sunder_i_cones){.vertex = (uint32_t *)(block + 6 * (size_t)n),
                          .x = block,
                          .y = block + n,
                          .in_x = block + 2 * (size_t)n,
                          .in_y = block + 3 * (size_t)n,
                          .out_x = block + 4 * (size_t)n,
                          .out_y = block + 5 * (size_t)n};
    return true;
}

/* ---- Sectors ---- */

/* How uncertain the direction of a difference of two vertices is; a quotient by zero, which is so, too. */
static double turn_error(const sunder_i_operands *g, double x, double y) { return 4 * g->coarse / (fabs(x) + fabs(y)); }

/* The sectors that cone k belongs to: *n from the one returned on, cyclically; all where its edges do not say. */
static uint32_t sectors_of(const sunder_i_operands *g, const sunder_i_cones *c, uint32_t k, uint32_t sectors,
                           uint32_t *n)
{
    const double error = turn_error(g, c->in_x[k], c->in_y[k]) + turn_error(g, c->out_x[k], c->out_y[k]);
    const double slack = 2 * TURN_SLACK + error;
    const double from = sunder_i_turn(c->in_x[k], c->in_y[k]) - slack;
    double width = sunder_i_turn(c->out_x[k], c->out_y[k]) + slack - from;
    if (width < 0) width += 4;
    *n = sectors;
    if (!(slack < 0.25) || width >= 4) return 0;
    const double scale = sectors / 4.0, first = floor(from * scale);
    *n = (uint32_t)(floor((from + width) * scale) - first) + 1;
    if (*n > sectors) *n = sectors;
    return (uint32_t)(int64_t)(first < 0 ? first + sectors : first) % sectors;
}

/* So many sectors that cones are listed a few times each; 0: not worth it. */
static uint32_t choose_sectors(const sunder_i_operands *g, const sunder_i_cones *c)
{
    if (c->n < SECTORS_FROM) return 0;
    uint32_t sectors = SECTORS_MOST;
    while (sectors > 2 * c->n) sectors /= 2;
    for (; sectors >= 16; sectors /= 4) {
        uint64_t listed = 0;
        for (uint32_t k = 0, n; k < c->n && listed <= (uint64_t)LISTED_MOST * c->n; k++) {
            sectors_of(g, c, k, sectors, &n);
            listed += n;
        }
        if (listed <= (uint64_t)LISTED_MOST * c->n) return sectors;
        if (!sunder_i_steps(c->n / 16)) return 0;
    }
    return 0;
}

static bool list_sectors(sunder_i_operands *g, sunder_i_cones *c)
{
    const uint32_t sectors = choose_sectors(g, c);
    if (!sectors) return !g->placed.lattice.arena.failed;
    uint32_t *end = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)sectors + 1, sizeof *end);
    if (!end) return false;
    memset(end, 0, ((size_t)sectors + 1) * sizeof *end);
    for (uint32_t k = 0; k < c->n; k++) {
        uint32_t n, at = sectors_of(g, c, k, sectors, &n);
        for (; n > 0; n--, at = (at + 1) % sectors) end[at + 1]++;
    }
    for (uint32_t i = 0; i < sectors; i++) end[i + 1] += end[i];
    c->sector = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)end[sectors] + 1, sizeof *c->sector);
    if (!c->sector) return false;
    for (uint32_t k = 0; k < c->n; k++) {
        uint32_t n, at = sectors_of(g, c, k, sectors, &n);
        for (; n > 0; n--, at = (at + 1) % sectors) c->sector[end[at]++] = k;
    }
    c->sector_end = end; /* end[i] has become the end of sector i */
    c->sectors = sectors;
    return true;
}

bool sunder_i_cones_find(sunder_i_operands *g, int side, sunder_i_cones *c)
{
    const sunder_shape *s = g->shape[side];
    if (!make_room(g, s->vertices, c)) return false;
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (!sunder_i_step()) return false;
        sunder_i_cone at;
        if (!cone_of(g, side, v, &at)) continue;
        const uint32_t k = c->n++;
        c->vertex[k] = v;
        c->x[k] = at.x;
        c->y[k] = at.y;
        c->in_x[k] = at.in_x;
        c->in_y[k] = at.in_y;
        c->out_x[k] = at.out_x;
        c->out_y[k] = at.out_y;
    }
    return list_sectors(g, c);
}

/* ---- Asking ---- */

static inline bool meets(const sunder_i_cones *c, uint32_t k, double dx, double dy, double bound)
{
    return (c->in_x[k] * dy - c->in_y[k] * dx >= bound) & (dx * c->out_y[k] - dy * c->out_x[k] >= bound);
}

uint32_t sunder_i_cones_met(const sunder_i_operands *g, const sunder_i_cones *c, double dx, double dy, uint32_t *met,
                            uint32_t *looked_at)
{
    const double bound = -(fabs(dx) + fabs(dy)) * g->error - 8 * g->magnitude * g->coarse;
    uint32_t n = 0;
    /* Without branches: which corners pass is anyone's guess. */
    if (c->sectors && turn_error(g, dx, dy) < TURN_SLACK) {
        const uint32_t at = (uint32_t)(sunder_i_turn(dx, dy) * (c->sectors / 4.0)) % c->sectors;
        const uint32_t first = at ? c->sector_end[at - 1] : 0, last = c->sector_end[at];
        for (uint32_t i = first; i < last; i++) {
            met[n] = c->sector[i];
            n += meets(c, c->sector[i], dx, dy, bound);
        }
        *looked_at = last - first;
        return n;
    }
    for (uint32_t k = 0; k < c->n; k++) {
        met[n] = k;
        n += meets(c, k, dx, dy, bound);
    }
    *looked_at = c->n;
    return n;
}
