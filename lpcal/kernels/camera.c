/* The lens: radial polynomials, their quotient, and tangential terms. Twin: geometry/camera.py. */

#include "kernel.h"

/* Distorted coordinates of a point of the plane, and their Jacobian J (2, 2); lens: k1 k2 p1 p2 k3 k4 k5 k6. */
static inline void distorted(const double point[2], const double lens[8], double found[2], double J[4]) {
    double x = point[0], y = point[1], r2 = x * x + y * y, p1 = lens[2], p2 = lens[3];
    double above = 1 + r2 * (lens[0] + r2 * (lens[1] + r2 * lens[4])), below = 1 + r2 * (lens[5] + r2 * (lens[6] + r2 * lens[7]));
    double slope_above = lens[0] + r2 * (2 * lens[1] + 3 * lens[4] * r2), slope_below = lens[5] + r2 * (2 * lens[6] + 3 * lens[7] * r2);
    double radial = above / below, slope = 2 * (slope_above - radial * slope_below) / below;
    found[0] = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    found[1] = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
    J[0] = radial + slope * x * x + 2 * p1 * y + 6 * p2 * x;
    J[1] = J[2] = slope * x * y + 2 * p1 * x + 2 * p2 * y;
    J[3] = radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
}

KERNEL void lpcal_distort(int64_t count, const double *plane, const double *lens, double *found, double *J) {
    for (int64_t p = 0; p < count; p++) distorted(plane + 2 * p, lens, found + 2 * p, J + 4 * p);
}

#define BLOCK 64

/* Undistorted plane coordinates (count, 2) of distorted ones, by Newton's method; all iterate until the largest step is small. */
KERNEL void lpcal_undistort(int64_t count, const double *given, const double *lens, int64_t most, double precision, double *plane) {
    double held[8], largest = INFINITY;
    memcpy(held, lens, sizeof held);
    for (int64_t step = 0; step < most && !(largest < precision); step++) {
        double moved[BLOCK] = {0.0};
        for (int64_t first = 0; first < count; first += BLOCK) {
            int64_t some = count - first < BLOCK ? count - first : BLOCK;
            const double *to = given + 2 * first;
            double *at = plane + 2 * first;
            for (int64_t p = 0; p < some; p++) {
                double found[2], J[4];
                distorted(at + 2 * p, held, found, J);
                double x = to[2 * p] - found[0], y = to[2 * p + 1] - found[1], determinant = J[0] * J[3] - J[1] * J[2];
                double right = (J[3] * x - J[1] * y) / determinant, down = (J[0] * y - J[2] * x) / determinant;
                at[2 * p] += right;
                at[2 * p + 1] += down;
                double far = fabs(right) > fabs(down) ? fabs(right) : fabs(down);
                moved[p] = far > moved[p] ? far : moved[p];
            }
        }
        largest = 0.0;
        for (int p = 0; p < BLOCK; p++) largest = moved[p] > largest ? moved[p] : largest;
    }
}
