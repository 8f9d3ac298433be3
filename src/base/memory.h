/* memory.h: the allocation hooks, and arenas that use them.
 *
 * Nothing in the library calls malloc directly. Long-lived arrays are allocated with sunder_i_alloc() and the functions
 * below, which return NULL if out of memory; memory for one computation is allocated in an arena. After a failed
 * allocation, an arena sets `failed` and returns NULL for every request, so that a function with many small allocations
 * tests for failure once, at its end. A thread that is to stop is refused memory, too (watch.h). */
#ifndef SUNDER_I_MEMORY_H
#define SUNDER_I_MEMORY_H

#include "base/error.h"

/* Allocates n * size bytes, uninitialised; returns NULL if the size overflows or if out of memory. If n * size == 0,
 * the result is a valid pointer. */
void *sunder_i_alloc(size_t n, size_t size);
/* The same, with all bytes zero. */
void *sunder_i_calloc(size_t n, size_t size);
/* Resizes a block to n * size bytes; NULL: failed, and the old block is unchanged. */
void *sunder_i_realloc(void *old, size_t n, size_t size);
void sunder_i_free(void *memory);
/* Frees n pointers, in order; NULL is allowed. */
void sunder_i_free_list(void *const *memory, size_t n);
/* Frees each of the pointers given, in order; NULL is allowed. */
#define sunder_i_free_all(...)                                                                                         \
    sunder_i_free_list((void *const[]){__VA_ARGS__}, sizeof((void *const[]){__VA_ARGS__}) / sizeof(void *))

/* Enlarges an array for sunder_i_reserve(), if need > *capacity. */
bool sunder_i_enlarge(void *array, size_t *capacity, size_t need, size_t size);

/* Makes room for at least `need` elements of `size` bytes in a growing array, whose capacity is doubled. array is the
 * address of the pointer; *array == NULL and *capacity == 0 begin a new array. Returns false if out of memory; then the
 * array is unchanged. */
static inline bool sunder_i_reserve(void *array, size_t *capacity, size_t need, size_t size)
{
    return need <= *capacity || sunder_i_enlarge(array, capacity, need, size);
}

struct sunder_i_chunk;

typedef struct sunder_i_arena {
    struct sunder_i_chunk *chunk; /* the newest chunk, which is linked to the older ones */
    bool failed;                  /* whether an allocation has failed since the arena was made */
} sunder_i_arena;

typedef struct sunder_i_mark {
    struct sunder_i_chunk *chunk;
    size_t used;
} sunder_i_mark;

/* Makes an empty arena. A struct of zeros is an empty arena, too. */
void sunder_i_arena_init(sunder_i_arena *arena);
/* Makes an arena whose first chunk is the caller's memory, which must be 16-byte aligned and outlive the arena: as long
 * as it suffices, nothing is allocated. */
void sunder_i_arena_init_on(sunder_i_arena *arena, void *memory, size_t bytes);
/* Allocates n * size bytes, 16-byte aligned and uninitialised, which exist until the arena is freed or released to an
 * earlier mark; NULL if `failed`. */
void *sunder_i_arena_alloc(sunder_i_arena *arena, size_t n, size_t size);
/* sunder_i_reserve() in an arena; the memory of the smaller arrays is not freed before the arena's. */
bool sunder_i_arena_reserve(sunder_i_arena *arena, void *array, size_t *capacity, size_t need, size_t size);
sunder_i_mark sunder_i_arena_mark(const sunder_i_arena *arena);
void sunder_i_arena_release(sunder_i_arena *arena, sunder_i_mark mark);
void sunder_i_arena_free(sunder_i_arena *arena);

#endif
