/* Steps of log depth between neighbours by their normals. Twin: integration/integrate.py (steps). */

#include "kernel.h"

/* The step from ray a to ray b on a plane of normal n. */
static inline double own_step(const double *n, const double *a, const double *b, double steepest) {
    return logarithm(fmax(-dot3(n, a), steepest) / fmax(-dot3(n, b), steepest));
}

/* Steps and their sigmas of edges (count) between pixels `from` and `to`, of normals and rays (pixels, 3); normals err by `error`, and by `tilt`
   (pixels) of their own, squares; `uneven` is a share of what the steps by either normal differ by. */
KERNEL void lpcal_steps(int64_t count, int64_t pixels, const int64_t *from, const int64_t *to, const double *normal, const double *ray,
                        const double *tilt2, double error, double uneven, double steepest, double *step, double *sigma) {
    (void)pixels;
    for (int64_t e = 0; e < count; e++) {
        int64_t p = from[e], q = to[e];
        const double *a = ray + 3 * p, *b = ray + 3 * q;
        double mean[3], apart[3];
        for (int i = 0; i < 3; i++) {
            mean[i] = normal[3 * p + i] + normal[3 * q + i];
            apart[i] = b[i] - a[i];
        }
        double length = fmax(sqrt(dot3(mean, mean)), 1e-12);
        double towards_a = fmax(-dot3(mean, a) / length, steepest), towards_b = fmax(-dot3(mean, b) / length, steepest);
        double off = uneven * (own_step(normal + 3 * p, a, b, steepest) - own_step(normal + 3 * q, a, b, steepest));
        double turned = sqrt(error * error + (tilt2[p] + tilt2[q]) / 2.0) * sqrt(dot3(apart, apart)) / (towards_a * towards_b);
        step[e] = logarithm(towards_a / towards_b);
        sigma[e] = sqrt(off * off + turned * turned);
    }
}
