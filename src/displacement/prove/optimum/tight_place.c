/* Places without any spare room: a slot exactly as wide as the feature in it, or a row that exactly fits between two
 * walls.
 *
 * A search with a margin for rounding cannot enter such a place, and one without a margin ends near it, off by rounding
 * errors. But a passage has no spare width only if coordinates are special: all multiples of a step that is coarse
 * compared with rounding. Then the forbidden interval of two bodies along an axis also begins and ends at such
 * multiples. So bodies whose moves along an axis differ by a multiple of the step, up to a hair, get moves that differ
 * by exactly that: they form one *row*, which moves as a whole. Fixed bodies, and bodies outside, are in rows that
 * stay. Contacts between different rows still have room, and get their margin: rows are moved away from them in turn
 * [projections, Kac37]. Callers verify the layout exactly.
 *
 * The group need not have touched these outside bodies before: the lack of room may be due to something outside,
 * usually a barrier. So bodies within a hair of the place take part, in rows that stay where they are.
 *
 * Shadows are closed: a move that ends exactly on the boundary of one has jumped. If a row cannot avoid that, only
 * coordinates in which a body is squeezed (touched squarely from both sides) are aligned, and all others get margins.
 *
 *   coordinates without a common step     no place: no passage is exactly as wide as a feature then
 *   a tight passage at an angle           only if the place is on the lattice, too: otherwise no doubles are in it */
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/tight.h"
#include "displacement/prove/optimum/tuning.h"

#include "displacement/layer/rounding.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

static void free_tight(sunder_i_tight *f)
{
    sunder_i_free_all(f->body, f->t, f->row, f->base, f->ahead, f->stays, f->alone, f->touch.item, f->meeting,
                      f->near.item, f->corner);
}

/* Moves rows of bodies that rounding brought beyond their limits back by one unit towards home. Returns false if there
 * are none. Where rows have room this may take many calls. */
static bool step_back(sunder_i_tight *f, double unit)
{
    bool any = false;
    for (size_t k = 0; k < 2 * f->n; k += 2) {
        const sunder_i_body *body = &f->model->body[f->body[k / 2]];
        const double t[2] = {sunder_i_tight_place_of(f, k), sunder_i_tight_place_of(f, k + 1)};
        if (body->fixed || sunder_i_is_within_limit(t, sunder_i_limit_of(body))) continue;
        for (size_t c = 0; c < 2; c++) {
            if (f->stays[f->row[k + c]] || t[c] == 0) continue;
            f->base[f->row[k + c]] -= copysign(unit, t[c]);
            any = true;
        }
    }
    return any;
}

/* Rounds the bases of rows to whole units. */
static void round_bases(sunder_i_tight *f, double unit)
{
    for (size_t row = 0; row < f->rows; row++)
        if (!f->stays[row]) f->base[row] = unit * rint(f->base[row] / unit);
}

/* Rounds the bases of rows to units that all bodies of the group can represent; steps are whole numbers of these. If
 * steps of one unit towards home do not bring all bodies within their limits, because limits on both sides push a row
 * back and forth, the rows are moved apart again with a few units of room. */
static void round_rows(sunder_i_tight *f)
{
    double coarsest = 0, out[2], unit;
    for (size_t k = 0; k < f->n; k++) {
        sunder_i_round_move(f->model, f->body[k], f->t + 2 * k, out, &unit);
        coarsest = sunder_i_max(coarsest, unit);
    }
    if (!(coarsest > 0)) return;
    round_bases(f, coarsest);
    bool beyond = true;
    for (int turn = 0; turn < TIGHT_STEPS_BACK && beyond; turn++) beyond = step_back(f, coarsest);
    if (!beyond) return;
    f->room = TIGHT_ROOM * coarsest;
    sunder_i_tight_draw_apart(f);
    round_bases(f, coarsest);
}

/* Sets `move` to the places. Returns false if a body's coordinates plus its move are not doubles. */
static bool take_places(const sunder_i_tight *f, double *move)
{
    for (size_t k = 0; k < 2 * f->n; k++) move[k] = sunder_i_tight_place_of(f, k);
    for (size_t k = 0; k < f->n; k++) {
        double out[2];
        const double *t = move + 2 * k;
        if (f->model->body[f->body[k]].fixed) {
            if (t[0] != 0 || t[1] != 0) return false;
        } else if (!sunder_i_round_move(f->model, f->body[k], t, out, NULL) || out[0] != t[0] || out[1] != t[1]) {
            return false;
        }
    }
    return true;
}

static bool fit_places(sunder_i_tight *f, double *move, bool *found)
{
    double *to = sunder_i_alloc(2 * f->n, sizeof *to);
    const bool ok = to && sunder_i_tight_draw_rows(f);
    if (ok) {
        round_rows(f);
        *found = take_places(f, to);
        memcpy(move, to, 2 * f->n * sizeof *move);
    }
    sunder_i_free(to);
    return ok;
}

bool sunder_i_may_be_tight(const sunder_i_model *model, const uint32_t *body, size_t n, bool *may)
{
    const double home[2] = {0, 0};
    sunder_i_tight f = {.model = model, .n = n};
    bool ok = true;
    *may = false;
    if (n > MOST_TIGHT) return true;
    for (size_t k = 0; k < n && ok; k++) ok = sunder_i_tight_add(&f, body[k], home);
    ok = ok && sunder_i_tight_find_step(&f, may);
    free_tight(&f);
    return ok;
}

bool sunder_i_tight_place(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *body, size_t n,
                          double margin, double *move, bool *found)
{
    sunder_i_tight f = {.model = model, .waived = waived, .margin = margin};
    bool ok = true, coarse;
    *found = false;
    if (n > MOST_TIGHT) return true;
    for (size_t k = 0; k < n && ok; k++) ok = sunder_i_tight_add(&f, body[k], move + 2 * k);
    f.n = n;
    ok = ok && sunder_i_tight_find_step(&f, &coarse);
    if (ok && coarse) ok = sunder_i_tight_find_outside(&f) && fit_places(&f, move, found);
    free_tight(&f);
    return ok;
}
