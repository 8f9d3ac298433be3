/* corners.c: the nodes, the vertices of the outline at which a shortest path can bend. At a plain corner two stretches
 * meet and O is on one side of them; a path bends there only around O, so that the corner is a node if O is convex
 * there. A vertex at which more than two stretches meet, or at which a degenerate stretch ends or joins others, is
 * always a node; where two degenerate stretches meet it is one if they are not collinear. */
#include "motion/corners.h"

#include "outline/coverage.h"

#include <string.h>

void sunder_i_corners_free(sunder_i_corners *corners)
{
    sunder_i_free_all(corners->place, corners->beside, corners->node, corners->parent);
    memset(corners, 0, sizeof *corners);
}

/* The number of stretches that end at a vertex, and the number of those that have O on both sides. */
typedef struct degree {
    uint32_t all, degenerate;
} degree;

static void count_degrees(const sunder_i_free_space *s, sunder_i_corners *c, degree *d)
{
    const uint8_t both = SUNDER_I_BANK_LEFT | SUNDER_I_BANK_RIGHT;
    for (size_t i = 0; i < s->stretches; i++) {
        const sunder_i_outline_stretch *e = &s->stretch[i];
        const uint32_t end[2] = {e->from, e->to};
        for (int k = 0; k < 2; k++) {
            d[end[k]].all++;
            d[end[k]].degenerate += e->banks == both;
        }
        /* `u` to `v` has O on its left; a degenerate stretch takes whichever entry of `beside` is still empty. */
        const bool turned = e->banks == SUNDER_I_BANK_RIGHT;
        const uint32_t u = end[turned], v = end[!turned];
        c->beside[u][e->banks == both && c->beside[u][1] != SUNDER_I_NO_PLACE ? 0 : 1] = v;
        c->beside[v][e->banks == both && c->beside[v][0] != SUNDER_I_NO_PLACE ? 1 : 0] = u;
    }
}

static bool is_node(const sunder_i_free_space *s, const sunder_i_corners *c, uint32_t v, const degree *d)
{
    if (d->all == 0) return false; /* a degenerate point: no path leads there */
    if (d->all != 2 || d->degenerate == 1) return true;
    const int turn =
        sunder_i_filtered_orient(&s->filter, &c->place[c->beside[v][0]], &c->place[v], &c->place[c->beside[v][1]]);
    return d->degenerate ? turn != 0 : turn > 0;
}

static bool is_same(const sunder_i_free_space *s, const sunder_i_corners *c, uint32_t u, uint32_t v)
{
    return sunder_i_filtered_cmp(&s->filter, &c->place[u], &c->place[v]) == 0;
}

static bool find_nodes(const sunder_i_free_space *s, sunder_i_corners *c)
{
    degree *d = sunder_i_calloc(c->vertices, sizeof *d);
    if (!d) return false;
    count_degrees(s, c, d);
    for (uint32_t v = 0; v < c->vertices; v++) {
        /* A vertex at the start or goal is no node: it would only repeat that end of the path. */
        if (is_node(s, c, v, &d[v]) && !is_same(s, c, v, c->vertices) && !is_same(s, c, v, c->vertices + 1))
            c->node[c->nodes++] = v;
        if (d[v].all != 2 || d[v].degenerate) c->beside[v][0] = c->beside[v][1] = SUNDER_I_NO_PLACE;
    }
    sunder_i_free(d);
    c->node[c->nodes++] = c->vertices;
    c->node[c->nodes++] = c->vertices + 1;
    return true;
}

/* Removes the nodes that are not in the component of the start. */
static void keep_reachable(sunder_i_corners *c)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < c->nodes; i++)
        if (c->node[i] >= c->vertices || sunder_i_corners_connected(c, c->node[i], c->vertices))
            c->node[n++] = c->node[i];
    c->nodes = n;
}

sunder_status sunder_i_corners_find(const sunder_i_free_space *space, const sunder_i_filtered_point *start,
                                    const sunder_i_filtered_point *goal, sunder_i_corners *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    const uint32_t n = out->vertices = space->sum->vertices;
    out->place = sunder_i_alloc((size_t)n + 2, sizeof *out->place);
    out->beside = sunder_i_alloc((size_t)n + 2, sizeof *out->beside);
    out->node = sunder_i_alloc((size_t)n + 2, sizeof *out->node);
    out->parent = sunder_i_alloc((size_t)n + 3, sizeof *out->parent);
    bool ok = out->place && out->beside && out->node && out->parent;
    if (ok) {
        for (uint32_t v = 0; v < n; v++)
            out->place[v] = sunder_i_filtered_of_vertex(space->filter.lattice, &space->sum->vertex[v]);
        out->place[n] = *start;
        out->place[n + 1] = *goal;
        memset(out->beside, 0xff, ((size_t)n + 2) * sizeof *out->beside);
        ok = !space->filter.lattice->arena.failed && find_nodes(space, out) && sunder_i_components_find(space, out) &&
             !space->filter.lattice->arena.failed;
    }
    if (ok) {
        keep_reachable(out);
        return SUNDER_OK;
    }
    sunder_i_corners_free(out);
    return sunder_i_failure_cause(err);
}
