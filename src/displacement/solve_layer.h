/* The stages between the relations of a layer and its report. */
#ifndef SUNDER_I_SOLVE_LAYER_H
#define SUNDER_I_SOLVE_LAYER_H

#include "displacement/solve/clusters/solver.h"

/* The approximate share of the whole work that is done when the solver is prepared. */
#define SUNDER_I_PREPARED 0.1

/* Finds the moves: runs all stages, in the order of the tables. */
sunder_status sunder_i_layer_solve(sunder_i_solver *solver, sunder_error *err);

#endif
