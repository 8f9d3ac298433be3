/* The sweep that recognises rings without any contact, compared with all pairs of edges: random rings on small grids,
 * in which corners fall on edges and edges on each other; stars, which are mostly simple; two rings. And long spikes
 * through the public interface, with one corner that touches or crosses. */
#include "generate.h"
#include "shape/build.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define MOST 24

typedef struct fixture {
    sunder_i_lattice lattice;
    sunder_i_arena arena;
    sunder_i_rings r;
    sunder_i_point at[MOST];
    double xy[2 * MOST];
    uint32_t next[MOST], prev[MOST], ring_end[2];
} fixture;

static void add(fixture *f, int64_t x, int64_t y)
{
    const uint32_t v = f->r.vertices++;
    f->at[v] = (sunder_i_point){x, y};
    f->xy[2 * v] = (double)x;
    f->xy[2 * v + 1] = (double)y;
}

static void random_ring(fixture *f, rng *r)
{
    const bool star = rng_once_in(r, 2);
    const int n = (int)rng_int(r, 3, MOST / 2), size = (int)rng_int(r, 3, star ? 40 : 9);
    for (int i = 0; i < n; i++) {
        const double angle = 6.283185307179586 * i / n, length = size * (0.2 + 0.8 * rng_unit(r));
        if (star)
            add(f, (int64_t)rint(length * cos(angle)), (int64_t)rint(length * sin(angle)));
        else
            add(f, rng_int(r, 0, size), rng_int(r, 0, size));
    }
    f->ring_end[f->r.rings++] = f->r.vertices;
}

/* Links the vertices as clean.c leaves rings: without repeated or straight corners, without spikes. */
static bool link_clean(fixture *f)
{
    for (uint32_t k = 0, v = 0; k < f->r.rings; k++) {
        const uint32_t first = v, end = f->ring_end[k];
        for (; v < end; v++) {
            f->next[v] = v + 1 < end ? v + 1 : first;
            f->prev[v] = v > first ? v - 1 : end - 1;
        }
    }
    for (uint32_t v = 0; v < f->r.vertices; v++)
        if (sunder_i_rings_orient(&f->r, f->prev[v], v, f->next[v]) == 0) return false;
    return true;
}

static void start(fixture *f)
{
    memset(f, 0, sizeof *f);
    f->lattice = (sunder_i_lattice){.narrow = true, .small = true, .scale = 1};
    f->r = (sunder_i_rings){
        .lattice = &f->lattice, .at = f->at, .xy = f->xy, .ring_end = f->ring_end, .next = f->next, .prev = f->prev};
}

static void test_against_all_pairs(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(20000);
    size_t simple = 0, met = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed * 47, i);
        fixture f;
        start(&f);
        random_ring(&f, &r);
        if (rng_once_in(&r, 3)) random_ring(&f, &r);
        if (!link_clean(&f)) continue;
        sunder_i_problem problem = {SUNDER_I_SOUND, 0, SUNDER_I_NONE};
        bool touches;
        sunder_i_intersections_find(&f.r, 0, f.r.rings, NULL, &f.arena, &problem, &touches);
        const bool expected = !problem.fault && !touches;
        if (sunder_i_rings_simple(&f.r, 0, f.r.rings, &f.arena) != expected) {
            print_message("case %zu: %s\n", i, expected ? "simple" : "not simple");
            fail();
        }
        *(expected ? &simple : &met) += 1;
        sunder_i_arena_free(&f.arena);
        sunder_i_lattice_free(&f.lattice);
    }
    assert_true(simple > n / 20 && met > n / 20);
}

#define SPIKES 600

/* A star of spikes whose boxes meet nearly all others; the last corner but one is displaced. */
static void spikes(double *xy, rng *r)
{
    for (int i = 0; i < SPIKES; i++) {
        const double angle = 6.283185307179586 * i / SPIKES, length = i % 2 ? 100000 : 1000 * (1 + rng_unit(r));
        xy[2 * i] = rint(length * cos(angle));
        xy[2 * i + 1] = rint(length * sin(angle));
    }
}

static void test_spikes(void **state)
{
    (void)state;
    static double xy[2 * SPIKES];
    const size_t ring = SPIKES, polygon = 1;
    rng r = rng_start(test_seed(), 0);
    spikes(xy, &r);
    sunder_shape *shape;
    assert_int_equal(sunder_shape_from_rings(xy, &ring, &polygon, 1, SUNDER_VALIDITY_STRICT, &shape, NULL), SUNDER_OK);
    assert_false(sunder_shape_touches(shape));
    sunder_shape_free(shape);

    /* a base corner moved onto another one, and past it */
    const double *foot = xy + 2 * (SPIKES - 2), *other = xy + 2 * 300;
    double moved[2 * SPIKES];
    memcpy(moved, xy, sizeof moved);
    moved[2 * (SPIKES - 2)] = other[0];
    moved[2 * (SPIKES - 2) + 1] = other[1];
    sunder_error err;
    const sunder_status touching =
        sunder_shape_from_rings(moved, &ring, &polygon, 1, SUNDER_VALIDITY_STRICT, &shape, &err);
    assert_true(touching == SUNDER_EINVALID || (touching == SUNDER_OK && sunder_shape_touches(shape)));
    if (touching == SUNDER_OK) sunder_shape_free(shape);
    moved[2 * (SPIKES - 2)] = 3 * other[0] - foot[0];
    moved[2 * (SPIKES - 2) + 1] = 3 * other[1] - foot[1];
    assert_int_equal(sunder_shape_from_rings(moved, &ring, &polygon, 1, SUNDER_VALIDITY_STRICT, &shape, &err),
                     SUNDER_EINVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_all_pairs), cmocka_unit_test(test_spikes)};
    return cmocka_run_group_tests_name("simple rings", tests, NULL, NULL);
}
