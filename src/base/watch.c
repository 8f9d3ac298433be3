/* watch.c: whether work may continue. Watches are called from the innermost to the outermost, each by one thread at a
 * time. */
#include "base/watch.h"

_Thread_local sunder_i_thread sunder_i_this_thread;

/* If the lock is taken, the thread does not wait: the thread with the lock is calling the watch already. */
static void ask_watch(sunder_i_watch *watch)
{
    if (pthread_mutex_trylock(&watch->lock) != 0) return;
    if (!atomic_load(&watch->stopped) &&
        !(watch->go_on ? watch->go_on(watch->user) : watch->progress(watch->fraction, watch->user)))
        atomic_store(&watch->stopped, true);
    pthread_mutex_unlock(&watch->lock);
}

bool sunder_i_look(void)
{
    sunder_i_thread *t = &sunder_i_this_thread;
    t->left = 0; /* after a stop the thread looks at every step */
    for (sunder_i_watch *w = t->watch; w; w = w->outer) {
        ask_watch(w);
        if (atomic_load(&w->stopped)) return false;
    }
    t->left = SUNDER_I_STEPS;
    return true;
}

bool sunder_i_stopped(void)
{
    for (const sunder_i_watch *w = sunder_i_this_thread.watch; w; w = w->outer)
        if (atomic_load(&w->stopped)) return true;
    return false;
}

/* A function of the type sunder_progress: user is the watch. */
static bool tell_watch(double fraction, void *user)
{
    sunder_i_watch *watch = user;
    pthread_mutex_lock(&watch->lock);
    watch->fraction = fraction;
    if (!atomic_load(&watch->stopped) && !watch->progress(fraction, watch->user)) atomic_store(&watch->stopped, true);
    pthread_mutex_unlock(&watch->lock);
    return !atomic_load(&watch->stopped);
}

static void init_watch(sunder_i_watch *watch, sunder_progress progress, bool (*go_on)(void *), void *user)
{
    *watch = (sunder_i_watch){.progress = progress, .go_on = go_on, .user = user};
    pthread_mutex_init(&watch->lock, NULL);
    atomic_init(&watch->stopped, false);
}

void sunder_i_watch_begin(sunder_i_watch *watch, sunder_progress *progress, void **user)
{
    watch->progress = *progress;
    if (!*progress) return;
    init_watch(watch, *progress, NULL, *user);
    watch->outer = sunder_i_this_thread.watch;
    sunder_i_watch_join(watch);
    *progress = tell_watch;
    *user = watch;
}

void sunder_i_watch_end(sunder_i_watch *watch)
{
    if (!watch->progress) return;
    sunder_i_watch_join(watch->outer);
    pthread_mutex_destroy(&watch->lock);
}

sunder_i_watch *sunder_i_watch_here(void) { return sunder_i_this_thread.watch; }

void sunder_i_watch_join(sunder_i_watch *watch)
{
    sunder_i_this_thread.watch = watch;
    sunder_i_this_thread.left = 0;
}

void sunder_watch(bool (*go_on)(void *user), void *user)
{
    sunder_i_watch *own = &sunder_i_this_thread.own;
    if (own->go_on) pthread_mutex_destroy(&own->lock);
    own->go_on = go_on;
    if (go_on) init_watch(own, NULL, go_on, user);
    sunder_i_watch_join(go_on ? own : NULL);
}

bool sunder_i_too_many(void)
{
    sunder_i_this_thread.too_many = true;
    return false;
}

bool sunder_i_was_too_many(void)
{
    const bool was = sunder_i_this_thread.too_many;
    sunder_i_this_thread.too_many = false;
    return was;
}
