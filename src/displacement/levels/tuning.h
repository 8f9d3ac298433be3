/* These constants decide how much is cut off, and never whether a shape lies in the one before it. */
#ifndef SUNDER_I_LEVELS_TUNING_H
#define SUNDER_I_LEVELS_TUNING_H

/* The version of the values below. It is raised with each change of a value (tests/house/TUNING). */
#define SUNDER_I_LEVELS_TUNING_VERSION 1

/* ---- Trim ---- */

/* The disc of the required distance is replaced by a polygon around it with ROUND_CORNERS corners. The excess at a
 * corner is 1 / cos(pi / ROUND_CORNERS) - 1 of the distance. */
#define ROUND_CORNERS 32u

#endif
