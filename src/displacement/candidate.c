/* What a candidate runs into: pairs of convex pieces that stand in each other, and the lines by which one can pass the
 * other. */
#include "displacement/inquiry.h"

#include "displacement/peace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t difference(sunder_i_inquiry *c, const sunder_i_piece *a, const sunder_i_piece *b, uint32_t i, uint32_t j)
{
    const sunder_i_body *p = &c->town->body[c->body[i]], *q = &c->town->body[c->body[j]];
    const double offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]};
    return sunder_i_difference(c->town->corner + 2 * (size_t)a->corner, a->corners,
                               c->town->corner + 2 * (size_t)b->corner, b->corners, offset, &c->scratch);
}

bool sunder_i_inquiry_may_overlap(const sunder_i_inquiry *c, uint32_t i, uint32_t j)
{
    const sunder_i_town *town = c->town;
    const sunder_i_body *p = &town->body[c->body[i]], *q = &town->body[c->body[j]];
    if (!sunder_i_may_be_inside(&town->rules)) return false;
    const double reach = nextafter(c->limit[i] + c->limit[j], INFINITY);
    for (uint32_t k = 0; k < p->members; k++)
        for (uint32_t l = 0; l < q->members; l++) {
            const size_t f = town->member[p->member + k], g = town->member[q->member + l];
            if (town->present[f] && town->present[g] &&
                sunder_i_may_get_inside(&town->rules, town->box + 4 * f, town->box + 4 * g, reach))
                return true;
        }
    return false;
}

/* An obstacle K grown by the gap has round corners. Where K turns by more than this, lines between its edges' are taken
 * too, so that the next is never more than half of it away: a place at distance g is g cos(CORNER / 2) beyond one of
 * the lines, or more. */
#define CORNER 0.78539816339744831

static void add_edge(const sunder_i_inquiry *c, const double at[2], const double n[2], const double u[2],
                     sunder_i_passage *e)
{
    *e = (sunder_i_passage){.n = {n[0], n[1]}};
    e->h = n[0] * at[0] + n[1] * at[1] + c->town->rules.gap * cos(CORNER / 2);
    e->at = n[0] * u[0] + n[1] * u[1] - e->h;
}

/* Lines such that what keeps the gap from the obstacle in scratch (n corners) is beyond one of them: into c->edge, from
 * c->edges on. Returns how many, 0 if memory is out; *depth: how far u, if it is behind all of them, is from the next.
 */
static size_t fill_edges(sunder_i_inquiry *c, size_t n, const double u[2], double *depth)
{
    const double *d = c->scratch.xy;
    const size_t most = 2 * n + (size_t)(7 / CORNER);
    size_t out = 0;
    if (!sunder_i_reserve(&c->edge, &c->edge_capacity, c->edges + most, sizeof *c->edge)) return 0;
    sunder_i_passage *list = c->edge + c->edges;
    for (size_t k = 0; k < n; k++) {
        const double *p = d + 2 * k, *q = d + 2 * (k + 1 < n ? k + 1 : 0), *r = NULL;
        const double x = q[0] - p[0], y = q[1] - p[1], length = hypot(x, y);
        if (!(length > 0)) continue;
        const double normal[2] = {y / length, -x / length};
        add_edge(c, p, normal, u, &list[out++]);
        for (size_t l = 2; l <= n && c->town->rules.gap > 0 && !r; l++) {
            r = d + 2 * ((k + l) % n);
            if (r[0] == q[0] && r[1] == q[1]) r = NULL;
        }
        if (!r) continue;
        const double turn = atan2(x * (r[1] - q[1]) - y * (r[0] - q[0]), x * (r[0] - q[0]) + y * (r[1] - q[1]));
        for (double a = CORNER; a < fabs(turn); a += CORNER)
            add_edge(c, q,
                     (double[2]){normal[0] * cos(a) - normal[1] * sin(a), normal[0] * sin(a) + normal[1] * cos(a)}, u,
                     &list[out++]);
    }
    double at = -INFINITY;
    for (size_t k = 0; k < out; k++) at = fmax(at, list[k].at);
    *depth = -at;
    return out;
}

static void look_at(sunder_i_inquiry *c, uint32_t i, uint32_t j, sunder_i_meeting *worst)
{
    const sunder_i_body *p = &c->town->body[c->body[i]], *q = &c->town->body[c->body[j]];
    const double *t = c->program.t;
    if (p->pieces == 0 || q->pieces == 0 || !(c->limit[i] + c->limit[j] > 0)) return;
    double box[4], shift[4];
    for (uint32_t x = 0; x < 4; x++) {
        shift[x] = p->origin[x & 1] + t[2 * i + (x & 1)] - q->origin[x & 1] - t[2 * j + (x & 1)];
        shift[x] += x < 2 ? -c->town->rules.gap : c->town->rules.gap;
        box[x] = p->box[x] + shift[x];
    }
    if (!sunder_i_box_meet(box, q->box) || sunder_i_inquiry_may_overlap(c, i, j)) return;
    const double u[2] = {t[2 * j] - t[2 * i], t[2 * j + 1] - t[2 * i + 1]};
    for (uint32_t k = p->piece; k < p->piece + p->pieces; k++) {
        const sunder_i_piece *a = &c->town->piece[k];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + shift[x];
        if (!sunder_i_box_meet(box, q->box)) continue;
        for (uint32_t l = q->piece; l < q->piece + q->pieces; l++) {
            const sunder_i_piece *b = &c->town->piece[l];
            if (!sunder_i_box_meet(box, b->box)) continue;
            const size_t n = difference(c, a, b, i, j);
            double depth;
            if (n == 0 || !fill_edges(c, n, u, &depth)) {
                c->scratch.failed = true;
                return;
            }
            if (depth > worst->depth) *worst = (sunder_i_meeting){i, j, depth, a, b};
        }
    }
}

size_t sunder_i_inquiry_meetings(sunder_i_inquiry *c, sunder_i_meeting deepest[SUNDER_I_CHOICES])
{
    size_t n = 0;
    for (uint32_t i = 0; i < c->bodies; i++)
        for (uint32_t j = i + 1; j < c->bodies; j++) {
            sunder_i_meeting o = {.depth = SUNDER_I_INQUIRY_TOLERANCE * c->longest};
            look_at(c, i, j, &o);
            if (!o.a || (n == SUNDER_I_CHOICES && o.depth <= deepest[n - 1].depth)) continue;
            size_t k = n < SUNDER_I_CHOICES ? n++ : n - 1;
            for (; k > 0 && deepest[k - 1].depth < o.depth; k--) deepest[k] = deepest[k - 1];
            deepest[k] = o;
        }
    return n;
}

static int by_nearness(const void *a, const void *b)
{
    const sunder_i_passage *p = a, *q = b;
    return (p->at < q->at) - (p->at > q->at);
}

size_t sunder_i_inquiry_passages(sunder_i_inquiry *c, const sunder_i_meeting *o)
{
    const double *t = c->program.t;
    const double u[2] = {t[2 * o->j] - t[2 * o->i], t[2 * o->j + 1] - t[2 * o->i + 1]};
    double depth;
    const size_t n = difference(c, o->a, o->b, o->i, o->j), edges = n ? fill_edges(c, n, u, &depth) : 0;
    if (edges) qsort(c->edge + c->edges, edges, sizeof *c->edge, by_nearness);
    return edges;
}
