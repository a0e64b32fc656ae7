/* A lock where there is one thread, for WebAssembly. */
#ifndef ROLLBEM_WASM_PTHREAD_H
#define ROLLBEM_WASM_PTHREAD_H

typedef int pthread_mutex_t;
#define PTHREAD_MUTEX_INITIALIZER 0

static inline int pthread_mutex_lock(pthread_mutex_t *lock)
{
    return *lock = 0;
}

static inline int pthread_mutex_unlock(pthread_mutex_t *lock)
{
    return *lock = 0;
}

#endif
