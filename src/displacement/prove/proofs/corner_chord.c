/* Chords across corners that two sides of barriers share, and across ends of two sides on one ray from the anchor.
 *
 * Each side casts its shadow from the anchor a (geometry/obstacle_shadow.h). If sides pb and bq meet in b, on opposite
 * sides of the ray from a through b, the two shadows share the ray beyond b as their boundary. All of it is forbidden,
 * but the lines of either shadow leave a gap around it, as narrow as rounding, that no line closes.
 *
 * Let p' be in the shadow of pb, q' in that of bq, and let the chord p'q' cross the ray at c, beyond b. The shadow of
 * pb is convex, contains p' and c, and contains everything behind any of its points; so it contains everything behind
 * p'c. The same holds for q'. So everything behind the chord is in the union of the two shadows, exactly and whatever
 * p' and q' are. The half-planes past the chord are used like those of any piece, and its lines pass the gap at some
 * distance on the left and right.
 *
 * The chord cuts off a little of the corner (CHORD of the sides), and is moved away from the anchor until it passes
 * beyond b, and a little more (BEYOND), so that rounding to doubles does no harm. Predicates test the required
 * properties on the doubles. The sliver between b and the chord is not covered.
 *
 * Two sides pb and b'q, whose ends b and b' lie on one ray from the anchor, do the same beyond the farther of the two
 * ends: both shadows have the rest of the ray as a boundary. So the chord passes beyond both. */
#include "displacement/prove/proofs/plane.h"
#include "displacement/prove/proofs/tuning.h"

#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"

#include "base/extremes.h"

static double cross_product(const double u[2], const double v[2]) { return u[0] * v[1] - u[1] * v[0]; }
static double dot_product(const double u[2], const double v[2]) { return u[0] * v[0] + u[1] * v[1]; }

static int side_of(const double p[2], const double q[2], const double u[2])
{
    return sunder_orient(&(sunder_point){p[0], p[1]}, &(sunder_point){q[0], q[1]}, &(sunder_point){u[0], u[1]});
}

/* Returns the side of a barrier that has this piece. */
static const sunder_i_side *side_of_piece(const sunder_i_model *model, const sunder_i_body_piece *piece)
{
    const sunder_i_body *of = &model->body[model->body_of[piece->feature]];
    for (uint32_t k = of->has->side; k < of->has->side + of->has->sides; k++)
        if (piece == &model->side[k].piece) return &model->side[k];
    return NULL;
}

/* Is `place` in the shadow of the segment from b to p, seen from a? */
static bool is_shaded(const double a[2], const double b[2], const double p[2], const double place[2])
{
    const int turn = side_of(a, b, p);
    return turn != 0 && side_of(a, b, place) == turn && side_of(a, p, place) != turn && side_of(b, p, place) != 0 &&
           side_of(b, p, place) == -side_of(b, p, a);
}

/* Do the ends of the two sides lie on one ray from a? The sign of a difference of doubles is exact. */
static bool are_on_one_ray(const double a[2], const double *const end[2])
{
    for (int c = 0; c < 2; c++) {
        const double to[2] = {end[0][c] - a[c], end[1][c] - a[c]};
        if ((to[0] > 0) != (to[1] > 0) || (to[0] < 0) != (to[1] < 0)) return false;
    }
    return side_of(a, end[0], end[1]) == 0;
}

/* Does the shadow of the chord lie in the shadows of the two sides? The chord is in front of the anchor everywhere, so
 * it crosses the ray beyond an end if that end is on the anchor's side of it. far: the farther end, from a. */
static bool is_behind(const double a[2], const double *const end[2], const double *const other[2], const double far[2],
                      const double chord[4])
{
    if (!is_shaded(a, end[0], other[0], chord) || !is_shaded(a, end[1], other[1], chord + 2)) return false;
    for (int k = 0; k < 4; k += 2) {
        const double at[2] = {chord[k] - a[0], chord[k + 1] - a[1]};
        if (!(dot_product(at, far) > 0.5 * dot_product(far, far))) return false;
    }
    const int anchor = side_of(chord, chord + 2, a);
    return side_of(a, end[0], other[0]) == -side_of(a, end[1], other[1]) && anchor != 0 &&
           side_of(chord, chord + 2, end[0]) == anchor && side_of(chord, chord + 2, end[1]) == anchor;
}

/* Computes a chord from behind the side between end[0] and other[0] to behind that between end[1] and other[1], seen
 * from the anchor a. The two ends have to lie on one ray from a. Returns false if there is no chord. */
static bool make_side_chord(const double a[2], const double *const end[2], const double *const other[2],
                            double chord[4])
{
    if (!are_on_one_ray(a, end)) return false;
    const double to[2][2] = {{end[0][0] - a[0], end[0][1] - a[1]}, {end[1][0] - a[0], end[1][1] - a[1]}};
    const double *path = dot_product(to[1], to[1]) > dot_product(to[0], to[0]) ? to[1] : to[0];
    const double size = dot_product(path, path);
    double at[2][2];
    if (!(size > 0)) return false;
    /* A point of each side near its end, moved outwards as far as the end would have to be moved to the farther one. */
    for (int k = 0; k < 2; k++) {
        const double outwards = size / dot_product(to[k], path);
        for (int c = 0; c < 2; c++) at[k][c] = outwards * (to[k][c] + CHORD * (other[k][c] - end[k][c]));
    }
    /* Where the segment between these points crosses the ray, as a multiple of the distance of the farther end. */
    const double left = cross_product(path, at[0]), right = cross_product(path, at[1]);
    if (!(left * right < 0)) return false;
    const double share = left / (left - right),
                 passes = ((1 - share) * dot_product(at[0], path) + share * dot_product(at[1], path)) / size;
    if (!(passes > 0.5)) return false;
    const double times = (1 + BEYOND) * sunder_i_max(1, 1 / passes);
    for (int c = 0; c < 2; c++) {
        chord[c] = a[c] + times * at[0][c];
        chord[2 + c] = a[c] + times * at[1][c];
    }
    return is_behind(a, end, other, path, chord);
}

size_t sunder_i_branching_chord_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                            const sunder_i_body_piece *anchor, const sunder_i_body *q,
                                            const double chord[4])
{
    double at[4];
    for (int k = 0; k < 4; k++) at[k] = chord[k] - q->origin[k & 1];
    const sunder_i_parting parting = {.a = anchor->corner,
                                      .b = at,
                                      .na = 1,
                                      .nb = 2,
                                      .offset = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]}};
    const size_t most = SUNDER_I_HALF_PLANES_A_CORNER * 3 + SUNDER_I_HALF_PLANES_MORE;
    branching->looked += most;
    if (!sunder_i_reserve(&branching->scratch, &branching->scratch_capacity, most, sizeof *branching->scratch)) {
        branching->failed = true;
        return 0;
    }
    return sunder_i_half_planes_past(&parting, branching->scratch);
}

/* ---- Spokes ------------------------------------------------------------------------------------------------------ */

/* A side of body q that begins near the anchor's path: `end` is its end near the path, `other` the other end. */
typedef struct spoke {
    const sunder_i_body_piece *anchor, *piece;
    uint32_t q;
    const sunder_i_side *side;
    const double *end, *other;
} spoke;

/* Does the anchor's path pass nearly through `end`? Relative to the side the anchor moves by -u. */
static bool is_beside(const double a[2], const double end[2], const double u[2])
{
    const double to[2] = {end[0] - a[0], end[1] - a[1]}, along = -dot_product(to, u);
    return along > 0 && fabs(cross_product(to, u)) <= BESIDE * along;
}

/* Finds the spoke of a piece that is a side of body q. Returns false if it has none. */
static bool find_spoke(const sunder_i_model *model, const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece,
                       uint32_t q, const double u[2], spoke *s)
{
    const double *a = model->side_at + 2 * (size_t)anchor->feature;
    const double *c = piece->corner, *origin = model->body[q].origin;
    for (int k = 0; k < 2; k++) {
        const double end[2] = {c[2 * k] + origin[0], c[2 * k + 1] + origin[1]};
        if (!is_beside(a, end, u)) continue;
        const sunder_i_side *side = side_of_piece(model, piece);
        if (!side || (side->area && side->area->rational)) return false;
        *s = (spoke){anchor, piece, q, side, k ? side->to : side->from, k ? side->from : side->to};
        return true;
    }
    return false;
}

/* Does the chord across the ends of two spokes exclude the move u of body p? Sets *chord, and the number
 * *half_planes of its half-planes, which are in scratch. */
static bool shuts_move(sunder_i_branching *c, uint32_t p, const spoke *s, const spoke *r, const double u[2],
                       sunder_i_chord *chord, size_t *half_planes)
{
    const sunder_i_model *model = c->model;
    const double *a = model->side_at + 2 * (size_t)s->anchor->feature;
    const double *const end[2] = {s->end, r->end}, *const other[2] = {s->other, r->other};
    if (s->anchor != r->anchor || !make_side_chord(a, end, other, chord->at)) return false;
    chord->side[0] = s->side;
    chord->side[1] = r->side;
    *half_planes = sunder_i_branching_chord_half_planes(c, &model->body[p], s->anchor, &model->body[s->q], chord->at);
    return !c->failed && sunder_i_branching_depth(c, *half_planes, u) > 0;
}

/* Adds the spoke behind the *n that there are. Returns the first one that shuts the move together with it, or NULL. */
static const spoke *add_spoke(sunder_i_branching *c, uint32_t p, spoke spokes[SPOKES], size_t *n, const double u[2],
                              sunder_i_chord *chord, size_t *half_planes)
{
    const spoke *last = &spokes[(*n)++];
    for (const spoke *s = spokes; s < last && !c->failed; s++)
        if (shuts_move(c, p, s, last, u, chord, half_planes)) return s;
    return NULL;
}

/* ---- Chords in the plane of one relative move -------------------------------------------------------------------- */

const sunder_i_plane_obstacle *sunder_i_plane_find_chord(sunder_i_plane *plane, const double u[2],
                                                         sunder_i_chord *chord, size_t *half_planes)
{
    const struct sunder_i_plane_kept *kept = plane->kept;
    const sunder_i_model *model = plane->c->model;
    const sunder_i_plane_obstacle *of[SPOKES];
    spoke spokes[SPOKES];
    size_t n = 0;
    plane->c->looked += plane->obstacles;
    for (size_t r = 0; r < plane->runs; r++) {
        const sunder_i_plane_run *run = &kept->run[plane->run[r]];
        if (!run->side) continue;
        for (size_t k = run->first; k < run->end && n < SPOKES; k++) {
            const sunder_i_plane_obstacle *o = &kept->obstacle[k];
            if (kept->box[4 * k] > kept->box[4 * k + 2] || !o->shadow ||
                !sunder_i_is_barrier_body(model, &model->body[o->q]) ||
                !find_spoke(model, o->a, o->b, o->q, u, &spokes[n]))
                continue;
            of[n] = o;
            const spoke *first = add_spoke(plane->c, plane->p, spokes, &n, u, chord, half_planes);
            if (first) return of[first - spokes];
        }
    }
    return NULL;
}

/* ---- Chords for a candidate -------------------------------------------------------------------------------------- */

/* Adds the spokes among the sides of a part that the anchor of body p may not cross. Returns as add_spoke(). */
static const spoke *look_at_sides(sunder_i_branching *c, uint32_t p, const sunder_i_body_piece *anchor, uint32_t part,
                                  const double u[2], spoke spokes[SPOKES], size_t *n)
{
    const sunder_i_model *model = c->model;
    const uint32_t q = model->body_of[part];
    const sunder_i_extras *has = model->body[q].has;
    const spoke *first = NULL;
    size_t half_planes;
    for (uint32_t l = has->side; l < has->side + has->sides && !first && *n < SPOKES && !c->failed; l++)
        if (sunder_i_branching_shades(c, anchor->feature, part) &&
            sunder_i_side_faces(model, &model->side[l], anchor->feature) &&
            find_spoke(model, anchor, &model->side[l].piece, q, u, &spokes[*n]))
            first = add_spoke(c, p, spokes, n, u, &c->across, &half_planes);
    return first;
}

/* Adds the spokes along the way of the anchor, which moves by -u. Returns as add_spoke(). */
static const spoke *find_spokes(sunder_i_branching *c, uint32_t p, const sunder_i_body_piece *anchor, const double u[2],
                                spoke spokes[SPOKES])
{
    const double *a = c->model->side_at + 2 * (size_t)anchor->feature, end[2] = {a[0] - u[0], a[1] - u[1]};
    const spoke *first = NULL;
    double box[4];
    size_t n = 0;
    c->near.n = 0;
    sunder_i_box_of_segment(a, end, box);
    if (!sunder_i_look_about(c->model, &c->model->tree, box, &c->near)) c->failed = true;
    c->near.n = sunder_i_set_make(c->near.item, c->near.n);
    for (size_t k = 0; k < c->near.n && !first && !c->failed; k++)
        if (sunder_i_is_barrier(c->model, c->near.item[k]))
            first = look_at_sides(c, p, anchor, c->near.item[k], u, spokes, &n);
    return first;
}

bool sunder_i_branching_find_chord(sunder_i_branching *branching, sunder_i_violation *violation)
{
    const sunder_i_model *model = branching->model;
    spoke spokes[SPOKES];
    for (uint32_t i = 0; i < branching->bodies && model->sides && !branching->subproblem->ignore_paths; i++) {
        const uint32_t p = branching->body[i];
        if (p == SUNDER_I_NOBODY) continue;
        const double u[2] = {-branching->t[2 * i], -branching->t[2 * i + 1]};
        for (uint32_t m = 0; m < model->body[p].members && !branching->failed; m++) {
            const sunder_i_body_piece *anchor = &model->side_anchor[model->member[model->body[p].member + m]];
            const spoke *s = anchor->corners ? find_spokes(branching, p, anchor, u, spokes) : NULL;
            if (!s) continue;
            *violation = (sunder_i_violation){.p = p,
                                              .q = s->q,
                                              .a = s->anchor,
                                              .b = s->piece,
                                              .shadow = true,
                                              .known = true,
                                              .chord = &branching->across};
            return true;
        }
    }
    return false;
}
