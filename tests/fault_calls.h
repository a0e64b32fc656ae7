/* Which allocation to refuse so that every call of the program that leads to one sees a
 * failure: the first that is reached through a call instruction which no refused
 * allocation has been reached through before.  For one source file each, before any other
 * header and behind _GNU_SOURCE. */
#ifndef ROLLBEM_TESTS_FAULT_CALLS_H
#define ROLLBEM_TESTS_FAULT_CALLS_H

#include <dlfcn.h>
#include <link.h>
#include <stdint.h>
#include <string.h>
#include <unwind.h>

enum { CALLS = 1 << 16, STACKS = 1 << 16, WORDS = 128, KERNELS = 400 };

static uintptr_t *calls;  /* CALLS, of the includer: return addresses, less the base */
static uintptr_t *stacks; /* STACKS, of the includer: those that have been walked */
static uintptr_t base, code_start, code_end;
static uintptr_t kernel[KERNELS][2]; /* code of the program from ... to: fault_malloc.c */
static int kernels;
static unsigned call_parts = 1, call_part; /* which calls count */

/* 1: the set has that key now and had not before.  A full set takes no more. */
static int insert(uintptr_t *set, size_t size, uintptr_t key)
{
    size_t i = (size_t)((uint64_t)key * 0x9e3779b97f4a7c15u >> 32) % size;
    for (size_t k = 0; k < size; k++, i = (i + 1) % size) {
        if (set[i] == key)
            return 0;
        if (set[i] == 0) {
            set[i] = key;
            return 1;
        }
    }
    return 0;
}

static _Unwind_Reason_Code note_call(struct _Unwind_Context *context, void *found)
{
    const uintptr_t at = _Unwind_GetIP(context);
    if (at >= code_start && at < code_end &&
        (at - base) * 0x9e3779b1u / 7 % call_parts == call_part && insert(calls, CALLS, at - base))
        *(int *)found = 1;
    return _URC_NO_REASON;
}

/* OpenBLAS' kernels for small matrices ask for memory and use it without a look.  Those that are
 * linked as an archive have no names at run time. */
static int is_unchecked(const void *caller)
{
    Dl_info info;
    for (int k = 0; k < kernels; k++)
        if ((uintptr_t)caller - base >= kernel[k][0] && (uintptr_t)caller - base < kernel[k][1])
            return 1;
    return dladdr(caller, &info) && info.dli_sname && strstr(info.dli_sname, "small_kernel");
}

/* A number of a stack: from its depth and from what lies next on it and could be a return
 * address into the program.  Two calls of one function out of one other are two stacks. */
__attribute__((no_sanitize("address"))) static uintptr_t number_of(const void *caller,
                                                                   const void *frame)
{
    const uintptr_t *word = frame;
    uintptr_t number = (uintptr_t)caller * 31 + (uintptr_t)frame;
    for (int k = 0; k < WORDS; k++)
        if (word[k] >= code_start && word[k] < code_end)
            number = number * 31 + word[k];
    return number;
}

/* Walking a stack is slow, and one that has been walked has nothing new. */
static int has_new_call(const void *caller, const void *frame)
{
    int found = 0;
    if (insert(stacks, STACKS, number_of(caller, frame)) && !is_unchecked(caller))
        _Unwind_Backtrace(note_call, &found);
    return found;
}

static int take_program(struct dl_phdr_info *info, size_t size, void *unused)
{
    (void)size;
    (void)unused;
    base = info->dlpi_addr;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD && info->dlpi_phdr[i].p_flags & PF_X) {
            code_start = base + info->dlpi_phdr[i].p_vaddr;
            code_end = code_start + info->dlpi_phdr[i].p_memsz;
        }
    return 1; /* the program comes first */
}

static void find_program(void)
{
    dl_iterate_phdr(take_program, NULL);
}

#endif
