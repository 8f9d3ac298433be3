/* beside.h: one piece of work at a time on a thread of its own, beside the caller's, which goes on meanwhile. */
#ifndef GIS_BESIDE_H
#define GIS_BESIDE_H

typedef struct gis_beside gis_beside;

/* NULL where there can be no other thread: then the caller's does what it is given, as it is given. */
gis_beside *gis_beside_new(void);
/* Does work(context), which is to end by itself, once what was given before has ended. Between this and
 * gis_beside_wait() what the work uses is the work's alone. */
void gis_beside_do(gis_beside *beside, void (*work)(void *context), void *context);
/* Until nothing that was given is left to do; what the work wrote can be read then. */
void gis_beside_wait(gis_beside *beside);
/* Waits, too. */
void gis_beside_free(gis_beside *beside);

#endif
