/* The least time of a cycle loop: its square roots and divisions alone, on numbers that stay. */
#include <math.h>

void roots(const double *restrict x, double *restrict y, long n, long roots_, long divisions,
           long rounds)
{
    for (long round = 0; round < rounds; round++) {
        for (long i = 0; i < roots_; i++)
            for (long j = 0; j < n; j++)
                y[i * n + j] = sqrt(x[i * n + j]);
        for (long i = roots_; i < roots_ + divisions; i++)
            for (long j = 0; j < n; j++)
                y[i * n + j] = 1.0 / x[i * n + j];
    }
}
