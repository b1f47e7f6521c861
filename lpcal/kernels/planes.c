/* Misfit of pixels against a plane. Twin: segmentation/planes.py (misfit). Signals and those of the plane at albedo 1 are (L, P). */

#include "kernel.h"

#define MOST_LIGHTS 64 /* FEW_LIGHTS of the twin's module */

#define BLOCK 64

enum { MODEL, SHADE, WEAK };

/* The median of the `sound` ratios among L, the others being the smallest. */
static double middle(const double ratio[][BLOCK], int64_t p, int64_t L, int64_t sound) {
    double sorted[MOST_LIGHTS];
    for (int64_t k = 0; k < L; k++) {
        int64_t at = k;
        for (; at && sorted[at - 1] > ratio[k][p]; at--) sorted[at] = sorted[at - 1];
        sorted[at] = ratio[k][p];
    }
    return sorted[L - 1 - (sound > 1 ? sound - 1 : 0) / 2];
}

/* Mean square residual a degree of freedom (P), infinite where fewer than two samples count or the plane is missed; and how many count; of
   pixels from the first to the last. */
KERNEL void lpcal_misfit(int64_t L, int64_t P, const double *signal, const double *sigma, const bool *usable, const double *m,
                         int64_t shaded, const double *c, int64_t first, int64_t last, double *square, double *count) {
    double ratio[MOST_LIGHTS][BLOCK], model = c[MODEL], weak = c[WEAK];
    for (; first < last; first += BLOCK) {
        int64_t some = last - first < BLOCK ? last - first : BLOCK;
        double top[BLOCK], hit[BLOCK], high[BLOCK], next[BLOCK], sound[BLOCK] = {0.0}, above[BLOCK] = {0.0}, below[BLOCK] = {0.0};
        double counted[BLOCK] = {0.0}, albedo[BLOCK], total[BLOCK] = {0.0};
        for (int p = 0; p < BLOCK; p++) {
            top[p] = high[p] = next[p] = -INFINITY;
            hit[p] = 1.0;
        }
        for (int64_t k = 0; k < L; k++) {
            const double *white = m + k * P + first;
            for (int64_t p = 0; p < some; p++) {
                hit[p] = white[p] - white[p] == 0.0 ? hit[p] : 0.0; /* not where it is infinite, or no number */
                top[p] = white[p] > top[p] ? white[p] : top[p];
            }
        }
        for (int64_t k = 0; k < L; k++) {
            const double *white = m + k * P + first, *shown = signal + k * P + first;
            const bool *good = usable + k * P + first;
            for (int64_t p = 0; p < some; p++) {
                double strong = white[p] > weak * top[p] ? 1.0 : 0.0, quotient = shown[p] / (white[p] > 1e-9 ? white[p] : 1e-9);
                strong = good[p] ? strong : 0.0;
                ratio[k][p] = quotient = strong > 0.0 ? quotient : -INFINITY;
                sound[p] += strong;
                double lesser = quotient < high[p] ? quotient : high[p];
                next[p] = lesser > next[p] ? lesser : next[p];
                high[p] = quotient > high[p] ? quotient : high[p];
            }
        }
        for (int64_t p = 0; !shaded && p < some; p++) next[p] = middle((const double (*)[BLOCK])ratio, p, L, (int64_t)sound[p]);
        for (int64_t k = 0; k < L; k++) {
            const double *white = m + k * P + first, *shown = signal + k * P + first, *noise = sigma + k * P + first;
            for (int64_t p = 0; p < some; p++) {
                double lacks = model * shown[p], weight = 1.0 / (noise[p] * noise[p] + lacks * lacks), by = weight * white[p];
                double taken = ratio[k][p] > c[SHADE] * next[p] ? 1.0 : 0.0;
                above[p] += taken > 0.0 ? by * shown[p] : 0.0;
                below[p] += taken > 0.0 ? by * white[p] : 0.0;
                counted[p] += taken;
            }
        }
        for (int p = 0; p < BLOCK; p++) albedo[p] = above[p] / (below[p] > 1e-30 ? below[p] : 1e-30);
        for (int64_t k = 0; k < L; k++) {
            const double *white = m + k * P + first, *shown = signal + k * P + first, *noise = sigma + k * P + first;
            for (int64_t p = 0; p < some; p++) {
                double lacks = model * shown[p], apart = shown[p] - albedo[p] * white[p];
                double own = apart * apart / (noise[p] * noise[p] + lacks * lacks);
                total[p] += ratio[k][p] > c[SHADE] * next[p] ? own : 0.0;
            }
        }
        for (int64_t p = 0; p < some; p++) {
            bool meets = hit[p] > 0.0 && top[p] > 0.0;
            count[first + p] = meets ? counted[p] : 0.0;
            square[first + p] = meets && counted[p] >= 2.0 ? total[p] / (counted[p] - 1.0) : INFINITY;
        }
    }
}
