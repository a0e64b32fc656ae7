/* A program of which one system call fails (Linux on x86-64 and on ARM). */
#ifndef ROLLBEM_TESTS_FAULT_CALL_H
#define ROLLBEM_TESTS_FAULT_CALL_H

typedef enum {
    FAULT_WRITE,  /* of files and standard output: ENOSPC */
    FAULT_RENAME, /* and naming a file that has no name: EPERM */
    FAULT_CLOSE   /* EIO */
} fault_kind;

enum { FAULT_UNTRACED = 126 }; /* exit code where programs cannot be followed */

/* Runs argv[0] with standard output and standard error in files; its k-th call of that
 * kind fails (0: none), *count gets how many there were.  Returns the status of waitpid.
 * Processes that the program starts run undisturbed. */
int fault_run(char *const argv[], const char *out, const char *err, fault_kind kind, int k,
              int *count);

#endif
