/* A list of clauses without repetitions. */
#include "displacement/hide/clauses.h"

#include "base/mix.h"

#include <string.h>

/* Returns the slot of the clause that has exactly these features and levels; an empty slot if there is no such clause.
 * The table always has an empty slot. */
static uint32_t *find_slot(const sunder_i_clauses *clauses, const uint32_t *member, const uint32_t *level, size_t n)
{
    uint64_t hash = 0;
    for (size_t m = 0; m < n; m++) hash = sunder_i_mix(sunder_i_mix(hash, member[m]), level[m]);
    for (size_t k = (size_t)(hash >> 32);; k++) {
        uint32_t *slot = &clauses->slot[k & (clauses->slots - 1)];
        if (*slot == 0) return slot;
        const sunder_i_clause *c = &clauses->clause[*slot - 1];
        if (c->n == n && (n == 0 || (memcmp(clauses->item + c->first, member, n * sizeof *member) == 0 &&
                                     memcmp(clauses->level + c->first, level, n * sizeof *level) == 0)))
            return slot;
    }
}

/* Keeps at least half of the table empty with one more clause. Returns false if memory is out. */
static bool reserve_slot(sunder_i_clauses *clauses)
{
    if (2 * (clauses->n + 1) <= clauses->slots) return true;
    const size_t slots = clauses->slots ? 2 * clauses->slots : 16;
    uint32_t *slot = sunder_i_calloc(slots, sizeof *slot);
    if (!slot) return false;
    sunder_i_free(clauses->slot);
    clauses->slot = slot;
    clauses->slots = slots;
    for (size_t k = 0; k < clauses->n; k++) {
        const sunder_i_clause *c = &clauses->clause[k];
        *find_slot(clauses, clauses->item + c->first, clauses->level + c->first, c->n) = (uint32_t)(k + 1);
    }
    return true;
}

bool sunder_i_clauses_add(sunder_i_clauses *clauses, const uint32_t *item, const uint32_t *level, size_t n,
                          size_t others, bool proved, bool *added)
{
    *added = false;
    if (!reserve_slot(clauses)) return false;
    uint32_t *slot = find_slot(clauses, item, level, n);
    if (*slot && (clauses->clause[*slot - 1].proved || !proved)) return true;
    if (!sunder_i_reserve(&clauses->clause, &clauses->room, clauses->n + 1, sizeof *clauses->clause) ||
        !sunder_i_reserve(&clauses->item, &clauses->item_room, clauses->items + n + others, sizeof *item) ||
        !sunder_i_reserve(&clauses->level, &clauses->level_room, clauses->items + n + others, sizeof *level))
        return false;
    if (*slot == 0) *slot = (uint32_t)++clauses->n;
    clauses->clause[*slot - 1] = (sunder_i_clause){clauses->items, n, others, proved};
    if (n + others) memcpy(clauses->item + clauses->items, item, (n + others) * sizeof *item);
    if (n + others) memset(clauses->level + clauses->items, 0, (n + others) * sizeof *level);
    if (n) memcpy(clauses->level + clauses->items, level, n * sizeof *level);
    clauses->items += n + others;
    *added = true;
    return true;
}

void sunder_i_clauses_free(sunder_i_clauses *clauses)
{
    sunder_i_free_all(clauses->item, clauses->level, clauses->clause, clauses->slot);
    memset(clauses, 0, sizeof *clauses);
}
