/* sunder_base.h: what all functions of the library share: status codes and errors, memory, progress, and how structs of
 * options grow. Part of sunder.h, which states the conventions. */
#ifndef SUNDER_BASE_H
#define SUNDER_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32) || !defined(__GNUC__)
#define SUNDER_API
#else
#define SUNDER_API __attribute__((visibility("default")))
#endif
#define SUNDER_EXPERIMENTAL SUNDER_API

/* ---- Status and errors ------------------------------------------------------------------------------------ */

typedef enum sunder_status {
    SUNDER_OK = 0,
    SUNDER_EINVALID, /* a geometry breaks a rule; the error names the polygon, ring and vertex */
    SUNDER_EARG,     /* an option or argument is out of its range */
    SUNDER_ERANGE,   /* doubles cannot hold the result */
    SUNDER_ENOMEM,   /* an allocation failed; everything made so far has been released */
    SUNDER_ECANCEL,  /* a progress callback, or the watch of the thread, asked to stop */
    SUNDER_ESIZE,    /* there are more vertices, pairs of convex pieces, or corners of a sum than can be numbered */
    SUNDER_EFAULT    /* the result failed the library's own exact check, and is withheld; this is a defect to report */
} sunder_status;

#define SUNDER_MESSAGE_MAX 256

typedef struct sunder_error {
    sunder_status status;
    size_t polygon, ring, vertex; /* the place of the error, counted from 0; SIZE_MAX for what does not apply */
    char message[SUNDER_MESSAGE_MAX];
} sunder_error;

/* Returns a fixed sentence for each code; never NULL. */
SUNDER_API const char *sunder_status_string(sunder_status status);

/* Returns the version of the library: the SUNDER_VERSION that it was built with. */
SUNDER_API const char *sunder_version(void);

/* Returns the version of the GMP that the library runs with. It need not be the version that it was built with. */
SUNDER_API const char *sunder_gmp_version(void);

/* Sets the three functions through which the library allocates and frees all memory. NULL for all three restores
 * malloc, realloc and free. Call it before any other function, and never while an object of the library exists. */
SUNDER_API void sunder_set_allocator(void *(*allocate)(size_t), void *(*reallocate)(void *, size_t),
                                     void (*release)(void *));

/* Frees a text or an array that a function of the library allocated for the caller. */
SUNDER_API void sunder_free(void *memory);

/* The numbers of elementary operations that were done, of the kinds that the literature counts [AFH00, section 3]. */
typedef struct sunder_counts {
    uint64_t comparisons;           /* comparisons of two points, or of two crossings along a line */
    uint64_t orientation_tests;     /* decisions about the side of a line on which a point lies */
    uint64_t segment_intersections; /* crossing points that were constructed */
    uint64_t exact_fallbacks;       /* decisions that the floating-point filter left to exact arithmetic */
} sunder_counts;

/* A progress callback. It is called with the fraction of the work that is done, in [0, 1], often with the same fraction
 * again. If it returns false, the function that called it fails with SUNDER_ECANCEL. Calls do not overlap, but if
 * threads share the work they may come from any of these threads. At most some milliseconds of work lie between two
 * calls, and between a false result and the return of the function (tests count it). */
typedef bool (*sunder_progress)(double fraction, void *user);

/* Sets the watch of the calling thread, which can also stop functions that take no progress callback; NULL removes it.
 * Every function of this library that the thread calls then calls go_on(user) as often as a progress callback. Once
 * go_on has returned false, that function fails with SUNDER_ECANCEL, and so does every later function that can be
 * stopped, at once, until the thread sets another watch or removes it. Calls of go_on do not overlap, but they may come
 * from threads that the library started on behalf of the calling thread. */
SUNDER_API void sunder_watch(bool (*go_on)(void *user), void *user);

/* ---- Options ------------------------------------------------------------------------------------------------ */

/* A struct of options begins with its size, so that a later version can add members at its end. The library reads as
 * many bytes as `size` says. Members of the library's struct beyond these bytes have their defaults. If the caller's
 * struct is longer than the library's, the bytes beyond the library's struct must be 0.
 *
 * The _init function of a struct sets `size` and the defaults. It is inline, so it uses the size that the struct has in
 * the caller's header. Other languages call the _init_sized function, which the library exports. NULL in place of
 * options means the defaults.
 *
 * Fails  SUNDER_EARG  `size` is 0, no multiple of sizeof(size_t), or above SUNDER_OPTIONS_MAX; or a byte beyond the
 *                     library's own struct is not 0. */
#define SUNDER_OPTIONS_MAX 4096

#ifdef __cplusplus
}
#endif
#endif
