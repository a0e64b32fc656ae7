/* Rows of the tables of docs/performance.md, which tests/figures compares with that page,
 * and the clock of ratios: processor time, which other work on the machine changes
 * little. */
#ifndef ROLLBEM_BENCH_ROWS_H
#define ROLLBEM_BENCH_ROWS_H

#include <math.h>
#include <stdio.h>
#include <time.h>

static inline double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct {
    char text[24];
} row_cell;

/* 2.8 ms, 45 ms, 0.11 s, 5.3 s */
static inline row_cell row_seconds(double seconds)
{
    row_cell cell;
    const double shown = seconds < 0.0995 ? 1000.0 * seconds : seconds;
    snprintf(cell.text, sizeof cell.text, "%.*f %s",
             shown < 0.995  ? 2 - (shown < 0.0995 || seconds < 0.0995)
             : shown < 9.95 ? 1
                            : 0,
             shown, seconds < 0.0995 ? "ms" : "s");
    return cell;
}

/* 6e-15, as the pages write it */
static inline row_cell row_power(int digits, double value)
{
    row_cell cell;
    const int power = value > 0.0 ? (int)floor(log10(value)) : 0;
    snprintf(cell.text, sizeof cell.text, "%.*fe%d", digits - 1, value / pow(10.0, power), power);
    return cell;
}

/* 1 300 000 */
static inline row_cell row_count(int n)
{
    row_cell cell;
    if (n >= 1000000)
        snprintf(cell.text, sizeof cell.text, "%d %03d %03d", n / 1000000, n / 1000 % 1000,
                 n % 1000);
    else if (n >= 1000)
        snprintf(cell.text, sizeof cell.text, "%d %03d", n / 1000, n % 1000);
    else
        snprintf(cell.text, sizeof cell.text, "%d", n);
    return cell;
}

#endif
