/* side_thread.c: see side_thread.h. */
#include "base/side_thread.h"

#include <cpl_error.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct piece {
    void (*work)(void *context);
    void *context;
} piece;

struct gis_side_thread {
    pthread_t thread;
    pthread_mutex_t lock; /* protects the members that follow */
    pthread_cond_t changed;
    piece left[GIS_SIDE_THREAD_PIECES]; /* pieces to be done, in order */
    size_t n;
    bool end;
};

/* Does the pieces of work one by one, without holding the lock; a piece stays in the list until it is done. GDAL's
 * messages on this thread are suppressed, since the results of the work tell the same. */
static void *do_pieces(void *argument)
{
    gis_side_thread *b = argument;
    CPLPushErrorHandler(CPLQuietErrorHandler);
    pthread_mutex_lock(&b->lock);
    while (!b->end || b->n > 0) {
        if (b->n == 0) {
            pthread_cond_wait(&b->changed, &b->lock);
            continue;
        }
        const piece first = b->left[0];
        pthread_mutex_unlock(&b->lock);
        first.work(first.context);
        pthread_mutex_lock(&b->lock);
        b->n--;
        memmove(b->left, b->left + 1, b->n * sizeof *b->left);
        pthread_cond_broadcast(&b->changed);
    }
    pthread_mutex_unlock(&b->lock);
    CPLPopErrorHandler();
    return NULL;
}

gis_side_thread *gis_side_thread_new(void)
{
    gis_side_thread *b = calloc(1, sizeof *b);
    if (!b) return NULL;
    pthread_mutex_init(&b->lock, NULL);
    pthread_cond_init(&b->changed, NULL);
    if (pthread_create(&b->thread, NULL, do_pieces, b) == 0) return b;
    pthread_cond_destroy(&b->changed);
    pthread_mutex_destroy(&b->lock);
    free(b);
    return NULL;
}

void gis_side_thread_do(gis_side_thread *beside, void (*work)(void *context), void *context)
{
    if (!beside) {
        work(context);
        return;
    }
    gis_side_thread_wait(beside, GIS_SIDE_THREAD_PIECES - 1);
    pthread_mutex_lock(&beside->lock);
    beside->left[beside->n++] = (piece){work, context};
    pthread_cond_broadcast(&beside->changed);
    pthread_mutex_unlock(&beside->lock);
}

void gis_side_thread_wait(gis_side_thread *beside, size_t left)
{
    if (!beside) return;
    pthread_mutex_lock(&beside->lock);
    while (beside->n > left) pthread_cond_wait(&beside->changed, &beside->lock);
    pthread_mutex_unlock(&beside->lock);
}

void gis_side_thread_free(gis_side_thread *beside)
{
    if (!beside) return;
    pthread_mutex_lock(&beside->lock);
    beside->end = true;
    pthread_cond_broadcast(&beside->changed);
    pthread_mutex_unlock(&beside->lock);
    pthread_join(beside->thread, NULL);
    pthread_cond_destroy(&beside->changed);
    pthread_mutex_destroy(&beside->lock);
    free(beside);
}
