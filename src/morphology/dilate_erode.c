/* dilate_erode.c: F + B and F^c + (-B), where the vertices of F are rational.
 *
 * Let C be a convex piece of the added shape, c a point inside it, and X a set with a known boundary. Then
 *
 *   X + int C  =  (X + c)  u  (boundary of X + int C)           for X open or closed
 *
 * Proof: let x = y + b with y in X, b in int C. If x - c is not in X, then on the segment from b to c, which is inside
 * C, the point x minus the moving point leaves X, and there it is on the boundary. The boundary consists of sides, so
 * that the second set is a union of *bands*: a side s results in the open convex polygon s + int C. (A degenerate
 * segment or point of X is boundary, too.) The union over the pieces of B contains everything except what only the
 * diagonals between pieces reach: for open X nothing, since y and b can be changed slightly in opposite directions; for
 * closed X only seams without area, which the closure contains.
 *
 * So the bands are united in a planar map (../planar_map/), one after the other in biased random order, and everything
 * inside the union is removed. No band meets a cell of the map (face, edge or vertex) that none covers: so neither does
 * the boundary of X + c, and the cell is in X + c completely or not at all. Testing one of its vertices suffices. (If X
 * + c were drawn as a region beside the bands, its complement would need a frame, and vertices where rings touch would
 * need counts; a test costs one location for each cell, and few cells are left.)
 *
 *   dilation: a cell is inside   if it is covered, or in F + c for some piece;
 *   erosion:  a cell is inside   if it is not covered, and in F + c for every piece: in no F^c + c.
 *
 * Every vertex that is compared is on the lines of two sides: of F, of B translated by a vertex of F, or of F
 * translated by a vertex of B. All have lattice directions, and none is computed from more than one vertex of F: so the
 * size of numbers does not depend on the size of the figure, only on how its own vertices were computed.
 *
 * Cost: expected O(b log b + k), b sides of bands, k crossings drawn; those inside the union are removed at once. */
#include "morphology/morphology.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/random.h"
#include "base/watch.h"
#include "predicate/rational_point.h"
#include "spatial/strips.h"
#include "sum/canonical_sum.h"
#include "sum/from_map.h"

#include <math.h>
#include <string.h>

/* The figure, prepared for point location. */
typedef struct solid {
    const sunder_i_figure *figure;
    uint32_t *next;        /* [sides] the next side of the ring */
    double (*xy)[2], most; /* [sides] the start of each side, times 2^shift; the largest absolute coordinate */
    long shift;
    sunder_i_strips strips;
} solid;

typedef struct stage {
    const sunder_i_figure *figure;
    const sunder_i_structuring_element *element;
    const sunder_sum_options *options;
    sunder_i_planar_map *bands;
    solid solid; /* the figure itself */
    sunder_i_arena scratch;
    uint64_t random;
    bool erode;
} stage;

/* The part of a stage's work that the current step takes: from and to are fractions of the stage. */
typedef struct share {
    double from, to;
} share;

static const share of_bands = {0, 1};

static bool go_on(const sunder_sum_options *options, const share *s, uint64_t done, uint64_t all)
{
    return !options || !options->progress ||
           options->progress(s->from + (s->to - s->from) * ((double)done / (double)all), options->progress_user);
}

enum { ROUNDS = 64 };

/* Returns the round in which an item is added: the last one has half of the items, the previous one a quarter, and so
 * on. */
static unsigned round_of(uint64_t *random)
{
    unsigned heads = 0;
    for (uint64_t r = sunder_i_draw(random) | (uint64_t)1 << (ROUNDS - 1); !(r & 1); r >>= 1) heads++;
    return ROUNDS - 1 - heads;
}

/* Returns an order of n items that follow each other along rings; NULL if out of memory. In rounds of twice as many
 * items each time, drawn at random, the expected cost is that of a random order up to a factor. Within a round items
 * keep their order, so that each one is added near the previous one, where the map is in the cache [ACR03]. This takes
 * half the time of a random order on coasts of a hundred thousand vertices. */
static uint64_t *biased_order(uint64_t *random, uint64_t n)
{
    uint64_t *order = sunder_i_alloc(n, sizeof *order);
    uint8_t *round = sunder_i_alloc(n, sizeof *round);
    uint64_t at[ROUNDS + 1] = {0};
    for (uint64_t i = 0; order && round && i < n; i++) at[1 + (round[i] = (uint8_t)round_of(random))]++;
    for (unsigned r = 0; r < ROUNDS; r++) at[r + 1] += at[r];
    for (uint64_t i = 0; order && round && i < n; i++) order[at[round[i]]++] = i;
    if (!round) {
        sunder_i_free(order);
        order = NULL;
    }
    sunder_i_free(round);
    return order;
}

/* Sets ends[] to the two ends of the generator of band i: of the sides of all rings, then of the segments, then of the
 * points (twice the point). */
static void ends_of(const sunder_i_figure *f, const uint32_t *next, uint64_t i, uint32_t ends[2])
{
    if (i < f->sides) {
        ends[0] = f->ring[i];
        ends[1] = f->ring[next[i]];
    } else if (i < f->sides + f->segments)
        memcpy(ends, f->segment + 2 * (i - f->sides), 2 * sizeof *ends);
    else
        ends[0] = ends[1] = f->point[i - f->sides - f->segments];
}

/* Returns the next side of each side; NULL if out of memory. */
static uint32_t *next_sides(const sunder_i_figure *f)
{
    uint32_t *next = sunder_i_alloc(f->sides, sizeof *next);
    for (size_t r = 0; next && r < f->rings; r++) {
        const size_t first = r ? f->ring_end[r - 1] : 0, end = f->ring_end[r];
        for (size_t i = first; i < end; i++) next[i] = (uint32_t)(i + 1 < end ? i + 1 : first);
    }
    return next;
}

/* ---- Point location in the figure ---- */

/* Returns a bound of the error of coordinates in doubles, if `most` is the largest one. */
static double margin_of_doubles(double most) { return most * 0x1p-50 + 0x1p-900; }

/* Sorts the figure's sides by height, with vertices as doubles, scaled by a power of two so that all fit. Returns false
 * if out of memory. */
static bool solid_init(solid *s, const sunder_i_figure *f, const sunder_i_lattice *lattice)
{
    *s = (solid){.figure = f, .shift = -(long)lattice->approx_shift};
    sunder_i_arena scratch = {0};
    double(*span)[2] = sunder_i_alloc(f->sides, sizeof *span);
    s->xy = sunder_i_alloc(f->sides, sizeof *s->xy);
    s->next = next_sides(f);
    for (size_t i = 0; span && s->xy && i < f->sides; i++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&scratch);
        sunder_i_rational_doubles(&scratch, f->at[f->ring[i]], s->shift, &s->xy[i][0], &s->xy[i][1]);
        s->most = sunder_i_max(s->most, sunder_i_max(fabs(s->xy[i][0]), fabs(s->xy[i][1])));
        sunder_i_arena_release(&scratch, mark);
    }
    bool ok = span && s->xy && s->next && !scratch.failed;
    for (size_t i = 0; ok && i < f->sides; i++) {
        const double y[2] = {s->xy[i][1], s->xy[s->next[i]][1]};
        span[i][0] = sunder_i_min(y[0], y[1]) - 4 * margin_of_doubles(s->most);
        span[i][1] = sunder_i_max(y[0], y[1]) + 4 * margin_of_doubles(s->most);
    }
    ok = ok && sunder_i_strips_build(&s->strips, (const double(*)[2])span, f->sides, f->sides);
    sunder_i_arena_free(&scratch);
    sunder_i_free(span);
    return ok;
}

static void solid_free(solid *s)
{
    sunder_i_strips_free(&s->strips);
    sunder_i_free_all(s->xy, s->next);
}

/* Returns whether vertex i of the rings is above the point. */
static bool is_above(const solid *s, sunder_i_arena *scratch, size_t i, const sunder_i_rational_point *at, double y)
{
    const double gap = s->xy[i][1] - y;
    if (fabs(gap) > margin_of_doubles(s->most) + margin_of_doubles(y < 0 ? -y : y)) return gap > 0;
    return sunder_i_rational_cmp(scratch, &s->figure->at[s->figure->ring[i]], at, 1) > 0;
}

/* Returns whether a point is inside the figure; it is not on the boundary. A ray to the left crosses the sides that
 * pass on its left and have exactly one end above it. */
static bool is_in_figure(const solid *s, sunder_i_arena *scratch, sunder_i_rational_point at)
{
    bool odd = false;
    size_t from, to;
    double x, y;
    sunder_i_rational_doubles(scratch, at, s->shift, &x, &y);
    const double error = margin_of_doubles(s->most) + margin_of_doubles(fabs(x));
    sunder_i_strips_at(&s->strips, y, &from, &to);
    for (; from < to && !scratch->failed; from++) {
        const uint32_t a = s->strips.item[from], b = s->next[a];
        const sunder_i_mark mark = sunder_i_arena_mark(scratch);
        const bool up = is_above(s, scratch, b, &at, y);
        if (up != is_above(s, scratch, a, &at, y)) {
            const double left = sunder_i_min(s->xy[a][0], s->xy[b][0]), right = sunder_i_max(s->xy[a][0], s->xy[b][0]);
            bool crosses = right + error < x;
            if (!crosses && !(left - error > x)) {
                const sunder_i_figure *f = s->figure;
                const int side = sunder_i_rational_orient(scratch, f->at[f->ring[a]], f->at[f->ring[b]], at);
                crosses = up ? side < 0 : side > 0;
            }
            odd = odd != crosses;
        }
        sunder_i_arena_release(scratch, mark);
    }
    return odd;
}

/* ---- Bands ---- */

/* Unites band number k with the map: the sum of piece k % pieces of the element and of generator k / pieces of the
 * figure; the generators are its sides, then its segments, then its points. */
static sunder_status add_band(stage *g, const uint32_t *next, uint64_t k, sunder_error *err)
{
    const sunder_i_figure *f = g->figure;
    const sunder_i_structuring_element *p = g->element;
    const uint64_t piece = k % p->pieces, i = k / p->pieces;
    const size_t first = piece ? p->end[piece - 1] : 0, end = p->end[piece];
    const sunder_i_mark mark = sunder_i_arena_mark(&g->scratch);
    sunder_i_rational_point *corner = sunder_i_arena_alloc(&g->scratch, end - first + 2, sizeof *corner);
    sunder_i_point *along = sunder_i_arena_alloc(&g->scratch, end - first + 2, sizeof *along);
    if (!corner || !along) return sunder_i_failure_cause(err);
    uint32_t ends[2];
    bool known;
    ends_of(f, next, i, ends);
    const size_t n = sunder_i_band(&g->scratch, p, first, end, f->at[ends[0]], f->at[ends[1]], corner, along, &known);
    if (g->scratch.failed) return sunder_i_failure_cause(err);
    const sunder_status status = sunder_i_planar_map_unite_polygon(g->bands, corner, known ? along : NULL, n, err);
    sunder_i_arena_release(&g->scratch, mark);
    return status;
}

static sunder_status unite_bands(stage *g, sunder_error *err)
{
    const sunder_i_figure *f = g->figure;
    const uint64_t all = (f->sides + f->segments + f->points) * (uint64_t)g->element->pieces;
    uint32_t *next = next_sides(f);
    uint64_t *order = biased_order(&g->random, all);
    sunder_status status = next && order ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint64_t i = 0; i < all && status == SUNDER_OK; i++)
        status = go_on(g->options, &of_bands, i, all) ? add_band(g, next, order[i], err) : sunder_i_cancelled(err);
    sunder_i_free_all(next, order);
    return status;
}

/* ---- Cells that no band covers ---- */

/* Sets *in to whether a vertex that no band covers is in F + c, for the inner point c of some piece (dilation) or of
 * all pieces (erosion). It is not on the boundary of any of them. */
static sunder_status is_inside(stage *g, uint32_t vertex, bool *in, sunder_error *err)
{
    const bool any = g->figure->rings > 0;
    *in = any && g->erode;
    if (!sunder_i_step()) return sunder_i_failure_cause(err);
    for (uint32_t j = 0; any && j < g->element->pieces && *in == g->erode; j++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&g->scratch);
        sunder_i_arena *s = &g->scratch;
        const sunder_i_rational_point at =
            sunder_i_rational_sub(s, *sunder_i_planar_map_vertex_point(g->bands, vertex), g->element->inner[j]);
        if (!s->failed) *in = is_in_figure(&g->solid, s, at);
        if (s->failed) return sunder_i_failure_cause(err);
        sunder_i_arena_release(s, mark);
    }
    return SUNDER_OK;
}

static sunder_status sort_faces(stage *g, bool *face, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (uint32_t f = 1; f < sunder_i_planar_map_face_end(g->bands) && status == SUNDER_OK; f++) {
        const bool covered = sunder_i_planar_map_face_covered(g->bands, f) != 0;
        face[f] = covered && !g->erode;
        if (!covered)
            status = is_inside(g, sunder_i_planar_map_origin(g->bands, sunder_i_planar_map_face_outer(g->bands, f)),
                               &face[f], err);
    }
    return status;
}

/* Classifies parts without area: edges and vertices between covered faces. Others belong to a face. */
static sunder_status sort_rest(stage *g, bool *edge, bool *vertex, sunder_error *err)
{
    const sunder_i_planar_map *map = g->bands;
    sunder_status status = SUNDER_OK;
    for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(map) && status == SUNDER_OK; e++)
        if (sunder_i_planar_map_edge_alive(map, e) && sunder_i_planar_map_edge_covered(map, e) == 0 &&
            sunder_i_planar_map_left_covered(map, 2 * e) && sunder_i_planar_map_left_covered(map, 2 * e + 1))
            status = is_inside(g, sunder_i_planar_map_origin(map, 2 * e), &edge[e], err);
    for (uint32_t v = 0; v < sunder_i_planar_map_vertex_end(map) && status == SUNDER_OK; v++)
        if (sunder_i_planar_map_vertex_alive(map, v) && sunder_i_planar_map_vertex_covered(map, v) == 0 &&
            sunder_i_planar_map_vertex_out(map, v) == SUNDER_I_NOWHERE)
            status = is_inside(g, v, &vertex[v], err);
    return status;
}

static sunder_status read_cells(stage *g, sunder_sum *sum, sunder_error *err)
{
    sunder_status status = sunder_i_planar_map_faces(g->bands, err);
    if (status != SUNDER_OK) return status;
    bool *face = sunder_i_calloc(sunder_i_planar_map_face_end(g->bands), sizeof *face);
    bool *edge = sunder_i_calloc(sunder_i_planar_map_edge_end(g->bands), sizeof *edge);
    bool *vertex = sunder_i_calloc(sunder_i_planar_map_vertex_end(g->bands), sizeof *vertex);
    const sunder_i_inside inside = {face, g->erode ? edge : NULL, g->erode ? vertex : NULL};
    status = face && edge && vertex ? sort_faces(g, face, err) : sunder_i_failure_cause(err);
    if (status == SUNDER_OK && g->erode) status = sort_rest(g, edge, vertex, err);
    if (status == SUNDER_OK) status = sunder_i_sum_from_cells(g->bands, &inside, sum, err);
    sunder_i_free_all(face, edge, vertex);
    return status;
}

static sunder_status dilate_or_erode(stage *g, sunder_sum *sum, sunder_error *err)
{
    static const sunder_sum_options defaults;
    if (!g->options) g->options = &defaults;
    g->random = g->options->seed;
    sunder_status status = sunder_i_planar_map_new(&sum->lattice, sunder_i_draw(&g->random), &g->bands, err);
    if (status == SUNDER_OK) status = unite_bands(g, err);
    if (status == SUNDER_OK && g->figure->rings && !solid_init(&g->solid, g->figure, &sum->lattice))
        status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK) status = read_cells(g, sum, err);
    sunder_i_planar_map_free(g->bands);
    solid_free(&g->solid);
    sunder_i_arena_free(&g->scratch);
    SUNDER_I_ASSERT(status != SUNDER_OK || !sunder_i_canonical_check(sum));
    return status;
}

sunder_status sunder_i_dilate_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                     const sunder_sum_options *options, sunder_sum *sum, sunder_error *err)
{
    stage g = {.figure = figure, .element = element, .options = options};
    return dilate_or_erode(&g, sum, err);
}

sunder_status sunder_i_erode_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                    const sunder_sum_options *options, sunder_sum *sum, sunder_error *err)
{
    stage g = {.figure = figure, .element = element, .options = options, .erode = true};
    return dilate_or_erode(&g, sum, err);
}
