/* Coordinates and area of a sum on the way out: exact rationals as text, nearest doubles. */
#include "sum/sum.h"

#include <math.h>

long sunder_i_sum_coordinate(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big d,
                             sunder_i_big *num, sunder_i_big *den)
{
    const sunder_i_lattice *l = &sum->lattice;
    /* n * 2^e / d + both origins, over one power of two. */
    long e = l->exponent;
    for (int operand = 0; operand < 2; operand++) {
        int oe;
        const sunder_i_big o = sunder_i_big_double(arena, sum->origin[operand][axis], &oe);
        if (o.size == 0) continue;
        sunder_i_big od = sunder_i_big_mul(arena, o, d);
        if (oe >= e)
            od = sunder_i_big_shl(arena, od, (unsigned long)(oe - e));
        else {
            n = sunder_i_big_shl(arena, n, (unsigned long)(e - oe));
            e = oe;
        }
        n = sunder_i_big_add(arena, n, od);
    }
    *num = n;
    *den = d;
    return e;
}

double sunder_i_sum_double(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big d)
{
    sunder_i_big num, den;
    const long e = sunder_i_sum_coordinate(arena, sum, axis, n, d, &num, &den);
    return arena->failed ? (double)NAN : sunder_i_big_ratio(arena, num, den, e);
}

sunder_status sunder_i_sum_texts(sunder_i_arena *arena, const sunder_sum *sum, const sunder_i_big xyw[3], char **x,
                                 char **y, sunder_error *err)
{
    char *text[2] = {NULL, NULL};
    for (int k = 0; k < 2; k++) {
        sunder_i_big num, den;
        const long e = sunder_i_sum_coordinate(arena, sum, k, xyw[k], xyw[2], &num, &den);
        if (!arena->failed) text[k] = sunder_i_big_ratio_text(arena, num, den, e);
    }
    if (!text[0] || !text[1]) {
        sunder_i_free(text[0]);
        sunder_i_free(text[1]);
        return sunder_i_no_memory(err);
    }
    *x = text[0];
    *y = text[1];
    return SUNDER_OK;
}

/* x, y, w of a vertex. */
static void vertex_xyw(sunder_i_arena *arena, const sunder_sum *sum, uint32_t vertex, sunder_i_big xyw[3])
{
    sunder_i_hpoint_read(arena, &sum->lattice, &sum->vertex[vertex], xyw);
}

void sunder_sum_vertex(const sunder_sum *sum, uint32_t vertex, double xy[2])
{
    sunder_i_arena arena = {0};
    sunder_i_big xyw[3];
    vertex_xyw(&arena, sum, vertex, xyw);
    for (int k = 0; k < 2; k++) xy[k] = sunder_i_sum_double(&arena, sum, k, xyw[k], xyw[2]);
    sunder_i_arena_free(&arena);
}

sunder_status sunder_sum_vertex_text(const sunder_sum *sum, uint32_t vertex, char **x, char **y, sunder_error *err)
{
    sunder_i_arena arena = {0};
    sunder_i_big xyw[3];
    vertex_xyw(&arena, sum, vertex, xyw);
    const sunder_status status = sunder_i_sum_texts(&arena, sum, xyw, x, y, err);
    sunder_i_arena_free(&arena);
    return status;
}

/* ---- Area ---- */

typedef struct ratio {
    sunder_i_big num, den;
} ratio;

static ratio add(sunder_i_arena *arena, ratio a, ratio b)
{
    if (sunder_i_big_cmp(a.den, b.den) == 0) return (ratio){sunder_i_big_add(arena, a.num, b.num), a.den};
    const sunder_i_big g = sunder_i_big_gcd(arena, a.den, b.den);
    if (g.size == 0) return a; /* memory is out; the caller looks */
    const sunder_i_big bd = sunder_i_big_div_floor(arena, b.den, g);
    const sunder_i_big ad = sunder_i_big_div_floor(arena, a.den, g);
    ratio r;
    r.num = sunder_i_big_add(arena, sunder_i_big_mul(arena, a.num, bd), sunder_i_big_mul(arena, b.num, ad));
    r.den = sunder_i_big_mul(arena, a.den, bd);
    return r;
}

static bool is_one(sunder_i_big a) { return a.size == 1 && a.limb[0] == 1; }

static ratio reduce(sunder_i_arena *arena, ratio r)
{
    if (is_one(r.den)) return r;
    const sunder_i_big g = sunder_i_big_gcd(arena, r.num, r.den);
    if (g.size == 0 || r.num.size == 0 || is_one(g)) return r;
    return (ratio){sunder_i_big_div_floor(arena, r.num, g), sunder_i_big_div_floor(arena, r.den, g)};
}

/* Twice the area over one edge, x1 y2 - x2 y1, in lattice units: the origin drops out over a closed ring. */
static ratio edge_term(sunder_i_arena *arena, const sunder_sum *sum, uint32_t u, uint32_t v)
{
    sunder_i_big c[2][3];
    vertex_xyw(arena, sum, u, c[0]);
    vertex_xyw(arena, sum, v, c[1]);
    ratio r;
    r.num =
        sunder_i_big_sub(arena, sunder_i_big_mul(arena, c[0][0], c[1][1]), sunder_i_big_mul(arena, c[0][1], c[1][0]));
    r.den = sunder_i_big_mul(arena, c[0][2], c[1][2]);
    return reduce(arena, r);
}

/* Sums are taken in pairs, pairs of pairs and so on, so that operands of one addition are of one size: level k holds
 * the sum of 2^k terms, or nothing. */
typedef struct adder {
    ratio level[64];
    bool full[64];
} adder;

static void add_term(sunder_i_arena *arena, adder *a, ratio term)
{
    int k = 0;
    for (; a->full[k]; k++) {
        term = reduce(arena, add(arena, a->level[k], term));
        a->full[k] = false;
    }
    a->level[k] = term;
    a->full[k] = true;
}

static ratio total_of(sunder_i_arena *arena, const adder *a)
{
    ratio total = {{NULL, 0}, sunder_i_big_i64(arena, 1)};
    for (int k = 0; k < 64; k++)
        if (a->full[k]) total = add(arena, total, a->level[k]);
    return total;
}

/* Every so many edges have their numbers in an arena of their own, of which only the sum is kept. */
#define EDGES 256

static ratio area_twice(sunder_i_arena *arena, const sunder_sum *sum)
{
    sunder_i_arena scratch = {0};
    adder some = {.full = {false}}, all = {.full = {false}};
    size_t n = 0;
    for (size_t r = 0; r < sum->rings; r++) {
        const size_t from = r ? sum->ring_end[r - 1] : 0, to = sum->ring_end[r];
        for (size_t i = from; i < to && !arena->failed; i++) {
            const uint32_t u = sum->ring_vertex[i], v = sum->ring_vertex[i + 1 < to ? i + 1 : from];
            add_term(&scratch, &some, edge_term(&scratch, sum, u, v));
            if (++n % EDGES && (i + 1 < to || r + 1 < sum->rings)) continue;
            const ratio part = reduce(&scratch, total_of(&scratch, &some));
            add_term(arena, &all, (ratio){sunder_i_big_copy(arena, part.num), sunder_i_big_copy(arena, part.den)});
            arena->failed = arena->failed || scratch.failed;
            sunder_i_arena_free(&scratch);
            scratch = (sunder_i_arena){0};
            some = (adder){.full = {false}};
        }
    }
    sunder_i_arena_free(&scratch);
    return total_of(arena, &all);
}

sunder_status sunder_sum_area_text(const sunder_sum *sum, char **area, sunder_error *err)
{
    sunder_i_arena arena = {0};
    const ratio twice = area_twice(&arena, sum);
    char *text = NULL;
    if (!arena.failed) {
        text = sunder_i_big_ratio_text(&arena, twice.num, twice.den, 2 * sum->lattice.exponent - 1);
    }
    sunder_i_arena_free(&arena);
    if (!text) return sunder_i_no_memory(err);
    *area = text;
    return SUNDER_OK;
}
