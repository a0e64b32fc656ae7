/* For builds with --coverage (make coverage), linked with --wrap=_exit: processes that
 * end by _exit, workers and HDF5's own, count as well. */
void __gcov_dump(void);
_Noreturn void __real__exit(int code);
_Noreturn void __wrap__exit(int code);

_Noreturn void __wrap__exit(int code)
{
    __gcov_dump();
    __real__exit(code);
}
