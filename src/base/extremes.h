/* extremes.h: the lesser and the greater of two numbers; of a number and NaN these functions return the number. They
 * replace fmin() and fmax(), which are library calls: about two hundred for each feature of a town. */
#ifndef SUNDER_I_EXTREMES_H
#define SUNDER_I_EXTREMES_H

static inline double sunder_i_min(double a, double b) { return a < b || b != b ? a : b; }
static inline double sunder_i_max(double a, double b) { return a > b || b != b ? a : b; }

/* The same for two numbers that are not NaN, in half the instructions. */
static inline double sunder_i_lesser(double a, double b) { return a < b ? a : b; }
static inline double sunder_i_greater(double a, double b) { return a > b ? a : b; }

#endif
