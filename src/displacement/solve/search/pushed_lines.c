/* What pushing along a line (pushed.c) asks of the bodies about it: the support lines between them, which of these is
 * missed most, and how far the limit of a body lets it go. */
#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

typedef struct taking {
    sunder_i_push_lines *out;
    uint32_t other;
    bool turned;        /* the body that owns the lines is the second of the pair */
    const double *from; /* relative position of the pair */
} taking;

static void take_line(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    const taking *g = context;
    sunder_i_push_lines *out = g->out;
    double gap;
    size_t n;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge) return;
    const sunder_i_support h = sunder_i_search_support(pair, edge, n, g->from);
    const double sign = g->turned ? -1 : 1;
    if (!sunder_i_reserve(&out->line, &out->capacity, out->n + 1, sizeof *out->line)) {
        s->failed = true;
        return;
    }
    out->line[out->n++] = (sunder_i_push_line){
        .other = g->other, .n = {sign * h.n[0], sign * h.n[1]}, .d = h.support + gap, .u = {g->from[0], g->from[1]}};
}

/* Chooses the lines of body i towards all bodies that it might push. */
static void take_lines(sunder_i_pushed *p, uint32_t i)
{
    sunder_i_search *s = p->about.all;
    sunder_i_push_lines *out = &p->of[i];
    const double reach = s->gap + 2 * p->reach;
    out->n = 0;
    out->known = true;
    memcpy(out->at, s->t + 2 * (size_t)i, sizeof out->at);
    if (!sunder_i_neighbourhood_look_about(&p->about, i, reach)) s->failed = true;
    for (size_t k = 0; k < p->about.near.n && !s->failed; k++) {
        const uint32_t j = p->about.near.item[k], a = i < j ? i : j, b = i < j ? j : i;
        if (j == i) continue;
        const double u[2] = {s->t[2 * b] - s->t[2 * a], s->t[2 * b + 1] - s->t[2 * a + 1]};
        taking g = {out, j, i > j, u};
        sunder_i_search_piece_pairs(s, a, b, u, reach, true, take_line, &g);
    }
}

/* Have body i or its neighbours moved so far that its lines demand much more than necessary? */
static bool is_stale(const sunder_i_pushed *p, uint32_t i)
{
    const sunder_i_search *s = p->about.all;
    const sunder_i_push_lines *of = &p->of[i];
    const double near = PUSHED_STALE * p->reach;
    if (!of->known || sunder_i_max(fabs(s->t[2 * i] - of->at[0]), fabs(s->t[2 * i + 1] - of->at[1])) > p->reach / 2)
        return true;
    for (size_t k = 0; k < of->n; k++) {
        const uint32_t j = of->line[k].other, a = i < j ? i : j, b = i < j ? j : i;
        if (fabs(s->t[2 * b] - s->t[2 * a] - of->line[k].u[0]) > near ||
            fabs(s->t[2 * b + 1] - s->t[2 * a + 1] - of->line[k].u[1]) > near)
            return true;
    }
    return false;
}

const sunder_i_push_lines *sunder_i_pushed_lines(sunder_i_pushed *pushed, uint32_t body)
{
    if (!pushed->of[body].fresh && is_stale(pushed, body)) take_lines(pushed, body);
    pushed->of[body].fresh = true;
    return &pushed->of[body];
}

typedef struct worst {
    const double *u;
    double missing, n[2];
} worst;

static void note_worst(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    worst *w = context;
    double gap;
    size_t n;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge) return;
    const sunder_i_support h = sunder_i_search_support(pair, edge, n, w->u);
    if (!(gap - h.distance > w->missing)) return;
    *w = (worst){w->u, gap - h.distance, {h.n[0], h.n[1]}};
}

double sunder_i_pushed_missing(sunder_i_pushed *pushed, uint32_t i, uint32_t j, double n[2])
{
    sunder_i_search *s = pushed->about.all;
    const double u[2] = {s->t[2 * j] - s->t[2 * i], s->t[2 * j + 1] - s->t[2 * i + 1]};
    worst w = {u, 0, {1, 0}};
    sunder_i_search_piece_pairs(s, i, j, u, s->gap, false, note_worst, &w);
    memcpy(n, w.n, sizeof w.n);
    return w.missing;
}

void sunder_i_pushed_renew(sunder_i_pushed *pushed, uint32_t i, uint32_t j)
{
    pushed->of[i].known = pushed->of[j].known = false;
    pushed->of[i].fresh = pushed->of[j].fresh = false;
}

double sunder_i_pushed_room(const sunder_i_pushed *pushed, uint32_t body, const double along[2])
{
    const sunder_i_search *s = pushed->about.all;
    const double limit = sunder_i_search_limit(s, body), *t = s->t + 2 * (size_t)body;
    if (!(s->mass[body] > 0)) return 0;
    if (limit == INFINITY) return INFINITY;
    const double on = (along[0] * t[0] + along[1] * t[1]), left = limit * limit - (t[0] * t[0] + t[1] * t[1]);
    return sunder_i_max(0, sqrt(sunder_i_max(0, on * on + left)) - on);
}
