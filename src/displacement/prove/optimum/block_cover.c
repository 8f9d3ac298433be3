/* Divides a group into blocks: sets of a few bodies that together contain all contacts with a force, each contact in
 * one block.
 *
 * A block starts from the contact with the greatest force that is in no block yet, and grows by the body on which its
 * bodies exert the greatest force. */
#include "displacement/prove/optimum/blocks.h"

#include <string.h>

static bool holds_body(const sunder_i_lagrangian *d, uint32_t at)
{
    for (size_t k = d->first[d->blocks]; k < d->items; k++)
        if (d->item[k].at == at) return true;
    return false;
}

static bool take_body(sunder_i_lagrangian *d, uint32_t at)
{
    if (at == SUNDER_I_GROUND || holds_body(d, at)) return true;
    if (!sunder_i_reserve(&d->item, &d->capacity, d->items + 1, sizeof *d->item)) return false;
    d->item[d->items++] = (sunder_i_block_copy){.at = at};
    d->count[at]++;
    return true;
}

/* Returns the place in the group's list of the movable body outside the block with the greatest sum of forces from the
 * block's movable bodies, over contacts that are in no block yet; the first of equal ones. Returns SUNDER_I_GROUND if
 * no force acts on such a body. */
static uint32_t most_pressed(sunder_i_lagrangian *d)
{
    const sunder_i_contact_forces *c = &d->contacts;
    uint32_t best = SUNDER_I_GROUND;
    memset(d->pressure, 0, d->group->n * sizeof *d->pressure);
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_move_cut *cut = &c->cut[k];
        if (!(c->force[k] > 0) || d->home[k] != SUNDER_I_NOBODY || cut->j == SUNDER_I_GROUND) continue;
        const bool i = holds_body(d, cut->i), j = holds_body(d, cut->j);
        if (i != j && sunder_i_is_mover_of(d, i ? cut->i : cut->j)) d->pressure[i ? cut->j : cut->i] += c->force[k];
    }
    double most = 0;
    for (uint32_t at = 0; at < d->group->n; at++) {
        if (!sunder_i_is_mover_of(d, at) || d->pressure[at] <= most) continue;
        most = d->pressure[at];
        best = at;
    }
    d->steps += c->n * (d->items - d->first[d->blocks] + 1);
    return best;
}

/* Assigns to the block all contacts whose movable bodies are in it; fixed bodies of such contacts become members.
 * Returns false if memory is out. */
static bool settle_contacts(sunder_i_lagrangian *d)
{
    const sunder_i_contact_forces *c = &d->contacts;
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_move_cut *cut = &c->cut[k];
        if (d->home[k] != SUNDER_I_NOBODY) continue;
        const bool ground = cut->j == SUNDER_I_GROUND, moves_i = sunder_i_is_mover_of(d, cut->i),
                   moves_j = !ground && sunder_i_is_mover_of(d, cut->j);
        if ((moves_i && !holds_body(d, cut->i)) || (moves_j && !holds_body(d, cut->j)) || (!moves_i && !moves_j))
            continue;
        d->home[k] = (uint32_t)d->blocks;
        if (!take_body(d, cut->i) || !take_body(d, cut->j)) return false;
    }
    return true;
}

static bool grow_block(sunder_i_lagrangian *d, size_t seed)
{
    const sunder_i_move_cut *cut = &d->contacts.cut[seed];
    if (!sunder_i_reserve(&d->first, &d->first_capacity, d->blocks + 2, sizeof *d->first)) return false;
    d->first[d->blocks] = d->items;
    if (!take_body(d, cut->i) || !take_body(d, cut->j)) return false;
    for (size_t size = 2; size < d->size; size++) {
        const uint32_t next = most_pressed(d);
        if (next == SUNDER_I_GROUND) break;
        if (!take_body(d, next)) return false;
    }
    if (!settle_contacts(d)) return false;
    d->first[++d->blocks] = d->items;
    return true;
}

bool sunder_i_make_blocks(sunder_i_lagrangian *lagrangian)
{
    const sunder_i_contact_forces *c = &lagrangian->contacts;
    for (size_t k = 0; k < c->n; k++) lagrangian->home[k] = SUNDER_I_NOBODY;
    for (;;) {
        size_t seed = SIZE_MAX;
        for (size_t k = 0; k < c->n; k++)
            if (c->force[k] > 0 && lagrangian->home[k] == SUNDER_I_NOBODY &&
                (seed == SIZE_MAX || c->force[k] > c->force[seed]))
                seed = k;
        lagrangian->steps += c->n;
        if (seed == SIZE_MAX) return true;
        if (!grow_block(lagrangian, seed)) return false;
    }
}
