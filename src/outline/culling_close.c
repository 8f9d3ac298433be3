/* culling_close.c: leaves: the pairs of a line and a part that result from a cell that is not divided further, and the
 * results for candidates. */
#include "outline/culling_inner.h"

#include "outline/tuning.h"

#include <string.h>

/* Returns whether the pair was pushed recently, and remembers it. Neighbouring leaves have most of their pairs in
 * common (with overlapping features nine of ten). A pair that was overwritten in the table is pushed twice, which is
 * harmless. */
static bool is_known(builder *b, uint64_t pair)
{
    uint64_t *slot = &b->recent[(pair * 0x9e3779b97f4a7c15u) >> (64 - b->recent_bits)];
    if (*slot == pair) return true;
    *slot = pair;
    return false;
}

void sunder_i_cells_forget_pairs(builder *b) { memset(b->recent, 0xff, sizeof *b->recent << b->recent_bits); }

static bool push_pair(builder *b, uint32_t line, uint32_t part)
{
    if (is_known(b, (uint64_t)line << 32 | part)) return true;
    if (sunder_i_pairs_add(&b->out->pairs, line, part)) return true;
    b->no_memory = true;
    return false;
}

/* Lists the candidates of some runs that pass through a box. */
void sunder_i_cells_gather(builder *b, size_t from, size_t to, const box *c)
{
    const uint32_t *of = b->lines->of;
    b->crossing_n = 0;
    for (size_t i = from; i < to; i++) {
        const run r = b->runs[i];
        if (r <= b->single_most && of[r] == SUNDER_I_NO_LINE) continue; /* the usual case */
        const uint32_t first = run_from(b, r), end = run_end(b, r);
        if (b->before[first] == b->before[end]) continue;
        if (end - first > 1) {
            const approx_side *s = &b->side[first], *t = &b->side[end - 1];
            const approx_side whole = {s->ax, s->ay, t->ax + t->dx - s->ax, t->ay + t->dy - s->ay};
            box clipped;
            if (!clip_by_side(b, &whole, c, &clipped)) continue;
        }
        for (uint32_t k = first; k < end; k++) {
            if (of[k] == SUNDER_I_NO_LINE) continue;
            crossing *x = &b->crossing[b->crossing_n];
            if (!clip_by_side(b, &b->side[k], c, &x->clipped)) continue;
            x->side = k;
            x->line = of[k];
            b->crossing_n++;
        }
    }
}

void sunder_i_cells_cover(builder *b, uint32_t side, uint32_t part)
{
    const uint32_t line = b->lines->of[side];
    if (line == SUNDER_I_NO_LINE) return;
    b->out->fate[side] |= CONTESTED;
    push_pair(b, line, part);
}

/* Pushes a pair of the part and the line of every gathered candidate: within this box the part covers these lines. */
static void cover_all(builder *b, uint32_t part)
{
    b->cells++;
    for (size_t i = 0; i < b->crossing_n; i++) {
        const uint32_t line = b->crossing[i].line;
        if (b->stamp[line] == b->cells) continue;
        b->stamp[line] = b->cells;
        if (!push_pair(b, line, part)) return;
    }
}

/* Closes a box that is inside `one`, or inside `one` and `other` together: every candidate of the parent's lists that
 * passes through it is covered there. */
void sunder_i_cells_close(builder *b, const cell *parent, const box *c, uint32_t one, uint32_t other)
{
    sunder_i_cells_gather(b, parent->run_from, parent->run_to, c);
    for (size_t i = 0; i < b->crossing_n; i++) b->out->fate[b->crossing[i].side] |= CONTESTED;
    cover_all(b, one);
    if (other != one && !b->no_memory) cover_all(b, other);
}

/* Marks the candidates of a leaf that only one part meets. */
void sunder_i_cells_lone_leaf(builder *b, const cell *c)
{
    sunder_i_cells_gather(b, c->run_from, c->run_to, &c->b);
    for (size_t i = 0; i < b->crossing_n; i++) b->out->fate[b->crossing[i].side] |= ALONE;
}

/* Pushes all pairs of a leaf, except for parts that are certainly disjoint from the only candidate of a line. The
 * candidates have been gathered. */
void sunder_i_cells_open_leaf(builder *b, const cell *c)
{
    const uint32_t once = ++b->cells, again = ++b->cells; /* the stamps of lines met once, and more often */
    for (size_t i = 0; i < b->crossing_n; i++) {
        const uint32_t line = b->crossing[i].line;
        b->out->fate[b->crossing[i].side] |= PASSES;
        b->stamp[line] = b->stamp[line] == once || b->stamp[line] == again ? again : once;
    }
    const uint32_t pushed = ++b->cells;
    for (size_t i = 0; i < b->crossing_n; i++) {
        const uint32_t line = b->crossing[i].line;
        if (b->stamp[line] == pushed) continue;
        const bool alone = b->stamp[line] == once;
        b->stamp[line] = pushed;
        for (size_t e = c->entry_from; e < c->entry_to; e++) {
            const uint32_t part = b->entries[e].part;
            if (alone && boxes_apart(&b->reach[part], &b->crossing[i].clipped)) continue;
            if (!push_pair(b, line, part)) return;
        }
    }
}

/* A trial is ended if the number of sides that it processed, plus PAIR_COST for each pair that it pushed, exceeds half
 * of PAIR_COST for each of the cell's own pairs; the cell then becomes a leaf, as if it had not been divided. Marks
 * that it set on candidates are kept: they only make more candidates open. */
void sunder_i_cells_end_trial(builder *b)
{
    trial *t = &b->trial;
    if (t->spent + PAIR_COST * (double)(b->out->pairs.count - t->pairs.count) <= PAIR_COST / 2 * t->of.trial) return;
    t->on = false;
    b->stack_n = t->stack_n;
    b->entries_n = t->of.entry_to;
    b->runs_n = t->of.run_to;
    sunder_i_pairs_take_back(&b->out->pairs, t->pairs);
    sunder_i_cells_forget_pairs(b);
    sunder_i_cells_gather(b, t->of.run_from, t->of.run_to, &t->of.b);
    sunder_i_cells_open_leaf(b, &t->of);
    b->done = t->done + t->of.share;
}

/* Converts marks to results. An open candidate is paired with its own part if no leaf has done so. Returns false if out
 * of memory. */
bool sunder_i_cells_fates(builder *b)
{
    const sunder_i_convex_pieces *s = b->parts;
    for (uint32_t i = 0; i < s->n; i++)
        for (uint32_t k = sunder_i_convex_pieces_first(s, i); k < s->end[i]; k++) {
            uint8_t *fate = &b->out->fate[k];
            if ((*fate & (PASSES | ALONE)) == 0)
                *fate = SUNDER_I_COVERED;
            else if (*fate == ALONE && !b->shared[b->lines->of[k]]) {
                *fate = SUNDER_I_WHOLE;
                b->out->whole++;
            } else {
                if ((*fate & ALONE) && !push_pair(b, b->lines->of[k], i)) return false;
                *fate = SUNDER_I_OPEN;
                b->out->live_line[b->lines->of[k]] = true;
            }
        }
    return true;
}
