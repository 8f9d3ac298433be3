/* area.c: the exact area of a sum. Vertices have denominators of their own, so that terms are reduced, and summed in
 * pairs of similar size. */
#include "sum/sum_value.h"

/* Returns twice the contribution of the edge uv to the area, x1 y2 - x2 y1, in lattice units: the origin cancels over a
 * closed ring. */
static sunder_i_ratio edge_term(sunder_i_arena *arena, const sunder_sum *sum, uint32_t u, uint32_t v)
{
    const sunder_i_rational_point a = sunder_i_sum_point(arena, sum, u), b = sunder_i_sum_point(arena, sum, v);
    return sunder_i_ratio_reduced(
        arena, (sunder_i_ratio){sunder_i_rational_cross(arena, a, b), sunder_i_big_mul(arena, a.w, b.w)});
}

/* Terms are added in pairs, pairs of pairs and so on, so that the operands of an addition have similar sizes: level k
 * is the sum of 2^k terms, or empty. */
typedef struct adder {
    sunder_i_ratio level[64];
    bool full[64];
} adder;

static void add_term(sunder_i_arena *arena, adder *a, sunder_i_ratio term)
{
    int k = 0;
    for (; a->full[k]; k++) {
        term = sunder_i_ratio_reduced(arena, sunder_i_ratio_add(arena, a->level[k], term));
        a->full[k] = false;
    }
    a->level[k] = term;
    a->full[k] = true;
}

static sunder_i_ratio total_of(sunder_i_arena *arena, const adder *a)
{
    sunder_i_ratio total = {{NULL, 0}, sunder_i_big_i64(arena, 1)};
    for (int k = 0; k < 64; k++)
        if (a->full[k]) total = sunder_i_ratio_add(arena, total, a->level[k]);
    return total;
}

/* The number of edges in a group; the arena of a group is freed, and only its sum is kept. */
#define EDGES 256

static sunder_i_ratio area_twice(sunder_i_arena *arena, const sunder_sum *sum)
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
            const sunder_i_ratio part = sunder_i_ratio_reduced(&scratch, total_of(&scratch, &some));
            add_term(arena, &all,
                     (sunder_i_ratio){sunder_i_big_copy(arena, part.num), sunder_i_big_copy(arena, part.den)});
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
    const sunder_i_ratio twice = area_twice(&arena, sum);
    char *text = NULL;
    if (!arena.failed) text = sunder_i_big_ratio_text(&arena, twice.num, twice.den, 2 * sum->lattice.exponent - 1);
    sunder_i_arena_free(&arena);
    if (!text) return sunder_i_failure_cause(err);
    *area = text;
    return SUNDER_OK;
}
