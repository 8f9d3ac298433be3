/* The search with a gap in long double: settles nearly all. */
#include "separation/gap.h"

#include <float.h>
#include <math.h>

#define REAL long double
#define REAL_EPSILON LDBL_EPSILON
#define REAL_SQRT sqrtl
#define SEARCH sunder_i_gap_search_long

#include "separation/gap_search.inc"
