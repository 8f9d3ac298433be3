/* cuts.c: makes pieces from cuts: the polygon's edges and the cuts form a planar subdivision with half-edges, and its
 * faces are the pieces.
 *
 * First the lines: each edge and each cut is a line with its two ends and the Steiner points where other cuts end on
 * it, sorted along the line; coincident ones become one node (fractions of degree 2, compared in degree 4). Each
 * stretch of a line between two such nodes is a pair of half-edges. Then the half-edges that leave each node are sorted
 * by angle: around a vertex from its outgoing edge counterclockwise through its sector to its incoming one, around a
 * Steiner point from the direction of its line through a full turn. Directions are lattice vectors, so that this has
 * degree 2. The half-edge after an arriving one is the half-edge that leaves directly before, counterclockwise, the
 * opposite direction.
 *
 * Degenerate cases. Two cuts that end at one point of a line, from one side or from both, have one node. If a cut ends
 * where another one does, at a vertex, that vertex has several cuts in its sector. Points that coincide but belong to
 * different sectors (rings that touch) are different vertices and remain so. Straight corners, at which a cut ends on
 * the other side of a line or which extend an edge, are omitted from the pieces (sunder_i_maker_end_piece()). */
#include "base/sort.h"
#include "decomposition/maker.h"

#include <string.h>

typedef struct subdivision {
    sunder_i_maker *m;
    const sunder_i_member *part;
    const sunder_i_cut *cut;
    uint32_t cuts, lines;         /* the lines are the polygon's edges, numbered by their first vertices, then the
                                   * cuts */
    sunder_i_point *along, *back; /* [lines] the vector of each line, and its negative */
    uint32_t *order;              /* [cuts] the cuts that end at Steiner points, by line and position */
    uint32_t steiner_ends, nodes; /* nodes: the vertices, then the Steiner points */
    uint32_t *end_node;           /* [cuts] the node at which each cut ends */
    uint32_t *node_corner;        /* [cuts] the corner number of Steiner node n + i */
    uint32_t *line_of;            /* [cuts] the line of Steiner node n + i */
    uint32_t *line_steiner;       /* [lines + 1] the index of the first Steiner node of each line */
    uint32_t *line_half;          /* [lines + 1] the first half-edge of each line: there are 2 for each stretch, forward
                                   * and backward */
    uint32_t *out_first, *out;    /* [nodes + 1], [halves] the half-edges that leave each node */
    uint32_t *node, *next;        /* [halves] the node at which a half-edge starts; the half-edge that follows it around
                                   * its face */
    uint32_t *line;               /* [halves] the line of a half-edge */
} subdivision;

bool sunder_i_cut_run(sunder_i_cut *cut, const sunder_i_ray_shooting *rays)
{
    const sunder_i_rings *r = rays->r;
    sunder_i_lattice *l = r->lattice;
    const sunder_i_point from = r->at[cut->from];
    const sunder_i_hit hit = sunder_i_ray_shooting_shoot(rays, cut->from, cut->toward);
    if (hit.which == SUNDER_I_NONE) return false;
    cut->at = hit.which;
    if (hit.at_vertex) {
        cut->end = SUNDER_I_AT_VERTEX;
        cut->length = sunder_i_along(l, from, cut->toward, r->at[hit.which]);
        return true;
    }
    const sunder_i_point a = r->at[hit.which], b = r->at[r->next[hit.which]];
    cut->end = SUNDER_I_ON_EDGE;
    cut->length = sunder_i_crossing(l, from, cut->toward, a, b);
    cut->on = sunder_i_crossing(l, a, b, from, cut->toward);
    return true;
}

int sunder_i_around(sunder_i_lattice *lattice, sunder_i_point ref, sunder_i_point a, sunder_i_point b)
{
    const sunder_i_point u[2] = {a, b};
    int quarter[2];
    for (int k = 0; k < 2; k++) {
        const int side = sunder_i_cross_sign(lattice, ref, u[k]);
        quarter[k] = side > 0 ? 1 : side < 0 ? 3 : sunder_i_dot_sign(lattice, ref, u[k]) > 0 ? 0 : 2;
    }
    if (quarter[0] != quarter[1]) return quarter[0] < quarter[1] ? -1 : 1;
    return -sunder_i_cross_sign(lattice, a, b);
}

/* Returns the line on which the cut ends. */
static uint32_t line_hit(const subdivision *s, uint32_t cut)
{
    const sunder_i_cut *c = &s->cut[cut];
    return c->end == SUNDER_I_ON_EDGE ? c->at - s->part->first : s->part->n + c->at;
}

static int compare_ends(void *context, uint32_t a, uint32_t b)
{
    const subdivision *s = context;
    const uint32_t la = line_hit(s, a), lb = line_hit(s, b);
    if (la != lb) return la < lb ? -1 : 1;
    return sunder_i_fraction_cmp(s->m->lattice, &s->cut[a].on, &s->cut[b].on);
}

/* Makes the Steiner nodes: the ends of cuts, one for each point of a line. Returns false if out of memory. */
static bool find_nodes(subdivision *s)
{
    const uint32_t n = s->part->n;
    sunder_i_lattice *l = s->m->lattice;
    for (uint32_t c = 0; c < s->cuts; c++) {
        if (s->cut[c].end == SUNDER_I_AT_VERTEX)
            s->end_node[c] = s->cut[c].at - s->part->first;
        else
            s->order[s->steiner_ends++] = c;
    }
    if (!sunder_i_sort_indices(s->order, s->steiner_ends, compare_ends, s)) return false;
    uint32_t made = 0, line = 0;
    for (uint32_t i = 0; i < s->steiner_ends; i++) {
        const uint32_t c = s->order[i], hit = line_hit(s, c);
        while (line <= hit) s->line_steiner[line++] = made;
        if (i > 0 && compare_ends(s, s->order[i - 1], c) == 0) {
            s->end_node[c] = n + made - 1;
            continue;
        }
        const sunder_i_cut *cut = &s->cut[c];
        s->node_corner[made] = sunder_i_maker_add_steiner(s->m, s->m->rings.at[cut->from], cut->toward, &cut->length);
        s->line_of[made] = hit;
        s->end_node[c] = n + made++;
    }
    while (line <= s->lines) s->line_steiner[line++] = made;
    s->nodes = n + made;
    return !l->arena.failed;
}

/* Stores the first and the last node of a line in `ends`. */
static void line_ends(const subdivision *s, uint32_t line, uint32_t ends[2])
{
    const sunder_i_rings *r = &s->m->rings;
    const uint32_t n = s->part->n, first = s->part->first;
    if (line < n) {
        ends[0] = line;
        ends[1] = r->next[first + line] - first;
    } else {
        ends[0] = s->cut[line - n].from - first;
        ends[1] = s->end_node[line - n];
    }
}

static void make_halves(subdivision *s)
{
    uint32_t h = 0;
    for (uint32_t line = 0; line < s->lines; line++) {
        uint32_t ends[2];
        line_ends(s, line, ends);
        s->line_half[line] = h;
        uint32_t from = ends[0];
        for (uint32_t k = s->line_steiner[line]; k <= s->line_steiner[line + 1]; k++) {
            const uint32_t to = k < s->line_steiner[line + 1] ? s->part->n + k : ends[1];
            s->node[h] = from;
            s->node[h + 1] = to;
            s->line[h] = s->line[h + 1] = line;
            from = to;
            h += 2;
        }
    }
    s->line_half[s->lines] = h;
}

static sunder_i_point half_along(const subdivision *s, uint32_t h)
{
    return h & 1 ? s->back[s->line[h]] : s->along[s->line[h]];
}

/* Sorts the half-edges that leave each node, and links the faces. */
static void link_halves(subdivision *s)
{
    sunder_i_lattice *l = s->m->lattice;
    const uint32_t halves = s->line_half[s->lines];
    memset(s->out_first, 0, ((size_t)s->nodes + 1) * sizeof *s->out_first);
    for (uint32_t h = 0; h < halves; h++) s->out_first[s->node[h] + 1]++;
    for (uint32_t i = 0; i < s->nodes; i++) s->out_first[i + 1] += s->out_first[i];
    for (uint32_t h = 0; h < halves; h++) s->out[s->out_first[s->node[h]]++] = h;
    for (uint32_t i = s->nodes; i > 0; i--) s->out_first[i] = s->out_first[i - 1];
    s->out_first[0] = 0;
    for (uint32_t i = 0; i < s->nodes; i++) {
        const sunder_i_point ref = s->along[i < s->part->n ? i : s->line_of[i - s->part->n]];
        uint32_t *out = s->out + s->out_first[i];
        const uint32_t n = s->out_first[i + 1] - s->out_first[i];
        for (uint32_t k = 1; k < n; k++) {
            const uint32_t h = out[k];
            uint32_t j = k;
            for (; j > 0 && sunder_i_around(l, ref, half_along(s, out[j - 1]), half_along(s, h)) > 0; j--)
                out[j] = out[j - 1];
            out[j] = h;
        }
        for (uint32_t k = 0; k < n; k++) s->next[out[k] ^ 1] = out[k ? k - 1 : n - 1];
    }
}

static void add_faces(subdivision *s)
{
    const uint32_t n = s->part->n;
    for (uint32_t h = 0; h < s->line_half[s->lines]; h++) {
        /* done already, or outside the polygon */
        if (s->node[h] == SUNDER_I_NONE || (h & 1 && s->line[h] < n)) continue;
        for (uint32_t g = h; s->node[g] != SUNDER_I_NONE; g = s->next[g]) {
            const uint32_t at = s->node[g];
            sunder_i_maker_add_side(s->m, at < n ? s->part->first + at : s->node_corner[at - n], half_along(s, g));
            s->node[g] = SUNDER_I_NONE;
        }
        sunder_i_maker_end_piece(s->m);
    }
}

/* Allocates all arrays in the maker's scratch memory. Returns false if out of memory. */
static bool make_room(subdivision *s)
{
    sunder_i_arena *arena = &s->m->scratch;
    const size_t n = s->part->n, cuts = s->cuts, lines = n + cuts, halves = 2 * (lines + cuts);
    s->lines = (uint32_t)lines;
    s->along = sunder_i_arena_alloc(arena, 2 * lines, sizeof *s->along);
    s->back = s->along ? s->along + lines : NULL;
    uint32_t **const array[] = {&s->order,        &s->end_node,  &s->node_corner, &s->line_of,
                                &s->line_steiner, &s->line_half, &s->out_first,   &s->out,
                                &s->node,         &s->next,      &s->line};
    const size_t size[] = {cuts, cuts, cuts, cuts, lines + 1, lines + 1, n + cuts + 1, halves, halves, halves, halves};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++)
        *array[k] = sunder_i_arena_alloc(arena, size[k], sizeof **array[k]);
    return !arena->failed;
}

void sunder_i_cuts_apply(sunder_i_maker *m, const sunder_i_member *member, const sunder_i_cut *cut, uint32_t n)
{
    const sunder_i_rings *r = &m->rings;
    subdivision s = {.m = m, .part = member, .cut = cut, .cuts = n};
    if (!make_room(&s)) return;
    for (uint32_t i = 0; i < s.lines; i++) {
        const uint32_t v = member->first + i;
        s.along[i] =
            i < member->n ? sunder_i_point_sub(m->lattice, r->at[r->next[v]], r->at[v]) : cut[i - member->n].along;
        s.back[i] = sunder_i_point_neg(m->lattice, s.along[i]);
    }
    if (!find_nodes(&s)) {
        m->scratch.failed = true;
        return;
    }
    make_halves(&s);
    link_halves(&s);
    if (!sunder_i_maker_failed(m)) add_faces(&s);
}
