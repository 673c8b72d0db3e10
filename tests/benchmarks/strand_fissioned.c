/* The strand's cycle loop in C, split into loops that gcc can vectorise without reordering sums.
   Same arithmetic and order as the compiled kernel; law archard (depth = factor load slip). */
#include <math.h>

enum { RUNNING, DEPTH_REACHED, UNSTABLE, CONFORMING, VANISHED };

static void end_frame(const double *x, const double *y, double *normal_x, double *normal_y,
                      double *curvature, double *spacing_squared, long end, long inward)
{
    double ax = x[end + inward] - x[end], ay = y[end + inward] - y[end];
    double bx = x[end + 2 * inward] - x[end + inward], by = y[end + 2 * inward] - y[end + inward];
    double a = sqrt(ax * ax + ay * ay), b = sqrt(bx * bx + by * by);
    double second_x = 2.0 * (bx / b - ax / a) / (a + b);
    double second_y = 2.0 * (by / b - ay / a) / (a + b);
    double tangent_x = ax / a - 0.5 * a * second_x, tangent_y = ay / a - 0.5 * a * second_y;
    double length = sqrt(tangent_x * tangent_x + tangent_y * tangent_y);
    double turn = (tangent_x * second_y - tangent_y * second_x) / (length * length * length);
    curvature[end] = inward * turn;
    normal_x[end] = inward * tangent_y / length;
    normal_y[end] = -inward * tangent_x / length;
    spacing_squared[end] = a * a;
}

static void flank_frame(const double *restrict x, const double *restrict y,
                        double *restrict normal_x, double *restrict normal_y,
                        double *restrict curvature, double *restrict spacing_squared, long n)
{
    for (long j = 1; j < n - 1; j++) {
        double ax = x[j] - x[j - 1], ay = y[j] - y[j - 1];
        double bx = x[j + 1] - x[j], by = y[j + 1] - y[j];
        double aa = ax * ax + ay * ay, bb = bx * bx + by * by;
        double cx = ax + bx, cy = ay + by;
        double inverse = 1.0 / sqrt(aa * bb * (cx * cx + cy * cy));
        spacing_squared[j] = aa < bb ? aa : bb;
        normal_x[j] = (ay * bb + by * aa) * inverse;
        normal_y[j] = -(ax * bb + bx * aa) * inverse;
        curvature[j] = 2.0 * (ax * by - ay * bx) * inverse;
    }
    end_frame(x, y, normal_x, normal_y, curvature, spacing_squared, 0, 1);
    end_frame(x, y, normal_x, normal_y, curvature, spacing_squared, n - 1, -1);
}

static void contact(const double *restrict x, const double *restrict y,
                    const double *restrict normal_x, const double *restrict normal_y,
                    const double *restrict curvature, const double *constants,
                    double *restrict load, double *restrict slip, double *restrict speed,
                    double *restrict relative, long n)
{
    double height = constants[0], radius = constants[1], pull = constants[2];
    double x_min = constants[3], x_max = constants[4], per_overlap = constants[5];
    double fraction = constants[6], omega = constants[7];
    for (long j = 0; j < n; j++) {
        double cx = x[j] + radius * normal_x[j], cy = y[j] + radius * normal_y[j];
        double square = cx * cx + cy * cy, inside = square - height * height;
        double distance = sqrt(inside > 0.0 ? inside : 0.0);
        double across = normal_x[j] * cy - normal_y[j] * cx;
        double along = normal_x[j] * cx + normal_y[j] * cy;
        speed[j] = distance;
        relative[j] = (across * height - along * distance) / square;
    }
    for (long j = 0; j < n; j++) {
        double start = x_max - speed[j], end = speed[j] - x_min;
        double share = (start < end ? start : end) * per_overlap;
        share = share < 1.0 ? share : 1.0;
        double carried = pull * share / relative[j];
        double sliding = fraction * (1.0 + radius * relative[j] / speed[j])
                         * (1.0 + radius * curvature[j]);
        double moving = fraction * omega * (speed[j] / relative[j] + radius);
        load[j] = share > 0.0 ? carried : 0.0;
        slip[j] = share > 0.0 ? sliding : 0.0;
        speed[j] = share > 0.0 ? moving : 0.0;
        relative[j] = 1.0 / radius + curvature[j];
    }
}

/* constants: line height, roller radius, pull per width, end and start of the load, 1/overlap,
   slip fraction, angular speed. work: normal_x, normal_y, step, sliding speed and what else is
   needed, 9 rows. */
long run_cycles(double *restrict x, double *restrict y, double *restrict depth, long n,
                const double *constants, double *restrict work, double factor,
                double diffusion, double critical_depth, long updates, double *done)
{
    double *restrict normal_x = work, *restrict normal_y = work + n, *restrict step = work + 2 * n;
    double *restrict speed = work + 3 * n, *restrict curvature = work + 4 * n;
    double *restrict spacing_squared = work + 5 * n, *restrict load = work + 6 * n;
    double *restrict slip = work + 7 * n, *restrict relative = work + 8 * n;
    *done = 0.0;
    for (long update = 0; update < updates; update++) {
        long worn = 0, unstable = 0, conforming = 0, reached = 0;
        flank_frame(x, y, normal_x, normal_y, curvature, spacing_squared, n);
        contact(x, y, normal_x, normal_y, curvature, constants, load, slip, speed, relative, n);
        for (long j = 0; j < n; j++)
            step[j] = load[j] > 0.0 ? factor * load[j] * slip[j] : 0.0;
        for (long j = 0; j < n; j++) {
            conforming += (load[j] > 0.0) & !(relative[j] > 0.0);
            worn += step[j] > 0.0;
            unstable += 2.0 * diffusion * step[j] > spacing_squared[j] * relative[j];
        }
        if (conforming)
            return CONFORMING;
        if (!worn)
            return VANISHED;
        if (unstable)
            return UNSTABLE;
        for (long j = 0; j < n; j++) {
            x[j] -= step[j] * normal_x[j];
            y[j] -= step[j] * normal_y[j];
            depth[j] += step[j];
            reached += depth[j] >= critical_depth;
        }
        *done = update + 1;
        if (reached)
            return DEPTH_REACHED;
    }
    return RUNNING;
}
