/* side_thread.h: work on a second thread, piece after piece, while the caller continues. */
#ifndef GIS_SIDE_THREAD_H
#define GIS_SIDE_THREAD_H

#include <stddef.h>

typedef struct gis_side_thread gis_side_thread;

/* As many pieces can be given before the first of them has ended. */
enum { GIS_SIDE_THREAD_PIECES = 3 };

/* NULL where there can be no other thread: then the caller's does what it is given, as it is given. */
gis_side_thread *gis_side_thread_new(void);
/* Does work(context), which is to end by itself, once what was given before has ended; waits where that is as much as
 * can be given. From here until it is known to have ended what the work uses is the work's alone. */
void gis_side_thread_do(gis_side_thread *beside, void (*work)(void *context), void *context);
/* Waits until at most `left` pieces are unfinished, the most recent ones; the output of all others can be read
 * then. */
void gis_side_thread_wait(gis_side_thread *beside, size_t left);
/* Waits for all of them, too. */
void gis_side_thread_free(gis_side_thread *beside);

#endif
