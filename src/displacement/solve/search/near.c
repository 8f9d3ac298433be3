/* Which bodies of a cluster stand near each other: a sweep over their boxes from left to right. */
#include "displacement/solve/search/cluster_search.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/sort.h"

/* Sorts boxes by their left sides. (Clusters can be large, so insertion sort from the last order would not do.) */
static int by_left(const void *a, const void *b)
{
    const double *p = *(const double *const *)a, *q = *(const double *const *)b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return p < q ? -1 : p > q;
}

static bool sort_boxes(sunder_i_search *s, const double *t, double reach, bool or_home)
{
    const double *o = s->model->body[s->body[0]].origin;
    const double *few[FEW_BODIES], **left = s->n <= FEW_BODIES ? few : sunder_i_alloc(s->n, sizeof *left);
    if (!left) return false;
    for (size_t k = 0; k < s->n; k++) {
        const sunder_i_body *b = &s->model->body[s->body[k]];
        const bool home = or_home && s->mass[k] > 0;
        for (int c = 0; c < 4; c++) {
            const double at = t[2 * k + (size_t)(c & 1)], least = home ? sunder_i_min(at, 0) : at,
                         most = home ? sunder_i_max(at, 0) : at;
            s->box[4 * k + (size_t)c] =
                b->box[c] + (b->origin[c & 1] - o[c & 1]) + (c < 2 ? least - reach / 2 : most + reach / 2);
        }
        left[k] = s->box + 4 * k;
    }
    sunder_i_sort_few(left, s->n, sizeof *left, by_left);
    for (size_t k = 0; k < s->n; k++) s->order[k] = (uint32_t)((size_t)(left[k] - s->box) / 4);
    if (left != few) sunder_i_free(left);
    return true;
}

static void visit_near(sunder_i_search *s, const double *t, double reach, bool or_home, sunder_i_visit_pair visit,
                       void *context)
{
    if (!sort_boxes(s, t, reach, or_home)) {
        s->failed = true;
        return;
    }
    /* visit() may change s->box, but never calls this function again. */
    for (size_t x = 0; x < s->n && !s->failed; x++) {
        const uint32_t i = s->order[x];
        const double *a = s->box + 4 * i;
        for (size_t y = x + 1; y < s->n; y++) {
            const uint32_t j = s->order[y];
            const double *b = s->box + 4 * j;
            if (b[0] > a[2]) break;
            if (b[1] > a[3] || a[1] > b[3] || !(s->mass[i] + s->mass[j] > 0)) continue;
            visit(s, i < j ? i : j, i < j ? j : i, context);
        }
    }
}

void sunder_i_search_visit_near(sunder_i_search *search, const double *t, double reach, sunder_i_visit_pair visit,
                                void *context)
{
    visit_near(search, t, reach, false, visit, context);
}

void sunder_i_search_visit_near_or_home(sunder_i_search *search, double reach, sunder_i_visit_pair visit, void *context)
{
    visit_near(search, search->t, reach, true, visit, context);
}
