/* What two bodies of a cluster owe each other, piece by piece: the gap, or what they are held to where they are left in
 * conflict; and the edges of one that keep the other inside. */
#include "displacement/search/search.h"

#include "base/watch.h"

#include <math.h>

/* Is it one of the town's truces that still counts here? */
static bool still_counts(const sunder_i_search *s, const sunder_i_truce *truce)
{
    if (s->ended_n == 0) return true;
    const sunder_i_ended wanted = sunder_i_ended_of(s->town, truce);
    const size_t at = sunder_i_ended_at(s->ended, s->ended_n, &wanted);
    return at == s->ended_n || sunder_i_by_ended(&s->ended[at], &wanted) != 0;
}

/* Has every truce of the town between the two been ended here? */
static bool all_ended(const sunder_i_search *s, const sunder_i_torn *torn)
{
    const sunder_i_ended first = {{torn->i, torn->j}, {0, 0}}, last = {{torn->i, torn->j}, {UINT32_MAX, UINT32_MAX}};
    return s->ended_n &&
           sunder_i_ended_at(s->ended, s->ended_n, &last) - sunder_i_ended_at(s->ended, s->ended_n, &first) == torn->n;
}

bool sunder_i_search_is_torn(const sunder_i_search *s, uint32_t body, uint32_t other, double *reach)
{
    *reach = 0;
    if (s->truces.n + s->town->truces.n == 0) return false;
    const sunder_i_torn *own = sunder_i_truces_between(&s->truces, body, other),
                        *all = sunder_i_truces_between(&s->town->truces, body, other);
    if (all && all_ended(s, all)) all = NULL;
    if (own) *reach = own->reach;
    if (all) *reach = fmax(*reach, all->reach);
    return own || all;
}

const sunder_i_truce *sunder_i_search_truce(const sunder_i_search *s, const sunder_i_piece *a, const sunder_i_piece *b)
{
    const sunder_i_truce *truce = sunder_i_truces_find(&s->truces, a->feature, b->feature);
    if (truce) return truce;
    truce = sunder_i_truces_find(&s->town->truces, a->feature, b->feature);
    return truce && still_counts(s, truce) ? truce : NULL;
}

/* Does the wall keep the piece inside, by the rules or by a truce? */
static bool keeps(const sunder_i_search *s, const sunder_i_piece *wall, const sunder_i_piece *piece,
                  sunder_i_part *part)
{
    if (sunder_i_holds(s->town, wall->feature, piece->feature, &part->keeping)) return true;
    if (!part->torn) return false;
    const sunder_i_truce *truce = sunder_i_search_truce(s, wall, piece);
    part->keeping = SUNDER_I_LENIENT;
    return truce && truce->inside && sunder_i_is_inner(s->town, piece->feature, wall->feature);
}

/* Do the pieces let each other alone? */
static bool are_exempt(const sunder_i_search *s, const sunder_i_piece *a, const sunder_i_piece *b, sunder_i_part *part)
{
    part->keeping = SUNDER_I_LAPSED;
    if (part->torn) part->truce = sunder_i_search_truce(s, a, b);
    return sunder_i_is_kept(s->town, a->feature, b->feature) || (part->truce && part->truce->inside);
}

/* Parts of `from` that may stand within `reach` of parts of `to` at `v`; walls: `from` holds what it is in. */
void sunder_i_search_visit(sunder_i_search *s, const sunder_i_piece *from, uint32_t n, const sunder_i_body *other,
                           const double v[2], double reach, sunder_i_part *part, bool swapped, bool walls,
                           sunder_i_visit_part visit, void *context)
{
    const sunder_i_town *town = s->town;
    for (uint32_t k = 0; k < n; k++) {
        const sunder_i_piece *a = &from[k];
        const double box[4] = {a->box[0] - v[0] - reach, a->box[1] - v[1] - reach, a->box[2] - v[0] + reach,
                               a->box[3] - v[1] + reach};
        if (!sunder_i_steps(1 + other->pieces / 8)) s->failed = true;
        if (!sunder_i_box_meet(box, other->box)) continue;
        for (uint32_t l = other->piece; l < other->piece + other->pieces && !s->failed; l++) {
            const sunder_i_piece *b = &town->piece[l];
            if (!sunder_i_box_meet(box, b->box)) continue;
            part->truce = NULL;
            if (walls ? !keeps(s, a, b, part) : are_exempt(s, a, b, part)) continue;
            const uint64_t key = walls ? UINT64_C(1) << 62 | (uint64_t)(a - town->wall) << 32 | l
                                       : (uint64_t)(a - town->piece) << 32 | l;
            part->a = swapped ? b : a;
            part->b = swapped ? a : b;
            part->key = key;
            visit(s, part, context);
        }
    }
}

void sunder_i_search_parts(sunder_i_search *s, uint32_t i, uint32_t j, const double u[2], double reach, bool yields,
                           sunder_i_visit_part visit, void *context)
{
    const sunder_i_town *town = s->town;
    const sunder_i_body *p = &town->body[s->body[i]], *q = &town->body[s->body[j]];
    sunder_i_part part = {.offset = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]}};
    const double v[2] = {part.offset[0] + u[0], part.offset[1] + u[1]}, back[2] = {-v[0], -v[1]};
    double shift = 0;
    part.torn = yields && sunder_i_search_is_torn(s, s->body[i], s->body[j], &shift);
    reach += shift;
    sunder_i_search_visit(s, town->piece + p->piece, p->pieces, q, v, reach, &part, false, false, visit, context);
    if (!part.torn && town->kept_n == 0) return;
    if (p->walls)
        sunder_i_search_visit(s, town->wall + p->wall, p->walls, q, v, reach, &part, false, true, visit, context);
    if (q->walls)
        sunder_i_search_visit(s, town->wall + q->wall, q->walls, p, back, reach, &part, true, true, visit, context);
}

double sunder_i_search_shift(const sunder_i_truce *truce, uint32_t of_j, double *corner, size_t n)
{
    double shift[2];
    const double gap = sunder_i_truce_shift(truce, of_j, shift);
    for (size_t k = 0; k < 2 * n; k++) corner[k] -= shift[k & 1];
    return gap;
}

/* A + (-B), as it is. */
static size_t make_obstacle(sunder_i_search *s, const sunder_i_part *part)
{
    const double *corner = s->town->corner;
    return sunder_i_difference(corner + 2 * (size_t)part->a->corner, part->a->corners,
                               corner + 2 * (size_t)part->b->corner, part->b->corners, part->offset, &s->scratch);
}

/* What a part without a truce owes, n edges of its obstacle given. */
static double owed(const sunder_i_search *s, const sunder_i_part *part, const sunder_i_edge *edge, size_t n)
{
    const double margin = s->gap - s->town->rules.gap, home[2] = {0, 0};
    if (part->keeping == SUNDER_I_LAPSED) return s->gap;
    if (part->keeping == SUNDER_I_STRICT) return margin;
    return fmin(margin, sunder_i_support_at(edge, n, home).distance);
}

/* The edges of what is in s->scratch. */
static const sunder_i_edge *take_edges(sunder_i_search *s, size_t *n)
{
    if (!sunder_i_reserve(&s->shifted, &s->shifted_capacity, *n, sizeof *s->shifted)) return NULL;
    *n = sunder_i_edges_of(s->scratch.xy, *n, s->shifted);
    return s->shifted;
}

const sunder_i_edge *sunder_i_search_edges(sunder_i_search *s, const sunder_i_part *part, size_t *n, double *gap)
{
    const sunder_i_edge *edge = part->truce ? NULL : sunder_i_shelf_find(&s->shelf, part->key, n);
    *gap = s->gap;
    s->steps++;
    if (!edge) {
        *n = make_obstacle(s, part);
        if (*n && part->truce) {
            *gap = fmin(s->gap, sunder_i_search_shift(part->truce, part->b->feature, s->scratch.xy, *n));
            edge = take_edges(s, n);
        } else if (*n) {
            edge = sunder_i_shelf_add(&s->shelf, part->key, s->scratch.xy, n);
        }
    }
    if (!edge || !sunder_i_steps(1 + *n / 8)) s->failed = true;
    if (edge && !part->truce) *gap = owed(s, part, edge, *n);
    return edge;
}

size_t sunder_i_search_obstacle(sunder_i_search *s, const sunder_i_part *part, double *gap)
{
    size_t n = 0;
    sunder_i_search_edges(s, part, &n, gap);
    n = s->failed ? 0 : make_obstacle(s, part);
    if (n && part->truce) sunder_i_search_shift(part->truce, part->b->feature, s->scratch.xy, n);
    if (n == 0) s->failed = true;
    return n;
}
