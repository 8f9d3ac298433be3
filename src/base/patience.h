/* patience.h: a limit for the number of tests of one kind, in one cluster, that fail. A successful test restores part
 * of it. When the patience is used up, only every `stride`-th test is made, and each one that fails doubles the
 * stride. */
#ifndef SUNDER_I_PATIENCE_H
#define SUNDER_I_PATIENCE_H

#include <stdbool.h>

typedef struct sunder_i_patience {
    unsigned most, regained; /* the initial patience, and the part restored by each success */
    unsigned left, stride, passed;
} sunder_i_patience;

static inline sunder_i_patience sunder_i_patience_of(unsigned most, unsigned regained)
{
    return (sunder_i_patience){most, regained, most, 1, 0};
}

/* Returns true if the next test is to be made. */
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
