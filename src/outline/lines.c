/* lines.c: groups sides by line with a hash table: the line of a side is its class and one number, its offset, which is
 * equal for all points of the line and exact: a plain integer, or a ratio in the pool if a corner has a denominator. */
#include "outline/lines.h"

#include "base/watch.h"
#include "predicate/narrow.h"
#include "predicate/rational_point.h"

#include <string.h>

/* A line: its class and the cross product of the class's direction with any of its points; two points have equal keys
 * exactly if they are on one line. */
typedef struct key {
    sunder_i_i128 offset; /* the number itself, or a handle if `pooled` */
    bool pooled;
    uint32_t class, hash;
} key;

typedef struct table {
    const sunder_i_convex_pieces *parts;
    uint32_t *slot; /* the number of the line + 1, or 0 */
    size_t mask;
    key *keys; /* [lines] */
} table;

static uint64_t mix_hash(uint64_t h, uint64_t v)
{
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 29;
}

static uint64_t mix_big(uint64_t h, sunder_i_big v)
{
    for (long i = 0; i < (v.size < 0 ? -v.size : v.size); i++) h = mix_hash(h, v.limb[i]);
    return h;
}

/* Sets the offset of a line through a point with a denominator, in lowest terms; the denominator of the direction is
 * the same for the whole class and omitted. The offset is an integer if the line passes through lattice points, and
 * then equal to theirs. Returns the hash. */
static uint64_t pooled_offset(sunder_i_lattice *l, sunder_i_point d, sunder_i_point a, uint64_t hash, key *k)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point u = sunder_i_rational_get(m, l, a);
    sunder_i_big num = sunder_i_rational_cross(m, sunder_i_rational_get(m, l, d), u), den = u.w;
    if (!sunder_i_big_is_one(den)) {
        const sunder_i_big g = sunder_i_big_gcd(m, num, den);
        num = sunder_i_big_div_floor(m, num, g);
        den = sunder_i_big_div_floor(m, den, g);
    }
    k->pooled = !sunder_i_big_is_one(den) || sunder_i_big_bits(num) > 126;
    if (k->pooled) {
        k->offset = sunder_i_lattice_pool(l, sunder_i_big_copy(&l->arena, num), sunder_i_big_copy(&l->arena, den), 0);
        hash = mix_big(mix_big(hash, num), den);
    } else {
        const uint64_t low = num.size ? num.limb[0] : 0, high = num.size > 1 || num.size < -1 ? num.limb[1] : 0;
        k->offset = (sunder_i_i128)((sunder_i_u128)high << 64 | low);
        if (num.size < 0) k->offset = -k->offset;
        hash = mix_hash(mix_hash(hash, (uint64_t)k->offset), (uint64_t)(k->offset >> 64));
    }
    sunder_i_lattice_end(l, mark);
    return hash;
}

static key make_key(const sunder_i_convex_pieces *s, uint32_t side)
{
    const uint32_t rank = s->rank[side];
    key k = {0, false, rank < s->classes ? rank : rank - s->classes, 0};
    const sunder_i_point d = s->direction[k.class], a = s->corner[side];
    uint64_t hash = mix_hash(0, k.class);
    if (s->lattice->narrow || (sunder_i_point_is_plain(d) && sunder_i_point_is_plain(a))) {
        k.offset = sunder_i_det_i128(sunder_i_narrow_cross(d, a));
        hash = mix_hash(mix_hash(hash, (uint64_t)k.offset), (uint64_t)(k.offset >> 64));
    } else {
        hash = pooled_offset(s->lattice, d, a, hash, &k);
    }
    k.hash = (uint32_t)(hash >> 32);
    return k;
}

static bool same_line(const sunder_i_convex_pieces *s, const key *a, const key *b)
{
    if (a->hash != b->hash || a->class != b->class || a->pooled != b->pooled) return false;
    if (!a->pooled) return a->offset == b->offset;
    sunder_i_arena *m = &s->lattice->scratch; /* nothing is allocated in it: the numbers are not plain */
    const sunder_i_ratio p = sunder_i_lattice_read(m, s->lattice, (int64_t)a->offset);
    const sunder_i_ratio q = sunder_i_lattice_read(m, s->lattice, (int64_t)b->offset);
    return sunder_i_big_cmp(p.num, q.num) == 0 && sunder_i_big_cmp(p.den, q.den) == 0;
}

/* Returns the number of the line of a side; a new line is added. */
static uint32_t find_or_add(table *t, uint32_t side, sunder_i_lines *out)
{
    const sunder_i_convex_pieces *s = t->parts;
    const key k = make_key(s, side);
    size_t at = k.hash & t->mask;
    for (; t->slot[at]; at = (at + 1) & t->mask)
        if (same_line(s, &t->keys[t->slot[at] - 1], &k)) return t->slot[at] - 1;
    const uint32_t n = out->n++;
    t->slot[at] = n + 1;
    t->keys[n] = k;
    out->side[n] = side;
    if (out->second) out->second[n] = sunder_i_point_add(s->lattice, s->corner[side], s->direction[k.class]);
    return n;
}

sunder_status sunder_i_lines_group(const sunder_i_convex_pieces *parts, sunder_i_lines *out, sunder_error *err)
{
    size_t n = 0, size = 16;
    memset(out, 0, sizeof *out);
    for (size_t k = 0; k < parts->corners; k++) n += parts->candidate[k];
    while (size < 2 * n) size *= 2;
    table t = {parts, sunder_i_calloc(size, sizeof *t.slot), size - 1, sunder_i_alloc(n, sizeof *t.keys)};
    const bool narrow = parts->lattice->narrow;
    out->corner = parts->corner;
    out->rank = parts->rank;
    out->direction = parts->direction;
    out->classes = parts->classes;
    out->side = sunder_i_alloc(n, sizeof *out->side);
    out->second = narrow ? NULL : sunder_i_alloc(n, sizeof *out->second);
    out->of = sunder_i_alloc(parts->corners, sizeof *out->of);
    bool ok = t.slot && t.keys && out->side && out->of && (narrow || out->second);
    for (uint32_t k = 0; ok && k < parts->corners; k++) {
        ok = sunder_i_step();
        out->of[k] = parts->candidate[k] ? find_or_add(&t, k, out) : SUNDER_I_NO_LINE;
    }
    sunder_i_free_all(t.slot, t.keys);
    if (ok && !parts->lattice->arena.failed) return SUNDER_OK;
    sunder_i_lines_free(out);
    return sunder_i_failure_cause(err);
}

void sunder_i_lines_free(sunder_i_lines *lines)
{
    sunder_i_free_all(lines->side, lines->second, lines->of);
    memset(lines, 0, sizeof *lines);
}
