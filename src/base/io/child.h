/* Work in a process of its own, for libraries that may crash.  Private to the folder io. */
#ifndef IO_CHILD_H
#define IO_CHILD_H

#include "base/base.h"

#include <stdio.h>

/* The work, in the child; out: its result as bytes. */
typedef rb_status io_work(FILE *out, const void *context, rb_message *why);

/* The status of the work, its line in why and its bytes, owned by the caller (NULL after
 * a failure).  RB_ENOMEM also where the child crashed: that is what libraries do that do
 * not look whether they got the memory they asked for. */
rb_status rb_io_in_child(const char *name, io_work *work, const void *context, char **bytes,
                         size_t *size, rb_message *why);

#endif
