/* Memory: the allocation hooks, and arenas on top of them.
 *
 * Nothing in the library calls malloc itself. Long-lived arrays come from sunder_i_alloc() and friends, which return
 * NULL when memory is out; memory that lives as long as one computation comes from an arena. An arena remembers a
 * failed allocation (`failed`) and from then on returns NULL, so that a stage of many small allocations is checked
 * once, at its end. A thread that is to stop is refused memory, too (watch.h). */
#ifndef SUNDER_I_MEMORY_H
#define SUNDER_I_MEMORY_H

#include "base/error.h"
#include "sunder.h"

/* n * size bytes, uninitialised; NULL if that overflows or memory is out. n * size == 0 gives a valid pointer. */
void *sunder_i_alloc(size_t n, size_t size);
/* The same, zeroed. */
void *sunder_i_calloc(size_t n, size_t size);
/* Resizes to n * size bytes; NULL leaves the old block as it is. */
void *sunder_i_realloc(void *old, size_t n, size_t size);
void sunder_i_free(void *memory);

/* sunder_i_reserve() where there is less than that. */
bool sunder_i_enlarge(void *array, size_t *capacity, size_t need, size_t size);

/* Makes room for at least `need` elements of `size` bytes in a growing array (doubling); false if memory is out, with
 * the array as it was. *array NULL and *capacity 0 start one. */
static inline bool sunder_i_reserve(void *array, size_t *capacity, size_t need, size_t size)
{
    return need <= *capacity || sunder_i_enlarge(array, capacity, need, size);
}

struct sunder_i_chunk;

typedef struct sunder_i_arena {
    struct sunder_i_chunk *chunk; /* the newest; older ones hang behind it */
    bool failed;                  /* an allocation failed; sticky */
} sunder_i_arena;

typedef struct sunder_i_mark {
    struct sunder_i_chunk *chunk;
    size_t used;
} sunder_i_mark;

/* A zeroed struct is an empty arena; this says it by name. */
void sunder_i_arena_init(sunder_i_arena *arena);
/* The same with a first piece of memory lent by the caller, 16-byte aligned, which must outlive the arena: as long as
 * that is enough nothing is allocated. */
void sunder_i_arena_init_on(sunder_i_arena *arena, void *memory, size_t bytes);
/* n * size bytes, 16-byte aligned, uninitialised, alive until the arena is freed or released past here; NULL if it
 * failed. */
void *sunder_i_arena_alloc(sunder_i_arena *arena, size_t n, size_t size);
/* sunder_i_reserve() in an arena; outgrown arrays stay in it. */
bool sunder_i_arena_reserve(sunder_i_arena *arena, void *array, size_t *capacity, size_t need, size_t size);
sunder_i_mark sunder_i_arena_mark(const sunder_i_arena *arena);
void sunder_i_arena_release(sunder_i_arena *arena, sunder_i_mark mark);
void sunder_i_arena_free(sunder_i_arena *arena);

#endif
