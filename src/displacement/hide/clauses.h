/* Clauses: sets of features that cannot all keep their levels. */
#ifndef SUNDER_I_CLAUSES_H
#define SUNDER_I_CLAUSES_H

#include "base/list.h"

/* At least one member of a clause needs a greater level than the one that the clause has for it. The level of a feature
 * is 0 with its shape as given, and greater with smaller shapes; with the last level it may be hidden. */
typedef struct sunder_i_clause {
    size_t first, n; /* its members in sunder_i_clauses.item, ascending */
    size_t others;   /* after these, the other things of its proof, which have no greater level; ascending */
    bool proved;     /* there is a proof that with these levels all members together have no solution; otherwise none
                      * was found yet */
} sunder_i_clause;

/* A list of clauses. A struct of zeros is an empty list. */
typedef struct sunder_i_clauses {
    uint32_t *item, *level; /* [items] the level of each member; 0 for other things */
    size_t items, item_room, level_room;
    sunder_i_clause *clause;
    size_t n, room;
    uint32_t *slot; /* [slots, a power of two, or 0] a hash table: the number of a clause + 1, or 0 */
    size_t slots;
} sunder_i_clauses;

/* Adds a clause of n features, followed by other things, unless the list has a clause of the same features with the
 * same levels that is proved or, if the new one is not proved, any such clause. Sets *added to whether the list has
 * changed. Returns false if memory is out. */
bool sunder_i_clauses_add(sunder_i_clauses *clauses, const uint32_t *item, const uint32_t *level, size_t n,
                          size_t others, bool proved, bool *added);
void sunder_i_clauses_free(sunder_i_clauses *clauses);

#endif
