/* Chords in proofs: a chord joins points of two sides of barriers, and a move that passes between the two sides crosses
 * it (geometry/side_chord.c). It is drawn across a corner that the two sides share, or across ends of the two that lie
 * on one ray from the anchor. A side is called a spoke here if the anchor's path passes one of its ends. */
#include "displacement/geometry/side_chord.h"
#include "displacement/geometry/tuning.h"
#include "displacement/prove/proofs/plane.h"
#include "displacement/prove/proofs/tuning.h"

#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"

/* Returns the side of a barrier that has this piece. */
static const sunder_i_side *side_of_piece(const sunder_i_model *model, const sunder_i_body_piece *piece)
{
    const sunder_i_body *of = &model->body[model->body_of[piece->feature]];
    for (uint32_t k = of->has->side; k < of->has->side + of->has->sides; k++)
        if (piece == &model->side[k].piece) return &model->side[k];
    return NULL;
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

/* Finds the spoke of a piece that is a side of body q. Returns false if it has none. */
static bool find_spoke(const sunder_i_model *model, const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece,
                       uint32_t q, const double u[2], spoke *s)
{
    const double *a = model->side_at + 2 * (size_t)anchor->feature;
    const double *c = piece->corner, *origin = model->body[q].origin;
    for (int k = 0; k < 2; k++) {
        const double end[2] = {c[2 * k] + origin[0], c[2 * k + 1] + origin[1]};
        if (!sunder_i_passes_end(a, end, u)) continue;
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
    if (s->anchor != r->anchor || !sunder_i_side_chord(a, end, other, CHORD, chord->at)) return false;
    chord->side[0] = s->side;
    chord->side[1] = r->side;
    *half_planes = sunder_i_branching_chord_half_planes(c, &model->body[p], s->anchor, &model->body[s->q], chord->at);
    return !c->failed && sunder_i_branching_depth(c, *half_planes, u) > 0;
}

/* Counts spokes[*n] as a spoke, which the caller has filled in. Returns the first earlier one whose chord with it
 * excludes the move u, or NULL. */
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

/* Adds the spokes among the sides of a part that the anchor of body p may not cross. Returns what add_spoke() returned
 * last, or NULL. */
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

/* Adds the spokes along the path of the anchor, which moves by -u. Returns what add_spoke() returned last. */
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
