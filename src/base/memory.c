/* memory.c: the allocation hooks, growing arrays, and arenas: chunks of memory, each twice as large as the previous
 * one. */
#include "base/memory.h"

#include "base/invariant.h"
#include "base/watch.h"

#include <stdlib.h>
#include <string.h>

/* The hooks are the only global state; sunder_set_allocator() documents when they may be set. */
static void *(*hook_alloc)(size_t) = malloc;
static void *(*hook_realloc)(void *, size_t) = realloc;
static void (*hook_free)(void *) = free;

void sunder_set_allocator(void *(*allocate)(size_t), void *(*reallocate)(void *, size_t), void (*release)(void *))
{
    hook_alloc = allocate ? allocate : malloc;
    hook_realloc = reallocate ? reallocate : realloc;
    hook_free = release ? release : free;
}

#ifndef NDEBUG
bool sunder_i_allocator_is_own(void) { return hook_alloc == malloc; }
#endif

void sunder_free(void *memory) { sunder_i_free(memory); }

static bool bytes_of(size_t n, size_t size, size_t *out)
{
    if (size != 0 && n > SIZE_MAX / 2 / size) return false;
    *out = n == 0 || size == 0 ? 1 : n * size;
    return true;
}

void *sunder_i_alloc(size_t n, size_t size)
{
    size_t b;
    return sunder_i_step() && bytes_of(n, size, &b) ? hook_alloc(b) : NULL;
}

void *sunder_i_calloc(size_t n, size_t size)
{
    size_t b;
    if (!sunder_i_step() || !bytes_of(n, size, &b)) return NULL;
    /* New pages of the system are zero already, and calloc() does not clear them again. */
    if (hook_alloc == malloc) return calloc(b, 1);
    void *p = hook_alloc(b);
    if (p) memset(p, 0, b);
    return p;
}

void *sunder_i_realloc(void *old, size_t n, size_t size)
{
    size_t b;
    if (!sunder_i_step() || !bytes_of(n, size, &b)) return NULL;
    return old ? hook_realloc(old, b) : hook_alloc(b);
}

void sunder_i_free(void *memory)
{
    if (memory) hook_free(memory);
}

void sunder_i_free_list(void *const *memory, size_t n)
{
    for (size_t k = 0; k < n; k++) sunder_i_free(memory[k]);
}

/* Returns a capacity for at least `need` elements, which is more than the present capacity: the capacity is doubled; 0
 * if the size is too large. The first capacity is `need`, at least 16. */
static size_t grown_capacity(size_t capacity, size_t need)
{
    size_t want = capacity ? capacity : need > 16 ? need : 16;
    while (want < need) {
        if (want > SIZE_MAX / 4) return 0;
        want *= 2;
    }
    return want;
}

bool sunder_i_enlarge(void *array, size_t *capacity, size_t need, size_t size)
{
    const size_t want = grown_capacity(*capacity, need);
    if (want == 0) return false;
    void *old;
    memcpy(&old, array, sizeof old);
    void *fresh = sunder_i_realloc(old, want, size);
    if (!fresh) return false;
    memcpy(array, &fresh, sizeof fresh);
    *capacity = want;
    return true;
}

/* ---- Arenas ---- */

typedef struct sunder_i_chunk {
    struct sunder_i_chunk *older;
    size_t size, used;
    bool lent; /* the memory is the caller's and must not be freed */
    _Alignas(16) unsigned char data[];
} sunder_i_chunk;

void sunder_i_arena_init(sunder_i_arena *arena)
{
    arena->chunk = NULL;
    arena->failed = false;
}

void sunder_i_arena_init_on(sunder_i_arena *arena, void *memory, size_t bytes)
{
    sunder_i_chunk *c = memory;
    *c = (sunder_i_chunk){.size = bytes - sizeof *c, .lent = true};
    arena->chunk = c;
    arena->failed = false;
}

static bool arena_grow(sunder_i_arena *arena, size_t need)
{
    size_t size = arena->chunk ? arena->chunk->size * 2 : 4096;
    const size_t limit = (size_t)1 << 22;
    if (size > limit) size = limit;
    if (size < need) size = need;
    sunder_i_chunk *c = sunder_i_alloc(sizeof *c + size, 1);
    if (!c) {
        arena->failed = true;
        return false;
    }
    c->older = arena->chunk;
    c->size = size;
    c->used = 0;
    c->lent = false;
    arena->chunk = c;
    return true;
}

static void *alloc_in_new_chunk(sunder_i_arena *arena, size_t n, size_t size)
{
    size_t b;
    if (!bytes_of(n, size, &b) || b > SIZE_MAX - 64) {
        arena->failed = true;
        return NULL;
    }
    b = (b + 15) & ~(size_t)15;
    if (!arena_grow(arena, b)) return NULL;
    void *p = arena->chunk->data;
    arena->chunk->used = b;
    return p;
}

void *sunder_i_arena_alloc(sunder_i_arena *arena, size_t n, size_t size)
{
    sunder_i_chunk *c = arena->chunk;
    size_t b;
    if (arena->failed) return NULL;
    if (!sunder_i_step()) {
        arena->failed = true;
        return NULL;
    }
    /* Usually the chunk has room; a request for 0 bytes takes one byte. */
    if (!c || __builtin_mul_overflow(n, size, &b) || b > c->size - c->used) return alloc_in_new_chunk(arena, n, size);
    b = (b + 15 + (b == 0)) & ~(size_t)15;
    if (b > c->size - c->used) return alloc_in_new_chunk(arena, n, size);
    void *p = c->data + c->used;
    c->used += b;
    return p;
}

bool sunder_i_arena_reserve(sunder_i_arena *arena, void *array, size_t *capacity, size_t need, size_t size)
{
    if (need <= *capacity) return true;
    const size_t want = grown_capacity(*capacity, need);
    void *old, *fresh = want ? sunder_i_arena_alloc(arena, want, size) : NULL;
    if (!fresh) return false;
    memcpy(&old, array, sizeof old);
    if (*capacity) memcpy(fresh, old, *capacity * size);
    memcpy(array, &fresh, sizeof fresh);
    *capacity = want;
    return true;
}

sunder_i_mark sunder_i_arena_mark(const sunder_i_arena *arena)
{
    return (sunder_i_mark){arena->chunk, arena->chunk ? arena->chunk->used : 0};
}

void sunder_i_arena_release(sunder_i_arena *arena, sunder_i_mark mark)
{
    while (arena->chunk != mark.chunk) {
        sunder_i_chunk *older = arena->chunk->older;
        if (!arena->chunk->lent) sunder_i_free(arena->chunk);
        arena->chunk = older;
    }
    if (arena->chunk) arena->chunk->used = mark.used;
}

void sunder_i_arena_free(sunder_i_arena *arena)
{
    sunder_i_arena_release(arena, (sunder_i_mark){NULL, 0});
    arena->failed = false;
}
