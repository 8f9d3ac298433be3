#include "minkowski/lines.h"

#include "predicate/kernel.h"
#include "predicate/wide_vector.h"

#include <string.h>

/* A line is its class and the cross product of the class's direction with any of its points: equal exactly for
 * points of one line. */
typedef struct key {
    sunder_i_i128 offset; /* the number itself, or on a wide lattice a handle */
    uint32_t class, hash;
} key;

typedef struct table {
    const sunder_i_subsums *subsums;
    uint32_t *slot; /* line number + 1, or 0 */
    size_t mask;
    key *keys; /* [lines] */
} table;

static uint64_t mix(uint64_t h, uint64_t v)
{
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 29;
}

static key make_key(const sunder_i_subsums *s, uint32_t side)
{
    const uint32_t rank = s->rank[side];
    key k = {0, rank < s->classes ? rank : rank - s->classes, 0};
    const sunder_i_point d = s->direction[k.class], a = s->corner[side];
    uint64_t hash = mix(0, k.class);
    if (s->lattice->narrow) {
        k.offset = sunder_i_narrow_cross(d, a);
        hash = mix(mix(hash, (uint64_t)k.offset), (uint64_t)(k.offset >> 64));
        k.hash = (uint32_t)(hash >> 32);
        return k;
    }
    const sunder_i_big v =
        sunder_i_wide_cross(s->lattice, sunder_i_wide_get(s->lattice, d), sunder_i_wide_get(s->lattice, a));
    k.offset = sunder_i_lattice_big(s->lattice, v);
    for (long i = 0; i < (v.size < 0 ? -v.size : v.size); i++) hash = mix(hash, v.limb[i]);
    k.hash = (uint32_t)(hash >> 32);
    return k;
}

static bool same_line(const sunder_i_subsums *s, const key *a, const key *b)
{
    if (a->hash != b->hash || a->class != b->class) return false;
    if (s->lattice->narrow) return a->offset == b->offset;
    return sunder_i_int_cmp(s->lattice, (int64_t)a->offset, (int64_t)b->offset) == 0;
}

/* The number of the line of a side, made if it is new. */
static uint32_t find_or_add(table *t, uint32_t side, sunder_i_lines *out)
{
    const sunder_i_subsums *s = t->subsums;
    const key k = make_key(s, side);
    size_t at = k.hash & t->mask;
    for (; t->slot[at]; at = (at + 1) & t->mask)
        if (same_line(s, &t->keys[t->slot[at] - 1], &k)) return t->slot[at] - 1;
    const uint32_t n = out->n++;
    t->slot[at] = n + 1;
    t->keys[n] = k;
    const sunder_i_point a = s->corner[side], d = s->direction[k.class];
    out->line[n] = (sunder_i_line){
        a, s->lattice->narrow ? (sunder_i_point){a.x + d.x, a.y + d.y} : sunder_i_point_add(s->lattice, a, d), k.class};
    return n;
}

sunder_status sunder_i_lines_group(const sunder_i_subsums *subsums, sunder_i_lines *out, sunder_error *err)
{
    size_t n = 0, size = 16;
    memset(out, 0, sizeof *out);
    for (size_t k = 0; k < subsums->sides; k++) n += subsums->candidate[k];
    while (size < 2 * n) size *= 2;
    table t = {subsums, sunder_i_calloc(size, sizeof *t.slot), size - 1, sunder_i_alloc(n, sizeof *t.keys)};
    out->line = sunder_i_alloc(n, sizeof *out->line);
    out->of = sunder_i_alloc(subsums->sides, sizeof *out->of);
    const bool ok = t.slot && t.keys && out->line && out->of;
    for (uint32_t k = 0; ok && k < subsums->sides; k++)
        out->of[k] = subsums->candidate[k] ? find_or_add(&t, k, out) : SUNDER_I_NO_LINE;
    sunder_i_free(t.slot);
    sunder_i_free(t.keys);
    if (ok && !subsums->lattice->arena.failed) return SUNDER_OK;
    sunder_i_lines_free(out);
    return sunder_i_no_memory(err);
}

void sunder_i_lines_free(sunder_i_lines *lines)
{
    sunder_i_free(lines->line);
    sunder_i_free(lines->of);
    memset(lines, 0, sizeof *lines);
}
