/* side_thread.h: does pieces of work on a second thread, one after the other, while the caller continues. */
#ifndef GIS_SIDE_THREAD_H
#define GIS_SIDE_THREAD_H

#include <stddef.h>

typedef struct gis_side_thread gis_side_thread;

/* Number of pieces that can be handed over before the first of them is done. */
enum { GIS_SIDE_THREAD_PIECES = 3 };

/* A second thread; NULL if none can be started: then the caller's thread does each piece when it is handed over. */
gis_side_thread *gis_side_thread_new(void);
/* Hands work(context) over, to be done after the earlier pieces; waits if GIS_SIDE_THREAD_PIECES pieces are unfinished.
 * Until it is known to be done, the caller must not touch what the work uses. */
void gis_side_thread_do(gis_side_thread *beside, void (*work)(void *context), void *context);
/* Waits until at most `left` pieces, the most recent ones, are unfinished; the results of all others can then be
 * read. */
void gis_side_thread_wait(gis_side_thread *beside, size_t left);
/* Waits for all pieces, and ends the thread. */
void gis_side_thread_free(gis_side_thread *beside);

#endif
