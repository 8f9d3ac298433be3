/* One cluster as the search sees it: which bodies stand near each other, which clash, and by how much. */
#include "displacement/search.h"

#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool sunder_i_search_init(sunder_i_search *s, const sunder_i_town *town, const uint32_t *body, size_t n, double margin,
                          const double *move)
{
    memset(s, 0, sizeof *s);
    s->town = town;
    s->body = body;
    s->n = s->own = n;
    s->gap = town->rules.gap + margin;
    s->tolerance = margin / 4;
    s->settled = 1e-3;
    s->cap = INFINITY;
    s->patience = UINT64_MAX;
    s->hope = INFINITY;
    s->mass = sunder_i_alloc(n, sizeof *s->mass);
    s->away = sunder_i_calloc(n, sizeof *s->away);
    s->t = sunder_i_alloc(2 * n, sizeof *s->t);
    s->next = sunder_i_alloc(2 * n, sizeof *s->next);
    s->box = sunder_i_alloc(4 * n, sizeof *s->box);
    s->order = sunder_i_alloc(n, sizeof *s->order);
    if (!s->mass || !s->away || !s->t || !s->next || !s->box || !s->order) return false;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &town->body[body[k]];
        s->mass[k] = b->fixed || b->pinned ? 0 : 0.5 / b->weight;
        if (b->pieces) s->extent += fmax(b->box[2] - b->box[0], b->box[3] - b->box[1]) / (double)n;
    }
    memcpy(s->t, move, 2 * n * sizeof *s->t);
    s->program.bodies = n;
    s->program.mass = s->mass;
    s->program.t = s->next;
    return true;
}

void sunder_i_search_free(sunder_i_search *s)
{
    sunder_i_free(s->mass);
    sunder_i_free(s->away);
    sunder_i_free(s->t);
    sunder_i_free(s->next);
    sunder_i_free(s->box);
    sunder_i_free(s->order);
    sunder_i_free(s->program.constraint);
    sunder_i_free(s->old);
    sunder_i_free(s->clash);
    sunder_i_truces_free(&s->truces);
    sunder_i_free(s->ended);
    sunder_i_free(s->scratch.xy);
    sunder_i_shelf_free(&s->shelf);
    sunder_i_free(s->shifted);
    memset(s, 0, sizeof *s);
}

double sunder_i_search_limit(const sunder_i_search *s, uint32_t i)
{
    return fmin(s->cap, s->town->body[s->body[i]].limit);
}

double sunder_i_search_cost(const sunder_i_search *s, const double *t)
{
    double cost = 0;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) cost += (t[2 * k] * t[2 * k] + t[2 * k + 1] * t[2 * k + 1]) / (2 * s->mass[k]);
    return cost;
}

/* ---- Who stands near whom ---------------------------------------------------------------------------------------- */

/* Sorts order by the left sides of the boxes; insertion would do between rounds, but clusters can be large. */
static int by_left(const void *a, const void *b)
{
    const double *p = *(const double *const *)a, *q = *(const double *const *)b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return p < q ? -1 : p > q;
}

static bool sort_boxes(sunder_i_search *s, const double *t, double reach, bool or_home)
{
    const double *o = s->town->body[s->body[0]].origin;
    const double **left = sunder_i_alloc(s->n, sizeof *left);
    if (!left) return false;
    for (size_t k = 0; k < s->n; k++) {
        const sunder_i_body *b = &s->town->body[s->body[k]];
        const bool home = or_home && s->mass[k] > 0;
        for (int c = 0; c < 4; c++) {
            const double at = t[2 * k + (size_t)(c & 1)], least = home ? fmin(at, 0) : at, most = home ? fmax(at, 0) : at;
            s->box[4 * k + (size_t)c] =
                b->box[c] + (b->origin[c & 1] - o[c & 1]) + (c < 2 ? least - reach / 2 : most + reach / 2);
        }
        left[k] = s->box + 4 * k;
    }
    qsort(left, s->n, sizeof *left, by_left);
    for (size_t k = 0; k < s->n; k++) s->order[k] = (uint32_t)((size_t)(left[k] - s->box) / 4);
    sunder_i_free(left);
    return true;
}

static void visit_near(sunder_i_search *s, const double *t, double reach, bool or_home, sunder_i_near visit,
                       void *context)
{
    if (!sort_boxes(s, t, reach, or_home)) {
        s->failed = true;
        return;
    }
    /* visit() may look elsewhere, but never sorts again. */
    for (size_t x = 0; x < s->n && !s->failed; x++) {
        const uint32_t i = s->order[x];
        const double *a = s->box + 4 * i;
        for (size_t y = x + 1; y < s->n; y++) {
            const uint32_t j = s->order[y];
            const double *b = s->box + 4 * j;
            if (b[0] > a[2]) break;
            if (b[1] > a[3] || a[1] > b[3] || !(s->mass[i] + s->mass[j] > 0)) continue;
            visit(s, i < j ? i : j, i < j ? j : i, context);
        }
    }
}

void sunder_i_search_near(sunder_i_search *s, const double *t, double reach, sunder_i_near visit, void *context)
{
    visit_near(s, t, reach, false, visit, context);
}

void sunder_i_search_near_or_home(sunder_i_search *s, double reach, sunder_i_near visit, void *context)
{
    visit_near(s, s->t, reach, true, visit, context);
}

/* ---- Who clashes --------------------------------------------------------------------------------------------------
 */

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
    return s->ended_n && sunder_i_ended_at(s->ended, s->ended_n, &last) -
                                 sunder_i_ended_at(s->ended, s->ended_n, &first) == torn->n;
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

typedef struct missing {
    const double *u;
    double worst;
} missing;

static void measure_part(sunder_i_search *s, const sunder_i_part *part, void *context)
{
    missing *m = context;
    double gap;
    size_t n;
    const sunder_i_edge *edge = sunder_i_search_edges(s, part, &n, &gap);
    if (edge) m->worst = fmax(m->worst, gap - sunder_i_support_at(edge, n, m->u).distance);
}

double sunder_i_search_pair(sunder_i_search *s, uint32_t i, uint32_t j, const double u[2], bool *yields)
{
    missing m = {u, 0};
    double shift;
    *yields = false;
    sunder_i_search_parts(s, i, j, u, s->gap, false, measure_part, &m);
    if (m.worst <= s->tolerance || !sunder_i_search_is_torn(s, s->body[i], s->body[j], &shift)) return m.worst;
    *yields = true;
    m.worst = 0;
    sunder_i_search_parts(s, i, j, u, s->gap, true, measure_part, &m);
    return m.worst;
}

typedef struct look {
    const double *t;
    double worst;
} look;

static void look_at(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    look *l = context;
    const double u[2] = {l->t[2 * j] - l->t[2 * i], l->t[2 * j + 1] - l->t[2 * i + 1]};
    bool yields;
    const double v = sunder_i_search_pair(s, i, j, u, &yields);
    if (v > l->worst) l->worst = v;
    if (v <= s->tolerance || s->failed) return;
    if (!sunder_i_reserve(&s->clash, &s->clash_capacity, s->clashes + 1, sizeof *s->clash)) {
        s->failed = true;
        return;
    }
    s->clash[s->clashes++] = (sunder_i_clash){i, j, v};
}

void sunder_i_search_look_at(sunder_i_search *s, const double *t, uint32_t i, uint32_t j)
{
    look l = {t, 0};
    look_at(s, i, j, &l);
}

double sunder_i_search_look(sunder_i_search *s, const double *t)
{
    look l = {t, 0};
    s->clashes = 0;
    sunder_i_search_near(s, t, s->gap, look_at, &l);
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) l.worst = fmax(l.worst, hypot(t[2 * k], t[2 * k + 1]) - sunder_i_search_limit(s, (uint32_t)k));
    return l.worst;
}

void sunder_i_search_look_again(sunder_i_search *s, const double *t, uint32_t i)
{
    size_t out = 0;
    for (size_t k = 0; k < s->clashes; k++)
        if (s->clash[k].i != i && s->clash[k].j != i) s->clash[out++] = s->clash[k];
    s->clashes = out;
    look l = {t, 0};
    const sunder_i_body *p = &s->town->body[s->body[i]];
    if (p->pieces == 0) return;
    for (uint32_t j = 0; j < s->n && !s->failed; j++) {
        const sunder_i_body *q = &s->town->body[s->body[j]];
        if (j == i || q->pieces == 0) continue;
        double box[4];
        for (size_t c = 0; c < 4; c++)
            box[c] = p->box[c] + p->origin[c & 1] + t[2 * i + (c & 1)] - q->origin[c & 1] - t[2 * j + (c & 1)] +
                     (c < 2 ? -s->gap : s->gap);
        if (sunder_i_box_meet(box, q->box)) look_at(s, i < j ? i : j, i < j ? j : i, &l);
    }
}
