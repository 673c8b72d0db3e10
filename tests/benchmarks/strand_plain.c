/* The strand's cycle loop as one writes it in plain C: one loop over the points, then the move.
   Same arithmetic as the compiled kernel; law archard (depth = factor load slip). */
#include <math.h>

enum { RUNNING, DEPTH_REACHED, UNSTABLE, CONFORMING, VANISHED };

typedef struct {
    double normal_x, normal_y, curvature, spacing_squared;
} frame;

static frame inner_frame(const double *x, const double *y, long j)
{
    double ax = x[j] - x[j - 1], ay = y[j] - y[j - 1];
    double bx = x[j + 1] - x[j], by = y[j + 1] - y[j];
    double aa = ax * ax + ay * ay, bb = bx * bx + by * by;
    double cx = ax + bx, cy = ay + by;
    double inverse = 1.0 / sqrt(aa * bb * (cx * cx + cy * cy));
    frame f;
    f.normal_x = (ay * bb + by * aa) * inverse;
    f.normal_y = -(ax * bb + bx * aa) * inverse;
    f.curvature = 2.0 * (ax * by - ay * bx) * inverse;
    f.spacing_squared = aa < bb ? aa : bb;
    return f;
}

static frame end_frame(const double *x, const double *y, long end, long inward)
{
    double ax = x[end + inward] - x[end], ay = y[end + inward] - y[end];
    double bx = x[end + 2 * inward] - x[end + inward], by = y[end + 2 * inward] - y[end + inward];
    double a = sqrt(ax * ax + ay * ay), b = sqrt(bx * bx + by * by);
    double second_x = 2.0 * (bx / b - ax / a) / (a + b);
    double second_y = 2.0 * (by / b - ay / a) / (a + b);
    double tangent_x = ax / a - 0.5 * a * second_x, tangent_y = ay / a - 0.5 * a * second_y;
    double length = sqrt(tangent_x * tangent_x + tangent_y * tangent_y);
    double turn = (tangent_x * second_y - tangent_y * second_x) / (length * length * length);
    frame f;
    f.normal_x = inward * tangent_y / length;
    f.normal_y = -inward * tangent_x / length;
    f.curvature = inward * turn;
    f.spacing_squared = a * a;
    return f;
}

/* constants: line height, roller radius, pull per width, end and start of the load, 1/overlap,
   slip fraction, angular speed. work: normal_x, normal_y, step, sliding speed. */
long run_cycles(double *x, double *y, double *depth, long n, const double *constants, double *work,
                double factor, double diffusion, double critical_depth,
                long updates, double *done)
{
    double height = constants[0], radius = constants[1], pull = constants[2];
    double x_min = constants[3], x_max = constants[4], per_overlap = constants[5];
    double fraction = constants[6], omega = constants[7];
    double *normal_x = work, *normal_y = work + n, *step = work + 2 * n;
    double *speed = work + 3 * n;
    *done = 0.0;
    for (long update = 0; update < updates; update++) {
        long worn = 0, unstable = 0, conforming = 0, reached = 0;
        for (long j = 0; j < n; j++) {
            frame f = j == 0       ? end_frame(x, y, 0, 1)
                      : j == n - 1 ? end_frame(x, y, n - 1, -1)
                                   : inner_frame(x, y, j);
            double cx = x[j] + radius * f.normal_x, cy = y[j] + radius * f.normal_y;
            double square = cx * cx + cy * cy;
            normal_x[j] = f.normal_x;
            normal_y[j] = f.normal_y;
            step[j] = speed[j] = 0.0;
            if (square <= height * height)
                continue;
            double distance = sqrt(square - height * height);
            double share = fmin(1.0, fmin(x_max - distance, distance - x_min) * per_overlap);
            if (share <= 0.0)
                continue;
            double across = f.normal_x * cy - f.normal_y * cx;
            double along = f.normal_x * cx + f.normal_y * cy;
            double cosine = (across * height - along * distance) / square;
            double load = pull * share / cosine;
            double relative = 1.0 / radius + f.curvature;
            double slip = fraction * (1.0 + radius * cosine / distance)
                          * (1.0 + radius * f.curvature);
            speed[j] = fraction * omega * (distance / cosine + radius);
            step[j] = factor * load * slip;
            conforming += !(relative > 0.0);
            worn += step[j] > 0.0;
            unstable += 2.0 * diffusion * step[j] > f.spacing_squared * relative;
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
