/* The constraints of a program in the layout that the dual methods need, which pass over them hundreds of times. The
 * data of a constraint are consecutive, and the ground is one more body, of infinite mass, so that no code has to test
 * which end is the ground. Each operation is the one described in quadratic.h and methods.h, in the same order. */
#ifndef SUNDER_I_LINKS_H
#define SUNDER_I_LINKS_H

#include "displacement/quadratic/methods.h"

typedef struct sunder_i_link {
    uint32_t i, j;        /* the two bodies; the ground has the number `bodies` */
    double n[2], mass[2]; /* the normal; the masses of i and of j */
} sunder_i_link;

/* A vector of x and y, which are processed together. */
typedef double sunder_i_two __attribute__((vector_size(16), aligned(8), may_alias));

/* Fills link[0 .. p->n - 1] with the constraints of p. */
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

/* Computes what sunder_i_stretch() does, for a link. t: [2 * (bodies + 1)], zero for the ground. */
static inline double sunder_i_link_stretch(const sunder_i_link *link, const double *t)
{
    const sunder_i_two *at = (const sunder_i_two *)(const void *)t, n = *(const sunder_i_two *)(const void *)link->n;
    const sunder_i_two to = n * at[link->j], from = n * at[link->i];
    return (to[0] + to[1]) - (from[0] + from[1]);
}

/* Does what sunder_i_push() does, for a link. It also moves the ground; the caller has to set the ground's move to zero
 * again, and not to subtract, since forces may overflow. */
static inline void sunder_i_link_push(const sunder_i_link *link, double force, double *t)
{
    sunder_i_two *at = (sunder_i_two *)(void *)t;
    const sunder_i_two n = *(const sunder_i_two *)(const void *)link->n;
    const double on_j = link->mass[1] * force, on_i = link->mass[0] * force;
    at[link->j] += on_j * n;
    at[link->i] -= on_i * n;
}

#endif
