/* cover_tree.c: a range is added from the elements upwards: the part of it that is in the same node as one of its ends
 * is counted there, child by child. The nodes between the two are covered completely, and are in turn children of nodes
 * one level up, where the same is done. */
#include "rectilinear/cover_tree.h"

#define CHILD_BITS 6
#define CHILDREN ((uint32_t)1 << CHILD_BITS)
#define ALL UINT64_MAX

typedef sunder_i_cover_node node;

bool sunder_i_cover_tree_init(sunder_i_cover_tree *tree, uint32_t elements)
{
    size_t start[SUNDER_I_COVER_LEVELS], n = 0;
    tree->levels = tree->digits = 0;
    for (uint32_t of = elements; tree->levels == 0 || of > 1;) {
        of = of / CHILDREN + (of % CHILDREN != 0);
        start[tree->levels++] = n;
        n += of;
    }
    node *all = sunder_i_calloc(n, sizeof *all);
    for (uint32_t k = 0; k < tree->levels; k++) tree->level[k] = all ? all + start[k] : NULL;
    return all != NULL;
}

void sunder_i_cover_tree_free(sunder_i_cover_tree *tree)
{
    if (tree->levels) sunder_i_free(tree->level[0]);
    tree->levels = 0;
}

/* Returns the bits from .. to, both inclusive. */
static uint64_t bits_of(uint32_t from, uint32_t to) { return ALL << from & ALL >> (CHILDREN - 1 - to); }

/* Adds one to, or subtracts one from, the count of each child that has a bit in `by`: carries go to the next digit. */
static void change_children(sunder_i_cover_tree *t, node *v, uint64_t by, bool more)
{
    uint64_t carry = by;
    uint32_t i = 0;
    if (more) {
        for (; carry; i++) {
            const uint64_t old = v->digit[i];
            v->digit[i] = old ^ carry;
            carry &= old;
        }
        if (i > t->digits) t->digits = i;
        v->own |= by;
    } else {
        uint64_t left = 0; /* the children with a set bit in any digit */
        for (; carry; i++) {
            v->digit[i] ^= carry;
            carry &= v->digit[i];
            left |= v->digit[i];
        }
        for (; i < t->digits; i++) left |= v->digit[i];
        v->own &= ~by | left;
    }
}

/* Updates the ancestors of node i, as far up as something changes. */
static void tell_above(sunder_i_cover_tree *t, uint32_t level, uint32_t i)
{
    const node *v = &t->level[level][i];
    while (++level < t->levels) {
        node *above = &t->level[level][i >> CHILD_BITS];
        const uint32_t at = i % CHILDREN;
        const bool full = (v->own | v->full) == ALL, some = (v->own | v->some) != 0;
        const uint64_t new_full = (above->full >> at & 1) ^ full, new_some = (above->some >> at & 1) ^ some;
        if (!(new_full | new_some)) return;
        above->full ^= new_full << at;
        above->some ^= new_some << at;
        v = above;
        i >>= CHILD_BITS;
    }
}

/* Adds one to, or subtracts one from, the number of own ranges of the children from .. last of node i of a level. */
static void change_ranges(sunder_i_cover_tree *t, uint32_t level, uint32_t i, uint32_t from, uint32_t last, bool more)
{
    node *v = &t->level[level][i];
    const uint64_t before = v->own;
    change_children(t, v, bits_of(from, last), more);
    if (v->own != before) tell_above(t, level, i);
}

static void change_range(sunder_i_cover_tree *t, uint32_t from, uint32_t to, bool more)
{
    for (uint32_t level = 0; from < to; level++) {
        const uint32_t a = from >> CHILD_BITS, b = (to - 1) >> CHILD_BITS, last = (to - 1) % CHILDREN;
        change_ranges(t, level, a, from % CHILDREN, a == b ? last : CHILDREN - 1, more);
        if (a == b) return;
        change_ranges(t, level, b, 0, last, more);
        from = a + 1;
        to = b;
    }
}

void sunder_i_cover_tree_add(sunder_i_cover_tree *tree, uint32_t from, uint32_t to)
{
    change_range(tree, from, to, true);
}

void sunder_i_cover_tree_remove(sunder_i_cover_tree *tree, uint32_t from, uint32_t to)
{
    change_range(tree, from, to, false);
}

/* ---- Free elements ---- */

typedef struct finder {
    const sunder_i_cover_tree *tree;
    uint32_t from, last; /* elements, both inclusive */
    size_t first;        /* the first run of this query */
    sunder_i_element_runs *out;
    bool no_memory;
} finder;

static void add_run(finder *f, uint32_t from, uint32_t to)
{
    sunder_i_element_runs *o = f->out;
    if (o->n > f->first && o->item[o->n - 1].to == from) {
        o->item[o->n - 1].to = to;
        return;
    }
    if (!sunder_i_reserve(&o->item, &o->capacity, o->n + 1, sizeof *o->item)) {
        f->no_memory = true;
        return;
    }
    o->item[o->n++] = (sunder_i_element_run){from, to};
}

/* Returns the number of trailing one bits; there must be at least one. */
static uint32_t trailing_ones(uint64_t bits) { return ~bits ? (uint32_t)__builtin_ctzll(~bits) : CHILDREN; }

/* Returns the bits of the children of a node that are in the query: `low` is the first child of the node, from .. last
 * are the children of the level in the query. */
static uint64_t asked_for(uint32_t low, uint32_t from, uint32_t last)
{
    return bits_of(from > low ? from - low : 0, last - low < CHILDREN ? last - low : CHILDREN - 1);
}

/* The same for a node of the lowest level. */
static void find_elements(finder *f, uint32_t i)
{
    const uint32_t low = i << CHILD_BITS;
    uint64_t free = asked_for(low, f->from, f->last) & ~f->tree->level[0][i].own;
    while (free) {
        const uint32_t at = (uint32_t)__builtin_ctzll(free), next = at + trailing_ones(free >> at);
        add_run(f, low + at, low + next);
        free = next < CHILDREN ? free & ALL << next : 0;
    }
}

/* Visits node i of a level, which has elements in the query. */
static void visit_node(finder *f, uint32_t level, uint32_t i)
{
    if (level == 0) {
        find_elements(f, i);
        return;
    }
    const node *v = &f->tree->level[level][i];
    const uint32_t shift = CHILD_BITS * level, low = i << CHILD_BITS;
    const uint64_t asked = asked_for(low, f->from >> shift, f->last >> shift), free = asked & ~(v->own | v->some);
    for (uint64_t rest = asked & ~(v->own | v->full); rest && !f->no_memory;) {
        const uint32_t at = (uint32_t)__builtin_ctzll(rest);
        if (free >> at & 1) {
            const uint32_t next = at + trailing_ones(free >> at), start = (low + at) << shift;
            const uint64_t end = (uint64_t)(low + next) << shift;
            add_run(f, start > f->from ? start : f->from, end <= f->last ? (uint32_t)end : f->last + 1);
            rest = next < CHILDREN ? rest & ALL << next : 0;
        } else {
            visit_node(f, level - 1, low + at);
            rest &= rest - 1;
        }
    }
}

bool sunder_i_cover_tree_free_runs(const sunder_i_cover_tree *tree, uint32_t from, uint32_t to,
                                   sunder_i_element_runs *out)
{
    finder f = {tree, from, to - 1, out->n, out, false};
    /* The lowest node that has the whole range below it; an ancestor with ranges of its own covers all of it. */
    uint32_t level = 0, top = from >> CHILD_BITS;
    for (uint32_t last = f.last >> CHILD_BITS; top != last; level++) top >>= CHILD_BITS, last >>= CHILD_BITS;
    for (uint32_t k = level + 1, i = top; k < tree->levels; k++, i >>= CHILD_BITS)
        if (tree->level[k][i >> CHILD_BITS].own >> i % CHILDREN & 1) return true;
    visit_node(&f, level, top);
    return !f.no_memory;
}
