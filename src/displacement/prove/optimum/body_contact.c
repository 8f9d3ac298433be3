/* Contacts of two bodies, in doubles.
 *
 * In a compact layout the relative move u of two bodies in contact is on the boundary of the pair's forbidden set
 * (forbidden.h): of one piece along a wall, of two pieces in a notch or where arcs meet. Each such piece has a tangent
 * there, with u on its far side. Because of rounding, and of a margin beyond the gap, u lies slightly off the boundary.
 * A tolerance ("hair") allows for that: a share of the gap or, if that is 0, of the smaller body, so that a layer on
 * another scale has the same contacts. */
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/layer/reads.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"

#include <math.h>

double sunder_i_contact_hair(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q)
{
    if (model->rules.gap > 0) return CONTACT * model->rules.gap;
    const double length = p->box[2] - p->box[0] + p->box[3] - p->box[1];
    return CONTACT * sunder_i_min(length, q->box[2] - q->box[0] + q->box[3] - q->box[1]);
}

static bool add_contact(sunder_i_contact_list *out, const sunder_i_forbidden_piece *piece, const double n[2], double d,
                        double off)
{
    if (!sunder_i_reserve(&out->item, &out->capacity, out->n + 1, sizeof *out->item)) return false;
    out->item[out->n++] = (sunder_i_contact){{n[0], n[1]}, d, off, piece->a->feature, piece->b->feature, piece->shadow};
    return true;
}

bool sunder_i_contacts_of_pair(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t i, uint32_t j,
                               const double t[2], const double v[2], double hair, sunder_i_contact_list *out,
                               size_t *edges)
{
    const double u[2] = {v[0] - t[0], v[1] - t[1]};
    sunder_i_forbidden f;
    out->n = 0;
    bool ok = sunder_i_forbidden_init_near(&f, model, waived, i, j, u, hair);
    for (size_t k = 0; k < f.pieces && ok; k++) {
        const sunder_i_forbidden_piece *piece = &f.piece[k];
        double n[2];
        if (!sunder_i_box_near_point(piece->box, u[0], u[1], hair)) continue;
        const double off = piece->radius - sunder_i_forbidden_normal(&f, piece, u, n);
        if (!(fabs(off) <= hair)) continue;
        ok = add_contact(out, piece, n, n[0] * u[0] + n[1] * u[1], off);
    }
    if (edges) *edges += f.edges;
    sunder_i_forbidden_free(&f);
    return ok;
}

size_t sunder_i_spring_cuts(const sunder_i_model *model, uint32_t a, uint32_t b, uint32_t i, uint32_t j,
                            sunder_i_move_cut cut[4])
{
    const sunder_i_row_side *side = model->row_sides ? sunder_i_row_side_of(model, &model->body[a], b) : NULL;
    sunder_i_spring spring[2];
    const size_t springs = side ? sunder_i_springs_of(model, side, spring) : 0;
    for (size_t k = 0; k < 2 * springs; k++) {
        const sunder_i_spring *s = &spring[k / 2];
        const double sign = k % 2 ? 1 : -1;
        /* Adding 0 makes a sum of -0 and -0 a 0. */
        cut[k] = (sunder_i_move_cut){.i = i,
                                     .j = j,
                                     .n = {sign * s->n[0], sign * s->n[1]},
                                     .d = sign * s->n[0] * side->rest[0] + sign * s->n[1] * side->rest[1] + 0.0,
                                     .give = (1 + 0x1p-48) / (2 * s->stiff)};
    }
    return 2 * springs;
}

bool sunder_i_are_in_contact(const sunder_i_model *model, uint32_t i, uint32_t j, const double t[2], const double v[2],
                             bool *contact)
{
    const sunder_i_waived none = {0};
    const double u[2] = {v[0] - t[0], v[1] - t[1]};
    const double hair = sunder_i_contact_hair(model, &model->body[i], &model->body[j]);
    sunder_i_forbidden f;
    const bool ok = sunder_i_forbidden_init_near(&f, model, &none, i, j, u, hair);
    *contact = ok && sunder_i_forbidden_is_near(&f, u, hair);
    sunder_i_forbidden_free(&f);
    return ok;
}

bool sunder_i_bodies_about(const sunder_i_model *model, uint32_t body, const double t[2], double reach,
                           sunder_i_list *out)
{
    const double home[2] = {0, 0};
    double box[4], start[4];
    out->n = 0;
    sunder_i_body_box(&model->body[body], t, reach, box);
    sunder_i_body_box(&model->body[body], home, reach, start);
    if (sunder_i_forbids_paths(model)) sunder_i_box_join(box, start);
    if (!sunder_i_look_about(model, model->standing, box, out)) return false;
    sunder_i_things_to_bodies(model, out);
    return sunder_i_add_row_neighbours(model, body, out);
}
