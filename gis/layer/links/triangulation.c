/* triangulation.c: points are added from left to right. Each is beyond the boundary of the triangles so far: it is
 * joined to all edges of the boundary that it sees. Then every edge opposite to it is replaced by the other diagonal of
 * its two triangles as long as the circle through one of them contains the fourth corner (Lawson).
 *
 *        w             Seen from q the boundary's edge vw goes clockwise: q is to its right.
 *       / \
 *      /   q           Invariants: the boundary is a cycle of next[], prev[]; outer[v] is the triangle at the edge from
 *     / t /            v to next[v]; the point added last is on the boundary, since it is the rightmost one.
 *    v---/
 *
 * Degenerate cases: points on one line to begin with wait for the first that is not on it, and are all joined to it. A
 * point on the line of an edge does not see it. Four points on a circle: no flip. */
#include "layer/links/triangulation.h"

#include <stdlib.h>

__extension__ typedef __int128 wide;

static wide area(gis_grid_point a, gis_grid_point b, gis_grid_point c)
{
    return (wide)(b.x - a.x) * (c.y - a.y) - (wide)(b.y - a.y) * (c.x - a.x);
}

double gis_grid_area(gis_grid_point a, gis_grid_point b, gis_grid_point c) { return (double)area(a, b, c); }

/* Is d within the circle through a, b, c, which are counter-clockwise? Differences have 31 bits with their sign, so the
 * determinant has less than 126. */
static bool in_circle(gis_grid_point a, gis_grid_point b, gis_grid_point c, gis_grid_point d)
{
    const int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
    const wide bc = (wide)bx * cy - (wide)by * cx, ca = (wide)cx * ay - (wide)cy * ax,
               ab = (wide)ax * by - (wide)ay * bx;
    return ((wide)ax * ax + (wide)ay * ay) * bc + ((wide)bx * bx + (wide)by * by) * ca +
               ((wide)cx * cx + (wide)cy * cy) * ab >
           0;
}

typedef struct sweep {
    gis_triangulation *of;
    size_t *next, *prev, *outer; /* [n] */
    size_t *open, opens;         /* triangles of the new point whose opposite edges have to be looked at */
} sweep;

static int side(const sweep *s, size_t a, size_t b, size_t c)
{
    const gis_grid_point *p = s->of->point;
    const wide twice = area(p[a], p[b], p[c]);
    return (twice > 0) - (twice < 0);
}

static int slot_of(const size_t *three, size_t wanted) { return three[0] == wanted ? 0 : three[1] == wanted ? 1 : 2; }

/* Makes the triangle abc, counter-clockwise, with these beyond the edges bc, ca and ab. */
static size_t add_triangle(sweep *s, const size_t corner[3], const size_t beyond[3])
{
    gis_triangulation *all = s->of;
    gis_triangle *t = &all->triangle[all->triangles];
    for (int k = 0; k < 3; k++) {
        t->corner[k] = corner[k];
        t->beyond[k] = beyond[k];
    }
    return all->triangles++;
}

/* ---- Flips ------------------------------------------------------------------------------------------------------- */

static void replace_beyond(sweep *s, size_t triangle, size_t old, size_t new)
{
    if (triangle == GIS_NO_TRIANGLE) return;
    size_t *beyond = s->of->triangle[triangle].beyond;
    beyond[slot_of(beyond, old)] = new;
}

static void note_outer_edges(sweep *s, size_t triangle)
{
    const gis_triangle *t = &s->of->triangle[triangle];
    for (int k = 0; k < 3; k++)
        if (t->beyond[k] == GIS_NO_TRIANGLE) s->outer[t->corner[(k + 1) % 3]] = triangle;
}

/* Triangle t is q, a, b, with q at slot k, and u beyond ab is d, b, a. They become q, a, d and q, d, b. */
static void flip(sweep *s, size_t t, int k)
{
    gis_triangle *p = &s->of->triangle[t];
    const size_t u = p->beyond[k];
    gis_triangle *o = &s->of->triangle[u];
    const int m = slot_of(o->beyond, t);
    const size_t q = p->corner[k], a = p->corner[(k + 1) % 3], b = p->corner[(k + 2) % 3], d = o->corner[m];
    const size_t at_qa = p->beyond[(k + 2) % 3], at_bq = p->beyond[(k + 1) % 3], at_ad = o->beyond[(m + 1) % 3],
                 at_db = o->beyond[(m + 2) % 3];
    *p = (gis_triangle){{q, a, d}, {at_ad, u, at_qa}};
    *o = (gis_triangle){{q, d, b}, {at_db, at_bq, t}};
    replace_beyond(s, at_ad, u, t);
    replace_beyond(s, at_bq, t, u);
    note_outer_edges(s, t);
    note_outer_edges(s, u);
}

/* Flips edges opposite to q until none has to be. Each open triangle has q as a corner, and keeps it. */
static void settle(sweep *s, size_t q)
{
    const gis_grid_point *at = s->of->point;
    while (s->opens) {
        const size_t t = s->open[--s->opens];
        const gis_triangle *p = &s->of->triangle[t];
        const int k = slot_of(p->corner, q);
        const size_t u = p->beyond[k];
        if (u == GIS_NO_TRIANGLE) continue;
        const gis_triangle *o = &s->of->triangle[u];
        const size_t d = o->corner[slot_of(o->beyond, t)];
        if (!in_circle(at[p->corner[0]], at[p->corner[1]], at[p->corner[2]], at[d])) continue;
        flip(s, t, k);
        s->open[s->opens++] = t;
        s->open[s->opens++] = u;
    }
}

/* ---- The sweep --------------------------------------------------------------------------------------------------- */

/* Joins q to the boundary's edges from `first` to `last`, in its order, and puts q in their place. */
static void join(sweep *s, size_t first, size_t last, size_t q)
{
    size_t before = GIS_NO_TRIANGLE;
    for (size_t v = first, w; v != last; v = w) {
        w = s->next[v];
        const size_t inner = s->outer[v];
        const size_t t = add_triangle(s, (size_t[]){w, v, q}, (size_t[]){before, GIS_NO_TRIANGLE, inner});
        if (before != GIS_NO_TRIANGLE) s->of->triangle[before].beyond[1] = t;
        if (inner != GIS_NO_TRIANGLE) {
            gis_triangle *o = &s->of->triangle[inner];
            o->beyond[(slot_of(o->corner, v) + 2) % 3] = t;
        }
        if (v == first) s->outer[first] = t;
        s->outer[q] = before = t;
        s->open[s->opens++] = t;
    }
    s->next[first] = s->prev[last] = q;
    s->next[q] = last;
    s->prev[q] = first;
    settle(s, q);
}

/* Joins q, the first point that is not on the line of all points before it, to these. They are a boundary without
 * triangles, along which q sees all edges. */
static void begin(sweep *s, size_t q)
{
    const bool left = side(s, 0, 1, q) > 0;
    for (size_t v = 0; v < q; v++) {
        s->outer[v] = GIS_NO_TRIANGLE;
        s->next[v] = left ? v - 1 : v + 1; /* of the last one overwritten by join() */
        s->prev[v] = left ? v + 1 : v - 1;
    }
    const size_t first = left ? q - 1 : 0, last = left ? 0 : q - 1;
    join(s, first, last, q);
    /* The edges of the line are on the boundary themselves, in the other direction. */
    for (size_t v = last; v != first; v = left ? v + 1 : v - 1) {
        s->next[v] = left ? v + 1 : v - 1;
        s->prev[s->next[v]] = v;
    }
    s->next[first] = q;
    s->prev[q] = first;
    s->next[q] = last;
    s->prev[last] = q;
    for (size_t t = 0; t < s->of->triangles; t++) note_outer_edges(s, t);
}

static void add_point(sweep *s, size_t q)
{
    size_t first = q - 1, last = q - 1;
    while (side(s, s->prev[first], first, q) < 0) first = s->prev[first];
    while (side(s, last, s->next[last], q) < 0) last = s->next[last];
    join(s, first, last, q);
}

static void list_rim(const sweep *s, bool line)
{
    gis_triangulation *all = s->of;
    for (size_t v = 0; line && v < all->n; v++) all->rim[all->rims++] = v;
    for (size_t v = 0; !line && (v != 0 || all->rims == 0); v = s->next[v]) all->rim[all->rims++] = v;
}

bool gis_triangulate(const gis_grid_point *point, size_t n, gis_triangulation *out)
{
    *out = (gis_triangulation){.point = point, .n = n};
    out->triangle = malloc((2 * n + 1) * sizeof *out->triangle);
    out->rim = malloc((n + 1) * sizeof *out->rim);
    size_t *links = malloc((3 * n + 1) * sizeof *links), *open = malloc((4 * n + 4) * sizeof *open);
    const bool ok = out->triangle && out->rim && links && open;
    if (ok) {
        sweep s = {.of = out, .next = links, .prev = links + n, .outer = links + 2 * n, .open = open};
        size_t q = 2;
        while (q < n && side(&s, 0, 1, q) == 0) q++;
        if (q < n) begin(&s, q);
        for (size_t v = q + 1; v < n; v++) add_point(&s, v);
        list_rim(&s, q >= n);
    }
    free(links);
    free(open);
    return ok;
}

void gis_triangulation_clear(gis_triangulation *triangulation)
{
    free(triangulation->triangle);
    free(triangulation->rim);
    *triangulation = (gis_triangulation){0};
}

/* Goes on across an edge that has p on its other side; in a Delaunay triangulation this ends. */
size_t gis_triangulation_locate(const gis_triangulation *triangulation, gis_grid_point p, size_t *hint)
{
    size_t t = *hint < triangulation->triangles ? *hint : triangulation->triangles ? 0 : GIS_NO_TRIANGLE;
    while (t != GIS_NO_TRIANGLE) {
        const gis_triangle *at = &triangulation->triangle[t];
        const gis_grid_point *point = triangulation->point;
        int k = 0;
        while (k < 3 && area(point[at->corner[(k + 1) % 3]], point[at->corner[(k + 2) % 3]], p) >= 0) k++;
        *hint = t;
        if (k == 3) return t;
        t = at->beyond[k];
    }
    return GIS_NO_TRIANGLE;
}
