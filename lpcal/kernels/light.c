/* The light of a cluster of LEDs. Twins: geometry/led_cluster.py (cluster_field, cluster_slope).

   Exponential and logarithm are written out, without branches and without calls, so that compilers do several points at once. In single
   precision twice as many points go into a vector and the series are half as long. */

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

/* As the logarithm of kernel.h, in single precision. */
static inline float logarithm_single(float x) {
    uint32_t u = bits_of_single(x);
    float exponent = of_bits_single((u >> 23) | 0x4b000000u) - (8388608.0f + 127.0f);
    float fraction = of_bits_single((u & 0x007fffffu) | 0x3f800000u);
    bool large = fraction > 1.41421356f;
    fraction = large ? 0.5f * fraction : fraction;
    exponent = large ? exponent + 1.0f : exponent;
    float s = (fraction - 1.0f) / (fraction + 1.0f), z = s * s, sum = 1.0f / 9.0f;
    sum = sum * z + 1.0f / 7.0f;
    sum = sum * z + 1.0f / 5.0f;
    sum = sum * z + 1.0f / 3.0f;
    return exponent * (float)LN2 + (2.0f * s + 2.0f * s * z * sum);
}

/* Points, each coordinate of a block of them by itself. */
typedef float Points[3][BLOCK];

static inline void laid_out(const double *x, int64_t some, Points at) {
    for (int64_t p = 0; p < BLOCK; p++)
        for (int i = 0; i < 3; i++) at[i][p] = (float)x[3 * (p < some ? p : some - 1) + i];
}

/* `lpcal_cluster` in single precision: right to 1e-5 of the irradiance for LEDs as narrow as cos^80. */
KERNEL void lpcal_cluster_single(int64_t count, int64_t leds, const double *x, const double *place, const double *axis, const double *power,
                                 double m, double *d, double *E) {
    Points at, total;
    float steep = (float)m;
    for (int64_t first = 0; first < count; first += BLOCK) {
        int64_t some = count - first < BLOCK ? count - first : BLOCK;
        laid_out(x + 3 * first, some, at);
        memset(total, 0, sizeof total);
        for (int64_t k = 0; k < leds; k++) {
            float from[3], ahead[3], strength = (float)power[k];
            for (int i = 0; i < 3; i++) {
                from[i] = (float)place[3 * k + i];
                ahead[i] = (float)axis[3 * k + i];
            }
            for (int p = 0; p < BLOCK; p++) {
                float a = from[0] - at[0][p], b = from[1] - at[1][p], c = from[2] - at[2][p];
                float nearness = 1.0f / sqrtf(a * a + b * b + c * c);
                float cosine = -(a * ahead[0] + b * ahead[1] + c * ahead[2]) * nearness;
                float lit = exponential_single(steep * logarithm_single(cosine > 1e-6f ? cosine : 1e-6f));
                lit *= strength * (nearness * nearness * nearness);
                total[0][p] += a * lit;
                total[1][p] += b * lit;
                total[2][p] += c * lit;
            }
        }
        for (int64_t p = 0; p < some; p++) {
            double sum[3] = {(double)total[0][p], (double)total[1][p], (double)total[2][p]}, irradiance = sqrt(dot3(sum, sum));
            for (int i = 0; i < 3; i++) d[3 * (first + p) + i] = sum[i] / fmax(irradiance, 1e-300);
            E[first + p] = irradiance;
        }
    }
}

/* Derivative of the irradiance vector (count, 3) at points x (count, 3) by the logarithm of their distance from the frame's origin. */
KERNEL void lpcal_cluster_slope(int64_t count, int64_t leds, const double *x, const double *place, const double *axis, const double *power,
                                double m, double *slope) {
    Points at, total;
    float steep = (float)m;
    for (int64_t first = 0; first < count; first += BLOCK) {
        int64_t some = count - first < BLOCK ? count - first : BLOCK;
        laid_out(x + 3 * first, some, at);
        memset(total, 0, sizeof total);
        for (int64_t k = 0; k < leds; k++) {
            float from[3], along[3], strength = (float)power[k];
            for (int i = 0; i < 3; i++) {
                from[i] = (float)place[3 * k + i];
                along[i] = (float)axis[3 * k + i];
            }
            for (int p = 0; p < BLOCK; p++) {
                float u = at[0][p], v = at[1][p], w = at[2][p], a = from[0] - u, b = from[1] - v, c = from[2] - w;
                float nearness = 1.0f / sqrtf(a * a + b * b + c * c), nearer = (a * u + b * v + c * w) * (nearness * nearness);
                float level = -(a * along[0] + b * along[1] + c * along[2]), cosine = level * nearness;
                float turned = (u * along[0] + v * along[1] + w * along[2]) / level + nearer;
                float lit = exponential_single(steep * logarithm_single(cosine > 1e-6f ? cosine : 1e-6f));
                lit *= strength * (nearness * nearness * nearness);
                float change = lit * (3.0f * nearer + (cosine > 1e-6f ? steep * turned : 0.0f));
                total[0][p] += a * change - u * lit;
                total[1][p] += b * change - v * lit;
                total[2][p] += c * change - w * lit;
            }
        }
        for (int64_t p = 0; p < some; p++)
            for (int i = 0; i < 3; i++) slope[3 * (first + p) + i] = (double)total[i][p];
    }
}
