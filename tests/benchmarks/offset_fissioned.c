/* The cycle loop of a flank in offset form in C, split into loops that gcc can vectorise without
   reordering sums. Same arithmetic and order as the compiled kernel; law archard with the sliding
   path given (depth = amount sqrt(stress relative)). */
#include <math.h>

enum { RUNNING, DEPTH_REACHED, UNSTABLE };

/* table: before, after, base, stress, amount, allowed; work: relative, step. */
long run_offset_cycles(double *restrict depth, long n, const double *restrict table,
                       double *restrict work, double critical_depth, long updates, double *done)
{
    const double *restrict before = table, *restrict after = table + n;
    const double *restrict base = table + 2 * n, *restrict stress = table + 3 * n;
    const double *restrict amount = table + 4 * n, *restrict allowed = table + 5 * n;
    double *restrict relative = work, *restrict step = work + n;
    relative[0] = base[0];
    relative[n - 1] = base[n - 1];
    for (long update = 0; update < updates; update++) {
        long failures = 0, reached = 0;
        for (long j = 1; j < n - 1; j++) {
            double rise = depth[j + 1] - depth[j], fall = depth[j] - depth[j - 1];
            relative[j] = base[j] + (after[j] * rise - before[j] * fall);
        }
        for (long j = 0; j < n; j++)
            step[j] = sqrt(stress[j] * relative[j]) * amount[j];
        for (long j = 0; j < n; j++)
            failures += !(step[j] <= allowed[j] * relative[j]);
        if (failures)
            return UNSTABLE;
        for (long j = 0; j < n; j++) {
            depth[j] += step[j];
            reached += depth[j] >= critical_depth;
        }
        *done = update + 1;
        if (reached)
            return DEPTH_REACHED;
    }
    return RUNNING;
}
