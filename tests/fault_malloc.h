/* What tests/test_faults.c asks of the program under tests/fault_malloc.so. */
#ifndef ROLLBEM_TESTS_FAULT_MALLOC_H
#define ROLLBEM_TESTS_FAULT_MALLOC_H

/* Which allocations of one run fail.  A run by calls refuses the first allocation that is
 * reached through a call of the program that no refused allocation has been reached
 * through before, in this run or an earlier one of this server: after as many runs as give
 * refusals, each call that leads to an allocation has seen one fail. */
typedef struct {
    long only; /* this one, counted from 1; 0: none */
    long from; /* all from this one on; 0: none */
    int by_calls;
    int parts, part; /* by calls: only those of this part of all calls of the program */
} fault_request;

typedef struct {
    int status; /* of waitpid */
    int refused;
    long allocations;
} fault_reply;

/* Descriptors of the program on which it takes requests and answers each. */
enum { FAULT_REQUESTS = 60, FAULT_REPLIES = 61 };

#endif
