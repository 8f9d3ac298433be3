/* Least squares under linear constraints, for the nodes of optimum.c: min sum weight |t - p|^2, n.(t_b - t_a) >= h. */
#ifndef SUNDER_TESTS_OPTIMUM_DUAL_H
#define SUNDER_TESTS_OPTIMUM_DUAL_H

#include "optimum.h"

enum { OPTIMUM_ROWS = 512, OPTIMUM_NOBODY = OPTIMUM_BODIES };

typedef struct optimum_row {
    size_t a, b; /* bodies, or OPTIMUM_NOBODY, which is fixed */
    double n[2], h;
} optimum_row;

typedef enum optimum_verdict { OPTIMUM_SOLVED, OPTIMUM_INFEASIBLE, OPTIMUM_STUCK } optimum_verdict;

typedef struct optimum_solution {
    double t[2 * (OPTIMUM_BODIES + 1)]; /* 0 for fixed ones */
    double cost, bound;                 /* the bound is valid for any solution */
} optimum_solution;

/* For an infeasible program the bound is at least `enough`; otherwise the result is OPTIMUM_STUCK. */
optimum_verdict optimum_solve(const optimum_problem *m, const optimum_row *given, size_t n, double enough,
                              optimum_solution *s);

#endif
