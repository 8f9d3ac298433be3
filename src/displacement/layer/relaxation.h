/* Pairs that are left in conflict, and what is demanded of them instead; see relaxation.c. */
#ifndef SUNDER_I_RELAXATION_H
#define SUNDER_I_RELAXATION_H

#include "base/list.h"
#include "sunder.h"
#include <stdbool.h>

typedef struct sunder_i_town sunder_i_town;

/* A pair of features, a < b, that is left in conflict, and what is demanded of it instead of peace: that b + shift keep
 * `gap` from a; or that the one stay inside the other. See truce.c. */
typedef struct sunder_i_truce {
    uint32_t a, b;
    double shift[2], gap;
    bool inside;
    bool hopeless; /* no moves within the limits make peace, which was proved; else the search gave up */
} sunder_i_truce;

/* Bodies i < j with n truces between members of theirs; no shift is longer than `reach`. */
typedef struct sunder_i_torn {
    uint32_t i, j;
    double reach;
    size_t n;
} sunder_i_torn;

/* A truce that does not count any longer: of these bodies, i < j, and these features, a < b. */
typedef struct sunder_i_ended {
    sunder_i_couple body, feature;
} sunder_i_ended;

typedef struct sunder_i_truces {
    sunder_i_truce *item; /* sorted, as `torn` is, by sunder_i_truces_index() */
    size_t n, capacity;
    sunder_i_torn *torn;
    size_t torn_n, torn_capacity;
} sunder_i_truces;

void sunder_i_truces_free(sunder_i_truces *truces);
/* Appends one; to be indexed before anything is looked up. False if memory is out. */
bool sunder_i_truces_add(sunder_i_truces *truces, const sunder_i_truce *truce);
bool sunder_i_truces_index(sunder_i_truces *truces, const sunder_i_town *town);
/* The truce of two features, or between members of two bodies; NULL: there is none. */
const sunder_i_truce *sunder_i_truces_find(const sunder_i_truces *truces, uint32_t f, uint32_t g);
const sunder_i_torn *sunder_i_truces_between(const sunder_i_truces *truces, uint32_t body, uint32_t other);
/* One more, or one less, of truces that stay indexed. */
bool sunder_i_truces_insert(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_truce *truce);
void sunder_i_truces_remove(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_truce *truce);
/* Those that were ended, n of them, sorted, are no more; to be indexed again. */
void sunder_i_truces_end(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_ended *ended, size_t n);
/* Where it is, or belongs, among n of them, sorted. */
size_t sunder_i_ended_at(const sunder_i_ended *list, size_t n, const sunder_i_ended *wanted);
int sunder_i_by_ended(const void *a, const void *b);
sunder_i_ended sunder_i_ended_of(const sunder_i_town *town, const sunder_i_truce *truce);
/* A truce for two features, by how they stood at the start. */
sunder_status sunder_i_truce_of(const sunder_i_town *town, uint32_t f, uint32_t g, sunder_i_truce *out,
                                sunder_error *err);
/* Appends truces for all members of two bodies that stood within reach of each other. */
sunder_status sunder_i_truces_make(const sunder_i_town *town, uint32_t body, uint32_t other, double reach,
                                   sunder_i_truces *out, sunder_error *err);
/* By how much `of_j`, one of its features, is shifted before it is measured; returns the distance it then keeps. */
double sunder_i_truce_shift(const sunder_i_truce *truce, uint32_t of_j, double shift[2]);

#endif
