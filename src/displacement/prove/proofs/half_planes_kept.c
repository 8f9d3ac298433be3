/* A cache of the half-planes between two pieces that are not made for a particular place. They are the same for every
 * candidate of a tree, and are needed in hundreds of thousands of its nodes. Consecutive questions about one model
 * share them, also if their gaps differ. The cache is a table of sets of SLOTS slots; a hash chooses the set, and if
 * all its slots are taken another pair is evicted from one. Most trees meet a dozen pairs, a few meet thousands, so
 * the table begins small and doubles when half of its slots are taken. The cache only saves time: the half-planes are
 * the same, and their cost is counted the same. */
#include "displacement/prove/proofs/branching.h"
#include "displacement/prove/proofs/exact_line.h"
#include "displacement/prove/proofs/tuning.h"

#include "base/extremes.h"
#include "base/stage_switch.h"

#include <math.h>
#include <string.h>

/* Are the corners of feature f known only as rounded doubles, or moved because they are far? */
static bool is_vague(const sunder_i_model *model, uint32_t f)
{
    return sunder_i_thing_shape(model, f)->rational || model->body[model->body_of[f]].far;
}

/* Returns the distance by which half-planes between pieces of these bodies may demand less. */
static double coarse_for(const sunder_i_branching *c, const sunder_i_body *p, const sunder_i_body *q)
{
    const double reach = sunder_i_branching_limit(c, p) + sunder_i_branching_limit(c, q);
    return isfinite(reach) ? c->subproblem->coarse * reach : 0;
}

/* Are the corners of the piece, relative to the origin of its body, the corners as given without a rounding error? */
static bool is_exact(const sunder_i_model *model, const sunder_i_body *body, const sunder_i_body_piece *piece)
{
    double given[2 * WALL_CORNERS], d;
    if (is_vague(model, piece->feature) || piece->corners > WALL_CORNERS) return false;
    sunder_i_piece_as_given(model, piece, given);
    for (size_t k = 0; k < 2 * piece->corners; k++)
        if (!sunder_i_subtract_exactly(given[k], body->origin[k & 1], &d) || d != piece->corner[k]) return false;
    return true;
}

/* Are all differences of corners of the two known exactly, if that is asked for? */
static bool are_exact(const sunder_i_branching *c, const sunder_i_body *p, const sunder_i_body_piece *a,
                      const sunder_i_body *q, const sunder_i_body_piece *b)
{
    double d;
    return c->subproblem->exact && sunder_i_subtract_exactly(q->origin[0], p->origin[0], &d) &&
           sunder_i_subtract_exactly(q->origin[1], p->origin[1], &d) && is_exact(c->model, p, a) &&
           is_exact(c->model, q, b);
}

size_t sunder_i_branching_fill_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                           const sunder_i_body_piece *a, const sunder_i_body *q,
                                           const sunder_i_body_piece *b, double clearance, bool shadow,
                                           const double *at)
{
    const sunder_i_model *model = branching->model;
    sunder_i_parting parting = {.a = a->corner,
                                .b = b->corner,
                                .na = a->corners,
                                .nb = b->corners,
                                .offset = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]},
                                .clearance = clearance,
                                .at = at,
                                .coarse = coarse_for(branching, p, q),
                                .exact = are_exact(branching, p, a, q, b)};
    for (int x = 0; x < 4; x++) {
        if (is_vague(model, a->feature)) parting.vague += fabs(p->origin[x & 1]) + fabs(a->box[x]);
        if (is_vague(model, b->feature)) parting.vague += fabs(q->origin[x & 1]) + fabs(b->box[x]);
    }
    const size_t most = SUNDER_I_HALF_PLANES_A_CORNER * (parting.na + parting.nb) + SUNDER_I_HALF_PLANES_MORE;
    branching->looked += parting.na + parting.nb;
    if (!sunder_i_reserve(&branching->scratch, &branching->scratch_capacity, most, sizeof *branching->scratch)) {
        branching->failed = true;
        return 0;
    }
    return shadow ? sunder_i_half_planes_past(&parting, branching->scratch)
                  : sunder_i_half_planes_between(&parting, branching->scratch);
}

/* The half-planes of one pair of pieces, or an empty slot. */
typedef struct slot {
    const sunder_i_body_piece *a, *b; /* NULL: the slot is empty */
    double clearance, coarse;
    bool shadow;
    sunder_i_half_plane *half_plane;
    size_t n, capacity;
} slot;

enum { SLOT_BITS = 2, SLOTS = 1 << SLOT_BITS }; /* the slots of a set */

struct sunder_i_half_planes_kept {
    slot *slot; /* [2^bits]: the sets, one after the other */
    size_t taken;
    int bits;
};

/* Hashes what the piece is, not its address, which differs in every run. */
static uint64_t hash_piece(const sunder_i_body_piece *piece)
{
    uint64_t bits[4], mixed = piece->feature;
    memcpy(bits, piece->box, sizeof bits);
    for (int c = 0; c < 4; c++) mixed = mixed * UINT64_C(0x9e3779b97f4a7c15) + (bits[c] ^ bits[c] >> 32);
    return mixed;
}

static uint64_t hash_pair(const sunder_i_body_piece *a, const sunder_i_body_piece *b)
{
    const uint64_t hash = hash_piece(a), mixed = (hash ^ hash >> 29) * UINT64_C(0x9e3779b97f4a7c15) + hash_piece(b);
    return mixed * UINT64_C(0xd1342543de82ef95);
}

/* Returns the slot that holds a pair of pieces; if none does, an empty slot of its set, or one to evict. */
static slot *slot_of(const struct sunder_i_half_planes_kept *kept, const sunder_i_body_piece *a,
                     const sunder_i_body_piece *b)
{
    const uint64_t hash = hash_pair(a, b);
    slot *set = kept->slot + (hash >> (64 - kept->bits + SLOT_BITS)) * SLOTS;
    for (size_t k = 0; k < SLOTS; k++)
        if (!set[k].a || (set[k].a == a && set[k].b == b)) return &set[k];
    return &set[hash % SLOTS];
}

/* Makes an empty cache; returns NULL if memory is out. */
static struct sunder_i_half_planes_kept *new_cache(void)
{
    struct sunder_i_half_planes_kept *kept = sunder_i_calloc(1, sizeof *kept);
    if (!kept) return NULL;
    kept->bits = WAYS_KEPT_BITS;
    kept->slot = sunder_i_calloc((size_t)1 << kept->bits, sizeof *kept->slot);
    if (kept->slot) return kept;
    sunder_i_free(kept);
    return NULL;
}

void sunder_i_half_planes_forget(struct sunder_i_half_planes_kept **kept)
{
    if (!*kept) return;
    for (size_t k = 0; k < (size_t)1 << (*kept)->bits; k++) sunder_i_free((*kept)->slot[k].half_plane);
    sunder_i_free_all((*kept)->slot, *kept);
    *kept = NULL;
}

/* Doubles the table. Leading bits of a hash choose a set, so the pairs of one set go to two new sets that no others go
 * to. Returns false if memory is out. */
static bool double_slots(struct sunder_i_half_planes_kept *kept)
{
    const struct sunder_i_half_planes_kept old = *kept;
    slot *wider = sunder_i_calloc((size_t)2 << old.bits, sizeof *wider);
    if (!wider) return false;
    kept->slot = wider;
    kept->bits++;
    for (size_t k = 0; k < (size_t)1 << old.bits; k++)
        if (old.slot[k].a)
            *slot_of(kept, old.slot[k].a, old.slot[k].b) = old.slot[k];
        else
            sunder_i_free(old.slot[k].half_plane);
    sunder_i_free(old.slot);
    return true;
}

/* Returns the slot for a pair of pieces, empty or not; NULL if memory is out. */
static slot *find_slot(struct sunder_i_half_planes_kept **kept, const sunder_i_body_piece *a,
                       const sunder_i_body_piece *b)
{
    if (!*kept) *kept = new_cache();
    if (!*kept) return NULL;
    const bool full = (*kept)->taken > (size_t)1 << ((*kept)->bits - 1) && (*kept)->bits < WAYS_MOST_BITS;
    if (full && !double_slots(*kept)) return NULL;
    slot *here = slot_of(*kept, a, b);
    (*kept)->taken += !here->a;
    return here;
}

/* Computes the half-planes and stores them in this slot. Returns false if memory is out. */
static bool keep_half_planes(sunder_i_branching *c, slot *here, const sunder_i_body *p, const sunder_i_body *q,
                             const slot *asked)
{
    here->a = NULL;
    here->n = sunder_i_branching_fill_half_planes(c, p, asked->a, q, asked->b, asked->clearance, asked->shadow, NULL);
    if (c->failed || !sunder_i_reserve(&here->half_plane, &here->capacity, here->n, sizeof *here->half_plane))
        return false;
    if (here->n) memcpy(here->half_plane, c->scratch, here->n * sizeof *here->half_plane);
    here->a = asked->a;
    here->b = asked->b;
    here->clearance = asked->clearance;
    here->coarse = asked->coarse;
    here->shadow = asked->shadow;
    return true;
}

/* Are the half-planes in this slot those that are asked for, apart from the amount of the clearance? With `exact` it
 * has to be the same, since lines without a rounding error are not moved. */
static bool is_kept(const slot *here, const slot *asked, bool exact)
{
    if (exact && here->clearance != asked->clearance) return false;
    return here->a == asked->a && here->b == asked->b && here->shadow == asked->shadow &&
           here->coarse == asked->coarse && (here->clearance > 0) == (asked->clearance > 0) &&
           (here->clearance < 0) == (asked->clearance < 0) && sunder_i_stage_is_on("memo", "half planes");
}

static void set_clearance(slot *here, double clearance)
{
    if (here->clearance == clearance) return;
    for (size_t k = 0; k < here->n; k++)
        here->half_plane[k].d = here->half_plane[k].base + here->half_plane[k].by * clearance;
    here->clearance = clearance;
}

const sunder_i_half_plane *sunder_i_branching_kept_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                                               const sunder_i_body_piece *a, const sunder_i_body *q,
                                                               const sunder_i_body_piece *b, double clearance,
                                                               bool shadow, size_t *n)
{
    const sunder_i_subproblem *subproblem = branching->subproblem;
    struct sunder_i_half_planes_kept **kept = subproblem->planes ? &subproblem->planes->half_planes : &branching->kept;
    const slot asked = {
        .a = a, .b = b, .clearance = clearance, .coarse = coarse_for(branching, p, q), .shadow = shadow};
    *n = 0;
    slot *here = find_slot(kept, a, b);
    if (here && is_kept(here, &asked, subproblem->exact)) {
        branching->looked += a->corners + b->corners;
        set_clearance(here, clearance);
    } else if (!here || !keep_half_planes(branching, here, p, q, &asked)) {
        branching->failed = true;
        return NULL;
    }
    *n = here->n;
    return here->half_plane;
}

size_t sunder_i_branching_take_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                           const sunder_i_body_piece *a, const sunder_i_body *q,
                                           const sunder_i_body_piece *b, double clearance, bool shadow)
{
    sunder_i_branching *c = branching;
    size_t n;
    const sunder_i_half_plane *half_plane = sunder_i_branching_kept_half_planes(c, p, a, q, b, clearance, shadow, &n);
    if (n && !sunder_i_reserve(&c->scratch, &c->scratch_capacity, n, sizeof *c->scratch)) c->failed = true;
    if (n && !c->failed) memcpy(c->scratch, half_plane, n * sizeof *half_plane);
    return c->failed ? 0 : n;
}

double sunder_i_branching_depth(const sunder_i_branching *branching, size_t half_planes, const double u[2])
{
    double at = -INFINITY;
    for (size_t k = 0; k < half_planes; k++) {
        sunder_i_half_plane *w = &branching->scratch[k];
        w->at = w->n[0] * u[0] + w->n[1] * u[1] - w->d;
        at = sunder_i_max(at, w->at);
    }
    return half_planes ? -at : -INFINITY;
}
