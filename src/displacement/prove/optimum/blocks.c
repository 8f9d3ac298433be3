/* A lower bound for a group that is too large for one tree, from overlapping blocks [Lagrangian decomposition, GK87].
 *
 * Give each block S a share w_i^S of the weight of each of its bodies i, and a place a_i^S to which the body is drawn.
 * Let W_i be the sum of the shares of body i, less than its weight w_i; v_i = sum of w_i^S a_i^S, c_i = sum of w_i^S
 * |a_i^S|^2. Then
 *
 *     sum w |t|^2  =  sum over S of sum w^S |t - a^S|^2  +  sum over i of (w_i - W_i) |t_i|^2 + 2 t_i.v_i - c_i
 *                 >=  sum over S of opt(S)  -  sum over i of c_i + |v_i|^2 / (w_i - W_i),
 *
 * where opt(S) is the least cost of the block's bodies alone, for which a tree (tree.c) proves a lower bound. This
 * holds for any shares and places, so they are taken as the doubles that were computed; v_i is nearly 0, and its term
 * is rounded so that the bound stays valid. It also holds if t and a^S count from the preferred move of each body, as
 * they do in these sums; an anchor below is a^S plus the preferred move.
 *
 * A spring between neighbours in a row is a contact, and belongs to one block; the others do without it.
 *
 * Good places make the present layout the best one for each block alone: then nothing is lost. If F_i^S is the sum of
 * the forces of the block's contacts on a body (contact_forces.c), the body is at rest at a_i^S = t_i - F_i^S / (2
 * w_i^S). So the blocks together contain all contacts with a force, each once (block_cover.c). In a loose group these
 * places are as good as any. In a dense group they prove less than no places at all, since under such forces a block
 * alone moves around obstacles in a way that its neighbours would prevent; so places are searched for. A better layout
 * of a block is a cut, an upper bound of the block's value at any places, and the next places are where the cuts
 * promise most (bundle.c), until the steps are used up. If little more is promised, larger blocks are tried, as long as
 * they prove more.
 *
 * (Moving places towards each other by a subgradient, as the copies of a body drift apart, proved half as much: 364
 * instead of 690 for a group of cost 2,740.) */
#include "displacement/prove/optimum/blocks.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

static const double *preferred_of(const sunder_i_lagrangian *d, const sunder_i_block_copy *copy)
{
    return d->anchor + 2 * (size_t)copy->at;
}

/* How far from its preferred move the copy is drawn, along axis e: correct but for a share of 2^-53. */
static double drawn_by(const sunder_i_lagrangian *d, const sunder_i_block_copy *copy, size_t e)
{
    return copy->anchor[e] - preferred_of(d, copy)[e];
}

/* Computes the forces on each copy of a body, and its share of the body's weight. */
static void share_out(sunder_i_lagrangian *d)
{
    for (size_t m = 0; m < d->items; m++) d->item[m].force[0] = d->item[m].force[1] = 0;
    const sunder_i_contact_forces *c = &d->contacts;
    for (size_t k = 0; k < c->n; k++) {
        if (!(c->force[k] > 0)) continue;
        const sunder_i_move_cut *cut = &c->cut[k];
        for (size_t m = d->first[d->home[k]]; m < d->first[d->home[k] + 1]; m++) {
            const double f = d->item[m].at == cut->j ? c->force[k] : d->item[m].at == cut->i ? -c->force[k] : 0;
            for (int e = 0; e < 2; e++) d->item[m].force[e] += f * cut->n[e];
        }
    }
    for (size_t m = 0; m < d->items; m++) {
        sunder_i_block_copy *i = &d->item[m];
        if (!sunder_i_is_mover_of(d, i->at)) continue;
        i->share = d->weight[i->at] * (1 - SPARED) / d->count[i->at];
    }
}

/* Sets the anchor of each copy to `part` times the place where the contacts' forces hold it. */
static void draw_copies(sunder_i_lagrangian *d, double part)
{
    for (size_t m = 0; m < d->items; m++) {
        sunder_i_block_copy *i = &d->item[m];
        for (int e = 0; e < 2 && i->share > 0; e++)
            i->anchor[e] = part * (d->contacts.program.t[2 * i->at + (size_t)e] - preferred_of(d, i)[e] -
                                   i->force[e] / (2 * i->share)) +
                           preferred_of(d, i)[e];
    }
}

/* ---- The bound --------------------------------------------------------------------------------------------------- */

/* Returns what places and shares subtract from the bound, sum of c_i + |v_i|^2 / (w_i - W_i), rounded upwards. Each sum
 * has at most `items` terms with a few roundings each, so its error is less than (items + 8) 2^-52 of the sum of
 * magnitudes; twice that is added. */
static double taken_by_shares(const sunder_i_lagrangian *d)
{
    const double unit = 2 * ((double)d->items + 8) * 0x1p-52;
    double all = 0;
    for (uint32_t at = 0; at < d->group->n; at++) {
        double whole = 0, v[2] = {0, 0}, size[2] = {0, 0}, own = 0;
        if (!sunder_i_is_mover_of(d, at) || d->count[at] == 0) continue;
        for (size_t m = 0; m < d->items; m++) {
            const sunder_i_block_copy *i = &d->item[m];
            if (i->at != at) continue;
            whole += i->share;
            for (size_t e = 0; e < 2; e++) {
                const double a = drawn_by(d, i, e);
                v[e] += i->share * a;
                size[e] += fabs(i->share * a);
                own += i->share * a * a;
            }
        }
        const double left = d->weight[at] - whole * (1 + unit);
        if (!(left > 0)) return INFINITY;
        for (int e = 0; e < 2; e++) v[e] = fabs(v[e]) + unit * size[e];
        all += own + (v[0] * v[0] + v[1] * v[1]) / left * (1 + 0x1p-48);
    }
    return all * (1 + unit) * (1 + (double)d->group->n * 0x1p-52);
}

/* Changes the place of the last copy of each body so that v_i is as near to 0 as rounding allows. */
static void balance_anchors(sunder_i_lagrangian *d)
{
    for (size_t m = d->items; m-- > 0;) {
        sunder_i_block_copy *last = &d->item[m];
        if (!sunder_i_is_mover_of(d, last->at)) continue;
        double sum[2] = {0, 0};
        bool is_last = true;
        for (size_t k = m + 1; k < d->items && is_last; k++) is_last = d->item[k].at != last->at;
        if (!is_last) continue;
        for (size_t k = 0; k < m; k++)
            for (size_t e = 0; e < 2 && d->item[k].at == last->at; e++)
                sum[e] += d->item[k].share * drawn_by(d, &d->item[k], e);
        for (int e = 0; e < 2; e++) last->anchor[e] = -sum[e] / last->share + preferred_of(d, last)[e];
    }
}

/* Adds the result for a block to the bundle, as a cut for later proposals. Returns false if memory is out. */
static bool note_cut(sunder_i_lagrangian *d, size_t block, double value)
{
    const size_t n = d->first[block + 1] - d->first[block];
    const sunder_i_block_copy *item = d->item + d->first[block];
    double x[2 * MOST_IN_BLOCK], t[2 * MOST_IN_BLOCK];
    for (size_t k = 0; k < n; k++)
        for (size_t e = 0; e < 2; e++) {
            const double a = drawn_by(d, &item[k], e);
            x[2 * k + e] = item[k].share * a;
            t[2 * k + e] = item[k].t[e] - preferred_of(d, &item[k])[e];
            value -= item[k].share * a * a;
        }
    return sunder_i_bundle_add(&d->bundle, block, value, x, t);
}

/* Returns the place in the block of the body that has place `at` in the group's list. */
static uint32_t place_in_block(const sunder_i_lagrangian *d, size_t block, uint32_t at)
{
    uint32_t k = 0;
    while (d->item[d->first[block] + k].at != at) k++;
    return k;
}

/* Lists the springs that belong to the block as cuts of its own bodies, *n of them. Returns their cost at the moves of
 * the copies. */
static double list_springs(const sunder_i_lagrangian *d, size_t block, sunder_i_move_cut spring[MOST_SPRINGS],
                           size_t *n)
{
    const sunder_i_contact_forces *c = &d->contacts;
    double cost = 0;
    *n = 0;
    for (size_t k = 0; k < c->n && *n < MOST_SPRINGS; k++) {
        if (!(c->cut[k].give > 0) || d->home[k] != block) continue;
        sunder_i_move_cut *cut = &spring[(*n)++];
        *cut = c->cut[k];
        cut->i = place_in_block(d, block, c->cut[k].i);
        cut->j = place_in_block(d, block, c->cut[k].j);
        const double *t = d->item[d->first[block] + cut->i].t, *s = d->item[d->first[block] + cut->j].t;
        const double missing = sunder_i_max(0, cut->d + cut->n[0] * (t[0] - s[0]) + cut->n[1] * (t[1] - s[1]));
        cost += missing * missing / (2 * cut->give);
    }
    return cost;
}

/* Proves a bound for one block: *value. *most is the cost of the present layout for the block, an upper bound of
 * *value. The moves of the block's best layout go to its copies. trees: NULL, or the tree is appended to it. Returns
 * false if memory is out. */
static bool ask_block(sunder_i_lagrangian *d, size_t block, sunder_i_bound_trees *trees, double *value, double *most)
{
    const size_t n = d->first[block + 1] - d->first[block];
    sunder_i_block_copy *item = d->item + d->first[block];
    uint32_t body[MOST_IN_BLOCK];
    double weight[MOST_IN_BLOCK], anchor[2 * MOST_IN_BLOCK], cost = 0, least = INFINITY;
    sunder_i_move_cut spring[MOST_SPRINGS];
    size_t springs;
    *value = *most = 0;
    if (n > MOST_IN_BLOCK) return true;
    for (size_t k = 0; k < n; k++) {
        const double *t = d->group->move + 2 * (size_t)item[k].at;
        body[k] = d->group->body[item[k].at];
        weight[k] = item[k].share;
        for (size_t e = 0; e < 2; e++) {
            anchor[2 * k + e] = item[k].anchor[e];
            cost += item[k].share * (t[e] - item[k].anchor[e]) * (t[e] - item[k].anchor[e]);
            item[k].t[e] = t[e];
        }
    }
    cost += list_springs(d, block, spring, &springs);
    *most = cost;
    const sunder_i_task task = {.model = d->model,
                                .waived = d->waived,
                                .body = body,
                                .n = n,
                                .weight = weight,
                                .anchor = anchor,
                                .goal = cost * (1 - OPTIMAL_SHARE),
                                .spring = spring,
                                .springs = springs,
                                .keep = trees != NULL};
    sunder_i_tree tree;
    bool ok = sunder_i_tree_init(&tree, &task);
    while (ok && sunder_i_tree_run(&tree, d->each) == SUNDER_I_TREE_FOUND && !tree.failed)
        if (tree.leaf < least) {
            least = tree.leaf;
            for (size_t k = 0; k < n; k++) memcpy(item[k].t, tree.program.t + 2 * k, sizeof item[k].t);
        }
    /* If the least open node decides the bound, its minimiser is taken. */
    if (ok && tree.opens && tree.open[0].value < sunder_i_min(least, task.goal)) {
        sunder_i_tree_load(&tree, tree.open[0].node);
        for (size_t k = 0; k < n; k++) memcpy(item[k].t, tree.program.t + 2 * k, sizeof item[k].t);
    }
    ok = ok && !tree.failed;
    if (ok) *value = sunder_i_tree_bound(&tree);
    if (ok && !trees) ok = note_cut(d, block, *value);
    if (ok && trees) ok = sunder_i_tree_keep(&tree, trees);
    d->steps += tree.steps;
    sunder_i_tree_free(&tree);
    return ok;
}

/* Computes the bound at the present places. Returns false if memory is out. A bound below `enough` is useless, and
 * *bound may then be -INFINITY: no block proves more than its part of the present layout costs, so this may become
 * clear before all blocks have been evaluated. */
static bool evaluate_blocks(sunder_i_lagrangian *d, sunder_i_bound_trees *trees, double enough, double *bound)
{
    double sum = 0, missed = 0;
    balance_anchors(d);
    *bound = -INFINITY;
    for (size_t k = 0; k < d->blocks; k++) {
        double value, most;
        if (!ask_block(d, k, trees, &value, &most)) return false;
        sum = nextafter(sum + value, -INFINITY);
        missed += most - value;
        if (d->group->cost - missed < enough) return true;
    }
    *bound = nextafter(sum - taken_by_shares(d), -INFINITY);
    return true;
}

/* Starts with the better of two choices of places: 0, and the places where the forces hold the bodies. *bound is what
 * it proves; `best` gets its copies. */
static bool begin_at_best(sunder_i_lagrangian *d, sunder_i_block_copy *best, double *bound)
{
    static const double part[] = {0, 1};
    *bound = -INFINITY;
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) {
        double value;
        draw_copies(d, part[k]);
        if (!evaluate_blocks(d, NULL, *bound, &value)) return false;
        if (value <= *bound) continue;
        *bound = value;
        memcpy(best, d->item, d->items * sizeof *best);
        if (part[k] == 1) break;
    }
    memcpy(d->item, best, d->items * sizeof *best);
    return true;
}

/* Returns the stride for the first proposal: the share FIRST_STRIDE of a step along the drift of the copies, each away
 * from the mean of its body's copies, that would prove all of `missing` if the bound kept growing at its initial
 * rate. */
static double first_stride(const sunder_i_lagrangian *d, const sunder_i_block_copy *best, double missing)
{
    double square = 0;
    for (size_t m = 0; m < d->items; m++)
        for (size_t e = 0; e < 2; e++) {
            double mean = 0;
            for (size_t k = 0; k < d->items; k++)
                if (best[k].at == best[m].at) mean += best[k].t[e] / d->count[best[m].at];
            if (best[m].share > 0) square += (best[m].t[e] - mean) * (best[m].t[e] - mean);
        }
    return square > 0 ? FIRST_STRIDE * missing / (4 * square) : 1;
}

/* Returns the part of the bound that is missing. In a dense group, where blocks prove little, at most as much as is
 * proved now. */
static double hoped_for(double cost, double now) { return now > 0 ? sunder_i_min(cost - now, now) : cost - now; }

static void put_anchors(sunder_i_lagrangian *d, const double *x)
{
    for (size_t m = 0; m < d->items; m++)
        for (size_t e = 0; e < 2 && d->item[m].share > 0; e++)
            d->item[m].anchor[e] = x[2 * m + e] / d->item[m].share + preferred_of(d, &d->item[m])[e];
}

/* Repeatedly evaluates the places where the known cuts promise most, around the centre. best: the copies at the best
 * places; x: scratch. The centre moves if a fair share of the promise was proved; otherwise strides become shorter.
 * Returns true if little more is promised, and blocks took so few steps that larger ones may pay. *ok: false if memory
 * is out. */
static bool improve_anchors(sunder_i_lagrangian *d, sunder_i_block_copy *best, double *centre, double *x, double *bound,
                            bool *ok)
{
    const double cost = d->group->cost;
    double now = *bound, stride = first_stride(d, best, hoped_for(cost, now)), past = now;
    size_t looks = 0;
    for (size_t m = 0; m < d->items; m++)
        for (size_t e = 0; e < 2; e++) centre[2 * m + e] = best[m].share * drawn_by(d, &best[m], e);
    for (uint64_t each = d->each; d->steps < d->most && cost - now > BLOCKS_NEAR * cost;) {
        double value, promise;
        *ok = sunder_i_bundle_propose(&d->bundle, centre, stride, x, &promise);
        if (!*ok) break;
        d->steps += d->bundle.steps;
        d->bundle.steps = 0;
        promise -= now;
        const uint64_t before = d->steps;
        if (promise <= PROMISED_LITTLE * (cost - now) && each <= d->each / 3) return true;
        if (promise <= PROMISED_NOTHING * (cost - now)) break;
        put_anchors(d, x);
        *ok = evaluate_blocks(d, NULL, -INFINITY, &value);
        if (!*ok) break;
        each = (d->steps - before) / d->blocks;
        if (value > *bound) {
            *bound = value;
            memcpy(best, d->item, d->items * sizeof *best);
        }
        if (++looks == LOOKS && *bound - past < PROVED_LITTLE * (cost - past)) break;
        if (looks == LOOKS) {
            looks = 0;
            past = *bound;
        }
        if (value < now + SERIOUS * promise) {
            stride *= SHORTER;
            continue;
        }
        if (value >= now + promise / 2) stride *= LONGER;
        now = value;
        memcpy(centre, x, 2 * d->items * sizeof *x);
    }
    return false;
}

/* Sets up the bundle; the present layout is the first cut of each block. Returns false if memory is out. */
static bool begin_bundle(sunder_i_lagrangian *d)
{
    d->member = sunder_i_alloc(d->items, sizeof *d->member);
    d->others = sunder_i_alloc(d->items, sizeof *d->others);
    if (!d->member || !d->others) return false;
    for (size_t m = 0; m < d->items; m++) {
        d->member[m] = d->item[m].at;
        d->others[m] = d->item[m].share > 0 ? 1 - 1.0 / d->count[d->item[m].at] : 0;
    }
    d->bundle = (sunder_i_bundle){.blocks = d->blocks,
                                  .copies = d->items,
                                  .members = d->group->n,
                                  .first = d->first,
                                  .member = d->member,
                                  .others = d->others};
    if (!sunder_i_bundle_init(&d->bundle)) return false;
    for (size_t k = 0; k < d->blocks; k++) {
        sunder_i_move_cut spring[MOST_SPRINGS];
        size_t springs;
        double value = 0;
        if (d->first[k + 1] - d->first[k] > MOST_IN_BLOCK) continue;
        for (size_t m = d->first[k]; m < d->first[k + 1]; m++)
            for (int e = 0; e < 2; e++) {
                sunder_i_block_copy *i = &d->item[m];
                i->t[e] = d->group->move[2 * (size_t)i->at + (size_t)e];
                const double t = i->t[e] - preferred_of(d, i)[e];
                value += i->share * t * t;
            }
        value += list_springs(d, k, spring, &springs);
        if (!note_cut(d, k, value)) return false;
    }
    return true;
}

static bool prepare_forces(sunder_i_lagrangian *d)
{
    const size_t n = d->group->n;
    d->weight = sunder_i_alloc(n, sizeof *d->weight);
    d->mass = sunder_i_alloc(n, sizeof *d->mass);
    d->anchor = sunder_i_calloc(2 * n, sizeof *d->anchor);
    d->count = sunder_i_calloc(n, sizeof *d->count);
    d->pressure = sunder_i_alloc(n, sizeof *d->pressure);
    if (!d->weight || !d->mass || !d->anchor || !d->count || !d->pressure) return false;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &d->model->body[d->group->body[k]];
        d->weight[k] = b->fixed ? INFINITY : sunder_i_weight_below(d->model, b);
        d->mass[k] = b->fixed ? 0 : 0.5 / d->weight[k];
        if (!b->fixed)
            memcpy(d->anchor + 2 * k, sunder_i_preferred(d->model, d->group->body[k]), 2 * sizeof *d->anchor);
    }
    if (!sunder_i_contact_forces_find(&d->contacts, d->model, d->waived, d->group, d->weight, d->mass, d->anchor))
        return false;
    d->steps += d->contacts.steps;
    d->home = sunder_i_alloc(d->contacts.n, sizeof *d->home);
    return d->home != NULL;
}

/* Proves a bound by blocks of d->size movable bodies. Replaces *bound and *trees if it is greater. *larger is set if
 * larger blocks may prove more. Returns false if memory is out. */
static bool ask_blocks(sunder_i_lagrangian *d, double *bound, sunder_i_bound_trees *trees, bool *larger)
{
    *larger = false;
    d->items = d->blocks = 0;
    memset(d->count, 0, d->group->n * sizeof *d->count);
    if (!sunder_i_make_blocks(d)) return false;
    if (d->blocks == 0) return true;
    share_out(d);
    d->each = (d->most > d->steps ? d->most - d->steps : 0) / (ROUNDS * d->blocks);
    sunder_i_block_copy *best = sunder_i_alloc(d->items, sizeof *best);
    double *centre = sunder_i_alloc(2 * d->items, sizeof *centre), *x = sunder_i_alloc(2 * d->items, sizeof *x), value;
    bool ok = best && centre && x && begin_bundle(d) && begin_at_best(d, best, &value);
    if (ok) *larger = improve_anchors(d, best, centre, x, &value, &ok) && d->blocks > 1;
    /* If these blocks proved less than smaller ones, their trees did not end, and larger trees would not either. */
    *larger = *larger && ok && value > d->proved;
    if (ok) d->proved = sunder_i_max(d->proved, value);
    if (ok && value > *bound && d->model->rules.keep_trees) {
        sunder_i_bound_trees made = {0};
        memcpy(d->item, best, d->items * sizeof *best);
        ok = evaluate_blocks(d, &made, -INFINITY, &value);
        if (ok && value > *bound) {
            const sunder_i_bound_trees before = *trees;
            *trees = made;
            made = before;
        }
        sunder_i_bound_trees_free(&made);
    }
    if (ok) *bound = sunder_i_max(*bound, value);
    sunder_i_free_all(best, centre, x);
    sunder_i_bundle_free(&d->bundle);
    sunder_i_free_all(d->member, d->others);
    d->member = NULL;
    d->others = NULL;
    return ok;
}

sunder_status sunder_i_blocks_bound(const sunder_i_model *model, const sunder_i_waived *waived,
                                    const sunder_i_group *group, uint64_t steps, double known, double *bound,
                                    sunder_i_bound_trees *trees, sunder_error *err)
{
    sunder_i_lagrangian d = {.model = model, .waived = waived, .group = group, .most = steps, .proved = -INFINITY};
    bool ok = prepare_forces(&d), larger = true;
    *bound = known;
    for (d.size = BLOCK; ok && larger && d.steps < d.most; d.size += d.size / 2)
        ok = ask_blocks(&d, bound, trees, &larger);
    sunder_i_contact_forces_free(&d.contacts);
    sunder_i_free_all(d.weight, d.mass, d.anchor, d.home, d.count, d.item, d.first, d.pressure);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
