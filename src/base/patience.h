/* Questions in vain: of one kind, and of one cluster, so many may be asked in vain yet, and each that has an answer
 * makes good some. Where none is left, ever more pass between two that are asked. */
#ifndef SUNDER_I_PATIENCE_H
#define SUNDER_I_PATIENCE_H

#include <stdbool.h>

typedef struct sunder_i_patience {
    unsigned most, regained; /* at first, and for each answer */
    unsigned left, stride, passed;
} sunder_i_patience;

static inline sunder_i_patience sunder_i_patience_of(unsigned most, unsigned regained)
{
    return (sunder_i_patience){most, regained, most, 1, 0};
}

/* Is the next one to be asked? */
static inline bool sunder_i_patience_asks(sunder_i_patience *p)
{
    if (p->left) return true;
    if (++p->passed < p->stride) return false;
    p->passed = 0;
    return true;
}

static inline void sunder_i_patience_note(sunder_i_patience *p, bool answered)
{
    if (answered) {
        p->left = p->left + p->regained < p->most ? p->left + p->regained : p->most;
        p->stride = 1;
    } else if (p->left) {
        p->left--;
    } else {
        p->stride *= 2;
    }
}

#endif
