/* How well pixels fit a plane. Twin: segmentation/planes.py (misfit). Signals and those of a white plane are (L, P). */

#include "kernel.h"

#define MOST_LIGHTS 64 /* FEW_LIGHTS of the twin's module */

enum { MODEL, SHADE, WEAK };

/* The ratio of its rank among L, of which all but `sound` are the least: the highest but one, or the middle one. */
static double ranked(const double *ratio, int64_t L, int64_t sound, bool shaded) {
    double high = -INFINITY, next = -INFINITY, sorted[MOST_LIGHTS];
    if (shaded) {
        for (int64_t k = 0; k < L; k++) {
            if (ratio[k] > high) {
                next = high;
                high = ratio[k];
            } else if (ratio[k] > next)
                next = ratio[k];
        }
        return next;
    }
    for (int64_t k = 0; k < L; k++) {
        int64_t at = k;
        for (; at && sorted[at - 1] > ratio[k]; at--) sorted[at] = sorted[at - 1];
        sorted[at] = ratio[k];
    }
    return sorted[L - 1 - (sound > 1 ? sound - 1 : 0) / 2];
}

/* Mean square residual a degree of freedom (P), infinite where fewer than two samples count or the plane is missed; and how many count. */
KERNEL void lpcal_misfit(int64_t L, int64_t P, const double *signal, const double *sigma, const bool *usable, const double *m,
                         int64_t shaded, const double *c, double *square, double *count) {
    for (int64_t p = 0; p < P; p++) {
        double ratio[MOST_LIGHTS], top = -INFINITY, above = 0.0, below = 0.0, total = 0.0;
        bool hit = true;
        int64_t sound = 0, counted = 0;
        for (int64_t k = 0; k < L; k++) {
            double white = m[k * P + p];
            hit = hit && isfinite(white);
            top = white > top ? white : top;
        }
        square[p] = INFINITY;
        count[p] = 0.0;
        if (!hit || !(top > 0.0)) continue;
        for (int64_t k = 0; k < L; k++) {
            double white = m[k * P + p];
            bool strong = usable[k * P + p] && white > c[WEAK] * top;
            ratio[k] = strong ? signal[k * P + p] / (white > 1e-9 ? white : 1e-9) : -INFINITY;
            sound += strong;
        }
        double least = c[SHADE] * ranked(ratio, L, sound, shaded);
        for (int64_t k = 0; k < L; k++) {
            double white = m[k * P + p], s = signal[k * P + p], lacks = c[MODEL] * s;
            if (!(ratio[k] > least)) continue;
            double weight = 1.0 / (sigma[k * P + p] * sigma[k * P + p] + lacks * lacks);
            above += weight * white * s;
            below += weight * (white * white);
            counted++;
        }
        count[p] = (double)counted;
        if (counted < 2) continue;
        double albedo = above / (below > 1e-30 ? below : 1e-30);
        for (int64_t k = 0; k < L; k++) {
            double s = signal[k * P + p], lacks = c[MODEL] * s;
            if (!(ratio[k] > least)) continue;
            double r = (s - albedo * m[k * P + p]) / sqrt(sigma[k * P + p] * sigma[k * P + p] + lacks * lacks);
            total += r * r;
        }
        square[p] = total / (double)(counted - 1);
    }
}
