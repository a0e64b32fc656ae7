/* Scratch memory that is freed at once. */
#include "base/base.h"

#include <stddef.h>
#include <stdlib.h>

/* Stands before each array, which is aligned as calloc aligns. */
union rb_arena_block {
    union rb_arena_block *before;
    max_align_t alignment;
};

void *rb_arena_zeros(rb_arena *arena, size_t count, size_t size)
{
    union rb_arena_block *block = NULL;

    if (!arena->failed && count <= (SIZE_MAX - sizeof *block) / size)
        block = calloc(1, sizeof *block + count * size);
    arena->failed = !block;
    if (!block)
        return NULL;
    block->before = arena->last;
    arena->last = block;
    return block + 1;
}

double *rb_arena_doubles(rb_arena *arena, size_t rows, size_t cols)
{
    return rb_arena_zeros(arena, cols && rows > SIZE_MAX / cols ? SIZE_MAX : rows * cols,
                          sizeof(double));
}

int *rb_arena_ints(rb_arena *arena, size_t n)
{
    return rb_arena_zeros(arena, n, sizeof(int));
}

void rb_arena_free(rb_arena *arena)
{
    while (arena->last) {
        union rb_arena_block *before = arena->last->before;
        free(arena->last);
        arena->last = before;
    }
    arena->failed = 0;
}

rb_status rb_arena_done(rb_arena *arena, rb_status s)
{
    rb_arena_free(arena);
    return s;
}
