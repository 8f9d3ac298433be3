#include "gap_oracle_inner.h"

#include <math.h>
#include <stdlib.h>

/* Squared distance of corner (cx, cy) + sign (x, y) from the side, minus the square of the gap. */
static void excess(mpf_t out, const side *s, double cx, double cy, const mpf_t x, const mpf_t y, int sign, double gap,
                   numbers *w)
{
    mpf_t *v = w->v;
    minus(v[0], s->bx, s->ax);
    minus(v[1], s->by, s->ay);
    minus(v[2], cx, s->ax);
    minus(v[3], cy, s->ay);
    (sign > 0 ? mpf_add : mpf_sub)(v[2], v[2], x);
    (sign > 0 ? mpf_add : mpf_sub)(v[3], v[3], y);
    pair_sum(v[4], v[0], v[2], v[1], v[3], v[6], false);
    pair_sum(v[5], v[0], v[0], v[1], v[1], v[6], false);
    if (mpf_sgn(v[4]) > 0 && mpf_cmp(v[4], v[5]) < 0) {
        pair_sum(v[4], v[0], v[3], v[1], v[2], v[6], true);
        mpf_mul(v[4], v[4], v[4]);
        mpf_div(out, v[4], v[5]);
    } else {
        if (mpf_sgn(v[4]) > 0) {
            mpf_sub(v[2], v[2], v[0]);
            mpf_sub(v[3], v[3], v[1]);
        }
        pair_sum(out, v[2], v[2], v[3], v[3], v[6], false);
    }
    mpf_set_d(v[4], gap);
    mpf_mul(v[4], v[4], v[4]);
    mpf_sub(out, out, v[4]);
}

static double side_distance(const side *s, double x, double y)
{
    const double dx = s->bx - s->ax, dy = s->by - s->ay;
    double t = ((x - s->ax) * dx + (y - s->ay) * dy) / (dx * dx + dy * dy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - s->ax - t * dx, y - s->ay - t * dy);
}

/* Returns 1 if the place keeps the gap, 0 if it does not, -1 if more bits are needed. With many bits a difference near
 * zero counts as zero. Pairs that are farther apart in doubles than the gap plus `spare` are skipped. */
static int keeps(const figure *f, const mpf_t x, const mpf_t y, double spare, int level, numbers *w)
{
    const double dx = mpf_get_d(x), dy = mpf_get_d(y), far = f->gap + spare;
    int answer = 1;
    mpf_t e;
    mpf_init2(e, precision(level));
    for (size_t i = 0; i < f->n && answer; i++)
        for (size_t j = 0; j < f->m && answer; j++)
            for (int k = 0; k < 2 && answer; k++) {
                if ((k ? side_distance(&f->b[j], f->a[i].ax - dx, f->a[i].ay - dy)
                       : side_distance(&f->a[i], f->b[j].ax + dx, f->b[j].ay + dy)) > far)
                    continue;
                if (k)
                    excess(e, &f->b[j], f->a[i].ax, f->a[i].ay, x, y, -1, f->gap, w);
                else
                    excess(e, &f->a[i], f->b[j].ax, f->b[j].ay, x, y, 1, f->gap, w);
                if (negligible(e, level))
                    answer = level == LONG ? answer : -1;
                else if (mpf_sgn(e) < 0)
                    answer = 0;
            }
    mpf_clear(e);
    return answer;
}

/* In doubles: does the place violate the gap by far more than their rounding error? */
static bool plainly_near(const figure *f, double x, double y, double spare)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < f->m; j++)
            if (side_distance(&f->a[i], f->b[j].ax + x, f->b[j].ay + y) < f->gap - spare ||
                side_distance(&f->b[j], f->a[i].ax - x, f->a[i].ay - y) < f->gap - spare)
                return true;
    return false;
}

typedef struct judging {
    figure f;
    double size, limit;  /* size of the figure; places farther away than `limit` do not matter */
    mpf_t answer, bound; /* squares: of the answer minus 1e-9 of it, and of the bound */
    numbers work[2];
    mpf_t x[2], y[2], square;
    gap_verdict verdict;
    double length;
} judging;

static void try_place(judging *g, place *p)
{
    bool sure;
    if (!rough_place(p, g->size, g->limit, &sure)) return;
    const double spare = 1e-7 * g->size;
    if (sure && (hypot(p->x, p->y) > g->limit + spare || plainly_near(&g->f, p->x, p->y, spare))) return;
    if (!locate(g->x[SHORT], g->y[SHORT], p, SHORT, &g->work[SHORT])) return;
    const double x = mpf_get_d(g->x[SHORT]), y = mpf_get_d(g->y[SHORT]);
    if (hypot(x, y) > g->limit) return;
    /* After a free place is found, only places that are nearer than the answer or the bound can change the verdict. */
    pair_sum(g->square, g->x[SHORT], g->x[SHORT], g->y[SHORT], g->y[SHORT], g->work[SHORT].v[0], false);
    if (g->length < INFINITY && mpf_cmp(g->square, g->answer) >= 0 && mpf_cmp(g->square, g->bound) >= 0) return;
    if (plainly_near(&g->f, x, y, spare)) return;
    int free = keeps(&g->f, g->x[SHORT], g->y[SHORT], spare, SHORT, &g->work[SHORT]);
    if (free == 0) return;
    if (!locate(g->x[LONG], g->y[LONG], p, LONG, &g->work[LONG])) return;
    pair_sum(g->square, g->x[LONG], g->x[LONG], g->y[LONG], g->y[LONG], g->work[LONG].v[0], false);
    const bool shorter = mpf_cmp(g->square, g->answer) < 0, below = mpf_cmp(g->square, g->bound) < 0;
    if (free < 0) free = keeps(&g->f, g->x[LONG], g->y[LONG], spare, LONG, &g->work[LONG]);
    if (free <= 0 || !interiors_apart(&g->f, x, y)) return;
    if (below)
        g->verdict = GAP_BOUND_HIGH;
    else if (shorter && g->verdict == GAP_FINE)
        g->verdict = GAP_TOO_LONG;
    g->length = fmin(g->length, sqrt(mpf_get_d(g->square)));
}

static void judging_open(judging *g, const mpq_t square, double bound)
{
    for (size_t i = 0; i < g->f.n; i++) g->size = fmax(g->size, fmax(fabs(g->f.a[i].ax), fabs(g->f.a[i].ay)));
    for (size_t i = 0; i < g->f.m; i++) g->size = fmax(g->size, fmax(fabs(g->f.b[i].ax), fabs(g->f.b[i].ay)));
    g->size += g->f.gap;
    g->limit = sqrt(mpq_get_d(square)) * (1 + 1e-6);
    for (int k = 0; k < 2; k++) {
        numbers_open(&g->work[k], k);
        mpf_init2(g->x[k], precision(k));
        mpf_init2(g->y[k], precision(k));
    }
    mpf_init2(g->square, precision(LONG));
    mpf_init2(g->answer, precision(LONG));
    mpf_init2(g->bound, precision(LONG));
    mpf_set_q(g->answer, square);
    mpf_set_d(g->bound, 1 + 1e-9);
    mpf_div(g->answer, g->answer, g->bound);
    mpf_div(g->answer, g->answer, g->bound);
    mpf_set_d(g->bound, bound);
    mpf_mul(g->bound, g->bound, g->bound);
    g->verdict = GAP_FINE;
    g->length = INFINITY;
}

static void judging_close(judging *g)
{
    for (int k = 0; k < 2; k++) {
        numbers_close(&g->work[k]);
        mpf_clears(g->x[k], g->y[k], NULL);
    }
    mpf_clears(g->square, g->answer, g->bound, NULL);
    figure_close(&g->f);
}

gap_verdict gap_oracle_judge(const polyset *p, const polyset *q, double gap, const mpq_t square, double bound,
                             double *length)
{
    judging g = {.size = 0};
    figure_open(&g.f, p, q, gap);
    judging_open(&g, square, bound);
    track *t = test_alloc(5 * g.f.n * g.f.m, sizeof *t);
    const size_t n = drop_far_tracks(t, add_tracks(&g.f, t), g.limit + 1e-9 * g.size);
    for (size_t i = 0; i < n; i++) {
        place at = {.t = &t[i]};
        try_place(&g, &at);
        for (size_t j = 0; j < i; j++)
            for (int root = -1; root <= 1; root += 2) {
                if (root > 0 && !t[i].circle && !t[j].circle) continue;
                at = (place){&t[i], &t[j], root, 0, 0};
                try_place(&g, &at);
            }
    }
    for (size_t i = 0; i < n; i++) release(&t[i]);
    free(t);
    *length = g.length;
    const gap_verdict verdict = g.verdict;
    judging_close(&g);
    return verdict;
}
