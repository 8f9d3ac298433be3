/* Finds the common step of coordinates, if they have one, and the bodies that take part in a place without spare room:
 * the group, and bodies outside that it touches there (tight_place.c). */
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/tight.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "displacement/layer/rounding.h"
#include "number/lattice.h"

#include <limits.h>
#include <math.h>
#include <string.h>

bool sunder_i_tight_add(sunder_i_tight *f, uint32_t body, const double t[2])
{
    if (!sunder_i_reserve(&f->body, &f->capacity, f->all + 1, sizeof *f->body) ||
        !sunder_i_reserve(&f->t, &f->places, 2 * f->all + 2, sizeof *f->t))
        return false;
    f->body[f->all] = body;
    memcpy(f->t + 2 * f->all++, t, 2 * sizeof *t);
    return true;
}

/* ---- The step ---------------------------------------------------------------------------------------------------- */

static void lower_exponent(int *exponent, double v)
{
    const int e = sunder_i_low_bit(v);
    if (e < *exponent) *exponent = e;
}

/* Lowers *exponent to the lowest bit of the piece's corners as given; relative to the body's origin they may be
 * rounded. Returns false if memory is out. */
static bool lower_by_piece(sunder_i_tight *f, const sunder_i_body_piece *piece, int *exponent)
{
    const size_t n = sunder_i_corners_as_given(f->model, piece);
    if (!sunder_i_reserve(&f->corner, &f->corners, 2 * n, sizeof *f->corner)) return false;
    sunder_i_piece_as_given(f->model, piece, f->corner);
    for (size_t v = 0; v < 2 * n; v++) lower_exponent(exponent, f->corner[v]);
    return true;
}

/* Lowers *exponent to the lowest bit of each distance that has to be kept from a thing; *known is set if all of them
 * are doubles. */
static void lower_by_distances(const sunder_i_model *model, uint32_t thing, int *exponent, bool *known)
{
    const bool part = sunder_i_is_barrier(model, thing);
    const size_t classes = model->gaps ? model->gaps->n : 1;
    *known = true;
    if (!part) lower_exponent(exponent, model->rules.gap);
    for (uint32_t of = 0; part && of < classes; of++) {
        const double *owed = sunder_i_required(model->barriers, sunder_i_barrier_of(model, thing), of);
        lower_exponent(exponent, owed[0]);
        *known = *known && owed[1] == 0;
    }
    for (size_t k = 0; !part && model->gaps && k < classes * classes; k++)
        lower_exponent(exponent, model->class_gap[k]);
}

/* Lowers *exponent to the lowest bit of a body's coordinates and of the distances that it has to keep; *known is set if
 * these are doubles. Returns false if memory is out. */
static bool lower_by_body(sunder_i_tight *f, const sunder_i_body *body, int *exponent, bool *known)
{
    const sunder_i_model *model = f->model;
    const uint32_t thing = model->member[body->member];
    lower_by_distances(model, thing, exponent, known);
    const sunder_i_body_pieces *of = sunder_i_pieces_of(model, body);
    if (!of) return false;
    for (uint32_t p = 0; *known && p < body->pieces; p++)
        if (!lower_by_piece(f, &of->piece[p], exponent)) return false;
    return true;
}

static bool is_coarse(const sunder_i_tight *f, int exponent) { return ldexp(1, exponent) >= TIGHT_STEP * f->size; }

/* Does one body alone move, without a limit? */
static bool is_lone_body(const sunder_i_tight *f)
{
    size_t movers = 0;
    bool limited = false;
    for (size_t k = 0; k < f->n; k++) {
        const sunder_i_body *body = &f->model->body[f->body[k]];
        movers += !body->fixed;
        limited = limited || (!body->fixed && sunder_i_limit_of(body) < INFINITY);
    }
    return movers == 1 && !limited;
}

bool sunder_i_tight_find_step(sunder_i_tight *f, bool *coarse)
{
    *coarse = true;
    f->exponent = INT_MAX;
    for (size_t k = 0; k < f->n && *coarse; k++) {
        const sunder_i_body *body = &f->model->body[f->body[k]];
        for (int c = 0; c < 4 && !body->fixed; c++) f->size = sunder_i_max(f->size, fabs(body->box[c]));
        if (!lower_by_body(f, body, &f->exponent, coarse)) return false;
        /* The step never becomes coarser, nor the size smaller, so most layers end here, at the first body. */
        *coarse = *coarse && is_coarse(f, f->exponent);
    }
    *coarse = *coarse && f->exponent < INT_MAX && is_coarse(f, f->exponent);
    /* Sides at an angle cross between the steps of their corners: two at 45 degrees in the middle of a step. */
    for (int k = 0; k < TIGHT_FINER && *coarse && is_lone_body(f) && is_coarse(f, f->exponent - 1); k++) f->exponent--;
    if (*coarse) f->hair = sunder_i_min(TIGHT_HAIR * f->size, TIGHT_STEP_HAIR * ldexp(1, f->exponent));
    return true;
}

/* ---- Bodies outside ---------------------------------------------------------------------------------------------- */

static bool takes_part(const sunder_i_tight *f, uint32_t body)
{
    for (size_t k = 0; k < f->all; k++)
        if (f->body[k] == body) return true;
    return false;
}

/* Adds body `other` if it touches the body at place k, and its coordinates have a coarse step, too. Returns false if
 * memory is out. */
static bool take_in(sunder_i_tight *f, size_t k, uint32_t other)
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
    return sunder_i_tight_add(f, other, stands);
}

bool sunder_i_tight_find_outside(sunder_i_tight *f)
{
    for (size_t k = 0; k < f->n; k++) {
        if (f->model->body[f->body[k]].fixed) continue;
        if (!sunder_i_bodies_about(f->model, f->body[k], f->t + 2 * k, f->model->rules.gap + f->hair, &f->near))
            return false;
        for (size_t m = 0; m < f->near.n && f->all < 2 * MOST_TIGHT; m++)
            if (!takes_part(f, f->near.item[m]) && !take_in(f, k, f->near.item[m])) return false;
    }
    return true;
}
