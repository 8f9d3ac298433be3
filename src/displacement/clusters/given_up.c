/* What clusters gave up, and what they found a solution for after all: their truces become the town's. */
#include "displacement/clusters/stages.h"

#include <stdlib.h>

/* Pairs that are at peace again: they are under no truce, and bodies between which none is left are not given up. */
static bool end_truces(sunder_i_town *town, const sunder_i_cluster *cluster, size_t clusters)
{
    size_t n = 0, out = 0;
    for (size_t k = 0; k < clusters; k++) n += cluster[k].ended_n;
    if (n == 0) return true;
    sunder_i_ended *ended = sunder_i_alloc(n, sizeof *ended);
    if (!ended) return false;
    n = 0;
    for (size_t k = 0; k < clusters; k++)
        for (size_t e = 0; e < cluster[k].ended_n; e++) ended[n++] = cluster[k].ended[e];
    qsort(ended, n, sizeof *ended, sunder_i_by_ended);
    sunder_i_truces_end(&town->truces, town, ended, n);
    sunder_i_free(ended);
    if (!sunder_i_truces_index(&town->truces, town)) return false;
    for (size_t k = 0; k < town->given_n; k++)
        if (sunder_i_truces_between(&town->truces, town->given[k].a, town->given[k].b))
            town->given[out++] = town->given[k];
    town->given_n = out;
    return true;
}

/* The clusters' truces, in place of what the town had for the same features; those that are not hopeless are given
 * up. */
static bool take_truces(sunder_i_town *town, const sunder_i_cluster *cluster, size_t clusters)
{
    sunder_i_truces *all = &town->truces;
    const size_t before = all->n;
    size_t n = 0, out = 0;
    for (size_t k = 0; k < clusters; k++) n += cluster[k].truces.n;
    if (n == 0) return true;
    sunder_i_couple *given = sunder_i_realloc(town->given, town->given_n + n, sizeof *given);
    if (!given) return false;
    town->given = given;
    for (size_t k = 0; k < clusters; k++)
        for (size_t t = 0; t < cluster[k].truces.n; t++) {
            sunder_i_truce truce = cluster[k].truces.item[t];
            const sunder_i_truces known = {.item = all->item, .n = before};
            const sunder_i_truce *old = sunder_i_truces_find(&known, truce.a, truce.b);
            const uint32_t i = town->body_of[truce.a], j = town->body_of[truce.b];
            if (!truce.hopeless) given[town->given_n++] = (sunder_i_couple){i < j ? i : j, i < j ? j : i};
            truce.hopeless = old ? old->hopeless : truce.hopeless;
            if (old)
                all->item[old - all->item] = truce;
            else if (!sunder_i_truces_add(all, &truce))
                return false;
        }
    qsort(given, town->given_n, sizeof *given, sunder_i_by_couple);
    for (size_t k = 0; k < town->given_n; k++)
        if (k == 0 || sunder_i_by_couple(&given[out - 1], &given[k])) given[out++] = given[k];
    town->given_n = out;
    return sunder_i_truces_index(all, town);
}

sunder_status sunder_i_job_note_truces(sunder_i_job *w, sunder_error *err)
{
    const bool ok = end_truces(&w->town, w->cluster, w->clusters) && take_truces(&w->town, w->cluster, w->clusters);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
