/* convex_fit.c: tests whether a convex shape D fits into the intersection of P and Q, that is, whether the erosion of
 * the intersection by D has a point, be it of its interior, of a slide or of an exact fit.
 *
 *   E = { x : D + x in P and D + x in Q } = complement of ((P^c + int(-D)) u (Q^c + int(-D)))
 *
 * As for an erosion (dilate_erode.c), P^c + int(-D) is P^c (the origin is inside D) and the bands: every side of P plus
 * int(-D). All bands, of both, are united in one planar map. E is closed and bounded, and its boundary consists of
 * bands' boundaries: so if E is not empty, a vertex of the map is in it. A vertex that no band covers is on no boundary
 * of P or Q, and it is in E exactly if it is in both, which a map of each decides.
 *
 * Only the neighbourhood matters. The boxes of P and Q define a *window* for x: nothing outside it is in E. So of P and
 * Q only convex pieces near the window grown by D are drawn, and only bands near the window. The common boundary of an
 * omitted piece and a drawn one looks like boundary, but is in the omitted piece's box, and its band does not reach the
 * window.
 *
 * Polygons may overlap and share walls: the map of a shape is that of its open convex pieces, of all polygons, and its
 * sides are the edges with a covered face on one side only. Diagonals and shared walls have them on both. */
#include "morphology/morphology.h"

#include "base/extremes.h"
#include "base/random.h"
#include "predicate/rational_point.h"
#include "spatial/box.h"

#include <math.h>

typedef struct fit {
    sunder_i_lattice *lattice;
    double origin[2]; /* the origin of positions on the lattice */
    double window[4]; /* the box that contains all possible x, up to rounding errors, which are far below `slack` */
    double reach[4];  /* the box of D */
    double slack;
    sunder_i_structuring_element element; /* -D */
    sunder_i_planar_map *region[2], *bands;
    sunder_i_arena scratch;
    uint64_t random;
} fit;

/* A side between two vertices of a region. */
typedef struct side {
    uint32_t region, half_edge;
} side;

/* Computes window and slack. Numbers of magnitude at most M result from fewer than eight roundings each, of at most
 * 2^-53 M; 2^-46 M is far more. Whatever is omitted is farther than several times that from where it would matter.
 * Returns false if the window is certainly empty. */
static bool look_through_window(fit *f, const sunder_shape *const shape[2], const double *const t[2],
                                const sunder_shape *d)
{
    double box[2][4], most = 0;
    sunder_shape_box(d, f->reach);
    for (int i = 0; i < 2; i++) {
        sunder_shape_box(shape[i], box[i]);
        for (int k = 0; k < 4; k++) {
            const double move = t[i] ? t[i][k & 1] : 0;
            most = sunder_i_max(most, fabs(box[i][k]) + fabs(move) + fabs(f->reach[k]));
            box[i][k] += move;
        }
    }
    f->slack = most * 0x1p-46;
    for (int k = 0; k < 2; k++) {
        f->window[k] = sunder_i_max(box[0][k], box[1][k]) - f->reach[k];
        f->window[k + 2] = sunder_i_min(box[0][k + 2], box[1][k + 2]) - f->reach[k + 2];
        if (f->window[k] > f->window[k + 2] + 2 * f->slack) return false;
    }
    return true;
}

/* ---- Regions ----------------------------------------------------------------------------------------------------- */

static bool piece_is_near(const fit *f, const sunder_shape *shape, const double *t, size_t first, size_t end)
{
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY}, near[4];
    for (size_t i = first; i < end; i++)
        for (int c = 0; c < 2; c++) {
            const double v = shape->xy[2 * (size_t)sunder_i_piece_vertices(shape)[i] + (size_t)c] + (t ? t[c] : 0);
            box[c] = sunder_i_min(box[c], v);
            box[c + 2] = sunder_i_max(box[c + 2], v);
        }
    for (int k = 0; k < 4; k++) near[k] = f->window[k] + f->reach[k];
    return sunder_i_box_near(box, near, 16 * f->slack);
}

/* Draws the near pieces of a shape as open regions of a map, and counts how many cover each cell. */
static sunder_status draw_region(fit *f, int i, const sunder_shape *shape, const sunder_i_point *at, const double *t,
                                 sunder_error *err)
{
    sunder_status status = sunder_i_planar_map_new(f->lattice, sunder_i_draw(&f->random), &f->region[i], err);
    for (uint32_t p = 0; p < shape->pieces && status == SUNDER_OK; p++) {
        const size_t first = p ? shape->piece_end[p - 1] : 0, end = shape->piece_end[p];
        if (!piece_is_near(f, shape, t, first, end)) continue;
        const sunder_i_mark mark = sunder_i_arena_mark(&f->scratch);
        sunder_i_rational_point *corner = sunder_i_arena_alloc(&f->scratch, end - first, sizeof *corner);
        for (size_t k = first; corner && k < end; k++)
            corner[k - first] = sunder_i_rational_get(&f->scratch, f->lattice, at[sunder_i_piece_vertices(shape)[k]]);
        if (f->scratch.failed) return sunder_i_failure_cause(err);
        status = sunder_i_planar_map_insert_polygon(f->region[i], corner, NULL, end - first, err);
        sunder_i_arena_release(&f->scratch, mark);
    }
    return status == SUNDER_OK ? sunder_i_planar_map_mark(f->region[i], err) : status;
}

/* Sets *in to whether the region contains the point, which is not on its boundary. */
static sunder_status region_holds(sunder_i_planar_map *region, sunder_i_rational_point at, bool *in, sunder_error *err)
{
    sunder_i_location where;
    const sunder_status status = sunder_i_planar_map_locate(region, at, &where, err);
    if (status != SUNDER_OK) return status;
    uint32_t beside = SUNDER_I_NOWHERE; /* on a diagonal or a shared wall the faces beside it are covered, too */
    if (where.place == SUNDER_I_ON_EDGE) beside = 2 * where.id;
    if (where.place == SUNDER_I_AT_VERTEX) beside = sunder_i_planar_map_vertex_out(region, where.id);
    *in = beside == SUNDER_I_NOWHERE ? where.covered != 0 : sunder_i_planar_map_left_covered(region, beside) != 0;
    return SUNDER_OK;
}

/* ---- Bands ------------------------------------------------------------------------------------------------------- */

static const sunder_i_rational_point *end_of(const fit *f, const side *s, bool second)
{
    const sunder_i_planar_map *map = f->region[s->region];
    const uint32_t h = second ? sunder_i_planar_map_twin(s->half_edge) : s->half_edge;
    return sunder_i_planar_map_vertex_point(map, sunder_i_planar_map_origin(map, h));
}

/* Computes the approximate position in the caller's units. */
static void place_of(fit *f, const sunder_i_rational_point *at, double xy[2])
{
    sunder_i_rational_doubles(&f->scratch, *at, f->lattice->exponent, &xy[0], &xy[1]);
    for (int c = 0; c < 2; c++) xy[c] += f->origin[c];
}

static bool band_is_near(fit *f, const side *s)
{
    double a[2], b[2], box[4];
    const sunder_i_mark mark = sunder_i_arena_mark(&f->scratch);
    place_of(f, end_of(f, s, false), a);
    place_of(f, end_of(f, s, true), b);
    sunder_i_arena_release(&f->scratch, mark);
    for (int c = 0; c < 2; c++) {
        box[c] = sunder_i_min(a[c], b[c]) - f->reach[c + 2];
        box[c + 2] = sunder_i_max(a[c], b[c]) - f->reach[c];
    }
    return sunder_i_box_near(box, f->window, 8 * f->slack);
}

/* Lists the sides of both regions whose bands matter, in random order. */
static sunder_status find_sides(fit *f, side **sides, size_t *n, sunder_error *err)
{
    size_t most = 0;
    for (int i = 0; i < 2; i++) most += sunder_i_planar_map_edge_end(f->region[i]);
    *n = 0;
    *sides = sunder_i_alloc(most, sizeof **sides);
    if (!*sides) return sunder_i_failure_cause(err);
    for (uint32_t i = 0; i < 2; i++)
        for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(f->region[i]); e++) {
            const side s = {i, 2 * e};
            if (!sunder_i_planar_map_edge_alive(f->region[i], e) ||
                !sunder_i_planar_map_left_covered(f->region[i], 2 * e) ==
                    !sunder_i_planar_map_left_covered(f->region[i], 2 * e + 1))
                continue;
            if (band_is_near(f, &s)) (*sides)[(*n)++] = s;
        }
    sunder_i_shuffle(*sides, *n, sizeof **sides, &f->random);
    return f->scratch.failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}

static sunder_status unite_bands(fit *f, const side *sides, size_t n, sunder_error *err)
{
    const size_t corners = f->element.end[0];
    sunder_status status = sunder_i_planar_map_new(f->lattice, sunder_i_draw(&f->random), &f->bands, err);
    for (size_t k = 0; k < n && status == SUNDER_OK; k++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&f->scratch);
        sunder_i_rational_point *band = sunder_i_arena_alloc(&f->scratch, corners + 2, sizeof *band);
        sunder_i_point *along = sunder_i_arena_alloc(&f->scratch, corners + 2, sizeof *along);
        if (!band || !along) return sunder_i_failure_cause(err);
        bool known;
        const size_t m = sunder_i_band(&f->scratch, &f->element, 0, corners, *end_of(f, &sides[k], false),
                                       *end_of(f, &sides[k], true), band, along, &known);
        if (f->scratch.failed) return sunder_i_failure_cause(err);
        status = sunder_i_planar_map_unite_polygon(f->bands, band, known ? along : NULL, m, err);
        sunder_i_arena_release(&f->scratch, mark);
    }
    return status;
}

/* Sets *fits to whether a vertex of the united bands is in both regions: no band covers a vertex, so that D fits
 * there. */
static sunder_status look_at_vertices(fit *f, bool *fits, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *fits = false;
    for (uint32_t v = 0; v < sunder_i_planar_map_vertex_end(f->bands) && !*fits && status == SUNDER_OK; v++) {
        double at[2];
        bool in[2] = {false, false};
        if (!sunder_i_planar_map_vertex_alive(f->bands, v)) continue;
        const sunder_i_rational_point *point = sunder_i_planar_map_vertex_point(f->bands, v);
        const sunder_i_mark mark = sunder_i_arena_mark(&f->scratch);
        place_of(f, point, at);
        sunder_i_arena_release(&f->scratch, mark);
        const double box[4] = {at[0], at[1], at[0], at[1]};
        if (!sunder_i_box_near(box, f->window, 4 * f->slack)) continue;
        status = region_holds(f->region[0], *point, &in[0], err);
        if (status == SUNDER_OK && in[0]) status = region_holds(f->region[1], *point, &in[1], err);
        *fits = in[0] && in[1];
    }
    return f->scratch.failed ? sunder_i_failure_cause(err) : status;
}

/* ---- All steps --------------------------------------------------------------------------------------------------- */

static sunder_status find_fit(fit *f, bool *fits, sunder_error *err)
{
    side *sides = NULL;
    size_t n;
    sunder_status status = find_sides(f, &sides, &n, err);
    if (status == SUNDER_OK) status = unite_bands(f, sides, n, err);
    if (status == SUNDER_OK) status = look_at_vertices(f, fits, err);
    sunder_i_free(sides);
    return status;
}

/* Places D on the lattice, with the origin zero. */
static sunder_status place_element(fit *f, const sunder_shape *d, sunder_error *err)
{
    sunder_i_point *at = sunder_i_alloc(d->vertices, sizeof *at);
    if (!at) return sunder_i_failure_cause(err);
    for (uint32_t v = 0; v < d->vertices; v++)
        at[v] = (sunder_i_point){sunder_i_lattice_int(f->lattice, d->xy[2 * (size_t)v], 0),
                                 sunder_i_lattice_int(f->lattice, d->xy[2 * (size_t)v + 1], 0)};
    const bool ok = sunder_i_structuring_element_of_shape(f->lattice, d, at, true, &f->element);
    sunder_i_free(at);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_fits_in_both(const sunder_shape *p, const double tp[2], const sunder_shape *q,
                                    const double tq[2], const sunder_shape *d, bool *fits, sunder_error *err)
{
    fit f = {0};
    const sunder_shape *const shape[2] = {p, q};
    const double *const t[2] = {tp, tq};
    *fits = false;
    if (sunder_shape_is_empty(p) || sunder_shape_is_empty(q) || !look_through_window(&f, shape, t, d)) return SUNDER_OK;
    sunder_i_placed placed;
    const sunder_i_place_options how = {
        .common_origin = true, .shift_p = tp, .shift_q = tq, .extra = d->xy, .extra_n = 2 * (size_t)d->vertices};
    sunder_status status = sunder_i_place(p, q, &how, &placed, err);
    if (status != SUNDER_OK) return status;
    f.lattice = &placed.lattice;
    for (int c = 0; c < 2; c++) f.origin[c] = placed.origin_p[c];
    status = place_element(&f, d, err);
    if (status == SUNDER_OK) status = draw_region(&f, 0, p, placed.p, tp, err);
    if (status == SUNDER_OK) status = draw_region(&f, 1, q, placed.q, tq, err);
    if (status == SUNDER_OK) status = find_fit(&f, fits, err);
    sunder_i_planar_map_free(f.bands);
    for (int i = 0; i < 2; i++) sunder_i_planar_map_free(f.region[i]);
    sunder_i_structuring_element_free(&f.element);
    sunder_i_arena_free(&f.scratch);
    sunder_i_placed_free(&placed);
    return status;
}
