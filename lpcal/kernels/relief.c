/* A depth map as a body that stands in the way, and the light that patches throw on each other past it.
   Twins: surface/relief.py (behind, hidden) and surface/bounce.py (_received). */

#include "kernel.h"

#define PI 3.141592653589793
#define WHOLE 6755399441055744.0 /* 1.5 * 2^52: adding and taking it off rounds to the nearest whole number, halves to even */

/* How far y lies behind the front (height, width), by its depth; -1 where there is none. */
static double behind(const double y[3], int64_t height, int64_t width, const double *front, const double *pixel_of_ray) {
    double a = y[0] / y[2], b = y[1] / y[2];
    double power[6] = {1.0, a, b, a * a, a * b, b * b};
    double column = 0.0, row = 0.0;
    for (int k = 0; k < 6; k++) {
        column += power[k] * pixel_of_ray[2 * k];
        row += power[k] * pixel_of_ray[2 * k + 1];
    }
    column = column + WHOLE - WHOLE;
    row = row + WHOLE - WHOLE;
    if (!(column >= 0 && row >= 0 && column < (double)width && row < (double)height)) return -1.0;
    return y[2] / front[(int64_t)row * width + (int64_t)column] - 1.0;
}

/* Whether a point lies in the body: more than `tolerance` of its depth behind the front, and less than `thickness`. */
static bool holds(const double y[3], int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                  double thickness) {
    double deep = behind(y, height, width, front, pixel_of_ray);
    return deep > tolerance && deep < thickness;
}

/* Whether the surface stands between two points, tried at so many places. */
static bool stands_between(const double from[3], const double to[3], int64_t steps, int64_t height, int64_t width, const double *front,
                           const double *pixel_of_ray, double tolerance, double thickness) {
    for (int64_t k = 0; k < steps; k++) {
        double share = ((double)k + 0.5) / (double)steps, y[3];
        for (int i = 0; i < 3; i++) y[i] = from[i] + share * (to[i] - from[i]);
        if (holds(y, height, width, front, pixel_of_ray, tolerance, thickness)) return true;
    }
    return false;
}

KERNEL void lpcal_behind(int64_t count, const double *y, int64_t height, int64_t width, const double *front, const double *pixel_of_ray,
                         double *found) {
    for (int64_t p = 0; p < count; p++) found[p] = behind(y + 3 * p, height, width, front, pixel_of_ray);
}

KERNEL void lpcal_hidden(int64_t count, const double *from, const double *to, int64_t steps, int64_t height, int64_t width,
                         const double *front, const double *pixel_of_ray, double tolerance, double thickness, bool *found) {
    for (int64_t p = 0; p < count; p++)
        found[p] = stands_between(from + 3 * p, to + 3 * p, steps, height, width, front, pixel_of_ray, tolerance, thickness);
}

/* J (lights, count, 3) at patches of place x and normal n, of the light of others with place, normal, area and signal (others, lights). */
KERNEL void lpcal_received(int64_t lights, int64_t count, int64_t others, const double *x, const double *n, const double *other_x,
                           const double *other_n, const double *area, const double *signal, double *J, int64_t height, int64_t width,
                           const double *front, const double *pixel_of_ray, int64_t steps, double tolerance, double thickness, double grazing,
                           double off) {
    for (int64_t p = 0; p < count; p++)
        for (int64_t q = 0; q < others; q++) {
            const double *here = x + 3 * p, *there = other_x + 3 * q;
            double way[3], e[3], from[3], to[3];
            for (int i = 0; i < 3; i++) way[i] = there[i] - here[i];
            double square = fmax(dot3(way, way), 1e-18), far = sqrt(square);
            for (int i = 0; i < 3; i++) e[i] = way[i] / far;
            double leaving = -dot3(e, other_n + 3 * q);
            double arriving = dot3(e, n + 3 * p);
            if (!(arriving > grazing && leaving > grazing)) continue;
            double share = fmin(off * here[2] / far, 0.5);
            for (int i = 0; i < 3; i++) {
                from[i] = here[i] + share * way[i];
                to[i] = there[i] - share * way[i];
            }
            if (stands_between(from, to, steps, height, width, front, pixel_of_ray, tolerance, thickness)) continue;
            double factor = leaving * area[q] / (PI * square + area[q]);
            for (int64_t k = 0; k < lights; k++)
                for (int i = 0; i < 3; i++) J[3 * (k * count + p) + i] += signal[q * lights + k] * factor * e[i];
        }
}

/* Whether a way from each place x meets the body within the reaches, shares of its depth, and how far it goes until then, by halvings between
   the first reach in the body and the last before it. Twin: surface/sides.py (_entries). */
KERNEL void lpcal_entries(int64_t count, const double *x, const double *way, int64_t reaches, const double *reach, int64_t halvings,
                          int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                          double thickness, bool *met, double *far) {
    for (int64_t p = 0; p < count; p++) {
        const double *from = x + 3 * p, *along = way + 3 * p;
        double low = 0.0, high = 0.0, y[3];
        met[p] = false;
        for (int64_t k = 0; k < reaches && !met[p]; k++) {
            double r = reach[k] * from[2];
            for (int i = 0; i < 3; i++) y[i] = from[i] + r * along[i];
            if (holds(y, height, width, front, pixel_of_ray, tolerance, thickness)) {
                high = r;
                met[p] = true;
            } else
                low = r;
        }
        for (int64_t k = 0; k < halvings && met[p]; k++) {
            double middle = (low + high) / 2;
            for (int i = 0; i < 3; i++) y[i] = from[i] + middle * along[i];
            if (holds(y, height, width, front, pixel_of_ray, tolerance, thickness)) high = middle;
            else low = middle;
        }
        far[p] = high;
    }
}
