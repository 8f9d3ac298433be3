/* link_sight.c: are the inner points of a link free of the boundary of its part?
 *
 * Links leave their ends to the side that is searched (part_links.c), so only edges between the ends matter. A link
 * that touches an edge or a vertex there is not clear. */
#include "legibility/legibility.h"

#include "base/watch.h"

bool sunder_i_link_clear(sunder_i_part_read *part, uint32_t v, uint32_t w, bool foot, sunder_i_point end,
                         sunder_i_list *near, bool *clear)
{
    sunder_i_lattice *l = &part->placed.lattice;
    double box[4], edge[4];
    sunder_i_part_edge_box(part, v, box);
    sunder_i_part_edge_box(part, w, edge);
    sunder_i_box_join(box, edge); /* around both ends: the foot lies on the edge w */
    near->n = 0;
    *clear = true;
    if (!sunder_i_rtree_query(&part->tree, box, near) || !sunder_i_steps(near->n)) return false;
    for (size_t k = 0; k < near->n && *clear; k++) {
        const uint32_t g = part->first + near->item[k], g_end = sunder_i_part_next(part, g);
        if (g == v || g_end == v || g == w || (!foot && g_end == w)) continue;
        *clear = sunder_i_segments_meet(l, sunder_i_part_at(part, v), end, sunder_i_part_at(part, g),
                                        sunder_i_part_at(part, g_end)) == SUNDER_I_APART;
    }
    return true;
}

/* ---- Links between antiparallel edges ---------------------------------------------------------------------------- */

/* A part of the line of edge e, from its place `low` to `high` in units of the edge, over which an edge lies between e
 * and f. */
typedef struct covered {
    sunder_i_fraction low, high;
} covered;

typedef struct strip {
    sunder_i_part_read *part;
    uint32_t e, f;
    sunder_i_fraction low, high; /* the part over which e and f face each other */
    sunder_i_point middle[2];    /* the ends of the link over its middle */
    covered *item;
    size_t n;
} strip;

static sunder_i_fraction place_of(const strip *s, uint32_t v)
{
    return sunder_i_foot(&s->part->placed.lattice, sunder_i_part_at(s->part, s->e),
                         sunder_i_part_at(s->part, sunder_i_part_next(s->part, s->e)), sunder_i_part_at(s->part, v));
}

/* Is a vertex between the lines of e and f, or on one of them? */
static bool is_between(const strip *s, uint32_t v)
{
    const sunder_i_part_read *p = s->part;
    sunder_i_lattice *l = &s->part->placed.lattice;
    const sunder_i_point at = sunder_i_part_at(p, v);
    const sunder_i_point a = sunder_i_part_at(p, s->e), b = sunder_i_part_at(p, sunder_i_part_next(p, s->e));
    const sunder_i_point c = sunder_i_part_at(p, s->f), d = sunder_i_part_at(p, sunder_i_part_next(p, s->f));
    /* the edges are antiparallel, so a point between them is on the same side of both as each is of the other */
    const int side = sunder_i_orient(l, a, b, c);
    return sunder_i_orient(l, a, b, at) * side >= 0 && sunder_i_orient(l, c, d, at) * side >= 0;
}

/* Sets `middle` to the link over the middle of the part. */
static void set_middle(strip *s)
{
    const sunder_i_part_read *p = s->part;
    sunder_i_lattice *l = &s->part->placed.lattice;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_point from[2] = {sunder_i_part_at(p, s->e), sunder_i_part_at(p, s->f)};
    const sunder_i_rational_point d =
        sunder_i_rational_diff(m, l, sunder_i_part_at(p, sunder_i_part_next(p, s->e)), from[0]);
    const sunder_i_ratio twice =
        sunder_i_ratio_add(m, sunder_i_fraction_read(m, l, &s->low), sunder_i_fraction_read(m, l, &s->high));
    const sunder_i_rational_point along = {sunder_i_big_mul(m, twice.num, d.x), sunder_i_big_mul(m, twice.num, d.y),
                                           sunder_i_big_shl(m, sunder_i_big_mul(m, twice.den, d.w), 1)};
    const sunder_i_rational_point at = sunder_i_rational_add(m, sunder_i_rational_get(m, l, from[0]), along);
    const sunder_i_rational_point c =
        sunder_i_rational_diff(m, l, sunder_i_part_at(p, sunder_i_part_next(p, s->f)), from[1]);
    const sunder_i_rational_point a = sunder_i_rational_sub(m, at, sunder_i_rational_get(m, l, from[1]));
    const sunder_i_big dot = sunder_i_rational_dot(m, a, c),
                       over = sunder_i_big_mul(m, sunder_i_rational_dot(m, c, c), a.w);
    const sunder_i_rational_point step = {sunder_i_big_mul(m, dot, c.x), sunder_i_big_mul(m, dot, c.y), over};
    s->middle[0] = sunder_i_rational_put(l, at);
    s->middle[1] = sunder_i_rational_put(l, sunder_i_rational_add(m, sunder_i_rational_get(m, l, from[1]), step));
    sunder_i_lattice_end(l, mark);
}

/* Adds what edge g covers. Over the part where e and f face each other no edge crosses either of them: there g is
 * between them with all of its points or with none. So an end of g there decides; if there is none, g passes over all
 * of the part, and meets the link over its middle or not. */
static void add_edge(strip *s, uint32_t g)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    const uint32_t end[2] = {g, sunder_i_part_next(s->part, g)};
    const sunder_i_fraction at[2] = {place_of(s, end[0]), place_of(s, end[1])};
    const int turned = sunder_i_fraction_cmp(l, &at[0], &at[1]) > 0;
    const covered c = {at[turned], at[!turned]};
    if (sunder_i_fraction_cmp(l, &c.high, &s->low) <= 0 || sunder_i_fraction_cmp(l, &c.low, &s->high) >= 0) return;
    bool decided = false, between = false;
    for (int k = 0; k < 2 && !decided; k++) {
        decided = sunder_i_fraction_cmp(l, &at[k], &s->low) > 0 && sunder_i_fraction_cmp(l, &at[k], &s->high) < 0;
        if (decided) between = is_between(s, end[k]);
    }
    if (!decided)
        between = sunder_i_segments_meet(l, s->middle[0], s->middle[1], sunder_i_part_at(s->part, end[0]),
                                         sunder_i_part_at(s->part, end[1])) != SUNDER_I_APART;
    if (between) s->item[s->n++] = c;
}

/* Inserts each covered part into those before it, sorted by their low ends: there are few. */
static void sort_covered(strip *s)
{
    for (size_t k = 1; k < s->n; k++)
        for (size_t i = k; i > 0; i--) {
            const covered c = s->item[i];
            if (sunder_i_fraction_cmp(&s->part->placed.lattice, &s->item[i - 1].low, &c.low) <= 0) break;
            s->item[i] = s->item[i - 1];
            s->item[i - 1] = c;
        }
}

/* Is an open interval between low and high not covered? Then *at is the middle of the widest one. */
static bool find_clear(strip *s, double *at)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    bool clear = false;
    double widest = -1;
    sunder_i_fraction end = s->low;
    sort_covered(s);
    for (size_t k = 0; k <= s->n; k++) {
        sunder_i_fraction to = k < s->n ? s->item[k].low : s->high;
        if (sunder_i_fraction_cmp(l, &to, &s->high) > 0) to = s->high;
        if (sunder_i_fraction_cmp(l, &to, &end) > 0) {
            if (to.value - end.value > widest) {
                widest = to.value - end.value;
                *at = end.value + widest / 2;
            }
            clear = true;
        }
        if (k < s->n && sunder_i_fraction_cmp(l, &s->item[k].high, &end) > 0) end = s->item[k].high;
    }
    return clear;
}

bool sunder_i_links_clear(sunder_i_part_read *part, uint32_t e, uint32_t f, uint32_t low, uint32_t high,
                          sunder_i_list *near, bool *clear, double *at)
{
    double box[4], other[4];
    strip s = {.part = part, .e = e, .f = f};
    sunder_i_part_edge_box(part, e, box);
    sunder_i_part_edge_box(part, f, other);
    sunder_i_box_join(box, other);
    near->n = 0;
    if (!sunder_i_rtree_query(&part->tree, box, near) || !sunder_i_steps(8 * near->n)) return false;
    s.item = sunder_i_alloc(near->n + 1, sizeof *s.item);
    if (!s.item) return false;
    s.low = place_of(&s, low);
    s.high = place_of(&s, high);
    set_middle(&s);
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t g = part->first + near->item[k];
        if (g != e && g != f) add_edge(&s, g);
    }
    *clear = find_clear(&s, at);
    sunder_i_free(s.item);
    return true;
}
