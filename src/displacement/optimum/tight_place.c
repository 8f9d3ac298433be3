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
    const uint32_t *body;
    const double *t;
    size_t n;
    double step, hair, margin;
    uint32_t *row; /* [2 * n] of each body's x, and of its y; rows of both axes are numbered together */
    double *base;  /* [2 * n + 1] the move of the first body of each row */
    double *ahead; /* [2 * n] whole steps from there */
    size_t rows;
    sunder_i_contact_list touch; /* of the pair looked at */
    meeting *meeting;
    size_t meetings, capacity;
    double *corner; /* scratch */
    size_t corners;
} fitting;

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

/* The step of all coordinates of the bodies and of what they owe, and a hair beside them; *coarse: there is one. False
 * if memory is out. */
static bool find_step(fitting *f, bool *coarse)
{
    *coarse = false;
    const sunder_i_model *model = f->model;
    int exponent = INT_MAX;
    double size = 0;
    for (size_t k = 0; k < f->n; k++) {
        const sunder_i_body *body = &model->body[f->body[k]];
        const uint32_t thing = model->member[body->member];
        lower(&exponent, sunder_i_owed_below(model, thing, thing));
        if (sunder_i_owed_below(model, thing, thing) != sunder_i_owed_above(model, thing, thing)) return true;
        for (int c = 0; c < 4; c++) size = fmax(size, fabs(body->box[c]));
        for (uint32_t p = body->piece; p < body->piece + body->pieces; p++)
            if (!lower_by_piece(f, &model->piece[p], &exponent)) return false;
    }
    if (exponent == INT_MAX) return true;
    f->step = ldexp(1, exponent);
    f->hair = TIGHT_HAIR * size;
    *coarse = f->step >= TIGHT_STEP * size;
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

/* Coordinate c of all bodies: at home, or in the row of one before, or the first of a new one. */
static void find_rows(fitting *f, size_t c)
{
    const size_t first = f->rows;
    for (size_t k = c; k < 2 * f->n; k += 2) {
        size_t row = HOME;
        if (!f->model->body[f->body[k / 2]].fixed && !is_aligned(f, k, 0))
            for (row = first; row < f->rows && !is_aligned(f, k, f->base[row]); row++) {
            }
        if (row == f->rows) f->base[f->rows++] = f->t[k];
        line_up(f, k, row);
    }
}

static double place_of(const fitting *f, size_t k) { return f->base[f->row[k]] + f->ahead[k]; }

/* ---- Contacts with room ------------------------------------------------------------------------------------------ */

/* Draws the rows of two bodies away from their contact, if it is theirs to move from. */
static void draw_away(fitting *f, const meeting *m)
{
    const double *n = m->contact.n;
    double missing = m->contact.d + m->contact.off + f->margin, pull = 0, sign[4];
    uint32_t row[4];
    for (size_t c = 0; c < 2; c++) {
        missing -= n[c] * (place_of(f, 2 * m->j + c) - place_of(f, 2 * m->i + c));
        row[2 * c] = f->row[2 * m->i + c];
        row[2 * c + 1] = f->row[2 * m->j + c];
        const bool apart = row[2 * c] != row[2 * c + 1];
        sign[2 * c] = apart && row[2 * c] != HOME ? -n[c] : 0;
        sign[2 * c + 1] = apart && row[2 * c + 1] != HOME ? n[c] : 0;
        pull += sign[2 * c] * sign[2 * c] + sign[2 * c + 1] * sign[2 * c + 1];
    }
    if (missing <= 0 || !(pull > TIGHT_PULL)) return;
    for (size_t k = 0; k < 4; k++)
        if (sign[k] != 0) f->base[row[k]] += missing / pull * sign[k];
}

/* Brings a body back within its limit, by the rows that may move. Where one coordinate uses all of the limit up, what
 * is left of the other is 0, however little it missed the limit by: a share e of that is sqrt(2 e) of it. */
static void draw_within(fitting *f, size_t k)
{
    const double limit = sunder_i_limit_of(&f->model->body[f->body[k]]),
                 t[2] = {place_of(f, 2 * k), place_of(f, 2 * k + 1)};
    const bool free[2] = {f->row[2 * k] != HOME, f->row[2 * k + 1] != HOME};
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
        !sunder_i_reserve(&f->meeting, &f->capacity, f->meetings + f->touch.n, sizeof *f->meeting))
        return false;
    for (size_t k = 0; k < f->touch.n; k++) f->meeting[f->meetings++] = (meeting){i, j, f->touch.item[k]};
    return true;
}

static bool draw_apart(fitting *f)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = i + 1; j < f->n; j++)
            if (!sunder_i_step() || !find_meetings(f, i, j)) return false;
    for (int turn = 0; turn < TIGHT_TURNS; turn++) {
        for (size_t k = 0; k < f->meetings; k++) draw_away(f, &f->meeting[k]);
        for (size_t k = 0; k < f->n; k++)
            if (!f->model->body[f->body[k]].fixed) draw_within(f, k);
    }
    return true;
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
            if (f->row[k + c] == HOME || t[c] == 0) continue;
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
    for (size_t row = 1; row < f->rows && coarsest > 0; row++) f->base[row] = coarsest * rint(f->base[row] / coarsest);
    for (int turn = 0; turn < TIGHT_TURNS && step_back(f, coarsest); turn++) {
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

bool sunder_i_tight_place(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *body, size_t n,
                          double margin, double *move, bool *found)
{
    fitting f = {.model = model, .waived = waived, .body = body, .t = move, .n = n, .margin = margin, .rows = 1};
    *found = false;
    if (n > MOST_TIGHT) return true;
    bool coarse;
    const bool known = find_step(&f, &coarse);
    sunder_i_free(f.corner);
    if (!known || !coarse) return known;
    double *to = sunder_i_alloc(2 * n, sizeof *to);
    f.row = sunder_i_alloc(2 * n, sizeof *f.row);
    f.base = sunder_i_calloc(2 * n + 1, sizeof *f.base);
    f.ahead = sunder_i_alloc(2 * n, sizeof *f.ahead);
    bool ok = to && f.row && f.base && f.ahead;
    if (ok) {
        for (size_t c = 0; c < 2; c++) find_rows(&f, c);
        ok = draw_apart(&f);
    }
    if (ok) {
        round_rows(&f);
        *found = take_places(&f, to);
        memcpy(move, to, 2 * n * sizeof *move);
    }
    sunder_i_free(to);
    sunder_i_free(f.row);
    sunder_i_free(f.base);
    sunder_i_free(f.ahead);
    sunder_i_free(f.touch.item);
    sunder_i_free(f.meeting);
    return ok;
}
