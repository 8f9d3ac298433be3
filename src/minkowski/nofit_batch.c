/* nofit_batch.c: no-fit polygons of many pairs of rotated parts.
 *
 * Each different piece of work is done once. Parts with the same rings, and rotations with the same numbers, get the
 * number of the first of them. A task is then a pair of copies; a copy is a part with a rotation, and the moving one is
 * reflected. Both are numbered in the order of their first appearance, by hash tables. Copies are made first and sums
 * then, each in parallel, and stored by number, so that the number of threads has no effect.
 *
 * Rational rotations make coordinates with denominators. Both copies of a task are multiplied by the least common
 * multiple of the two denominators, which makes all coordinates integers times those of the parts. Doubles hold them,
 * unless these are long. The sum is then that of the parts times this number. If doubles do not hold a copy exactly,
 * the task is done with rounded copies, in the scale 1. */
#include "minkowski/rotated_copies.h"

#include "base/memory.h"
#include "base/mix.h"
#include "base/parallel.h"
#include "base/sized_struct.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* A copy of a part: cosine and sine are those of its rotation, times the factor, negative for a reflected one. */
typedef struct copy {
    uint32_t part;
    double cosine, sine;
    bool divided;              /* these are quotients that were rounded */
    const sunder_shape *shape; /* NULL: not made yet; the part itself, or ... */
    sunder_shape *made;        /* ... this copy */
    bool exact;
} copy;

typedef struct task {
    uint32_t fixed, moving; /* numbers of copies */
    double scale;
    bool exact;
    sunder_sum *sum;
} task;

struct sunder_nofits {
    copy *copy;
    task *task;
    uint32_t *result; /* [pairs] the task of each pair */
    size_t copies, tasks, pairs, copy_capacity, task_capacity;
};

/* A table of numbers + 1, by hashes; the number of slots is a power of two, at least twice that of the entries. */
typedef struct table {
    uint32_t *slot;
    size_t slots;
} table;

/* What a batch works on. */
typedef struct batch {
    const sunder_shape *const *part;
    const sunder_rotation *rotation;
    uint32_t *same_part, *same_rotation; /* the first part with the same rings, and so on */
    bool *rational;                      /* [rotations] */
    size_t parts, rotations;
    table copies, tasks;
    sunder_nofits *out;
} batch;

/* ---- Equal parts and rotations ----------------------------------------------------------------------------------- */

static bool table_init(table *t, size_t entries)
{
    t->slots = 16;
    while (t->slots < 2 * entries) t->slots *= 2;
    t->slot = sunder_i_calloc(t->slots, sizeof *t->slot);
    return t->slot != NULL;
}

static uint64_t hash_shape(const sunder_shape *shape)
{
    const double *xy;
    const size_t *ring_end, *poly_end, polygons = sunder_shape_given(shape, &xy, &ring_end, &poly_end),
                                       rings = polygons ? poly_end[polygons - 1] : 0;
    uint64_t hash = (uint64_t)rings;
    for (size_t k = 0; rings && k < 2 * ring_end[rings - 1]; k++) hash = sunder_i_mix(hash, xy[k]);
    return hash;
}

/* Have the two shapes the same rings, bit by bit? */
static bool equal_shapes(const sunder_shape *a, const sunder_shape *b)
{
    const double *xy[2];
    const size_t *ring_end[2], *poly_end[2], polygons = sunder_shape_given(a, &xy[0], &ring_end[0], &poly_end[0]);
    if (polygons != sunder_shape_given(b, &xy[1], &ring_end[1], &poly_end[1]) ||
        sunder_shape_repaired(a) != sunder_shape_repaired(b))
        return false;
    const size_t rings = polygons ? poly_end[0][polygons - 1] : 0, n = rings ? ring_end[0][rings - 1] : 0;
    return polygons == 0 || (memcmp(poly_end[0], poly_end[1], polygons * sizeof **poly_end) == 0 &&
                             memcmp(ring_end[0], ring_end[1], rings * sizeof **ring_end) == 0 &&
                             memcmp(xy[0], xy[1], 2 * n * sizeof **xy) == 0);
}

static bool find_same_parts(batch *b)
{
    table seen;
    if (!table_init(&seen, b->parts)) return false;
    for (size_t i = 0; i < b->parts; i++) {
        size_t at = hash_shape(b->part[i]) & (seen.slots - 1);
        while (seen.slot[at] && !equal_shapes(b->part[seen.slot[at] - 1], b->part[i])) at = (at + 1) & (seen.slots - 1);
        if (!seen.slot[at]) seen.slot[at] = (uint32_t)i + 1;
        b->same_part[i] = seen.slot[at] - 1;
    }
    sunder_i_free(seen.slot);
    return true;
}

static bool find_same_rotations(batch *b)
{
    table seen;
    if (!table_init(&seen, b->rotations)) return false;
    for (size_t i = 0; i < b->rotations; i++) {
        const sunder_rotation *r = &b->rotation[i];
        size_t at = sunder_i_mix(sunder_i_mix(sunder_i_mix(0, r->cosine), r->sine), r->scale) & (seen.slots - 1);
        while (seen.slot[at] && memcmp(&b->rotation[seen.slot[at] - 1], r, sizeof *r) != 0)
            at = (at + 1) & (seen.slots - 1);
        if (!seen.slot[at]) seen.slot[at] = (uint32_t)i + 1;
        b->same_rotation[i] = seen.slot[at] - 1;
        b->rational[i] = sunder_i_rotation_is_rational(r);
    }
    sunder_i_free(seen.slot);
    return true;
}

/* ---- Copies and tasks -------------------------------------------------------------------------------------------- */

static uint64_t hash_copy(uint32_t part, double cosine, double sine)
{
    return sunder_i_mix(sunder_i_mix((uint64_t)part + 1, cosine), sine);
}

/* Sets *number to the copy, which is added if it is new. */
static bool number_copy(batch *b, uint32_t part, double cosine, double sine, bool divided, uint32_t *number)
{
    sunder_nofits *out = b->out;
    size_t at = hash_copy(part, cosine, sine) & (b->copies.slots - 1);
    for (; b->copies.slot[at]; at = (at + 1) & (b->copies.slots - 1)) {
        const copy *c = &out->copy[b->copies.slot[at] - 1];
        if (c->part == part && c->cosine == cosine && c->sine == sine && c->divided == divided) break;
    }
    if (!b->copies.slot[at]) {
        if (!sunder_i_reserve(&out->copy, &out->copy_capacity, out->copies + 1, sizeof *out->copy)) return false;
        out->copy[out->copies++] = (copy){.part = part, .cosine = cosine, .sine = sine, .divided = divided};
        b->copies.slot[at] = (uint32_t)out->copies;
    }
    *number = b->copies.slot[at] - 1;
    return true;
}

static double gcd(double a, double b)
{
    while (b != 0) {
        const double rest = fmod(a, b);
        a = b;
        b = rest;
    }
    return a;
}

/* The copies of a question: both in the scale of the task, the moving one reflected. */
static bool number_copies(batch *b, const sunder_nofit *asked, bool rounded, task *t)
{
    const uint32_t of[2] = {b->same_rotation[asked->fixed_rotation], b->same_rotation[asked->moving_rotation]};
    const uint32_t part[2] = {b->same_part[asked->fixed], b->same_part[asked->moving]};
    const sunder_rotation *r[2] = {&b->rotation[of[0]], &b->rotation[of[1]]};
    double d[2];
    for (int k = 0; k < 2; k++) d[k] = b->rational[of[k]] && !rounded ? r[k]->scale : 1;
    t->scale = d[0] / gcd(d[0], d[1]) * d[1];
    uint32_t *const number[2] = {&t->fixed, &t->moving};
    for (int k = 0; k < 2; k++) {
        const bool whole = b->rational[of[k]] && !rounded;
        const double factor = (whole ? t->scale / d[k] : t->scale) * (k ? -1 : 1), by = whole ? 1 : r[k]->scale;
        const double c = r[k]->cosine * factor / by, s = r[k]->sine * factor / by;
        const bool divided = fma(c, by, -r[k]->cosine * factor) != 0 || fma(s, by, -r[k]->sine * factor) != 0;
        /* + 0: no negative zero, which has another hash */
        if (!number_copy(b, part[k], c + 0, s + 0, divided, number[k])) return false;
    }
    return true;
}

static bool number_task(batch *b, const task *t, uint32_t *number)
{
    sunder_nofits *out = b->out;
    const uint64_t hash = sunder_i_mix(((uint64_t)t->fixed << 32 | t->moving) + 1, t->scale);
    size_t at = hash & (b->tasks.slots - 1);
    for (; b->tasks.slot[at]; at = (at + 1) & (b->tasks.slots - 1)) {
        const task *held = &out->task[b->tasks.slot[at] - 1];
        if (held->fixed == t->fixed && held->moving == t->moving && held->scale == t->scale) break;
    }
    if (!b->tasks.slot[at]) {
        if (!sunder_i_reserve(&out->task, &out->task_capacity, out->tasks + 1, sizeof *out->task)) return false;
        out->task[out->tasks++] = *t;
        b->tasks.slot[at] = (uint32_t)out->tasks;
    }
    *number = b->tasks.slot[at] - 1;
    return true;
}

/* Makes the copies first ... of the batch, up to the last. */
static sunder_status make_copies(void *context, size_t begin, size_t end, sunder_error *err)
{
    batch *b = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; status == SUNDER_OK && k < end; k++) {
        copy *c = &b->out->copy[k];
        if (c->shape) continue;
        c->exact = true;
        if (c->sine == 0 && c->cosine == 1) {
            c->shape = b->part[c->part];
            continue;
        }
        status = c->sine == 0 && c->cosine == -1
                     ? sunder_shape_reflect(b->part[c->part], &c->made, err)
                     : sunder_i_rotated_copy(b->part[c->part], c->cosine, c->sine, &c->made, &c->exact, err);
        c->shape = c->made;
        c->exact = c->exact && !c->divided;
    }
    return status;
}

/* Numbers the tasks of all pairs and makes their copies; those that doubles do not hold are replaced by copies in the
 * scale 1, rounded. */
static sunder_status prepare(batch *b, const sunder_nofit *pair, unsigned threads, sunder_error *err)
{
    sunder_nofits *out = b->out;
    for (size_t i = 0; i < out->pairs; i++) {
        task t = {0};
        if (!number_copies(b, &pair[i], false, &t) || !number_task(b, &t, &out->result[i]))
            return sunder_i_failure_cause(err);
    }
    sunder_status status = sunder_i_parallel(threads, out->copies, SUNDER_I_GRAIN_SHAPES, make_copies, b, err);
    if (status != SUNDER_OK) return status;
    for (size_t i = 0; i < out->pairs; i++) {
        task t = out->task[out->result[i]];
        if (out->copy[t.fixed].exact && out->copy[t.moving].exact) continue;
        if (!number_copies(b, &pair[i], true, &t) || !number_task(b, &t, &out->result[i]))
            return sunder_i_failure_cause(err);
    }
    return sunder_i_parallel(threads, out->copies, SUNDER_I_GRAIN_SHAPES, make_copies, b, err);
}

/* Drops tasks that no pair has any more, and renumbers the others. */
static bool drop_unused(sunder_nofits *out)
{
    uint32_t *number = sunder_i_calloc(out->tasks, sizeof *number);
    if (!number) return false;
    for (size_t i = 0; i < out->pairs; i++) number[out->result[i]] = 1;
    size_t kept = 0;
    for (size_t k = 0; k < out->tasks; k++) {
        if (!number[k]) continue;
        out->task[kept] = out->task[k];
        number[k] = (uint32_t)kept++;
    }
    for (size_t i = 0; i < out->pairs; i++) out->result[i] = number[out->result[i]];
    out->tasks = kept;
    sunder_i_free(number);
    return true;
}

static sunder_status add_tasks(void *context, size_t begin, size_t end, sunder_error *err)
{
    batch *b = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; status == SUNDER_OK && k < end; k++) {
        task *t = &b->out->task[k];
        const copy *fixed = &b->out->copy[t->fixed], *moving = &b->out->copy[t->moving];
        t->exact = fixed->exact && moving->exact;
        status = sunder_minkowski_sum(fixed->shape, moving->shape, NULL, &t->sum, err);
    }
    return status;
}

/* ---- The call ---------------------------------------------------------------------------------------------------- */

static sunder_status check_arguments(const batch *b, const sunder_nofit *pair, size_t pairs, sunder_error *err)
{
    if (b->parts > UINT32_MAX || b->rotations > UINT32_MAX || pairs > UINT32_MAX)
        return sunder_i_fail(err, SUNDER_ESIZE, "there are more parts, rotations or pairs than can be numbered");
    for (size_t i = 0; i < b->rotations; i++) {
        const sunder_rotation *r = &b->rotation[i];
        if (!isfinite(r->cosine) || !isfinite(r->sine) || !isfinite(r->scale) || !(r->scale > 0))
            return sunder_i_fail(err, SUNDER_EARG,
                                 "rotation %zu: its numbers are not finite, or its scale is not above 0", i);
    }
    for (size_t i = 0; i < pairs; i++)
        if (pair[i].fixed >= b->parts || pair[i].moving >= b->parts || pair[i].fixed_rotation >= b->rotations ||
            pair[i].moving_rotation >= b->rotations)
            return sunder_i_fail(err, SUNDER_EARG, "pair %zu: there is no such part or rotation", i);
    return SUNDER_OK;
}

static sunder_status run_batch(batch *b, const sunder_nofit *pair, unsigned threads, sunder_error *err)
{
    sunder_nofits *out = b->out;
    out->result = sunder_i_calloc(out->pairs, sizeof *out->result);
    b->same_part = sunder_i_calloc(b->parts, sizeof *b->same_part);
    b->same_rotation = sunder_i_calloc(b->rotations, sizeof *b->same_rotation);
    b->rational = sunder_i_calloc(b->rotations, sizeof *b->rational);
    /* A pair has at most two copies and one task, and as many again if these are rounded. */
    if (!out->result || !b->same_part || !b->same_rotation || !b->rational || !find_same_parts(b) ||
        !find_same_rotations(b) || !table_init(&b->copies, 4 * out->pairs) || !table_init(&b->tasks, 2 * out->pairs))
        return sunder_i_failure_cause(err);
    sunder_status status = prepare(b, pair, threads, err);
    if (status == SUNDER_OK && !drop_unused(out)) status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK) status = sunder_i_parallel(threads, out->tasks, SUNDER_I_GRAIN_SHAPES, add_tasks, b, err);
    return status;
}

sunder_status sunder_nofit_batch(const sunder_shape *const *part, size_t parts, const sunder_rotation *rotation,
                                 size_t rotations, const sunder_nofit *pair, size_t pairs,
                                 const sunder_sum_options *options, sunder_nofits **out, sunder_error *err)
{
    sunder_sum_options o = {.size = sizeof o};
    batch b = {.part = part, .rotation = rotation, .parts = parts, .rotations = rotations};
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status == SUNDER_OK) status = check_arguments(&b, pair, pairs, err);
    if (status != SUNDER_OK) return status;
    b.out = sunder_i_calloc(1, sizeof *b.out);
    if (!b.out) return sunder_i_failure_cause(err);
    b.out->pairs = pairs;
    sunder_i_watch watch;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    status = run_batch(&b, pair, o.threads ? o.threads : 1, err);
    sunder_i_watch_end(&watch);
    sunder_i_free_all(b.same_part, b.same_rotation, b.rational, b.copies.slot, b.tasks.slot);
    if (status == SUNDER_OK)
        *out = b.out;
    else
        sunder_nofits_free(b.out);
    return status;
}

void sunder_nofits_free(sunder_nofits *nofits)
{
    if (!nofits) return;
    for (size_t k = 0; k < nofits->copies; k++) sunder_shape_free(nofits->copy[k].made);
    for (size_t k = 0; k < nofits->tasks; k++) sunder_sum_free(nofits->task[k].sum);
    sunder_i_free_all(nofits->copy, nofits->task, nofits->result, nofits);
}

size_t sunder_nofits_distinct(const sunder_nofits *nofits) { return nofits->tasks; }

size_t sunder_nofits_result(const sunder_nofits *nofits, size_t pair) { return nofits->result[pair]; }

const sunder_sum *sunder_nofits_sum(const sunder_nofits *nofits, size_t result, double *scale, bool *exact)
{
    *scale = nofits->task[result].scale;
    *exact = nofits->task[result].exact;
    return nofits->task[result].sum;
}
