/* Which pairs of pieces of two bodies are examined: those whose boxes are near each other, in order, for every kind of
 * pruning; compared with a loop over all of them. Few pieces and many, near and far. */
#include "random.h"

#include "displacement/solve/search/cluster_search.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 3 * MOST_FACING };

typedef struct world {
    sunder_i_model model;
    sunder_i_search search;
    sunder_i_body body[3];
    sunder_i_body_piece piece[3 * MOST];
    size_t pieces;
    double run[4 * (3 * MOST / SUNDER_I_RUN)];
    sunder_i_body_pieces of[3];
    _Atomic(sunder_i_body_pieces *) made[3];
    uint32_t number[2];
} world;

/* A body of n pieces, small and close together, or scattered. */
static void add_body(rng *r, world *w, size_t b, size_t n)
{
    sunder_i_body *body = &w->body[b];
    *body = (sunder_i_body){
        .piece = (uint32_t)w->pieces, .pieces = (uint32_t)n, .has = &sunder_i_no_extras, .clear = INFINITY};
    w->of[b].piece = w->piece + w->pieces;
    w->of[b].run = w->run;
    w->made[b] = &w->of[b];
    for (size_t c = 0; c < 2; c++) body->origin[c] = (double)rng_int(r, -400, 400) / 4;
    sunder_i_box_clear(body->box);
    const int64_t wide = rng_once_in(r, 3) ? 20 : 400;
    for (size_t k = 0; k < n; k++) {
        sunder_i_body_piece *p = &w->piece[w->pieces];
        for (size_t c = 0; c < 2; c++) {
            p->box[c] = (double)rng_int(r, -wide, wide) / 4 + (rng_once_in(r, 2) ? 0.1 : 0);
            p->box[c + 2] = p->box[c] + (double)rng_int(r, 0, 40) / 4;
        }
        sunder_i_box_join(body->box, p->box);
        sunder_i_box_join(w->run + 4 * (w->pieces++ / SUNDER_I_RUN), p->box);
    }
}

static size_t draw_number(rng *r)
{
    return (size_t)(rng_once_in(r, 3)   ? rng_int(r, 0, FEW_PARTS + 2)
                    : rng_once_in(r, 4) ? rng_int(r, MOST_FACING - 2, MOST)
                                        : rng_int(r, 1, 80));
}

static void make(rng *r, world *w)
{
    memset(w, 0, sizeof *w);
    for (size_t k = 0; k < sizeof w->run / sizeof *w->run / 4; k++) sunder_i_box_clear(w->run + 4 * k);
    w->model.made = w->made;
    w->model.body = w->body;
    w->model.rules.jumps = true;
    for (size_t b = 0; b < 3; b++) add_body(r, w, b, draw_number(r));
    w->number[0] = (uint32_t)rng_int(r, 0, 2);
    w->number[1] = (w->number[0] + (uint32_t)rng_int(r, 1, 2)) % 3;
    w->search.model = &w->model;
    w->search.body = w->number;
    w->search.n = w->search.own = 2;
}

typedef struct found {
    uint64_t key[MOST * 16];
    size_t n, all;
} found;

static void note(sunder_i_search *s, const sunder_i_piece_pair *part, void *context)
{
    found *f = context;
    const sunder_i_body_piece *all = ((const world *)s->model)->piece; /* the model is the first member of the struct */
    assert_int_equal(part->key, (uint64_t)(part->a - all) << 32 | (uint64_t)(part->b - all));
    if (f->n < sizeof f->key / sizeof *f->key) f->key[f->n++] = part->key;
    f->all++;
}

static void check_all(const world *w, const double u[2], double reach, const found *f)
{
    const sunder_i_body *p = &w->body[w->number[0]], *q = &w->body[w->number[1]];
    const double v[2] = {q->origin[0] - p->origin[0] + u[0], q->origin[1] - p->origin[1] + u[1]};
    size_t n = 0;
    for (uint32_t k = p->piece; k < p->piece + p->pieces; k++) {
        const double *a = w->piece[k].box,
                     box[4] = {a[0] - v[0] - reach, a[1] - v[1] - reach, a[2] - v[0] + reach, a[3] - v[1] + reach};
        for (uint32_t l = q->piece; l < q->piece + q->pieces; l++) {
            if (!sunder_i_box_meet(box, w->piece[l].box)) continue;
            if (n < f->n) assert_int_equal(f->key[n], (uint64_t)k << 32 | l);
            n++;
        }
    }
    assert_int_equal(n, f->all);
}

static void test_same_pairs(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    static world w;
    static found f;
    size_t some = 0;
    const size_t rounds = test_count(400);
    for (size_t k = 0; k < rounds; k++) {
        rng r = rng_start(seed, k);
        make(&r, &w);
        const double u[2] = {(double)rng_int(&r, -40, 40) / 4, (double)rng_int(&r, -40, 40) / 4};
        const double reach = rng_once_in(&r, 3) ? 0 : (double)rng_int(&r, -1, 40) / 4;
        f.n = f.all = 0;
        sunder_i_search_piece_pairs(&w.search, 0, 1, u, reach, false, note, &f);
        check_all(&w, u, reach, &f);
        some += f.all > 0;
    }
    assert_true(some > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_pairs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
