/* Do two bodies have no free relative move? If jumps are not allowed this happens: a feature in a courtyard can leave
 * it no more than the courtyard can leave the feature, and if the courtyard is too small there is no place in it.
 *
 * All relative moves within a square are examined, which is so large that beyond it the two are certainly apart. There
 * only shadows forbid a move, and these are unbounded: a direction that leads into one stays in it. So if the square is
 * covered (covered_region.c), the whole plane is, whatever limits and fixed features exist. Either two whole bodies are
 * examined, or two features whose blocks move with them and only add their shadows.
 *
 * Few pairs are shut in, and for most pairs the straight direction apart is obviously open. So directions are tried
 * first, in doubles, which decides nothing: if one is open there is nothing to prove. */
#include "displacement/prove/optimum/forbidden.h"
#include "displacement/prove/optimum/region.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/watch.h"

#include <math.h>

typedef struct outlook {
    const sunder_i_model *model;
    const sunder_i_body *p, *q;
    const sunder_i_body_pieces *of_p, *of_q;
    double offset[2]; /* the origin of q relative to that of p */
} outlook;

/* Does the ray from u along dir meet the convex piece, moved by `shift`? */
static bool ray_meets(const sunder_i_body_piece *piece, const double shift[2], const double u[2], const double dir[2])
{
    const double *corner = piece->corner;
    bool left = false, right = false, ahead = false;
    for (uint32_t k = 0; k < piece->corners; k++) {
        const double x = corner[2 * k] + shift[0] - u[0], y = corner[2 * k + 1] + shift[1] - u[1];
        const double side = dir[0] * y - dir[1] * x;
        left = left || side >= 0;
        right = right || side <= 0;
        ahead = ahead || dir[0] * x + dir[1] * y > 0;
    }
    return left && right && ahead;
}

/* Does an anchor of the body that moves along dir (p if p_runs, else q) meet the other body, whose origin is at `shift`
 * from it? */
static bool runs_into(const outlook *l, bool p_runs, const double shift[2], const double dir[2])
{
    const sunder_i_body *of = p_runs ? l->p : l->q, *other = p_runs ? l->q : l->p;
    const sunder_i_body_piece *piece = (p_runs ? l->of_q : l->of_p)->piece;
    for (uint32_t m = 0; m < of->members; m++) {
        const sunder_i_body_piece *anchor = &(p_runs ? l->of_p : l->of_q)->anchor[m];
        for (uint32_t k = 0; k < other->pieces && anchor->corners; k++)
            if (ray_meets(&piece[k], shift, anchor->box, dir) &&
                !sunder_i_may_pass(l->model, anchor->feature, piece[k].feature))
                return true;
    }
    return false;
}

static bool is_open(const outlook *l, const double dir[2])
{
    const double to_p[2] = {-l->offset[0], -l->offset[1]}, back[2] = {-dir[0], -dir[1]};
    return !runs_into(l, false, to_p, dir) && !runs_into(l, true, l->offset, back);
}

/* Is one of OUTLOOKS directions open? The first is that from the middle of p to the middle of q. */
static bool any_is_open(const outlook *l)
{
    double out[2];
    for (int c = 0; c < 2; c++)
        out[c] = l->q->box[c] + l->q->box[c + 2] + 2 * l->offset[c] - l->p->box[c] - l->p->box[c + 2];
    const double length = hypot(out[0], out[1]);
    double dir[2] = {length > 0 ? out[0] / length : 1, length > 0 ? out[1] / length : 0};
    for (int k = 0; k < OUTLOOKS; k++) {
        if (is_open(l, dir)) return true;
        const double x = dir[0];
        dir[0] = TURN_COS * x - TURN_SIN * dir[1];
        dir[1] = TURN_SIN * x + TURN_COS * dir[1];
    }
    return false;
}

/* Sets *part to the k-th part of the square, slightly enlarged to allow for rounding. */
static void find_part(int k, double reach, sunder_i_region *part)
{
    const int column = k % SQUARE_PARTS, row = k / SQUARE_PARTS;
    const double half = reach / SQUARE_PARTS,
                 centre[2] = {(2 * column + 1) * half - reach, (2 * row + 1) * half - reach};
    sunder_i_region_init(part, centre, half * (1 + 0x1p-20));
}

/* Is the whole square covered? It is tested in parts, each of which may take as much work as a cut. */
static bool is_covered(const sunder_i_forbidden *f, double reach, uint64_t *steps)
{
    for (int k = 0; k < SQUARE_PARTS * SQUARE_PARTS; k++) {
        sunder_i_region part;
        find_part(k, reach, &part);
        if (!sunder_i_region_is_covered(&part, f, NULL, NULL, steps)) return false;
    }
    return true;
}

bool sunder_i_may_be_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q)
{
    outlook l = {.model = model, .p = &model->body[p], .q = &model->body[q]};
    for (size_t c = 0; c < 2; c++) l.offset[c] = l.q->origin[c] - l.p->origin[c];
    l.of_p = sunder_i_pieces_of(model, l.p);
    l.of_q = sunder_i_pieces_of(model, l.q);
    /* If memory is out, the exact test that follows reports it. */
    return !l.of_p || !l.of_q || !any_is_open(&l);
}

/* Lists the forbidden set of the two bodies, and sets *reach to half the side of the square to be examined. */
static bool find_forbidden(sunder_i_forbidden *f, const sunder_i_model *model, uint32_t p, uint32_t q, double *reach)
{
    *reach = 2 * sunder_i_farthest_near(model, p, q);
    return sunder_i_forbidden_with_covers(f, model, p, q, *reach, MOST_SHUT_IN);
}

bool sunder_i_is_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q, bool *shut)
{
    sunder_i_forbidden f;
    double reach;
    uint64_t steps = 0;
    bool ok = find_forbidden(&f, model, p, q, &reach) && sunder_i_forbidden_index(&f);
    *shut = ok && is_covered(&f, reach, &steps);
    ok = ok && sunder_i_steps(steps / 8);
    sunder_i_forbidden_free(&f);
    return ok;
}

/* ---- Pairs of features ------------------------------------------------------------------------------------------- */

static bool is_between(const sunder_i_forbidden_piece *piece, const sunder_i_id_pair *pair)
{
    const uint32_t a = piece->a->feature, b = piece->b->feature;
    return (a == pair->a && b == pair->b) || (a == pair->b && b == pair->a);
}

/* Copies the shadows among all pieces to `part`, which has room for all of them. */
static void keep_shadows(const sunder_i_forbidden *all, sunder_i_forbidden *part)
{
    part->pieces = 0;
    for (size_t k = 0; k < all->pieces; k++)
        if (all->piece[k].shadow) part->piece[part->pieces++] = all->piece[k];
}

/* Appends, after the n shadows, the pieces of these two features. */
static void add_pair(const sunder_i_forbidden *all, const sunder_i_id_pair *pair, size_t n, sunder_i_forbidden *part)
{
    part->pieces = n;
    for (size_t k = 0; k < all->pieces; k++)
        if (!all->piece[k].shadow && is_between(&all->piece[k], pair)) part->piece[part->pieces++] = all->piece[k];
}

/* Are all regions of *left covered by the forbidden set f? A region that is not covered is moved to the front, as it is
 * likely to be uncovered for the next pair of features, too. */
static bool covers_regions(const sunder_i_forbidden *f, sunder_i_regions *left, uint64_t *steps)
{
    for (size_t k = 0; k < left->n; k++) {
        if (sunder_i_region_is_covered(&left->item[k], f, NULL, NULL, steps)) continue;
        const sunder_i_region first = left->item[k];
        left->item[k] = left->item[0];
        left->item[0] = first;
        return false;
    }
    return true;
}

/* The shadows are the same for all pairs, and are most of the pieces: what they cover is proved once. */
bool sunder_i_find_shut_in_pairs(const sunder_i_model *model, uint32_t p, uint32_t q, const sunder_i_id_pair *pair,
                                 size_t n, bool *shut)
{
    sunder_i_forbidden all;
    sunder_i_regions left = {0};
    double reach;
    uint64_t steps = 0;
    bool ok = find_forbidden(&all, model, p, q, &reach);
    sunder_i_forbidden part = all; /* its edges are those of `all` */
    part.piece = sunder_i_alloc(all.pieces, sizeof *part.piece);
    ok = ok && part.piece;
    if (ok) keep_shadows(&all, &part);
    const size_t shadows = ok ? part.pieces : 0;
    ok = ok && sunder_i_forbidden_index(&part);
    for (int k = 0; k < SQUARE_PARTS * SQUARE_PARTS && ok; k++) {
        sunder_i_region square;
        find_part(k, reach, &square);
        ok = sunder_i_region_cover(&square, &part, &left, &steps);
    }
    for (size_t k = 0; k < n && ok; k++) {
        add_pair(&all, &pair[k], shadows, &part);
        shut[k] = covers_regions(&part, &left, &steps);
        ok = sunder_i_steps(steps / 8);
        steps = 0;
    }
    part.edge = NULL;
    sunder_i_forbidden_free(&part);
    sunder_i_forbidden_free(&all);
    sunder_i_free(left.item);
    return ok;
}
