/* Prints the obstacle problem on m x m points of the unit square as an LCP: a membrane
 * that a constant load presses down on a plane 0.02 below its frame.
 *
 *     obstacle M >obstacle.mtx        M: minus the five-point Laplacian times h^2
 *     obstacle -q M >obstacle-q.txt   q
 *
 * z is the height above the plane, w the force of the plane. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double LOAD = 1.0, DEPTH = 0.02;

/* The load less what the frame, DEPTH above the plane, gives its neighbours. */
static void print_q(int m)
{
    const double h = 1.0 / (m + 1);
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++) {
            const int frame = (i == 0) + (i == m - 1) + (j == 0) + (j == m - 1);
            printf("%.17g\n", LOAD * h * h - DEPTH * frame);
        }
}

static void print_matrix(int m)
{
    printf("%%%%MatrixMarket matrix coordinate real symmetric\n%d %d %d\n", m * m, m * m,
           m * m + 2 * m * (m - 1));
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++) {
            const int k = 1 + i + j * m;
            printf("%d %d 4\n", k, k);
            if (i + 1 < m)
                printf("%d %d -1\n", k + 1, k);
            if (j + 1 < m)
                printf("%d %d -1\n", k + m, k);
        }
}

int main(int argc, char **argv)
{
    const int only_q = argc == 3 && !strcmp(argv[1], "-q");
    const int m = argc == 2 + only_q ? atoi(argv[1 + only_q]) : 0;
    if (m < 1 || m > 10000) {
        fprintf(stderr, "obstacle: expected [-q] M, M points on a side from 1 to 10000\n");
        return 64;
    }
    if (only_q)
        print_q(m);
    else
        print_matrix(m);
    return 0;
}
