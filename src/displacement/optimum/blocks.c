/* A bound for a group that is too large for one tree, from overlapping blocks [Lagrangian decomposition, GK87].
 *
 * Give each block S a share w_i^S of the weights of its bodies, and each body in it a place a_i^S that it is drawn to.
 * With W_i the sum of a body's shares, less than its weight, v_i = sum of w_i^S a_i^S, c_i = sum of w_i^S |a_i^S|^2,
 *
 *     sum w |t|^2  =  sum over S of sum w^S |t - a^S|^2  +  sum over i of (w_i - W_i) |t_i|^2 + 2 t_i.v_i - c_i
 *                 >=  sum over S of opt(S)  -  sum over i of c_i + |v_i|^2 / (w_i - W_i),
 *
 * opt(S) the least that the block's bodies alone can cost so, of which its tree (tree.c) proves a bound. That holds for
 * any shares and places: so these are doubles as they come, v_i is nearly 0, and what it takes is added up against us.
 *
 * Good places make the layout's own the best for each block alone: then nothing is lost. With F_i^S the forces of the
 * block's contacts on a body (contact_forces.c), it stands still at a_i^S = t_i - F_i^S / (2 w_i^S). So blocks have to
 * hold all contacts that press, each once: they are grown from the contact that presses most and is in none yet, by the
 * body that is pressed most by those in it. Where a block finds a better place, the copies of a body drift apart; their
 * places are then drawn towards each other [subgradient, Pol69], a step at a time, while the effort lasts. */
#include "displacement/optimum/blocks.h"
#include "displacement/optimum/tree.h"
#include "displacement/optimum/tuning.h"

#include <math.h>
#include <string.h>

/* A body as a member of a block. */
typedef struct copy {
    uint32_t at; /* in the group's list */
    double share;
    double force[2], anchor[2], t[2], drift[2];
    double pull[2]; /* the mean of its drifts, of which later ones count more */
} copy;

typedef struct decomposition {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const sunder_i_group *group;
    double *weight, *mass, *anchor; /* of the group's bodies; anchors are 0 */
    sunder_i_contact_forces contacts;
    uint32_t *home;  /* [contacts] the block that holds the contact */
    uint32_t *count; /* [group] copies of each body */
    copy *item;
    size_t items, capacity;
    size_t *first; /* [blocks + 1] */
    size_t blocks, first_capacity;
    double *pressure;           /* [group] scratch */
    uint64_t steps, most, each; /* each: for the tree of a block */
} decomposition;

static bool is_mover(const decomposition *d, uint32_t at) { return d->mass[at] > 0; }

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

static bool holds(const decomposition *d, uint32_t at)
{
    for (size_t k = d->first[d->blocks]; k < d->items; k++)
        if (d->item[k].at == at) return true;
    return false;
}

static bool take(decomposition *d, uint32_t at)
{
    if (at == SUNDER_I_GROUND || holds(d, at)) return true;
    if (!sunder_i_reserve(&d->item, &d->capacity, d->items + 1, sizeof *d->item)) return false;
    d->item[d->items++] = (copy){.at = at};
    d->count[at]++;
    return true;
}

/* The body outside that the block's bodies press most, by contacts that are in no block yet; of equals the first. */
static uint32_t most_pressed(decomposition *d)
{
    const sunder_i_contact_forces *c = &d->contacts;
    uint32_t best = SUNDER_I_GROUND;
    memset(d->pressure, 0, d->group->n * sizeof *d->pressure);
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_move_cut *cut = &c->cut[k];
        if (!(c->force[k] > 0) || d->home[k] != SUNDER_I_NOBODY || cut->j == SUNDER_I_GROUND) continue;
        const bool i = holds(d, cut->i), j = holds(d, cut->j);
        if (i != j && is_mover(d, i ? cut->i : cut->j)) d->pressure[i ? cut->j : cut->i] += c->force[k];
    }
    double most = 0;
    for (uint32_t at = 0; at < d->group->n; at++) {
        if (!is_mover(d, at) || d->pressure[at] <= most) continue;
        most = d->pressure[at];
        best = at;
    }
    d->steps += c->n * (d->items - d->first[d->blocks] + 1);
    return best;
}

/* Contacts whose bodies are all in the block are its from now on; fixed ones come with them. */
static bool settle_contacts(decomposition *d)
{
    const sunder_i_contact_forces *c = &d->contacts;
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_move_cut *cut = &c->cut[k];
        if (d->home[k] != SUNDER_I_NOBODY) continue;
        const bool ground = cut->j == SUNDER_I_GROUND, moves_i = is_mover(d, cut->i),
                   moves_j = !ground && is_mover(d, cut->j);
        if ((moves_i && !holds(d, cut->i)) || (moves_j && !holds(d, cut->j)) || (!moves_i && !moves_j)) continue;
        d->home[k] = (uint32_t)d->blocks;
        if (!take(d, cut->i) || !take(d, cut->j)) return false;
    }
    return true;
}

static bool grow_block(decomposition *d, size_t seed)
{
    const sunder_i_move_cut *cut = &d->contacts.cut[seed];
    if (!sunder_i_reserve(&d->first, &d->first_capacity, d->blocks + 2, sizeof *d->first)) return false;
    d->first[d->blocks] = d->items;
    if (!take(d, cut->i) || !take(d, cut->j)) return false;
    for (size_t size = 2; size < BLOCK; size++) {
        const uint32_t next = most_pressed(d);
        if (next == SUNDER_I_GROUND) break;
        if (!take(d, next)) return false;
    }
    if (!settle_contacts(d)) return false;
    d->first[++d->blocks] = d->items;
    return true;
}

static bool make_blocks(decomposition *d)
{
    const sunder_i_contact_forces *c = &d->contacts;
    for (size_t k = 0; k < c->n; k++) d->home[k] = SUNDER_I_NOBODY;
    for (;;) {
        size_t seed = SIZE_MAX;
        for (size_t k = 0; k < c->n; k++)
            if (c->force[k] > 0 && d->home[k] == SUNDER_I_NOBODY && (seed == SIZE_MAX || c->force[k] > c->force[seed]))
                seed = k;
        d->steps += c->n;
        if (seed == SIZE_MAX) return true;
        if (!grow_block(d, seed)) return false;
    }
}

/* Shares, and the forces on each copy. */
static void share_out(decomposition *d)
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
        copy *i = &d->item[m];
        if (!is_mover(d, i->at)) continue;
        i->share = d->weight[i->at] * (1 - SPARED) / d->count[i->at];
    }
}

/* Every copy is drawn to so much of the way to where the contacts' forces hold it. */
static void draw(decomposition *d, double part)
{
    for (size_t m = 0; m < d->items; m++) {
        copy *i = &d->item[m];
        for (int e = 0; e < 2 && i->share > 0; e++)
            i->anchor[e] = part * (d->contacts.program.t[2 * i->at + (size_t)e] - i->force[e] / (2 * i->share));
    }
}

/* ---- The bound --------------------------------------------------------------------------------------------------- */

/* What places and shares take: sum of c_i + |v_i|^2 / (w_i - W_i), rounded upwards. Every sum is of at most `items`
 * terms, each with a few roundings of its own: so it is off by less than (items + 8) 2^-52 of the sum of magnitudes,
 * and twice that is added. */
static double taken(const decomposition *d)
{
    const double unit = 2 * ((double)d->items + 8) * 0x1p-52;
    double all = 0;
    for (uint32_t at = 0; at < d->group->n; at++) {
        double whole = 0, v[2] = {0, 0}, size[2] = {0, 0}, own = 0;
        if (!is_mover(d, at) || d->count[at] == 0) continue;
        for (size_t m = 0; m < d->items; m++) {
            const copy *i = &d->item[m];
            if (i->at != at) continue;
            whole += i->share;
            for (int e = 0; e < 2; e++) {
                v[e] += i->share * i->anchor[e];
                size[e] += fabs(i->share * i->anchor[e]);
                own += i->share * i->anchor[e] * i->anchor[e];
            }
        }
        const double left = d->weight[at] - whole * (1 + unit);
        if (!(left > 0)) return INFINITY;
        for (int e = 0; e < 2; e++) v[e] = fabs(v[e]) + unit * size[e];
        all += own + (v[0] * v[0] + v[1] * v[1]) / left * (1 + 0x1p-48);
    }
    return all * (1 + unit) * (1 + (double)d->group->n * 0x1p-52);
}

/* Lets the last copy of each body make v_i as near to 0 as it can. */
static void balance(decomposition *d)
{
    for (size_t m = d->items; m-- > 0;) {
        copy *last = &d->item[m];
        if (!is_mover(d, last->at)) continue;
        double sum[2] = {0, 0};
        bool is_last = true;
        for (size_t k = m + 1; k < d->items && is_last; k++) is_last = d->item[k].at != last->at;
        if (!is_last) continue;
        for (size_t k = 0; k < m; k++)
            for (int e = 0; e < 2 && d->item[k].at == last->at; e++) sum[e] += d->item[k].share * d->item[k].anchor[e];
        for (int e = 0; e < 2; e++) last->anchor[e] = -sum[e] / last->share;
    }
}

/* The bound of one block; where its bodies want to be goes to their copies. trees: NULL, or those that are kept. */
static bool ask_block(decomposition *d, size_t block, sunder_i_bound_trees *trees, double *value)
{
    const size_t n = d->first[block + 1] - d->first[block];
    copy *item = d->item + d->first[block];
    uint32_t body[MOST_IN_BLOCK];
    double weight[MOST_IN_BLOCK], anchor[2 * MOST_IN_BLOCK], cost = 0, least = INFINITY;
    *value = 0;
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
    const sunder_i_task task = {.model = d->model,
                                .waived = d->waived,
                                .body = body,
                                .n = n,
                                .weight = weight,
                                .anchor = anchor,
                                .goal = cost * (1 - OPTIMAL_SHARE),
                                .keep = trees != NULL};
    sunder_i_tree tree;
    bool ok = sunder_i_tree_init(&tree, &task);
    while (ok && sunder_i_tree_run(&tree, d->each) == SUNDER_I_TREE_FOUND && !tree.failed)
        if (tree.leaf < least) {
            least = tree.leaf;
            for (size_t k = 0; k < n; k++) memcpy(item[k].t, tree.program.t + 2 * k, sizeof item[k].t);
        }
    /* Where nothing is decided yet, what the least bound stands on. */
    if (ok && tree.opens && tree.open[0].value < fmin(least, task.goal)) {
        sunder_i_tree_load(&tree, tree.open[0].node);
        for (size_t k = 0; k < n; k++) memcpy(item[k].t, tree.program.t + 2 * k, sizeof item[k].t);
    }
    ok = ok && !tree.failed;
    if (ok) *value = sunder_i_tree_bound(&tree);
    if (ok && trees) ok = sunder_i_tree_keep(&tree, trees);
    d->steps += tree.steps;
    sunder_i_tree_free(&tree);
    return ok;
}

static bool evaluate(decomposition *d, sunder_i_bound_trees *trees, double *bound)
{
    double sum = 0;
    balance(d);
    for (size_t k = 0; k < d->blocks; k++) {
        double value;
        if (!ask_block(d, k, trees, &value)) return false;
        sum = nextafter(sum + value, -INFINITY);
    }
    *bound = nextafter(sum - taken(d), -INFINITY);
    return true;
}

/* By how much each copy wants to be elsewhere than the mean of its body's; the sum of squares. */
static double measure_drift(decomposition *d)
{
    double square = 0;
    for (size_t m = 0; m < d->items; m++) {
        copy *i = &d->item[m];
        double mean[2] = {0, 0};
        for (size_t k = 0; k < d->items; k++)
            for (int e = 0; e < 2 && d->item[k].at == i->at; e++) mean[e] += d->item[k].t[e] / d->count[i->at];
        for (int e = 0; e < 2; e++) {
            i->drift[e] = is_mover(d, i->at) ? i->t[e] - mean[e] : 0;
            square += i->drift[e] * i->drift[e];
        }
    }
    d->steps += d->items * d->items / 4;
    return square;
}

/* How far along to the forces' places is most proved? The bound is concave there, as everywhere. */
static bool begin(decomposition *d, copy *best, double *bound)
{
    static const double part[] = {0, 1, 0.5, 0.25, 0.125};
    *bound = -INFINITY;
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) {
        double value;
        draw(d, part[k]);
        if (!evaluate(d, NULL, &value)) return false;
        if (value <= *bound) continue;
        *bound = value;
        memcpy(best, d->item, d->items * sizeof *best);
        if (part[k] == 1) break;
    }
    memcpy(d->item, best, d->items * sizeof *best);
    return true;
}

/* The pull on each copy, by its last drift; the sum of squares. */
static double update_pulls(decomposition *d, double share)
{
    double square = 0;
    for (size_t m = 0; m < d->items; m++)
        for (int e = 0; e < 2; e++) {
            copy *i = &d->item[m];
            i->pull[e] = share * i->drift[e] + (1 - share) * i->pull[e];
            square += i->pull[e] * i->pull[e];
        }
    return square;
}

/* Takes the best places again; pulls stay. */
static void go_back(decomposition *d, const copy *best)
{
    for (size_t m = 0; m < d->items; m++) {
        copy *i = &d->item[m];
        const double pull[2] = {i->pull[0], i->pull[1]};
        *i = best[m];
        memcpy(i->pull, pull, sizeof pull);
    }
}

/* Draws copies together, a stride after the other; after some in vain back from the best places (`best`: copies) by
 * shorter ones. A stride goes along the mean of the last drifts, since single ones jump to and fro [CFM75]. */
static bool improve(decomposition *d, copy *best, double *bound)
{
    const double cost = d->group->cost;
    double stride = FIRST_STRIDE, now = *bound, share = 1;
    for (int vain = 0; stride > LEAST_STRIDE && d->steps < d->most && cost - *bound > BLOCKS_NEAR * cost;) {
        if (!(measure_drift(d) > 0)) break;
        const double square = update_pulls(d, share);
        if (!(square > 0)) break;
        share = DRIFT_SHARE;
        for (size_t m = 0; m < d->items; m++)
            for (int e = 0; e < 2 && d->item[m].share > 0; e++)
                d->item[m].anchor[e] -= stride * (cost - now) / square * d->item[m].pull[e] / (2 * d->item[m].share);
        if (!evaluate(d, NULL, &now)) return false;
        if (now > *bound) {
            vain = 0;
            *bound = now;
            memcpy(best, d->item, d->items * sizeof *best);
        } else if (++vain == MOST_VAIN) {
            vain = 0;
            stride /= 2;
            now = *bound;
            go_back(d, best);
        }
    }
    return true;
}

static bool prepare(decomposition *d)
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
    }
    if (!sunder_i_contact_forces_find(&d->contacts, d->model, d->waived, d->group, d->weight, d->mass, d->anchor))
        return false;
    d->steps += d->contacts.steps;
    d->home = sunder_i_alloc(d->contacts.n, sizeof *d->home);
    return d->home != NULL;
}

sunder_status sunder_i_blocks_bound(const sunder_i_model *model, const sunder_i_waived *waived,
                                    const sunder_i_group *group, uint64_t steps, double known, double *bound,
                                    sunder_i_bound_trees *trees, sunder_error *err)
{
    decomposition d = {.model = model, .waived = waived, .group = group, .most = steps};
    copy *best = NULL;
    bool ok = prepare(&d) && make_blocks(&d);
    *bound = 0;
    if (ok && d.blocks) {
        share_out(&d);
        best = sunder_i_alloc(d.items, sizeof *best);
        d.each = d.most / (ROUNDS * d.blocks);
        ok = best && begin(&d, best, bound) && improve(&d, best, bound);
        if (ok && model->rules.keep_trees && *bound > known) {
            memcpy(d.item, best, d.items * sizeof *best);
            ok = evaluate(&d, trees, bound);
        }
    }
    sunder_i_free(best);
    sunder_i_contact_forces_free(&d.contacts);
    sunder_i_free(d.weight);
    sunder_i_free(d.mass);
    sunder_i_free(d.anchor);
    sunder_i_free(d.home);
    sunder_i_free(d.count);
    sunder_i_free(d.item);
    sunder_i_free(d.first);
    sunder_i_free(d.pressure);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
