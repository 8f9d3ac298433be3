/* The lesser and the greater of two numbers, neither of which is NaN. fmin() and fmax(), which ask about that, are
 * calls into a library, some two hundred for each feature of a town; and no loop with one in it is made of vector
 * instructions. */
#ifndef SUNDER_I_EXTREMES_H
#define SUNDER_I_EXTREMES_H

static inline double sunder_i_min(double a, double b) { return b < a ? b : a; }
static inline double sunder_i_max(double a, double b) { return b > a ? b : a; }

#endif
