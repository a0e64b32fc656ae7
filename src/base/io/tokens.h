/* Words and numbers of a text file, with the line for messages.  Private to the folder
 * io.
 *
 * The first failure stays in `status` (and its line in the message): later calls do
 * nothing and give zeros, so that readers ask once per group of numbers. */
#ifndef IO_TOKENS_H
#define IO_TOKENS_H

#include "base/base.h"

#include <stdio.h>

/* All that is left of a file, or of a pipe, and a zero behind it; owned by the caller.
 * NULL: errno says why, EFBIG: there are more bytes than most. */
char *rb_io_read_all(FILE *file, size_t most, size_t *size);

typedef struct {
    const char *path; /* borrowed */
    char *text;       /* the whole file and a final zero; owned */
    const char *at, *end;
    int line;
    int infinite; /* 1: inf and -inf are numbers, too */
    rb_status status;
    rb_message *why;
} io_tokens;

/* Reads the whole file, or standard input where path is "-"; a failure is in the status;
 * close in any case. */
void rb_io_tokens_open(const char *path, io_tokens *t, rb_message *why);
void rb_io_tokens_close(io_tokens *t);

/* A failure at this place: "path:line: " and the text. */
void rb_io_tokens_fail(io_tokens *t, const char *format, ...) RB_PRINTF(2, 3);

/* `what` names the number in messages: "M", "q".  An integer may have a comma behind it. */
int rb_io_tokens_int(io_tokens *t, int low, int high, const char *what);
double rb_io_tokens_real(io_tokens *t, const char *what);
void rb_io_tokens_reals(io_tokens *t, size_t n, double *x, const char *what);
void rb_io_tokens_word(io_tokens *t, const char *word);
/* 1 when the next token is this word, in any case of letters, and has been read. */
int rb_io_tokens_take(io_tokens *t, const char *word);

/* Arrays of rows x cols numbers that the file is about to give: refused before memory is
 * asked for when the rest of the file is too short for them.  NULL on failure. */
double *rb_io_tokens_alloc(io_tokens *t, size_t rows, size_t cols, const char *what);
int *rb_io_tokens_alloc_int(io_tokens *t, size_t n, const char *what);
/* 1 when the rest of the file can hold so many numbers. */
int rb_io_tokens_room_for(io_tokens *t, size_t rows, size_t cols, const char *what);

/* 1 when another token follows. */
int rb_io_tokens_more(io_tokens *t);
void rb_io_tokens_skip_line(io_tokens *t);

/* To the beginning, whatever has failed since. */
void rb_io_tokens_rewind(io_tokens *t);
/* Overwrites what stands behind a # on each line with blanks. */
void rb_io_tokens_blank_comments(io_tokens *t);

#endif
