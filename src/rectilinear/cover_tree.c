/* Ranges are entered from the leaves up: what of a range is no whole leaf is counted element by element, and of the
 * whole leaves the range has those nodes for its own that it holds with all below, and not their parent. */
#include "rectilinear/cover_tree.h"

#include <string.h>

enum { FREE = 0, MIXED = 1, COVERED = 2, STATE = 3, ONE = 4 };

#define LEAF_BITS 6
#define LEAF ((uint32_t)1 << LEAF_BITS) /* elements: bits of a number */
#define DIGITS 32                       /* of a count */
#define ALL UINT64_MAX

bool sunder_i_cover_tree_init(sunder_i_cover_tree *tree, uint32_t elements)
{
    uint32_t size = 1;
    while (LEAF * (size_t)size < elements) size *= 2;
    const size_t n = (DIGITS + 2) * (size_t)size; /* two nodes are as long as a number of a leaf's elements */
    tree->size = size;
    tree->digits = 0;
    tree->covered = sunder_i_alloc(n, sizeof *tree->covered);
    if (!tree->covered) return false;
    memset(tree->covered, 0, n * sizeof *tree->covered);
    tree->digit = tree->covered + size;
    tree->node = (uint32_t *)(tree->digit + DIGITS * (size_t)size);
    return true;
}

void sunder_i_cover_tree_free(sunder_i_cover_tree *tree)
{
    sunder_i_free(tree->covered);
    tree->covered = NULL;
}

/* Of a node with that count, whose children are up to date. */
static uint32_t with_state(const sunder_i_cover_tree *t, uint32_t i, uint32_t count)
{
    if (count >= ONE) return count | COVERED;
    if (i < t->size) {
        const uint32_t first = t->node[2 * i] & STATE, second = t->node[2 * i + 1] & STATE;
        return first == second ? first : MIXED;
    }
    const uint64_t covered = t->covered[i - t->size];
    return covered == 0 ? FREE : covered == ALL ? COVERED : MIXED;
}

static void change(sunder_i_cover_tree *t, uint32_t i, uint32_t by)
{
    t->node[i] = with_state(t, i, (t->node[i] & ~(uint32_t)STATE) + by);
}

/* The bits from..to - 1 of a leaf, from < to. */
static uint64_t bits_of(uint32_t from, uint32_t to) { return ALL << from & ALL >> (LEAF - to); }

/* One more, or one less, of each element that has a bit in `by`: carries go on to the next digit. */
static void change_elements(sunder_i_cover_tree *t, uint32_t leaf, uint64_t by, bool more)
{
    uint64_t *digit = t->digit + DIGITS * (size_t)leaf, carry = by;
    uint32_t i = 0;
    if (more) {
        for (; carry; i++) {
            const uint64_t old = digit[i];
            digit[i] = old ^ carry;
            carry &= old;
        }
        if (i > t->digits) t->digits = i;
        t->covered[leaf] |= by;
    } else {
        uint64_t left = 0; /* bits of these elements in any digit */
        for (; carry; i++) {
            digit[i] ^= carry;
            carry &= digit[i];
            left |= digit[i];
        }
        for (; i < t->digits; i++) left |= digit[i];
        t->covered[leaf] &= ~by | left;
    }
    change(t, t->size + leaf, 0);
}

static void change_leaves(sunder_i_cover_tree *t, uint32_t from, uint32_t to, bool more)
{
    const uint32_t by = more ? ONE : -(uint32_t)ONE;
    for (uint32_t i = from + t->size, j = to + t->size; i < j; i /= 2, j /= 2) {
        if (i & 1) change(t, i++, by);
        if (j & 1) change(t, --j, by);
    }
}

static void change_range(sunder_i_cover_tree *t, uint32_t from, uint32_t to, bool more)
{
    const uint32_t a = from >> LEAF_BITS, b = (to - 1) >> LEAF_BITS, from_bit = from % LEAF,
                   to_bit = (to - 1) % LEAF + 1;
    if (a == b) {
        change_elements(t, a, bits_of(from_bit, to_bit), more);
    } else {
        change_elements(t, a, bits_of(from_bit, LEAF), more);
        change_elements(t, b, bits_of(0, to_bit), more);
        change_leaves(t, a + 1, b, more);
    }
    /* What is changed is at or below the first ancestor that the ends share; what is above it changes only with it. */
    uint32_t first = a + t->size, last = b + t->size;
    for (bool joined = first == last; first > 1;) {
        first /= 2, last /= 2;
        const uint32_t node = with_state(t, first, t->node[first] & ~(uint32_t)STATE);
        if (joined && node == t->node[first]) return;
        t->node[first] = node;
        if (first != last) t->node[last] = with_state(t, last, t->node[last] & ~(uint32_t)STATE);
        joined = first == last;
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

/* ---- What is free ---- */

typedef struct finder {
    const sunder_i_cover_tree *tree;
    uint32_t from, to;
    size_t first; /* run of this question */
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

/* Of a leaf whose elements are from `low` on. */
static void find_in_leaf(finder *f, uint32_t leaf, uint32_t low)
{
    const uint32_t from = f->from > low ? f->from - low : 0, to = f->to < low + LEAF ? f->to - low : LEAF;
    uint64_t free = ~f->tree->covered[leaf] & bits_of(from, to);
    while (free) {
        const uint32_t first = (uint32_t)__builtin_ctzll(free);
        const uint64_t rest = ~(free >> first);
        const uint32_t n = rest ? (uint32_t)__builtin_ctzll(rest) : LEAF;
        add_run(f, low + first, low + first + n);
        free = first + n < LEAF ? free & ALL << (first + n) : 0;
    }
}

/* Node i stands for the elements low..high - 1, of which some are asked for. */
static void find(finder *f, uint32_t i, uint32_t low, uint32_t high)
{
    const uint32_t state = f->tree->node[i] & STATE;
    if (state == COVERED || f->no_memory) return;
    if (state == FREE) {
        add_run(f, low > f->from ? low : f->from, high < f->to ? high : f->to);
    } else if (i >= f->tree->size) {
        find_in_leaf(f, i - f->tree->size, low);
    } else {
        const uint32_t middle = low + (high - low) / 2;
        if (f->from < middle) find(f, 2 * i, low, middle);
        if (f->to > middle) find(f, 2 * i + 1, middle, high);
    }
}

bool sunder_i_cover_tree_free_runs(const sunder_i_cover_tree *tree, uint32_t from, uint32_t to,
                                   sunder_i_element_runs *out)
{
    finder f = {tree, from, to, out->n, out, false};
    /* The first node that has all of the range below it; one above with ranges of its own covers that. */
    uint32_t top = (from >> LEAF_BITS) + tree->size, low = from & ~(LEAF - 1), width = LEAF;
    for (uint32_t last = ((to - 1) >> LEAF_BITS) + tree->size; top != last; width *= 2) {
        low -= top & 1 ? width : 0;
        top /= 2, last /= 2;
    }
    for (uint32_t i = top; i > 0; i /= 2)
        if (tree->node[i] >= ONE) return true;
    find(&f, top, low, low + width);
    return !f.no_memory;
}
