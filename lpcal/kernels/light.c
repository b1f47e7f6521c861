/* The light of a cluster of LEDs. Twin: geometry/led_cluster.py (cluster_field).

   Exponential and logarithm are written out, without branches and without calls, so that compilers do several points at once. */

#include "kernel.h"

#define BLOCK 64

/* Directions d (count, 3) and irradiances E (count) of LEDs (leds) of place, axis and power at points x (count, 3). */
KERNEL void lpcal_cluster(int64_t count, int64_t leds, const double *x, const double *place, const double *axis, const double *power,
                          double m, double *d, double *E) {
    double at[3][BLOCK], total[3][BLOCK];
    for (int64_t first = 0; first < count; first += BLOCK) {
        int64_t some = count - first < BLOCK ? count - first : BLOCK;
        for (int64_t p = 0; p < BLOCK; p++)
            for (int i = 0; i < 3; i++) {
                at[i][p] = x[3 * (first + (p < some ? p : some - 1)) + i];
                total[i][p] = 0.0;
            }
        for (int64_t k = 0; k < leds; k++) {
            const double *from = place + 3 * k, *ahead = axis + 3 * k;
            for (int p = 0; p < BLOCK; p++) {
                double a = from[0] - at[0][p], b = from[1] - at[1][p], c = from[2] - at[2][p];
                double r2 = a * a + b * b + c * c, r = sqrt(r2);
                double cosine = -(a * ahead[0] + b * ahead[1] + c * ahead[2]) / r;
                double lit = power[k] * exponential(m * logarithm(cosine > 1e-6 ? cosine : 1e-6)) / (r2 * r);
                total[0][p] += a * lit;
                total[1][p] += b * lit;
                total[2][p] += c * lit;
            }
        }
        for (int64_t p = 0; p < some; p++) {
            double irradiance = sqrt(total[0][p] * total[0][p] + total[1][p] * total[1][p] + total[2][p] * total[2][p]);
            for (int i = 0; i < 3; i++) d[3 * (first + p) + i] = total[i][p] / fmax(irradiance, 1e-300);
            E[first + p] = irradiance;
        }
    }
}

/* How the vector of irradiance (count, 3) at points x (count, 3) changes with the logarithm of their distance from a centre (3). */
KERNEL void lpcal_cluster_slope(int64_t count, int64_t leds, const double *x, const double *centre, const double *place, const double *axis,
                                const double *power, double m, double *slope) {
    double at[3][BLOCK], ahead[3][BLOCK], total[3][BLOCK];
    for (int64_t first = 0; first < count; first += BLOCK) {
        int64_t some = count - first < BLOCK ? count - first : BLOCK;
        for (int64_t p = 0; p < BLOCK; p++)
            for (int i = 0; i < 3; i++) {
                at[i][p] = x[3 * (first + (p < some ? p : some - 1)) + i];
                ahead[i][p] = at[i][p] - centre[i];
                total[i][p] = 0.0;
            }
        for (int64_t k = 0; k < leds; k++) {
            const double *from = place + 3 * k, *along = axis + 3 * k;
            for (int p = 0; p < BLOCK; p++) {
                double a = from[0] - at[0][p], b = from[1] - at[1][p], c = from[2] - at[2][p];
                double u = ahead[0][p], v = ahead[1][p], w = ahead[2][p];
                double r2 = a * a + b * b + c * c, r = sqrt(r2), nearer = (a * u + b * v + c * w) / r2;
                double level = -(a * along[0] + b * along[1] + c * along[2]), cosine = level / r;
                double turned = (u * along[0] + v * along[1] + w * along[2]) / level + nearer;
                double lit = power[k] * exponential(m * logarithm(cosine > 1e-6 ? cosine : 1e-6)) / (r2 * r);
                double change = lit * (3.0 * nearer + (cosine > 1e-6 ? m * turned : 0.0));
                total[0][p] += a * change - u * lit;
                total[1][p] += b * change - v * lit;
                total[2][p] += c * change - w * lit;
            }
        }
        for (int64_t p = 0; p < some; p++)
            for (int i = 0; i < 3; i++) slope[3 * (first + p) + i] = total[i][p];
    }
}
