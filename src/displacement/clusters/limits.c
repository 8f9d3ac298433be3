/* Limits of moves: first the layer is solved as if it had none.
 *
 * Whatever keeps its limits in that solution is left as it is: so limits that nothing oversteps make no difference,
 * and a limit is never the reason for a worse solution than is known without it. Only what oversteps them goes back
 * to where it came from, with all that the search found it to hang together with, and is solved again within its
 * limits.
 *
 * Pairs that no moves within the limits can part would be parted in vain: what hangs together with one at the start
 * is set aside meanwhile. If others run into it, they go back too. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/layer/inclusion.h"
#include "displacement/layer/rounding.h"

#include "base/union_find.h"

#include <math.h>
#include <string.h>

/* Components of the conflicts at the start; a fixed body joins none. */
static void join_conflicts(const sunder_i_job *w, uint32_t *root)
{
    const sunder_i_town *town = &w->town;
    sunder_i_union_init(root, town->bodies);
    for (size_t k = 0; k < w->start.n; k++) {
        const sunder_i_relation *r = &w->start.pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        if (!sunder_i_job_is_conflict(town, r) || town->body[i].fixed || town->body[j].fixed) continue;
        sunder_i_union_join(root, i, j);
    }
    for (size_t b = 0; b < town->bodies; b++) root[b] = sunder_i_union_find(root, (uint32_t)b);
}

/* ---- Without limits ---------------------------------------------------------------------------------------------- */

/* Marks what hangs together with a pair that limits cannot part; truces wait until the limits are back. */
static bool set_aside(sunder_i_job *w)
{
    sunder_i_town *town = &w->town;
    uint32_t *root = sunder_i_alloc(town->bodies, sizeof *root);
    bool *hard = sunder_i_calloc(town->bodies, sizeof *hard);
    const bool ok = root && hard;
    w->waiting = town->truces;
    memset(&town->truces, 0, sizeof town->truces);
    if (ok) {
        join_conflicts(w, root);
        for (size_t k = 0; k < w->waiting.n; k++) {
            hard[root[town->body_of[w->waiting.item[k].a]]] = true;
            hard[root[town->body_of[w->waiting.item[k].b]]] = true;
        }
        for (size_t k = 0; k < w->entries; k++)
            hard[root[town->body_of[w->entry[k].a]]] = hard[root[town->body_of[w->entry[k].b]]] = true;
        for (size_t b = 0; b < town->bodies; b++) w->aside[b] = !town->body[b].fixed && hard[root[b]];
    }
    sunder_i_free(root);
    sunder_i_free(hard);
    return ok;
}

sunder_status sunder_i_job_lift_limits(sunder_i_job *w, bool *lifted, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    *lifted = false;
    for (size_t b = 0; b < town->bodies; b++)
        *lifted = *lifted || (!town->body[b].fixed && town->body[b].limit < INFINITY);
    if (!*lifted) return SUNDER_OK;
    w->limit = sunder_i_alloc(town->bodies, sizeof *w->limit);
    w->aside = sunder_i_calloc(town->bodies, sizeof *w->aside);
    if (!w->limit || !w->aside || !set_aside(w)) return sunder_i_no_memory(err);
    for (size_t b = 0; b < town->bodies; b++) {
        w->limit[b] = town->body[b].limit;
        if (!town->body[b].fixed) town->body[b].limit = INFINITY;
    }
    return SUNDER_OK;
}

/* ---- Within them ------------------------------------------------------------------------------------------------- */

/* Marks the sets, by their roots, of which a body went too far, was set aside, or ran into one that was. */
static void find_offenders(sunder_i_job *w, bool *root)
{
    const sunder_i_town *town = &w->town;
    for (uint32_t b = 0; b < town->bodies; b++)
        if (!town->body[b].fixed && (w->aside[b] || !sunder_i_within(town->move + 2 * (size_t)b, town->body[b].limit)))
            root[sunder_i_union_find(w->parent, b)] = true;
    for (size_t k = 0; k < w->now.n; k++) {
        const sunder_i_relation *r = &w->now.pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        if (!sunder_i_job_is_conflict(town, r) || (!w->aside[i] && !w->aside[j])) continue;
        root[sunder_i_union_find(w->parent, i)] = root[sunder_i_union_find(w->parent, j)] = true;
    }
}

/* Forgets what these bodies were joined with, and what was given up of them. */
static bool forget(sunder_i_job *w, const bool *back)
{
    sunder_i_town *town = &w->town;
    sunder_i_truces *truces = &town->truces;
    size_t out = 0;
    for (size_t e = 0; e < w->edges; e++)
        if (!back[w->edge[e].a] && !back[w->edge[e].b]) w->edge[out++] = w->edge[e];
    w->edges = 0;
    sunder_i_union_init(w->parent, town->bodies);
    for (size_t e = 0; e < out; e++) sunder_i_job_add_edge(w, w->edge[e].a, w->edge[e].b); /* there is room */
    out = 0;
    for (size_t k = 0; k < town->given_n; k++)
        if (!back[town->given[k].a] && !back[town->given[k].b]) town->given[out++] = town->given[k];
    town->given_n = out;
    out = 0;
    for (size_t k = 0; k < truces->n; k++)
        if (!back[town->body_of[truces->item[k].a]] && !back[town->body_of[truces->item[k].b]])
            truces->item[out++] = truces->item[k];
    truces->n = out;
    for (size_t k = 0; k < w->waiting.n; k++)
        if (!sunder_i_truces_add(truces, &w->waiting.item[k])) return false;
    sunder_i_truces_free(&w->waiting);
    return sunder_i_truces_index(truces, town);
}

static void send_home(sunder_i_job *w, const bool *back)
{
    sunder_i_town *town = &w->town;
    const double home[2] = {0, 0};
    memset(w->changed, 0, town->features * sizeof *w->changed);
    for (uint32_t b = 0; b < town->bodies; b++) {
        if (!back[b]) continue;
        sunder_i_job_place(w, b, home);
        town->body[b].pinned = false;
        w->widened[b] = 0;
        w->improved[b] = false;
        w->carrier[b] = SUNDER_I_NOBODY;
    }
    for (size_t k = 0; k < town->kept_n; k++)
        if (back[town->body_of[town->kept[k].a]] || back[town->body_of[town->kept[k].b]])
            town->keeping[k] = town->enters[k] ? SUNDER_I_STRICT : SUNDER_I_LENIENT;
}

sunder_status sunder_i_job_restore_limits(sunder_i_job *w, bool *any, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    bool *root = sunder_i_calloc(town->bodies, sizeof *root), *back = sunder_i_calloc(town->bodies, sizeof *back);
    sunder_status status = root && back ? SUNDER_OK : sunder_i_no_memory(err);
    *any = false;
    for (size_t b = 0; b < town->bodies; b++) town->body[b].limit = w->limit[b];
    memset(w->standing, SUNDER_I_UNASKED, town->bodies * sizeof *w->standing); /* within limits more can be proved */
    if (!status) {
        find_offenders(w, root);
        for (uint32_t b = 0; b < town->bodies; b++) {
            back[b] = !town->body[b].fixed && root[sunder_i_union_find(w->parent, b)];
            *any = *any || back[b];
        }
        send_home(w, back);
        if (*any) w->members = 0; /* else who once was in a cluster with a fixed body would pass for known to it */
        memset(w->aside, 0, town->bodies * sizeof *w->aside);
        status = forget(w, back) ? sunder_i_job_check(w, err) : sunder_i_no_memory(err);
    }
    sunder_i_free(root);
    sunder_i_free(back);
    return status;
}
