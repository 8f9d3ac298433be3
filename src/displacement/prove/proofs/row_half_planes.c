/* The rule of rows in a question: for two neighbours it is one half-plane of their relative move, and no case. It is
 * rounded down, so that it demands no more than the rule does. */
#include "displacement/prove/proofs/branching.h"

#include "displacement/layer/requirement.h"

#include <math.h>
#include <stdlib.h>

/* Is a pair of the two bodies listed, apart from the pair in question? */
static bool is_any_listed(const sunder_i_branching *c, const sunder_i_body *p, const sunder_i_body *q)
{
    const sunder_i_subproblem *asked = c->subproblem;
    const uint32_t *member = c->model->member;
    for (uint32_t k = p->member; k < p->member + p->members && asked->required_n; k++)
        for (uint32_t m = q->member; m < q->member + q->members; m++) {
            const uint32_t f = member[k], g = member[m];
            const sunder_i_requirement key = {.a = f < g ? f : g, .b = f < g ? g : f};
            if (key.a == asked->a && key.b == asked->b) continue;
            if (bsearch(&key, asked->required, asked->required_n, sizeof key, sunder_i_by_id_pair)) return true;
        }
    return false;
}

/* Returns the piece by which a proof names a body. Returns NULL if memory is out, or if the body has none. */
static const sunder_i_body_piece *name_of(sunder_i_branching *c, const sunder_i_body *body)
{
    const sunder_i_body_pieces *pieces = body->pieces ? sunder_i_pieces_of(c->model, body) : NULL;
    c->failed = c->failed || (body->pieces && !pieces);
    return pieces ? pieces->piece : NULL;
}

/* Sets *half_plane to what the rule of the neighbours p and q demands. Returns false if there is no rule. Beyond a
 * substitute for a missing limit a rule may leave what it forbids nearer, so bodies without a limit have none. */
static bool find_half_plane(const sunder_i_branching *c, uint32_t p, uint32_t q, sunder_i_half_plane *half_plane)
{
    const sunder_i_subproblem *asked = c->subproblem;
    const sunder_i_body *i = &c->model->body[p], *j = &c->model->body[q];
    const double reach = sunder_i_limit_of(i) + sunder_i_limit_of(j);
    const sunder_i_row_side *side =
        asked->rows && i->has->row_sides && isfinite(reach) ? sunder_i_row_side_of(c->model, i, q) : NULL;
    if (!side || side->least == -INFINITY) return false;
    const bool listed = asked->row_listed || is_any_listed(c, i, j);
    const double least = nextafter(listed ? side->least_listed : side->least, -INFINITY);
    *half_plane = (sunder_i_half_plane){.n = {side->along[0], side->along[1]},
                                        .d = asked->less > 0 ? nextafter(least - asked->less, -INFINITY) : least};
    return true;
}

bool sunder_i_branching_misses_row(sunder_i_branching *branching, uint32_t p, uint32_t q, const double u[2],
                                   sunder_i_violation *violation)
{
    sunder_i_half_plane h;
    if (!find_half_plane(branching, p, q, &h)) return false;
    const double depth = h.d - (h.n[0] * u[0] + h.n[1] * u[1]);
    if (!(depth > 2 * branching->hair)) return false;
    const sunder_i_body_piece *a = name_of(branching, &branching->model->body[p]),
                              *b = name_of(branching, &branching->model->body[q]);
    if (!a || !b || !sunder_i_branching_is_path_heeded(branching, a->feature) ||
        !sunder_i_branching_is_path_heeded(branching, b->feature))
        return false;
    *violation = (sunder_i_violation){.p = p, .q = q, .a = a, .b = b, .depth = depth, .row = true};
    return true;
}

size_t sunder_i_branching_row_half_plane(sunder_i_branching *branching, uint32_t p, uint32_t q)
{
    if (!sunder_i_reserve(&branching->scratch, &branching->scratch_capacity, 1, sizeof *branching->scratch))
        branching->failed = true;
    return !branching->failed && find_half_plane(branching, p, q, branching->scratch);
}
