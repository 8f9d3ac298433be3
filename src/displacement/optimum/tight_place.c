/* Places with no room to spare: a slot just as wide as what goes in, a row that just fits between two walls.
 *
 * Whoever leaves a margin for rounding finds no way in there, and a place in doubles is off by their rounding. But a
 * passage has no width at all only where coordinates are few: all multiples of a step that is coarse beside rounding.
 * Then what two bodies may do to each other along an axis begins and ends at such multiples too. So bodies whose moves
 * along an axis differ by a multiple of the step, up to a hair, get moves that differ by just that: they are in one
 * *row*, which moves as a whole. What may not move, and all that stands about, is in the row that stays at 0. Contacts
 * of bodies in different rows still have room, and get their margin: rows are drawn away from them in turn
 * [projections, Kac37]. The rest is for those who ask exactly whether the layout holds.
 *
 * Nobody of the group need have touched it before: a place without room may be so by what stands outside, a barrier
 * mostly. So whoever stands within a hair of the place takes part, in rows that stay where they are.
 *
 * Shadows are closed: what is on the boundary of one to the last bit has jumped. Where a row has no way out of that,
 * only coordinates in which a body is squeezed, touched squarely from both sides, are lined up, and all others have
 * their margins.
 *
 *   coordinates without a common step     no place: there, no passage is just as wide as what goes through
 *   a tight passage that lies obliquely   only where the place is on the lattice, too: else no doubles are in it */
#include "displacement/optimum/contact.h"
#include "displacement/optimum/optimum.h"
#include "displacement/optimum/tuning.h"

#include "base/watch.h"
#include "displacement/layer/rounding.h"
#include "number/lattice.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#define HOME 0 /* the row that stays */

typedef struct meeting {
    size_t i, j; /* places in the list of bodies */
    sunder_i_contact contact;
} meeting;

typedef struct fitting {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    size_t n, all;  /* those that are to be placed; with those outside that stand within a hair, after them */
    uint32_t *body; /* [all] */
    double *t;      /* [2 * all] moves, good up to rounding; those outside stand just so */
    size_t capacity, places;
    int exponent; /* of the step */
    double step, size, hair, margin;
    uint32_t *row; /* [2 * all] of each body's x, and of its y; rows of both axes are numbered together */
    double *base;  /* [2 * all + 1] the move of the first body of each row */
    double *ahead; /* [2 * all] whole steps from there */
    bool *stays;   /* [2 * all + 1] rows with somebody that stands */
    bool *alone;   /* [2 * all] coordinates that are not lined up */
    size_t rows;
    sunder_i_contact_list touch; /* of the pair looked at */
    meeting *meeting;
    size_t meetings, most_meetings;
    sunder_i_list near; /* scratch */
    double *corner;     /* scratch */
    size_t corners;
} fitting;

static void end_fitting(fitting *f)
{
    sunder_i_free(f->body);
    sunder_i_free(f->t);
    sunder_i_free(f->row);
    sunder_i_free(f->base);
    sunder_i_free(f->ahead);
    sunder_i_free(f->stays);
    sunder_i_free(f->alone);
    sunder_i_free(f->touch.item);
    sunder_i_free(f->meeting);
    sunder_i_free(f->near.item);
    sunder_i_free(f->corner);
}

static bool add_body(fitting *f, uint32_t body, const double t[2])
{
    if (!sunder_i_reserve(&f->body, &f->capacity, f->all + 1, sizeof *f->body) ||
        !sunder_i_reserve(&f->t, &f->places, 2 * f->all + 2, sizeof *f->t))
        return false;
    f->body[f->all] = body;
    memcpy(f->t + 2 * f->all++, t, 2 * sizeof *t);
    return true;
}

/* ---- The step ---------------------------------------------------------------------------------------------------- */

static void lower(int *exponent, double v)
{
    const int e = sunder_i_low_bit(v);
    if (e < *exponent) *exponent = e;
}

/* Corners as they stood: less the body's origin they may be rounded. False if memory is out. */
static bool lower_by_piece(fitting *f, const sunder_i_body_piece *piece, int *exponent)
{
    if (!sunder_i_reserve(&f->corner, &f->corners, 2 * (size_t)piece->corners, sizeof *f->corner)) return false;
    sunder_i_piece_as_given(f->model, piece, f->corner);
    for (size_t v = 0; v < 2 * (size_t)piece->corners; v++) lower(exponent, f->corner[v]);
    return true;
}

/* By the coordinates of a body and what it owes; *known: that is a double. False if memory is out. */
static bool lower_by_body(fitting *f, const sunder_i_body *body, int *exponent, bool *known)
{
    const sunder_i_model *model = f->model;
    const uint32_t thing = model->member[body->member];
    const double owed = sunder_i_owed_below(model, thing, thing);
    lower(exponent, owed);
    *known = owed == sunder_i_owed_above(model, thing, thing);
    for (uint32_t p = body->piece; *known && p < body->piece + body->pieces; p++)
        if (!lower_by_piece(f, &model->piece[p], exponent)) return false;
    return true;
}

static bool is_coarse(const fitting *f, int exponent) { return ldexp(1, exponent) >= TIGHT_STEP * f->size; }

/* The step of all coordinates of the group's bodies and of what they owe, and a hair beside those that may move (what
 * stands may be a road, miles long); *coarse: there is one. False if memory is out. */
static bool find_step(fitting *f, bool *coarse)
{
    *coarse = true;
    f->exponent = INT_MAX;
    for (size_t k = 0; k < f->n && *coarse; k++) {
        const sunder_i_body *body = &f->model->body[f->body[k]];
        for (int c = 0; c < 4 && !body->fixed; c++) f->size = fmax(f->size, fabs(body->box[c]));
        if (!lower_by_body(f, body, &f->exponent, coarse)) return false;
    }
    *coarse = *coarse && f->exponent < INT_MAX && is_coarse(f, f->exponent);
    if (*coarse) f->hair = fmin(TIGHT_HAIR * f->size, TIGHT_STEP_HAIR * ldexp(1, f->exponent));
    return true;
}

/* ---- Those outside ----------------------------------------------------------------------------------------------- */

static bool takes_part(const fitting *f, uint32_t body)
{
    for (size_t k = 0; k < f->all; k++)
        if (f->body[k] == body) return true;
    return false;
}

/* Takes the body in, where it is touched by the one at place k, and has coordinates in coarse steps too. */
static bool take_in(fitting *f, size_t k, uint32_t other)
{
    const double *stands = f->model->move + 2 * (size_t)other;
    int exponent = f->exponent;
    bool known;
    if (!sunder_i_step() || !sunder_i_contacts_of_pair(f->model, f->waived, f->body[k], other, f->t + 2 * k, stands,
                                                       f->hair, &f->touch, NULL))
        return false;
    if (f->touch.n == 0) return true;
    if (!lower_by_body(f, &f->model->body[other], &exponent, &known)) return false;
    if (!known || !is_coarse(f, exponent)) return true;
    f->exponent = exponent;
    return add_body(f, other, stands);
}

/* Whoever else stands within a hair of the place takes part. */
static bool find_outside(fitting *f)
{
    for (size_t k = 0; k < f->n; k++) {
        if (f->model->body[f->body[k]].fixed) continue;
        if (!sunder_i_who_is_about(f->model, f->body[k], f->t + 2 * k, f->model->rules.gap + f->hair, &f->near))
            return false;
        for (size_t m = 0; m < f->near.n && f->all < 2 * MOST_TIGHT; m++)
            if (!takes_part(f, f->near.item[m]) && !take_in(f, k, f->near.item[m])) return false;
    }
    return true;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Is t[k] a multiple of the step away from `from`? */
static bool is_aligned(const fitting *f, size_t k, double from)
{
    const double steps = (f->t[k] - from) / f->step;
    return fabs(steps - rint(steps)) * f->step <= f->hair;
}

static void line_up(fitting *f, size_t k, size_t row)
{
    f->row[k] = (uint32_t)row;
    f->ahead[k] = f->step * rint((f->t[k] - f->base[row]) / f->step);
}

/* Where one coordinate uses up all of a limit, up to a hair, nothing is left of the other but what that hair makes of
 * it, which is much more: so it is at home. */
static void leave_limits_whole(fitting *f)
{
    for (size_t k = 0; k < 2 * f->n; k++) {
        const double limit = sunder_i_limit_of(&f->model->body[f->body[k / 2]]), left = limit - fabs(f->t[k]);
        double *other = &f->t[k ^ 1];
        if (limit > 0 && isfinite(limit) && left <= f->hair && *other * *other <= 4 * f->hair * limit) *other = 0;
    }
}

/* Coordinate k is at home, or in a row from `first` on, or the first of a new one. */
static void find_row(fitting *f, size_t first, size_t k)
{
    size_t row = HOME;
    if (f->alone[k])
        row = f->rows;
    else if (!f->model->body[f->body[k / 2]].fixed && !is_aligned(f, k, 0))
        for (row = first; row < f->rows && !is_aligned(f, k, f->base[row]); row++) {
        }
    if (row == f->rows) {
        f->stays[row] = k >= 2 * f->n;
        f->base[f->rows++] = f->t[k];
    }
    line_up(f, k, row);
}

/* Coordinate c of all bodies: of those outside first, whose rows stay; at last those that nobody is to be lined up
 * with. */
static void find_rows_along(fitting *f, size_t c)
{
    const size_t first = f->rows;
    for (size_t k = 2 * f->n + c; k < 2 * f->all; k += 2) find_row(f, first, k);
    for (int alone = 0; alone < 2; alone++)
        for (size_t k = c; k < 2 * f->n; k += 2)
            if (f->alone[k] == alone) find_row(f, first, k);
}

static void find_rows(fitting *f)
{
    f->rows = 1;
    f->base[HOME] = 0;
    f->stays[HOME] = true;
    for (size_t c = 0; c < 2; c++) find_rows_along(f, c);
}

static double place_of(const fitting *f, size_t k) { return f->base[f->row[k]] + f->ahead[k]; }

/* ---- Contacts with room ------------------------------------------------------------------------------------------ */

/* How much the two bodies are nearer than the margin. */
static double missing_at(const fitting *f, const meeting *m)
{
    double missing = m->contact.d + m->contact.off + f->margin;
    for (size_t c = 0; c < 2; c++) missing -= m->contact.n[c] * (place_of(f, 2 * m->j + c) - place_of(f, 2 * m->i + c));
    return missing;
}

/* Draws the rows of two bodies away from their contact, if it is theirs to move from. True if half of the margin was
 * missing. */
static bool draw_away(fitting *f, const meeting *m)
{
    const double *n = m->contact.n, missing = missing_at(f, m);
    double pull = 0, sign[4];
    uint32_t row[4];
    for (size_t c = 0; c < 2; c++) {
        row[2 * c] = f->row[2 * m->i + c];
        row[2 * c + 1] = f->row[2 * m->j + c];
        const bool apart = row[2 * c] != row[2 * c + 1];
        sign[2 * c] = apart && !f->stays[row[2 * c]] ? -n[c] : 0;
        sign[2 * c + 1] = apart && !f->stays[row[2 * c + 1]] ? n[c] : 0;
        pull += sign[2 * c] * sign[2 * c] + sign[2 * c + 1] * sign[2 * c + 1];
    }
    if (missing <= 0 || !(pull > TIGHT_PULL)) return false;
    for (size_t k = 0; k < 4; k++)
        if (sign[k] != 0) f->base[row[k]] += missing / pull * sign[k];
    return missing > f->margin / 2;
}

/* Brings a body back within its limit, by the rows that may move. Where one coordinate uses all of the limit up, what
 * is left of the other is 0, however little it missed the limit by: a share e of that is sqrt(2 e) of it. */
static void draw_within(fitting *f, size_t k)
{
    const double limit = sunder_i_limit_of(&f->model->body[f->body[k]]),
                 t[2] = {place_of(f, 2 * k), place_of(f, 2 * k + 1)};
    const bool free[2] = {!f->stays[f->row[2 * k]], !f->stays[f->row[2 * k + 1]]};
    if (sunder_i_is_within_limit(t, limit)) return;
    const double length = hypot(t[0], t[1]) * (1 + 0x1p-50);
    for (int c = 0; c < 2; c++) {
        if (!free[c]) continue;
        const double other = t[1 - c], most = sqrt(fmax(0, (limit - other) * (limit + other))) * (1 - 0x1p-50),
                     to = free[1 - c] ? t[c] * (limit / length) : fmax(-most, fmin(most, t[c]));
        f->base[f->row[2 * k + (size_t)c]] += to - t[c];
    }
}

static bool find_meetings(fitting *f, size_t i, size_t j)
{
    const sunder_i_body *body = f->model->body;
    if (body[f->body[i]].fixed && body[f->body[j]].fixed) return true;
    if (!sunder_i_contacts_of_pair(f->model, f->waived, f->body[i], f->body[j], f->t + 2 * i, f->t + 2 * j, f->hair,
                                   &f->touch, NULL) ||
        !sunder_i_reserve(&f->meeting, &f->most_meetings, f->meetings + f->touch.n, sizeof *f->meeting))
        return false;
    for (size_t k = 0; k < f->touch.n; k++) f->meeting[f->meetings++] = (meeting){i, j, f->touch.item[k]};
    return true;
}

static bool find_all_meetings(fitting *f)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = i + 1; j < f->all; j++)
            if (!sunder_i_step() || !find_meetings(f, i, j)) return false;
    return true;
}

static void draw_apart(fitting *f)
{
    bool again = true;
    for (int turn = 0; turn < TIGHT_TURNS && again; turn++) {
        again = false;
        for (size_t k = 0; k < f->meetings; k++) again = draw_away(f, &f->meeting[k]) || again;
        for (size_t k = 0; k < f->n; k++)
            if (!f->model->body[f->body[k]].fixed) draw_within(f, k);
    }
}

/* Is the margin missing to a shadow? */
static bool is_in_shadow(const fitting *f)
{
    for (size_t k = 0; k < f->meetings; k++)
        if (f->meeting[k].contact.shadow && missing_at(f, &f->meeting[k]) > f->margin / 2) return true;
    return false;
}

/* Is the body at place k of the list touched squarely from that side, along axis c, by what is no shadow? */
static bool is_touched(const fitting *f, size_t k, size_t c, double side)
{
    for (size_t m = 0; m < f->meetings; m++) {
        const meeting *at = &f->meeting[m];
        const double from = at->j == k ? at->contact.n[c] : at->i == k ? -at->contact.n[c] : 0;
        if (!at->contact.shadow && from * side > 1 - TIGHT_PULL) return true;
    }
    return false;
}

static void leave_alone(fitting *f)
{
    for (size_t k = 0; k < 2 * f->n; k++)
        f->alone[k] = !f->model->body[f->body[k / 2]].fixed &&
                      !(is_touched(f, k / 2, k & 1, 1) && is_touched(f, k / 2, k & 1, -1));
}

/* ---- Doubles ----------------------------------------------------------------------------------------------------- */

/* Rows of bodies that rounding brought beyond their limits go a unit back to where these stood; false: none is. Where
 * rows have room it is many units. */
static bool step_back(fitting *f, double unit)
{
    bool any = false;
    for (size_t k = 0; k < 2 * f->n; k += 2) {
        const sunder_i_body *body = &f->model->body[f->body[k / 2]];
        const double t[2] = {place_of(f, k), place_of(f, k + 1)};
        if (body->fixed || sunder_i_is_within_limit(t, sunder_i_limit_of(body))) continue;
        for (size_t c = 0; c < 2; c++) {
            if (f->stays[f->row[k + c]] || t[c] == 0) continue;
            f->base[f->row[k + c]] -= copysign(unit, t[c]);
            any = true;
        }
    }
    return any;
}

/* Bases of rows in units that all of the group can hold; steps are whole numbers of these. */
static void round_rows(fitting *f)
{
    double coarsest = 0, out[2], unit;
    for (size_t k = 0; k < f->n; k++) {
        sunder_i_round_move(f->model, f->body[k], f->t + 2 * k, out, &unit);
        coarsest = fmax(coarsest, unit);
    }
    for (size_t row = 0; row < f->rows && coarsest > 0; row++)
        if (!f->stays[row]) f->base[row] = coarsest * rint(f->base[row] / coarsest);
    for (int turn = 0; turn < TIGHT_STEPS_BACK && step_back(f, coarsest); turn++) {
    }
}

/* Can all bodies be moved just so? */
static bool take_places(const fitting *f, double *move)
{
    for (size_t k = 0; k < 2 * f->n; k++) move[k] = place_of(f, k);
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

static bool fit(fitting *f, double *move, bool *found)
{
    const size_t all = f->all;
    double *to = sunder_i_alloc(2 * f->n, sizeof *to);
    f->step = ldexp(1, f->exponent);
    f->row = sunder_i_alloc(2 * all, sizeof *f->row);
    f->base = sunder_i_calloc(2 * all + 1, sizeof *f->base);
    f->ahead = sunder_i_alloc(2 * all, sizeof *f->ahead);
    f->stays = sunder_i_calloc(2 * all + 1, sizeof *f->stays);
    f->alone = sunder_i_calloc(2 * all, sizeof *f->alone);
    const bool ok = to && f->row && f->base && f->ahead && f->stays && f->alone && find_all_meetings(f);
    if (ok) {
        leave_limits_whole(f);
        find_rows(f);
        draw_apart(f);
        if (is_in_shadow(f)) {
            leave_alone(f);
            find_rows(f);
            draw_apart(f);
        }
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
    fitting f = {.model = model, .n = n};
    bool ok = true;
    *may = false;
    if (n > MOST_TIGHT) return true;
    for (size_t k = 0; k < n && ok; k++) ok = add_body(&f, body[k], home);
    ok = ok && find_step(&f, may);
    end_fitting(&f);
    return ok;
}

bool sunder_i_tight_place(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *body, size_t n,
                          double margin, double *move, bool *found)
{
    fitting f = {.model = model, .waived = waived, .margin = margin};
    bool ok = true, coarse;
    *found = false;
    if (n > MOST_TIGHT) return true;
    for (size_t k = 0; k < n && ok; k++) ok = add_body(&f, body[k], move + 2 * k);
    f.n = n;
    ok = ok && find_step(&f, &coarse);
    if (ok && coarse) ok = find_outside(&f) && fit(&f, move, found);
    end_fitting(&f);
    return ok;
}
