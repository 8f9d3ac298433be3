/* digests_read.c: see write/sink/digest.h. Compares the features that are read with those that were sent. */
#include "write/sink/digest.h"

#include "base/array.h"

#include <string.h>

static bool is_next(const gis_digests_read *read, gis_digests *all, gis_digest one, bool *same, gis_error *error)
{
    gis_digest sent;
    *same = read->n < all->sent.n;
    if (!*same) return true;
    if (!gis_digest_list_get(&all->sent, read->n, &sent, error)) return false;
    *same = sent.place == one.place && (!all->values_comparable || sent.values == one.values);
    return true;
}

/* Called at the first difference: copies the hashes of the features read until now, which equal the first ones that
 * were sent, into the list of those read. */
static bool part_ways(gis_digests_read *read, gis_digests *all, gis_error *error)
{
    if (!gis_digest_list_hold(&all->sent, read->n, error)) return false;
    if (!gis_array_reserve(&read->at, &read->capacity, read->n + 1, sizeof *read->at)) return gis_no_memory(error);
    if (read->n) memcpy(read->at, all->sent.at, read->n * sizeof *read->at);
    read->differ = true;
    return true;
}

/* Features usually come back in the order in which they were sent; as long as they do, nothing is stored and nothing
 * has to be sorted. */
bool gis_digests_read_add(gis_digests_read *read, gis_digests *all, gis_digest one, gis_error *error)
{
    bool same = false;
    if (!read->differ && !is_next(read, all, one, &same, error)) return false;
    if (!read->differ && !same && !part_ways(read, all, error)) return false;
    if (read->differ) {
        if (!gis_array_reserve(&read->at, &read->capacity, read->n + 1, sizeof *read->at)) return gis_no_memory(error);
        read->at[read->n] = one;
    }
    read->n++;
    return true;
}
