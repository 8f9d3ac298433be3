/* The lesser and the greater of two numbers; of a number and NaN the number. They are what fmin() and fmax() are, which
 * are calls into a library, some two hundred for each feature of a town. */
#ifndef SUNDER_I_EXTREMES_H
#define SUNDER_I_EXTREMES_H

static inline double sunder_i_min(double a, double b) { return a < b || b != b ? a : b; }
static inline double sunder_i_max(double a, double b) { return a > b || b != b ? a : b; }

/* The same of two numbers of which neither is NaN, in half of the instructions. */
static inline double sunder_i_lesser(double a, double b) { return a < b ? a : b; }
static inline double sunder_i_greater(double a, double b) { return a > b ? a : b; }

#endif
