/* Rows: coordinates of moves along an axis that differ by whole steps, and change together. This file finds the rows,
 * and moves them away from contacts that have room, and within limits (tight_place.c). */
#include "displacement/prove/optimum/tight.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>

#define HOME 0 /* the number of the row that stays at 0 */

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Does t[k], a coordinate of a body's move, differ from `from` by a multiple of the step, up to f->hair? */
static bool is_aligned(const sunder_i_tight *f, size_t k, double from)
{
    const double steps = (f->t[k] - from) / f->step;
    return fabs(steps - rint(steps)) * f->step <= f->hair;
}

static void line_up(sunder_i_tight *f, size_t k, size_t row)
{
    f->row[k] = (uint32_t)row;
    f->ahead[k] = f->step * rint((f->t[k] - f->base[row]) / f->step);
}

/* If one coordinate uses up all of a limit, up to a hair, the other is set to 0: it can only differ from 0 because of
 * that hair, which allows for much more than a hair in the other coordinate. */
static void leave_limits_whole(sunder_i_tight *f)
{
    for (size_t k = 0; k < 2 * f->n; k++) {
        const double limit = sunder_i_limit_of(&f->model->body[f->body[k / 2]]), left = limit - fabs(f->t[k]);
        double *other = &f->t[k ^ 1];
        if (limit > 0 && isfinite(limit) && left <= f->hair && *other * *other <= 4 * f->hair * limit) *other = 0;
    }
}

/* Puts coordinate k into the row at home, into an aligned row from `first` on, or into a new row. */
static void find_row(sunder_i_tight *f, size_t first, size_t k)
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

/* Finds the rows of coordinate c of all bodies: first of the bodies outside, whose rows stay; last of coordinates that
 * are not to be aligned. */
static void find_rows_along(sunder_i_tight *f, size_t c)
{
    const size_t first = f->rows;
    for (size_t k = 2 * f->n + c; k < 2 * f->all; k += 2) find_row(f, first, k);
    for (int alone = 0; alone < 2; alone++)
        for (size_t k = c; k < 2 * f->n; k += 2)
            if (f->alone[k] == alone) find_row(f, first, k);
}

static void find_rows(sunder_i_tight *f)
{
    f->rows = 1;
    f->base[HOME] = 0;
    f->stays[HOME] = true;
    for (size_t c = 0; c < 2; c++) find_rows_along(f, c);
}

/* A row on which no contact presses is cheapest if its weighted moves from the preferred ones add up to zero. If a row
 * is nearly so, it is moved to that position: its bodies had a margin between them, so the first body's place is off by
 * about that margin. Returns false if memory is out. */
static bool centre_rows(sunder_i_tight *f)
{
    double *sum = sunder_i_calloc(2 * f->rows, sizeof *sum), *weight = sum ? sum + f->rows : NULL;
    for (size_t k = 0; sum && k < 2 * f->n; k++) {
        const double own = f->model->body[f->body[k / 2]].weight;
        sum[f->row[k]] += own * (sunder_i_tight_place_of(f, k) - sunder_i_preferred(f->model, f->body[k / 2])[k % 2]);
        weight[f->row[k]] += own;
    }
    for (size_t row = 0; sum && row < f->rows; row++)
        if (!f->stays[row] && fabs(sum[row]) <= TIGHT_OFF_CENTRE * f->margin * weight[row])
            f->base[row] -= sum[row] / weight[row];
    sunder_i_free(sum);
    return sum != NULL;
}

/* ---- Contacts with room ------------------------------------------------------------------------------------------ */

/* Returns the distance by which the contact misses the margin. */
static double missing_at(const sunder_i_tight *f, const sunder_i_tight_meeting *m)
{
    double missing = m->contact.d + m->contact.off + f->margin;
    for (size_t c = 0; c < 2; c++)
        missing -=
            m->contact.n[c] * (sunder_i_tight_place_of(f, 2 * m->j + c) - sunder_i_tight_place_of(f, 2 * m->i + c));
    return missing;
}

/* Moves the rows of two bodies away from their contact, if they can move from it. Returns true if more than half of the
 * margin was missing. */
static bool draw_away(sunder_i_tight *f, const sunder_i_tight_meeting *m)
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

/* Brings body k back within its limit, less f->room, by moving the rows of its x and its y, and with them all bodies
 * of these rows. If both rows can move, the whole move is scaled down; if one stays, only the other coordinate is
 * cut, to 0 if the first uses up the limit, however slightly the limit was exceeded: a relative excess e of it is
 * sqrt(2 e) of the other coordinate. Returns true if a row could move and the excess was more than a quarter of
 * f->room or, if that is 0, more than half of f->margin; the rows then have to be examined again, since the limit of
 * another body may move a shared row outward. */
static bool draw_within(sunder_i_tight *f, size_t k)
{
    const double limit = sunder_i_max(0, sunder_i_limit_of(&f->model->body[f->body[k]]) - f->room),
                 t[2] = {sunder_i_tight_place_of(f, 2 * k), sunder_i_tight_place_of(f, 2 * k + 1)};
    const bool free[2] = {!f->stays[f->row[2 * k]], !f->stays[f->row[2 * k + 1]]};
    if (sunder_i_is_within_limit(t, limit)) return false;
    const double length = hypot(t[0], t[1]) * (1 + 0x1p-50), little = f->room > 0 ? f->room / 4 : f->margin / 2;
    for (int c = 0; c < 2; c++) {
        if (!free[c]) continue;
        const double other = t[1 - c], most = sqrt(sunder_i_max(0, (limit - other) * (limit + other))) * (1 - 0x1p-50),
                     to = free[1 - c] ? t[c] * (limit / length) : sunder_i_max(-most, sunder_i_min(most, t[c]));
        f->base[f->row[2 * k + (size_t)c]] += to - t[c];
    }
    return (free[0] || free[1]) && length - limit > little;
}

static bool find_meetings(sunder_i_tight *f, size_t i, size_t j)
{
    const sunder_i_body *body = f->model->body;
    if (body[f->body[i]].fixed && body[f->body[j]].fixed) return true;
    if (!sunder_i_contacts_of_pair(f->model, f->waived, f->body[i], f->body[j], f->t + 2 * i, f->t + 2 * j, f->hair,
                                   &f->touch, NULL) ||
        !sunder_i_reserve(&f->meeting, &f->most_meetings, f->meetings + f->touch.n, sizeof *f->meeting))
        return false;
    for (size_t k = 0; k < f->touch.n; k++)
        f->meeting[f->meetings++] = (sunder_i_tight_meeting){i, j, f->touch.item[k]};
    return true;
}

static bool find_all_meetings(sunder_i_tight *f)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = i + 1; j < f->all; j++)
            if (!sunder_i_step() || !find_meetings(f, i, j)) return false;
    return true;
}

void sunder_i_tight_draw_apart(sunder_i_tight *f)
{
    bool again = true;
    for (int turn = 0; turn < TIGHT_TURNS && again; turn++) {
        again = false;
        for (size_t k = 0; k < f->meetings; k++) again = draw_away(f, &f->meeting[k]) || again;
        for (size_t k = 0; k < f->n; k++)
            if (!f->model->body[f->body[k]].fixed) again = draw_within(f, k) || again;
    }
}

/* Does a contact with a shadow miss its margin? */
static bool is_in_shadow(const sunder_i_tight *f)
{
    for (size_t k = 0; k < f->meetings; k++)
        if (f->meeting[k].contact.shadow && missing_at(f, &f->meeting[k]) > f->margin / 2) return true;
    return false;
}

/* Is the body at place k of the list touched squarely from the side `side` along axis c, by a piece that is not a
 * shadow? */
static bool is_touched(const sunder_i_tight *f, size_t k, size_t c, double side)
{
    for (size_t m = 0; m < f->meetings; m++) {
        const sunder_i_tight_meeting *at = &f->meeting[m];
        const double from = at->j == k ? at->contact.n[c] : at->i == k ? -at->contact.n[c] : 0;
        if (!at->contact.shadow && from * side > 1 - TIGHT_PULL) return true;
    }
    return false;
}

static void leave_alone(sunder_i_tight *f)
{
    for (size_t k = 0; k < 2 * f->n; k++)
        f->alone[k] = !f->model->body[f->body[k / 2]].fixed &&
                      !(is_touched(f, k / 2, k & 1, 1) && is_touched(f, k / 2, k & 1, -1));
}

bool sunder_i_tight_draw_rows(sunder_i_tight *f)
{
    const size_t all = f->all;
    f->step = ldexp(1, f->exponent);
    f->row = sunder_i_alloc(2 * all, sizeof *f->row);
    f->base = sunder_i_calloc(2 * all + 1, sizeof *f->base);
    f->ahead = sunder_i_alloc(2 * all, sizeof *f->ahead);
    f->stays = sunder_i_calloc(2 * all + 1, sizeof *f->stays);
    f->alone = sunder_i_calloc(2 * all, sizeof *f->alone);
    if (!f->row || !f->base || !f->ahead || !f->stays || !f->alone || !find_all_meetings(f)) return false;
    leave_limits_whole(f);
    find_rows(f);
    if (!centre_rows(f)) return false;
    sunder_i_tight_draw_apart(f);
    if (is_in_shadow(f)) {
        leave_alone(f);
        find_rows(f);
        sunder_i_tight_draw_apart(f);
    }
    return true;
}
