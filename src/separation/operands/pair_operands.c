/* pair_operands.c: places two operands on one lattice, with all their coordinates in doubles, too.
 *
 * Usually the coordinates of both, and their translations, are integers below 2^62 in one unit, a power of two, and
 * close to each other: then no general lattice is needed, and setting up a pair of buildings takes no longer than
 * testing it. Other operands are placed in the general way (shape/shape_on_lattice.c). */
#include "separation/operands/pair_operands.h"

#include "spatial/box.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* Coordinates in doubles have an error of 2^-53 of the magnitude M; a sum of two adds as much and its own rounding. A
 * point a + t d, with t from an exact fraction (an error of 2^-50 of max(1, |t|), t in [0, 1]) and |d| <= 4 M, has an
 * error of at most 2^-47 M. The constant is larger, which costs only a few exact evaluations. */
#define COORDINATE_ERROR 0x1p-45

void sunder_i_operands_fill_boxes(sunder_i_operands *operands, int side)
{
    const sunder_shape *s = operands->shape[side];
    const double *xy = operands->xy[side];
    double all[4];
    sunder_i_box_clear(all);
    const uint32_t *corner = sunder_i_piece_vertices(s);
    for (uint32_t i = 0; i < s->pieces; i++) {
        const uint32_t *const end = sunder_i_piece_vertices(s) + s->piece_end[i];
        double box[4];
        sunder_i_box_clear(box);
        for (; corner < end; corner++) sunder_i_box_include(box, xy + 2 * (size_t)*corner);
        sunder_i_box_join(all, box);
        memcpy(operands->piece_box[side] + 4 * (size_t)i, box, sizeof box);
        operands->turned[side][i].n = 0;
    }
    memcpy(operands->box[side], all, sizeof all);
    double most = operands->magnitude;
    for (int k = 0; k < 4; k++) most = fabs(all[k]) > most ? fabs(all[k]) : most;
    operands->magnitude = most;
}

static void fill_doubles(sunder_i_operands *g, int side)
{
    for (uint32_t v = 0; v < g->shape[side]->vertices; v++) {
        g->xy[side][2 * v] = sunder_i_approx(&g->placed.lattice, g->at[side][v].x);
        g->xy[side][2 * v + 1] = sunder_i_approx(&g->placed.lattice, g->at[side][v].y);
    }
}

/* Allocates all arrays as one block of the lattice's arena; with `points` also room for the vertices on the lattice.
 * Returns false if out of memory. */
static bool make_room(sunder_i_operands *g, sunder_i_point **points)
{
    const size_t pn = g->shape[0]->vertices, qn = g->shape[1]->vertices;
    const size_t pp = g->shape[0]->pieces, qp = g->shape[1]->pieces;
    const size_t doubles = (2 * (pn + qn) + 4 * (pp + qp)) * sizeof(double),
                 rings = (pp + qp) * sizeof(sunder_i_turned_piece);
    const size_t extra = points ? (pn + qn) * sizeof **points : 0;
    char *block = sunder_i_arena_alloc(&g->placed.lattice.arena, doubles + rings + extra, 1);
    if (!block) return false;
    g->xy[0] = (double *)(void *)block;
    g->xy[1] = g->xy[0] + 2 * pn;
    g->piece_box[0] = g->xy[1] + 2 * qn;
    g->piece_box[1] = g->piece_box[0] + 4 * pp;
    g->turned[0] = (sunder_i_turned_piece *)(void *)(block + doubles);
    g->turned[1] = g->turned[0] + pp;
    if (points) *points = (sunder_i_point *)(void *)(block + doubles + rings);
    return true;
}

/* ---- The usual case: all doubles are below 2^62 units in magnitude ---- */

typedef struct plain {
    int bit;            /* the unit is 2^bit */
    double scale, back; /* 2^-bit, 2^bit */
    double shift[2][2]; /* the translations of the operands, in units */
    double origin[2];   /* in units */
} plain;

static void hold_doubles(plain *u, const double *v, size_t n, double *most)
{
    for (size_t i = 0; i < n; i++) {
        const int b = sunder_i_low_bit(v[i]);
        if (b < u->bit) u->bit = b;
        *most = sunder_i_max(*most, fabs(v[i]));
    }
}

/* Returns whether coordinate k of every vertex of the translated operand is less than 2^58 units from the origin. */
static bool is_near(const sunder_shape *s, int k, const plain *u, const double *shift)
{
    const double by = shift ? shift[k] : 0;
    return fabs((s->box[k] + by) * u->scale - u->origin[k]) < 0x1p58 &&
           fabs((s->box[k + 2] + by) * u->scale - u->origin[k]) < 0x1p58;
}

/* Returns the origin of coordinates that have too many digits for doubles; the general way chooses the same. */
static double shared_origin(const sunder_shape *p, const sunder_shape *q, int k, int bit,
                            const sunder_i_operands_options *o)
{
    double low[2] = {p->box[k], q->box[k]}, high[2] = {p->box[k + 2], q->box[k + 2]};
    const double *const shift[2] = {o->tp, o->tq};
    for (int i = 0; i < 2; i++) {
        if (!shift[i] || shift[i][k] == 0) continue;
        low[i] = nextafter(low[i] + shift[i][k], -INFINITY);
        high[i] = nextafter(high[i] + shift[i][k], INFINITY);
    }
    return sunder_i_lattice_origin(sunder_i_min(low[0], low[1]), sunder_i_max(high[0], high[1]), bit);
}

/* Finds the unit in which everything is an integer below 2^62 and the operands, relative to the origin, are below 2^58,
 * so that their sums fit a narrow lattice. Returns false if there is none. */
static bool plain_unit(const sunder_shape *p, const sunder_shape *q, const sunder_i_operands_options *o, plain *u)
{
    if (p->rational || q->rational || o->force_wide) return false;
    double most = 0, added = 0;
    u->bit = p->low_bit < q->low_bit ? p->low_bit : q->low_bit;
    for (int k = 0; k < 4; k++) most = sunder_i_max(most, sunder_i_max(fabs(p->box[k]), fabs(q->box[k])));
    hold_doubles(u, o->extra, o->extra_n, &added);
    if (o->tp) hold_doubles(u, o->tp, 2, &added);
    if (o->tq) hold_doubles(u, o->tq, 2, &added);
    if (u->bit <= -900 || u->bit >= 900 || most >= sunder_i_power_of_two(u->bit + 62) ||
        added >= sunder_i_power_of_two(u->bit + 58))
        return false;
    u->scale = sunder_i_power_of_two(-u->bit);
    u->back = sunder_i_power_of_two(u->bit);
    const bool shorter = sunder_i_max(most, added) < sunder_i_power_of_two(u->bit + 53);
    for (int k = 0; k < 2; k++) {
        u->shift[0][k] = o->tp ? o->tp[k] * u->scale : 0;
        u->shift[1][k] = o->tq ? o->tq[k] * u->scale : 0;
        u->origin[k] = shorter ? floor((p->box[k] / 2 + p->box[k + 2] / 2) * u->scale)
                               : shared_origin(p, q, k, u->bit, o) * u->scale;
        if (!shorter && (!is_near(p, k, u, o->tp) || !is_near(q, k, u, o->tq))) return false;
    }
    return true;
}

/* Converts the vertices of an operand. All numbers are integers below 2^62, so that their differences are exact; they
 * are also exact in doubles unless the magnitude is too large. */
static void plain_operand(sunder_i_operands *g, int side, const plain *u, bool reflect, sunder_i_point *out)
{
    const sunder_shape *s = g->shape[side];
    double *xy = g->xy[side];
    const int64_t add_x = (int64_t)u->shift[side][0] - (int64_t)u->origin[0];
    const int64_t add_y = (int64_t)u->shift[side][1] - (int64_t)u->origin[1];
    for (uint32_t v = 0; v < s->vertices; v++) {
        const int64_t x = (int64_t)(s->xy[2 * v] * u->scale) + add_x,
                      y = (int64_t)(s->xy[2 * v + 1] * u->scale) + add_y;
        out[v] = reflect ? (sunder_i_point){-x, -y} : (sunder_i_point){x, y};
        xy[2 * v] = (double)out[v].x;
        xy[2 * v + 1] = (double)out[v].y;
    }
}

static bool place_plain(sunder_i_operands *g, const sunder_i_operands_options *o, const plain *u)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const bool reflect = o->reflect_q;
    if (o->memory) sunder_i_arena_init_on(&l->arena, o->memory, o->memory_bytes);
    l->narrow = l->small = true;
    l->exponent = u->bit;
    sunder_i_point *points;
    if (!make_room(g, &points)) return false;
    for (int k = 0; k < 2; k++) {
        g->placed.origin_p[k] = u->origin[k] * u->back;
        g->placed.origin_q[k] = reflect ? -g->placed.origin_p[k] : g->placed.origin_p[k];
    }
    g->at[0] = points;
    g->at[1] = points + g->shape[0]->vertices;
    plain_operand(g, 0, u, false, points);
    plain_operand(g, 1, u, reflect, points + g->shape[0]->vertices);
    return true;
}

/* Returns the difference of the translations if it is exact in doubles; only the difference matters, and applying it to
 * Q alone keeps the numbers short. NULL: it is not exact, which is decided by the rounding error of the subtraction
 * (Knuth's two-sum), or tp is NULL. */
static const double *reduced_translation(const double *tp, const double *tq, double difference[2])
{
    if (!tp) return NULL;
    for (int k = 0; k < 2; k++) {
        const double a = tq ? tq[k] : 0, b = -tp[k], s = a + b, bb = s - a;
        if (!isfinite(s) || (a - (s - bb)) + (b - bb) != 0) return NULL;
        difference[k] = s;
    }
    return difference;
}

static sunder_status place_operands(sunder_i_operands *g, const sunder_i_operands_options *given, sunder_error *err)
{
    plain u;
    double difference[2];
    sunder_i_operands_options reduced_options = *given;
    const sunder_i_operands_options *o = given;
    if (reduced_translation(given->tp, given->tq, difference)) {
        g->base[0] = given->tp[0];
        g->base[1] = given->tp[1];
        reduced_options.tp = NULL;
        reduced_options.tq = difference;
        o = &reduced_options;
    }
    const sunder_shape *p = g->shape[0], *q = g->shape[1];
    if (plain_unit(p, q, o, &u)) {
        if (place_plain(g, o, &u)) return SUNDER_OK;
        sunder_i_placed_free(&g->placed);
        return sunder_i_failure_cause(err);
    }
    const sunder_i_place_options options = {.reflect_q = o->reflect_q,
                                            .common_origin = true,
                                            .extra = o->extra,
                                            .extra_n = o->extra_n,
                                            .shift_p = o->tp,
                                            .shift_q = o->tq,
                                            .force_wide = o->force_wide};
    const sunder_status status = sunder_i_place(p, q, &options, &g->placed, err);
    if (status) return status;
    if (!make_room(g, NULL) || g->placed.lattice.arena.failed) {
        sunder_i_placed_free(&g->placed);
        return sunder_i_failure_cause(err);
    }
    g->at[0] = g->placed.p;
    g->at[1] = g->placed.q;
    fill_doubles(g, 0);
    fill_doubles(g, 1);
    return SUNDER_OK;
}

void sunder_i_operands_admit(sunder_i_operands *operands, double magnitude)
{
    operands->magnitude = sunder_i_max(operands->magnitude, magnitude);
    operands->error = sunder_i_max(operands->error, COORDINATE_ERROR * operands->magnitude);
}

sunder_status sunder_i_operands_init(sunder_i_operands *operands, const sunder_shape *p, const sunder_shape *q,
                                     const sunder_i_operands_options *options, sunder_error *err)
{
    memset(operands, 0, sizeof *operands);
    operands->shape[0] = p;
    operands->shape[1] = q;
    const sunder_status status = place_operands(operands, options, err);
    if (status) return status;
    sunder_i_lattice *l = &operands->placed.lattice;
    sunder_i_operands_fill_boxes(operands, 0);
    sunder_i_operands_fill_boxes(operands, 1);
    operands->brief = l->narrow && operands->magnitude < 0x1p28;
    sunder_i_operands_admit(operands, 0);
    /* differences in doubles are correctly rounded, except for what a scaled lattice loses below the range of
     * doubles */
    operands->rough = l->approx_shift == 0 ? 0 : 0x1p-1000;
    operands->coarse = l->narrow && operands->magnitude < 0x1p52 ? 0 : operands->error;
    operands->unit = sunder_i_power_of_two(l->exponent + l->approx_shift);
    return SUNDER_OK;
}

void sunder_i_operands_free(sunder_i_operands *operands) { sunder_i_placed_free(&operands->placed); }

sunder_status sunder_i_operands_end(sunder_i_operands *operands, sunder_error *err)
{
    const bool failed = operands->placed.lattice.arena.failed;
    sunder_i_operands_free(operands);
    return failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}

double sunder_i_operands_way_out(const sunder_i_operands *operands)
{
    double d = INFINITY;
    for (int k = 0; k < 4; k++) {
        const double way = fabs(operands->box[0][k] + operands->box[1][k]);
        if (way < d) d = way;
    }
    return d;
}

/* Returns whether a + s + gap <= b + t certainly. Each sum of doubles has an error of at most one ulp of its larger
 * operand. */
static bool certainly_below(double a, double s, double b, double t, double gap)
{
    const double left = a + s + gap, right = b + t;
    const double slack = 0x1p-50 * (fabs(a) + fabs(s) + gap + fabs(b) + fabs(t));
    return left + slack < right || (s == 0 && t == 0 && gap == 0 && a <= b);
}

bool sunder_i_boxes_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                          double gap)
{
    for (int k = 0; k < 2; k++) {
        const double s = tp ? tp[k] : 0, t = tq ? tq[k] : 0;
        if (certainly_below(p->box[k + 2], s, q->box[k], t, gap) ||
            certainly_below(q->box[k + 2], t, p->box[k], s, gap))
            return true;
    }
    return false;
}
