/* Where the bodies of a search have been on their way, as boxes: an index for the search for room.
 *
 * A body, at its origin or anywhere within reach of it, can meet another, or be kept from passing it, only where that
 * one stands, stood, or moved: within the box of its path. In a large cluster that rules out most bodies at once; in a
 * small one all are looked at. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <string.h>

static bool build_index(sunder_i_search *s)
{
    double *box = sunder_i_alloc(4 * s->n, sizeof *box);
    bool *present = sunder_i_alloc(s->n, sizeof *present);
    bool ok = box && present;
    sunder_i_rtree_free(&s->visited);
    for (uint32_t k = 0; ok && k < s->n; k++) {
        sunder_i_search_path_box(s, s->t, k, box + 4 * (size_t)k);
        present[k] = s->model->body[s->body[k]].pieces > 0;
    }
    ok = ok && sunder_i_rtree_build(box, present, s->n, &s->visited, NULL) == SUNDER_OK;
    if (ok) memcpy(s->visited_at, s->t, 2 * s->n * sizeof *s->visited_at);
    sunder_i_free_all(box, present);
    return ok;
}

/* Updates the index to the present moves. False if memory is out. */
static bool bring_up_to_date(sunder_i_search *s)
{
    if (!s->visited_at) {
        s->visited_at = sunder_i_alloc(2 * s->n, sizeof *s->visited_at);
        return s->visited_at && build_index(s);
    }
    if (memcmp(s->visited_at, s->t, 2 * s->n * sizeof *s->visited_at) == 0) return true;
    for (uint32_t k = 0; k < s->n; k++) {
        double box[4];
        if (memcmp(s->visited_at + 2 * k, s->t + 2 * k, 2 * sizeof *s->visited_at) == 0) continue;
        memcpy(s->visited_at + 2 * k, s->t + 2 * k, 2 * sizeof *s->visited_at);
        sunder_i_search_path_box(s, s->t, k, box);
        if (s->model->body[s->body[k]].pieces) sunder_i_rtree_move(&s->visited, k, box);
    }
    return !sunder_i_rtree_is_worn(&s->visited) || build_index(s);
}

bool sunder_i_search_find_about(sunder_i_search *search, uint32_t i, double reach)
{
    sunder_i_list *about = &search->about;
    const sunder_i_body *p = &search->model->body[search->body[i]], *first = &search->model->body[search->body[0]];
    double box[4];
    about->n = 0;
    if (search->n <= MANY) {
        for (uint32_t k = 0; k < search->n; k++)
            if (!sunder_i_list_push(about, k)) return false;
        return true;
    }
    for (uint32_t c = 0; c < 4; c++)
        box[c] = p->box[c] + (p->origin[c & 1] - first->origin[c & 1]) + (c < 2 ? -reach : reach);
    if (!bring_up_to_date(search) || !sunder_i_rtree_query(&search->visited, box, about)) return false;
    about->n = sunder_i_set_make(about->item, about->n);
    return true;
}
