/* canonical_sum.c: the canonical form: all rings are sorted once and then assigned to their polygons in that order;
 * segments and points are sorted directly. */
#include "sum/canonical_sum.h"

#include "base/sort.h"

#include <float.h>
#include <math.h>
#include <string.h>

int sunder_i_sum_vertex_cmp(void *context, uint32_t v, uint32_t w)
{
    sunder_sum *sum = context;
    return v == w ? 0 : sunder_i_hpoint_cmp(&sum->lattice, &sum->vertex[v], &sum->vertex[w]);
}

/* ---- Rings ---- */

static int compare_rings(void *context, uint32_t a, uint32_t b)
{
    const sunder_i_found *f = context;
    const sunder_i_found_ring *r = &f->ring[a], *s = &f->ring[b];
    const size_t m = r->end - r->start, n = s->end - s->start;
    for (size_t i = 0; i < m && i < n; i++) {
        const int c = f->compare(f->context, f->vertex[r->start + i], f->vertex[s->start + i]);
        if (c) return c;
    }
    return (m > n) - (m < n);
}

/* For the coordinates of two points, each with a relative error of at most 2^-50: returns true if b, which is not below
 * a as a double, may be at most a. */
static bool is_open(double a, double b) { return b - a <= SUNDER_I_DOUBT(0x1p-49 * (fabs(a) + fabs(b)) + DBL_MIN); }

static const sunder_i_hpoint *first_place(const sunder_i_found *f, uint32_t ring)
{
    return &f->place[f->vertex[f->ring[ring].start]];
}

/* Sorts n rings by exact coordinates, since doubles do not decide their order. Returns false if out of memory. */
static bool settle_rings(sunder_i_found *f, const sunder_i_valued *k, size_t n, uint32_t *order)
{
    for (size_t i = 0; i < n; i++) order[i] = k[i].item;
    return n == 1 || sunder_i_sort_indices(order, n, compare_rings, f);
}

/* Sorts n rings whose first vertices have the same x: by y as doubles, and exactly where these are too close. Returns
 * false if out of memory. */
static bool sort_column(sunder_i_found *f, sunder_i_valued *k, size_t n, uint32_t *order)
{
    for (size_t i = 0; i < n; i++) k[i].value = first_place(f, k[i].item)->ay;
    if (!sunder_i_sort_valued(k, n)) return false;
    for (size_t i = 0, j; i < n; i = j) {
        for (j = i + 1; j < n && is_open(k[j - 1].value, k[j].value);) j++;
        if (!settle_rings(f, k + i, j - i, order + i)) return false;
    }
    return true;
}

static bool is_column(const sunder_i_found *f, sunder_i_lattice *l, const sunder_i_valued *k, size_t n)
{
    for (size_t i = 1; i < n; i++)
        if (sunder_i_hpoint_cmp_x(l, first_place(f, k[i - 1].item), first_place(f, k[i].item)) != 0) return false;
    return true;
}

/* Sorts the rings by the doubles of their first vertices if these decide the order. Returns false if out of memory. */
static bool sort_rings_by_places(sunder_i_found *f, sunder_i_lattice *l, uint32_t *order)
{
    const size_t n = f->rings;
    sunder_i_valued *k = sunder_i_alloc(4 * n, sizeof *k); /* a column is sorted in the second half */
    bool ok = k != NULL;
    for (uint32_t r = 0; ok && r < n; r++) k[r] = (sunder_i_valued){first_place(f, r)->ax, r, 0};
    ok = ok && sunder_i_sort_valued(k, n);
    for (size_t i = 0, j; ok && i < n; i = j) {
        for (j = i + 1; j < n && is_open(k[j - 1].value, k[j].value);) j++;
        if (j - i > 2 && is_column(f, l, k + i, j - i)) {
            memcpy(k + 2 * n, k + i, (j - i) * sizeof *k);
            ok = sort_column(f, k + 2 * n, j - i, order + i);
        } else {
            ok = settle_rings(f, k + i, j - i, order + i);
        }
    }
    sunder_i_free(k);
    return ok;
}

/* Sorts the rings by the numbers of their first vertices; rings with the same first vertex are sorted by their further
 * vertices. Returns false if out of memory. */
static bool sort_rings_by_numbers(sunder_i_found *f, uint32_t *order)
{
    const size_t n = f->rings;
    uint64_t *key = sunder_i_alloc(n, sizeof *key);
    if (!key) return false;
    for (size_t r = 0; r < n; r++) key[r] = (uint64_t)f->vertex[f->ring[r].start] << 32 | r;
    bool ok = sunder_i_sort_keys(key, n);
    for (size_t i = 0, j; ok && i < n; i = j) {
        for (j = i; j < n && key[j] >> 32 == key[i] >> 32; j++) order[j] = (uint32_t)key[j];
        ok = j - i == 1 || sunder_i_sort_indices(order + i, j - i, compare_rings, f);
    }
    sunder_i_free(key);
    return ok;
}

static bool sort_rings(sunder_i_found *f, sunder_i_lattice *l, uint32_t *order)
{
    if (f->sorted) return sort_rings_by_numbers(f, order);
    if (f->place && f->rings > 1) return sort_rings_by_places(f, l, order);
    for (uint32_t r = 0; r < f->rings; r++) order[r] = r;
    return sunder_i_sort_indices(order, f->rings, compare_rings, f);
}

/* Assigns the outer rings to polygons in order, and then every ring, in order, to the next place in its polygon.
 *
 * place: [rings] becomes the result; hole: [rings] zeros, in the end used by polygon; polygon: [components] becomes the
 * polygon of each component. */
static void deal_rings(const sunder_i_found *f, const uint32_t *order, uint32_t *place, uint32_t *hole,
                       uint32_t *polygon, sunder_sum *out)
{
    for (size_t i = 0; i < f->rings; i++)
        if (f->ring[order[i]].outer) polygon[f->ring[order[i]].component] = (uint32_t)out->polygons++;
    for (size_t r = 0; r < f->rings; r++) hole[polygon[f->ring[r].component]]++;
    size_t sum = 0;
    for (size_t p = 0; p < out->polygons; p++) {
        const uint32_t rings = hole[p];
        hole[p] = (uint32_t)sum + 1; /* the place of its next hole, after the outer ring */
        sum += rings;
        out->poly_end[p] = sum;
    }
    for (size_t i = 0; i < f->rings; i++) {
        const sunder_i_found_ring *r = &f->ring[order[i]];
        const uint32_t p = polygon[r->component];
        place[r->outer ? (p ? out->poly_end[p - 1] : 0) : hole[p]++] = order[i];
    }
}

static void copy_rings(const sunder_i_found *f, const uint32_t *place, sunder_sum *out)
{
    size_t at = 0;
    for (size_t i = 0; i < f->rings; i++) {
        const sunder_i_found_ring *r = &f->ring[place[i]];
        memcpy(out->ring_vertex + at, f->vertex + r->start, (r->end - r->start) * sizeof *f->vertex);
        at += r->end - r->start;
        out->ring_end[i] = at;
    }
    out->rings = f->rings;
}

static bool order_rings(sunder_i_found *f, sunder_sum *out)
{
    const size_t n = f->rings;
    uint32_t *order = sunder_i_calloc(3 * n + f->components, sizeof *order);
    const bool ok = order && sort_rings(f, &out->lattice, order);
    if (ok) {
        deal_rings(f, order, order + n, order + 2 * n, order + 3 * n, out);
        copy_rings(f, order + n, out);
    }
    sunder_i_free(order);
    return ok;
}

static bool put_rings(sunder_i_found *f, sunder_sum *out)
{
    const uint32_t one = 0;
    size_t corners = 0;
    for (size_t r = 0; r < f->rings; r++) corners += f->ring[r].end - f->ring[r].start;
    out->ring_vertex = sunder_i_alloc(corners, sizeof *out->ring_vertex);
    out->ring_end = sunder_i_alloc(f->rings, sizeof *out->ring_end);
    out->poly_end = sunder_i_alloc(f->rings, sizeof *out->poly_end);
    if (!out->ring_vertex || !out->ring_end || !out->poly_end) return false;
    if (f->rings != 1) return order_rings(f, out);
    copy_rings(f, &one, out);
    out->polygons = out->poly_end[0] = 1;
    return true;
}

/* ---- Degenerate parts ---- */

static int compare_segments(void *context, uint32_t a, uint32_t b)
{
    const sunder_i_found *f = context;
    const uint32_t *s = f->segment + 2 * (size_t)a, *t = f->segment + 2 * (size_t)b;
    const int c = f->compare(f->context, s[0], t[0]);
    return c ? c : f->compare(f->context, s[1], t[1]);
}

static bool put_segments(sunder_i_found *f, sunder_sum *out)
{
    const size_t n = f->segments;
    if (n == 0) return true;
    uint32_t *order = sunder_i_alloc(n, sizeof *order);
    out->segment = sunder_i_alloc(2 * n, sizeof *out->segment);
    bool ok = order && out->segment;
    for (size_t i = 0; ok && i < n; i++) order[i] = (uint32_t)i;
    ok = ok && sunder_i_sort_indices(order, n, compare_segments, f);
    for (size_t i = 0; ok && i < n; i++)
        memcpy(out->segment + 2 * i, f->segment + 2 * (size_t)order[i], 2 * sizeof *out->segment);
    out->segments = ok ? n : 0;
    sunder_i_free(order);
    return ok;
}

static bool put_points(const sunder_i_found *f, sunder_sum *out)
{
    if (f->points == 0) return true;
    out->point = sunder_i_alloc(f->points, sizeof *out->point);
    if (!out->point) return false;
    memcpy(out->point, f->point, f->points * sizeof *f->point);
    out->points = f->points;
    return sunder_i_sort_indices(out->point, f->points, f->compare, f->context);
}

bool sunder_i_canonical(sunder_i_found *found, sunder_sum *out)
{
    return put_rings(found, out) && put_segments(found, out) && put_points(found, out);
}

/* ---- Tests of the canonical form ---- */

/* Compares two sequences of vertices lexicographically. */
static int compare_rows(sunder_sum *sum, const uint32_t *v, size_t m, const uint32_t *w, size_t n)
{
    for (size_t i = 0; i < m && i < n; i++) {
        const int c = sunder_i_sum_vertex_cmp(sum, v[i], w[i]);
        if (c) return c;
    }
    return (m > n) - (m < n);
}

static const char *check_polygons(sunder_sum *sum)
{
    const uint32_t *outer = NULL;
    size_t outer_n = 0;
    for (size_t p = 0; p < sum->polygons; p++) {
        const uint32_t *before = outer;
        size_t before_n = outer_n;
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &n);
            if (n < 3) return "a ring has under three vertices";
            for (size_t i = 1; i < n; i++)
                if (sunder_i_sum_vertex_cmp(sum, ring[0], ring[i]) >= 0) return "a ring starts at no smallest vertex";
            if (r != 1 && before && compare_rows(sum, before, before_n, ring, n) >= 0)
                return r ? "holes are out of order" : "polygons are out of order";
            if (r == 0) outer = ring, outer_n = n;
            before = ring;
            before_n = n;
        }
    }
    return NULL;
}

const char *sunder_i_canonical_check(sunder_sum *sum)
{
    const sunder_counts counts = sum->lattice.counts; /* the tests are not counted as operations */
    const char *wrong = check_polygons(sum);
    for (size_t i = 0; i < sum->segments && !wrong; i++) {
        const uint32_t *s = sum->segment + 2 * i;
        if (sunder_i_sum_vertex_cmp(sum, s[0], s[1]) >= 0) wrong = "a segment does not rise";
        if (i && compare_rows(sum, s - 2, 2, s, 2) >= 0) wrong = "segments are out of order";
    }
    for (size_t i = 1; i < sum->points && !wrong; i++)
        if (sunder_i_sum_vertex_cmp(sum, sum->point[i - 1], sum->point[i]) >= 0) wrong = "points are out of order";
    sum->lattice.counts = counts;
    return sum->lattice.arena.failed ? NULL : wrong; /* if out of memory, nothing can be tested */
}
