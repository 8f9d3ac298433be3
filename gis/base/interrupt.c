/* interrupt.c: see interrupt.h. A signal handler may call few functions, and may interrupt the program anywhere. So it
 * sets a flag that all work polls; for work that does not poll, it removes the files in a list that is changed only
 * while signals are blocked. */
#define _GNU_SOURCE
#include "base/interrupt.h"

#include "base/remove_tree.h"
#include "sunder.h"

#include <cpl_conv.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Seconds in which work that does not poll may end by itself. */
enum { PATIENCE = 1 };

struct gis_leftover {
    char *path, *back_to; /* back_to: path to which `path` is moved back, or NULL */
    gis_outcome stays;    /* `path` is kept from this outcome on; GIS_OPEN: it is always removed */
    gis_leftover *next;
};

/* Global variables, since a signal handler gets no argument. */
static atomic_int interrupted, outcome, told;
static gis_leftover *leftovers;
static pthread_t main_thread;
static int held;
static const char *volatile last_words = "";
static volatile sig_atomic_t log_file = -1;

/* ---- In the handler ---------------------------------------------------------------------------------------------- */

static void clear_away(void)
{
    int now = atomic_load(&outcome);
    for (const gis_leftover *each = leftovers; each; each = each->next) {
        if (each->back_to && now != GIS_DECIDED)
            (void)!rename(each->path, each->back_to);
        else if (each->stays == GIS_OPEN || now < (int)each->stays)
            gis_remove_tree(each->path);
    }
}

/* Called if no work polled the flag in time. If the output is being put in place at that moment, it waits again, and
 * the new output stays. */
static void lose_patience(void)
{
    if (atomic_load(&outcome) == GIS_DECIDING) alarm(PATIENCE);
    if (atomic_load(&outcome) != GIS_OPEN) return;
    clear_away();
    if (!atomic_load(&told)) {
        (void)!write(STDERR_FILENO, last_words, strlen(last_words));
        if (log_file >= 0) (void)!write(log_file, last_words, strlen(last_words));
    }
    _exit(atomic_load(&told) ? atomic_load(&told) : GIS_FAILED);
}

static void end_at_once(int number)
{
    sigset_t this_one;
    clear_away();
    signal(number, SIG_DFL);
    sigemptyset(&this_one);
    sigaddset(&this_one, number);
    raise(number);
    pthread_sigmask(SIG_UNBLOCK, &this_one, NULL);
}

/* The signal of a process limit is raised again at each write, or each second; such a repetition does not count as a
 * second signal. */
static bool is_limit(int number) { return number == SIGXFSZ || number == SIGXCPU; }

static void handle_signal(int number)
{
    int reason = errno;
    if (!pthread_equal(pthread_self(), main_thread))
        pthread_kill(main_thread, number);
    else if (number == SIGALRM)
        lose_patience();
    else if (!atomic_exchange(&interrupted, number))
        alarm(PATIENCE);
    else if (!is_limit(number))
        end_at_once(number);
    errno = reason;
}

/* The signals that end a run. SIGHUP: the terminal was closed, or the machine shuts down. SIGXFSZ, SIGXCPU: a file, or
 * the CPU time, has reached the limit of the process (setrlimit(2)). */
static const int requests[] = {SIGHUP, SIGXFSZ, SIGXCPU, SIGINT, SIGTERM};
enum { N_REQUESTS = sizeof requests / sizeof *requests };

static sigset_t all_of_them(void)
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGALRM);
    for (int k = 0; k < N_REQUESTS; k++) sigaddset(&set, requests[k]);
    return set;
}

/* ---- Outside ----------------------------------------------------------------------------------------------------- */

/* Installs the handler. Without SA_RESTART, so that blocking reads and writes are interrupted. */
static void catch_signal(int number)
{
    const struct sigaction action = {.sa_handler = handle_signal, .sa_mask = all_of_them()};
    sigaction(number, &action, NULL);
}

/* Did the parent process choose to ignore the signal? nohup(1) ignores SIGHUP so that the run survives its terminal; a
 * limit may be ignored so that the system call reports it. */
static bool is_to_be_ignored(int number)
{
    struct sigaction now;
    if (number == SIGINT || number == SIGTERM) return false;
    return sigaction(number, NULL, &now) == 0 && now.sa_handler == SIG_IGN;
}

void gis_catch_signals(void)
{
    main_thread = pthread_self();
    catch_signal(SIGALRM);
    for (int k = 0; k < N_REQUESTS; k++)
        if (!is_to_be_ignored(requests[k])) catch_signal(requests[k]);
    gis_watch();
}

bool gis_interrupted(void)
{
    return atomic_load_explicit(&interrupted, memory_order_relaxed) && atomic_load(&outcome) == GIS_OPEN;
}

const char *gis_interruption(void)
{
    switch (atomic_load(&interrupted)) {
    case SIGXFSZ: return GIS_INTERRUPTED ": a file would exceed the size limit of this process (ulimit -f)";
    case SIGXCPU: return GIS_INTERRUPTED ": the time limit of this process is reached (ulimit -t)";
    default: return GIS_INTERRUPTED;
    }
}

static bool go_on(void *user)
{
    (void)user;
    return !gis_interrupted();
}

void gis_watch(void) { sunder_watch(go_on, NULL); }

void gis_hold(void)
{
    sigset_t set = all_of_them();
    if (held++ == 0) pthread_sigmask(SIG_BLOCK, &set, NULL);
}

void gis_release(void)
{
    sigset_t set = all_of_them();
    if (--held == 0) pthread_sigmask(SIG_UNBLOCK, &set, NULL);
}

void gis_set_outcome(gis_outcome now) { atomic_store(&outcome, (int)now); }

static gis_leftover *add_leftover(const char *path, const char *back_to, gis_outcome stays)
{
    gis_leftover *leftover = CPLCalloc(1, sizeof *leftover);
    leftover->path = CPLStrdup(path);
    leftover->back_to = back_to ? CPLStrdup(back_to) : NULL;
    leftover->stays = stays;
    gis_hold();
    leftover->next = leftovers;
    leftovers = leftover;
    gis_release();
    return leftover;
}

gis_leftover *gis_leftover_temporary(const char *path) { return add_leftover(path, NULL, GIS_OPEN); }

gis_leftover *gis_leftover_until(gis_outcome outcome_then, const char *path)
{
    return add_leftover(path, NULL, outcome_then);
}

gis_leftover *gis_leftover_former(const char *path, const char *back_to)
{
    return add_leftover(path, back_to, GIS_OPEN);
}

void gis_leftover_forget(gis_leftover *leftover)
{
    if (!leftover) return;
    gis_hold();
    gis_leftover **at = &leftovers;
    while (*at != leftover) at = &(*at)->next;
    *at = leftover->next;
    gis_release();
    CPLFree(leftover->path);
    CPLFree(leftover->back_to);
    CPLFree(leftover);
}

void gis_set_last_words(const char *words, int log)
{
    last_words = words;
    log_file = log;
}

void gis_failure_told(int exit_status) { atomic_store(&told, exit_status); }
