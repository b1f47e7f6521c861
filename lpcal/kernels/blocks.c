/* Binning of blocks of pixels. Twin: view/coarse.py (coarse_of). */

#include "kernel.h"

/* Means of a row of blocks of `sums` down the blocks (columns, factor, each): summed along them in the twin's order. */
static inline void along(int64_t columns, int64_t factor, int64_t each, const double *sums, double *found) {
    double share = (double)(factor * factor);
    for (int64_t c = 0; c < columns; c++)
        for (int64_t i = 0; i < each; i++) {
            double total = sums[c * factor * each + i];
            for (int64_t k = 1; k < factor; k++) total += sums[(c * factor + k) * each + i];
            found[c * each + i] = total / share;
        }
}

/* Means (rows, columns, each) of blocks of maps (height, width, each); `work` are width times each numbers. */
KERNEL void lpcal_block_means(int64_t rows, int64_t columns, int64_t factor, int64_t width, int64_t each, const double *map, double *work,
                              double *found) {
    for (int64_t r = 0; r < rows; r++) {
        const double *first = map + r * factor * width * each;
        int64_t used = columns * factor * each;
        memcpy(work, first, (size_t)used * sizeof *work);
        for (int64_t k = 1; k < factor; k++)
            for (int64_t i = 0; i < used; i++) work[i] += first[k * width * each + i];
        along(columns, factor, each, work, found + r * columns * each);
    }
}

/* Signals, noise and usability (all pixels usable) of blocks of maps (L, height, width); `work` are twice width numbers. */
KERNEL void lpcal_blocks(int64_t L, int64_t rows, int64_t columns, int64_t factor, int64_t height, int64_t width, const float *signal,
                         const float *sigma, const bool *usable, double *work, double *joined, double *noise, bool *counts) {
    int64_t used = columns * factor;
    double *square = work + width;
    for (int64_t k = 0; k < L; k++)
        for (int64_t r = 0; r < rows; r++) {
            int64_t first = (k * height + r * factor) * width, to = (k * rows + r) * columns;
            memset(work, 0, 2 * (size_t)width * sizeof *work);
            for (int64_t c = 0; c < columns; c++) counts[to + c] = true;
            for (int64_t down = 0; down < factor; down++) {
                int64_t from = first + down * width;
                for (int64_t i = 0; i < used; i++) {
                    work[i] += (double)signal[from + i];
                    square[i] += (double)(sigma[from + i] * sigma[from + i]);
                }
                for (int64_t i = 0; i < used; i++)
                    if (!usable[from + i]) counts[to + i / factor] = false;
            }
            along(columns, factor, 1, work, joined + to);
            along(columns, factor, 1, square, noise + to);
            for (int64_t c = 0; c < columns; c++) noise[to + c] = sqrt(noise[to + c]) / (double)factor;
        }
}
