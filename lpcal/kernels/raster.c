/* Image operations. Twins: geometry/raster.py, which calls scipy.ndimage. */

#include "kernel.h"

#define BLOCK 256

static int64_t first_of(int32_t *of, int64_t p) {
    while (of[p] != p) p = of[p] = of[of[p]];
    return p;
}

/* Labels (H, W) from 1 of the mask's 4-connected components, in the order of their first pixels; 0 outside. */
KERNEL void lpcal_labelled(int64_t H, int64_t W, const bool *mask, int32_t *of, int32_t *label, int32_t *count) {
    for (int64_t i = 0; i < H; i++)
        for (int64_t j = 0, p = i * W; j < W; j++, p++) {
            if (!mask[p]) continue;
            bool left = j && mask[p - 1], above = i && mask[p - W];
            of[p] = (int32_t)(left ? of[p - 1] : above ? of[p - W] : p);
            if (left && above && !mask[p - W - 1]) {
                int64_t one = first_of(of, p - 1), other = first_of(of, p - W);
                if (one < other) of[other] = of[p] = (int32_t)one;
                else of[one] = of[p] = (int32_t)other;
            }
        }
    *count = 0;
    for (int64_t p = 0; p < H * W; p++) /* the first pixel of a set comes before its others and has its label by then */
        label[p] = !mask[p] ? 0 : of[p] == p ? ++*count : label[of[p]];
}

/* The number (H, W) of the nearest pixel of a mask and the square of its distance; of several the one that scipy takes: the upper one of
   a column, the first of those columns' ones. Columns first, then the lower envelope of parabolas along rows (Maurer, Qi and Raghavan
   2003). Work: 3 W. */
KERNEL void lpcal_nearest(int64_t H, int64_t W, const bool *mask, int64_t *work, int64_t *number, double *square) {
    int64_t *before = work, *stack = work + W, *high = work + 2 * W;
    for (int64_t j = 0; j < W; j++) before[j] = -1;
    for (int64_t i = 0; i < H; i++) /* the row of the last one above */
        for (int64_t j = 0; j < W; j++) number[i * W + j] = before[j] = mask[i * W + j] ? i : before[j];
    for (int64_t j = 0; j < W; j++) before[j] = -1;
    for (int64_t i = H - 1; i >= 0; i--) /* or of the first one below, where that is nearer */
        for (int64_t j = 0; j < W; j++) {
            int64_t above = number[i * W + j], below = before[j] = mask[i * W + j] ? i : before[j];
            number[i * W + j] = above < 0 || (below >= 0 && below - i < i - above) ? below : above;
        }
    for (int64_t i = 0; i < H; i++) {
        int64_t *row = number + i * W, top = -1;
        for (int64_t j = 0; j < W; j++) {
            if (row[j] < 0) continue;
            int64_t third = (row[j] - i) * (row[j] - i);
            while (top >= 1) {
                int64_t one = stack[top - 1], two = stack[top], a = two - one, b = j - two;
                if ((a + b) * high[top] - b * high[top - 1] - a * third - a * b * (a + b) <= 0) break;
                top--;
            }
            stack[++top] = j;
            high[top] = third;
        }
        if (top < 0) {
            for (int64_t j = 0; j < W; j++) square[i * W + j] = INFINITY;
            continue;
        }
        for (int64_t k = 0; k <= top; k++) before[k] = row[stack[k]] * W + stack[k];
        for (int64_t j = 0, k = 0; j < W; j++) {
            int64_t far = high[k] + (stack[k] - j) * (stack[k] - j);
            while (k < top) {
                int64_t next = high[k + 1] + (stack[k + 1] - j) * (stack[k + 1] - j);
                if (far <= next) break;
                far = next;
                k++;
            }
            row[j] = before[k];
            square[i * W + j] = (double)far;
        }
    }
}

/* The index in 0..n that replaces an index beyond an end; -1: zero. Borders: 0 zero, 1 nearest, 2 mirrored. */
static int64_t within(int64_t at, int64_t n, int64_t border) {
    if (at >= 0 && at < n) return at;
    if (border == 0) return -1;
    if (border == 1) return at < 0 ? 0 : n - 1;
    at %= 2 * n;
    if (at < 0) at += 2 * n;
    return at < n ? at : 2 * n - 1 - at;
}

/* Values (outer, n, inner) convolved along the middle axis with a symmetric window (radius + 1), the furthest weight first. Work: 3 n + 2 radius + BLOCK. */
#define JOINED(name, number)                                                                                                               \
    KERNEL void name(int64_t outer, int64_t n, int64_t inner, int64_t radius, int64_t border, const double *weight, double *work,          \
                     const number *values, number *found) {                                                                                \
        static const number nothing[BLOCK];                                                                                                \
        double sum[BLOCK];                                                                                                                 \
        for (int64_t o = 0; o < outer; o++, values += n * inner, found += n * inner) {                                                     \
            if (inner == 1) {                                                                                                              \
                double *line = work + radius, *total = work + n + 2 * radius;                                                              \
                for (int64_t i = -radius; i < n + radius; i++) {                                                                           \
                    int64_t at = within(i, n, border);                                                                                     \
                    line[i] = at < 0 ? 0.0 : values[at];                                                                                   \
                }                                                                                                                          \
                for (int64_t i = 0; i < n; i++) total[i] = line[i] * weight[0];                                                            \
                for (int64_t k = radius; k > 0; k--)                                                                                       \
                    for (int64_t i = 0; i < n; i++) total[i] += (line[i - k] + line[i + k]) * weight[k];                                   \
                for (int64_t i = 0; i < n; i++) found[i] = (number)total[i];                                                               \
                continue;                                                                                                                  \
            }                                                                                                                              \
            for (int64_t first = 0; first < inner; first += BLOCK) {                                                                       \
                int64_t some = inner - first < BLOCK ? inner - first : BLOCK;                                                              \
                for (int64_t i = 0; i < n; i++) {                                                                                          \
                    const number *here = values + i * inner + first;                                                                       \
                    for (int64_t c = 0; c < some; c++) sum[c] = here[c] * weight[0];                                                       \
                    for (int64_t k = radius; k > 0; k--) {                                                                                 \
                        int64_t a = within(i - k, n, border), b = within(i + k, n, border);                                                \
                        const number *one = a < 0 ? nothing : values + a * inner + first;                                                  \
                        const number *other = b < 0 ? nothing : values + b * inner + first;                                                \
                        for (int64_t c = 0; c < some; c++) sum[c] += ((double)one[c] + (double)other[c]) * weight[k];                      \
                    }                                                                                                                      \
                    for (int64_t c = 0; c < some; c++) found[i * inner + first + c] = (number)sum[c];                                      \
                }                                                                                                                          \
            }                                                                                                                              \
        }                                                                                                                                  \
    }

JOINED(lpcal_joined, double)
JOINED(lpcal_joined_singles, float)
