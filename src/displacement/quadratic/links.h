/* The constraints of a program in the layout that the dual methods need, which pass over them hundreds of times each:
 * the data of a constraint side by side, and the ground as one more body, of infinite mass, so that no code has to test
 * which end is the ground. Every operation is the one that quadratic.h and methods.h describe, in the same order. */
#ifndef SUNDER_I_LINKS_H
#define SUNDER_I_LINKS_H

#include "displacement/quadratic/methods.h"

typedef struct sunder_i_link {
    uint32_t i, j;        /* the ground is number `bodies` */
    double n[2], mass[2]; /* of i, of j */
} sunder_i_link;

/* x and y, which are taken together. */
typedef double sunder_i_two __attribute__((vector_size(16), aligned(8), may_alias));

/* link[p->n] */
static inline void sunder_i_links_make(const sunder_i_quadratic *p, sunder_i_link *link)
{
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        link[k] = (sunder_i_link){.i = c->i == SUNDER_I_GROUND ? (uint32_t)p->bodies : c->i,
                                  .j = c->j == SUNDER_I_GROUND ? (uint32_t)p->bodies : c->j,
                                  .n = {c->n[0], c->n[1]},
                                  .mass = {sunder_i_mass(p, c->i), sunder_i_mass(p, c->j)}};
    }
}

/* sunder_i_stretch(); t: [2 * (bodies + 1)], zero at the ground. */
static inline double sunder_i_link_stretch(const sunder_i_link *link, const double *t)
{
    const sunder_i_two *at = (const sunder_i_two *)(const void *)t, n = *(const sunder_i_two *)(const void *)link->n;
    const sunder_i_two to = n * at[link->j], from = n * at[link->i];
    return (to[0] + to[1]) - (from[0] + from[1]);
}

/* sunder_i_push(). What it does to the ground is to be undone: forces may outgrow all numbers. */
static inline void sunder_i_link_push(const sunder_i_link *link, double force, double *t)
{
    sunder_i_two *at = (sunder_i_two *)(void *)t;
    const sunder_i_two n = *(const sunder_i_two *)(const void *)link->n;
    const double on_j = link->mass[1] * force, on_i = link->mass[0] * force;
    at[link->j] += on_j * n;
    at[link->i] -= on_i * n;
}

#endif
