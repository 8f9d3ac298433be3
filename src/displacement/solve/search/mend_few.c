/* A crowd in which a body was sent back is repaired around the bodies that it clashes with.
 *
 * A body sent back by the rule that nothing becomes worse (../clusters/uphold.c) blocks some neighbours, in a crowd of
 * thousands that is otherwise settled. A program of all of them, starting from a mere compromise, takes minutes to find
 * out whether they have room. So the clashing bodies are settled with a few bodies around them, and then with more,
 * while all others stand (neighbourhood.c). If that is not enough the whole crowd is solved. In a crowd of more than
 * MOST_AGAIN bodies that would take longer than all work before; there the bodies that still clash yield instead
 * (yield.c), which gives up more pairs.
 *
 * It is no way to solve a crowd: parts that ran into each other, settled like this before any body was sent back, leave
 * 1,204 pairs of Germany's symbols within 6 km, where solving all together leaves 349. */
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

static const size_t stage[] = MENDING_STAGES;

static bool still_clash(sunder_i_search *s, const sunder_i_clash *c)
{
    const double *p = s->t + 2 * (size_t)c->i, *q = s->t + 2 * (size_t)c->j, u[2] = {q[0] - p[0], q[1] - p[1]};
    bool yields;
    return sunder_i_search_pair(s, c->i, c->j, u, &yields) > s->tolerance;
}

static bool settle_each(sunder_i_search *s, const sunder_i_clash *clash, size_t n)
{
    sunder_i_neighbourhood about;
    bool all = true;
    if (!sunder_i_neighbourhood_init(&about, s)) s->failed = true;
    for (size_t k = 0; k < n && !s->failed; k++) {
        const sunder_i_clash *c = &clash[k];
        bool done = !still_clash(s, c);
        for (size_t m = 0; m < sizeof stage / sizeof *stage && !done && !s->failed; m++)
            done = sunder_i_neighbourhood_settle(&about, c->i, c->j, stage[m], s->gap + 2 * c->violation);
        all = all && done;
    }
    sunder_i_neighbourhood_free(&about);
    return all && !s->failed;
}

static void yield_rest(sunder_i_search *s)
{
    size_t n = 0;
    sunder_i_clash *at_home = sunder_i_search_at_home(s, &n);
    s->failed = s->failed || !at_home;
    if (!s->failed) sunder_i_search_yield(s, at_home, n, s->tolerance);
    sunder_i_free(at_home);
}

static bool has_pinned_body(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++)
        if (s->model->body[s->body[k]].pinned) return true;
    return false;
}

/* Settles each of the n clashes; a very large crowd yields if that fails. If neither is done all bodies return. Returns
 * whether one was done. */
static bool mend_clashes(sunder_i_search *s, const sunder_i_clash *clash, size_t n)
{
    double *stood = sunder_i_search_copy_moves(s);
    if (s->failed) return false;
    bool done = settle_each(s, clash, n);
    if (!done && !s->failed && sunder_i_search_movers(s) > MOST_AGAIN) {
        yield_rest(s);
        done = true;
    }
    sunder_i_search_end_copy(s, stood, !done);
    return done;
}

/* Lists the clashes of more than the tolerance; *n: their number. NULL if memory is out. */
static sunder_i_clash *list_clashes(sunder_i_search *s, size_t *n)
{
    sunder_i_clash *list = sunder_i_alloc(s->clashes, sizeof *list);
    *n = 0;
    for (size_t k = 0; k < s->clashes && list; k++)
        if (s->clash[k].violation > s->tolerance) list[(*n)++] = s->clash[k];
    return list;
}

bool sunder_i_search_mend_few(sunder_i_search *search)
{
    const double tolerance = search->tolerance;
    size_t n = 0;
    bool done = false;
    if (search->failed || sunder_i_search_movers(search) <= LARGE_CROWD || !has_pinned_body(search) ||
        sunder_i_search_is_beyond(search, search->t))
        return false;
    sunder_i_search_find_clashes(search, search->t);
    if (search->failed) return false;
    /* If the margin has grown since the bodies settled, most pairs violate it. The part of it that they keep has proved
     * sufficient, so it is tolerated. */
    search->tolerance *= MARGIN_LEFT;
    sunder_i_clash *list = list_clashes(search, &n);
    search->failed = !list;
    if (!search->failed && n && n <= search->n / FEW_CLASHES) done = mend_clashes(search, list, n);
    search->tolerance = tolerance;
    sunder_i_free(list);
    return done && !search->failed;
}
