/* Cuts of an image by primal-dual steps. Twins: segmentation/cut.py (_relaxed) and segmentation/layers.py (cheapest); to the last bit. */

#include "kernel.h"

#define BLOCK 64
#define MOST_LAYERS 64

static inline float clipped(float x, float low, float high) {
    float above = x > low ? x : low;
    return above < high ? above : high;
}

static inline double held(double x, double most) {
    double above = x > -most ? x : -most;
    return above < most ? above : most;
}

/* u (rows, columns) of two labels after so many steps, from where the evidence points to. `across` (rows, columns - 1) and `down`
   (rows - 1, columns) are costs of the outline; `work` holds three images. Only pixels in stretches (stretches, 3) of a row from a first to
   before a last column change: beyond them the evidence stands. */
KERNEL void lpcal_two_labels(int64_t rows, int64_t columns, const float *evidence, const float *across, const float *down,
                             int64_t stretches, const int64_t *stretch, int64_t steps, double length, float *work, float *u) {
    int64_t n = rows * columns, wide = columns - 1;
    float *ahead = work, *right = work + n, *below = work + 2 * n, step = (float)length;
    for (int64_t i = 0; i < n; i++) {
        u[i] = ahead[i] = evidence[i] > 0.0f ? 1.0f : 0.0f;
        right[i] = below[i] = 0.0f;
    }
    for (int64_t k = 0; k < steps; k++) {
        for (int64_t s = 0; s < stretches; s++) {
            int64_t y = stretch[3 * s], begin = stretch[3 * s + 1], end = stretch[3 * s + 2], inner = end < wide ? end : wide;
            const float *from = ahead + y * columns, *most = across + y * wide, *under = from + columns, *deep = down + y * columns;
            float *flow = right + y * columns, *fall = below + y * columns;
            for (int64_t x = begin; x < inner; x++) flow[x] = clipped(flow[x] + step * (from[x + 1] - from[x]), -most[x], most[x]);
            if (y + 1 < rows)
                for (int64_t x = begin; x < end; x++) fall[x] = clipped(fall[x] + step * (under[x] - from[x]), -deep[x], deep[x]);
        }
        for (int64_t s = 0; s < stretches; s++) {
            int64_t y = stretch[3 * s], begin = stretch[3 * s + 1], end = stretch[3 * s + 2];
            const float *flow = right + y * columns, *fall = below + y * columns, *said = evidence + y * columns;
            float *now = u + y * columns, *next = ahead + y * columns;
            for (int64_t x = begin; x < end; x++) {
                float pull = said[x];
                if (x < wide) pull += flow[x];
                if (x) pull -= flow[x - 1];
                if (y + 1 < rows) pull += fall[x];
                if (y) pull -= fall[x - columns];
                float before = now[x];
                now[x] = clipped(before + step * pull, 0.0f, 1.0f);
                next[x] = 2.0f * now[x] - before;
            }
        }
    }
}

/* The point of the simplex nearest to each of `some` points, given and found layer by layer (layers, BLOCK). */
static void on_the_simplex(int64_t layers, double at[][BLOCK]) {
    static const int count = BLOCK;
    double ordered[MOST_LAYERS][BLOCK], over[MOST_LAYERS][BLOCK], last[BLOCK], by[BLOCK];
    memcpy(ordered, at, (size_t)layers * sizeof *at);
    for (int64_t i = 1; i < layers; i++) /* the largest first */
        for (int64_t j = i; j > 0; j--)
            for (int p = 0; p < count; p++) {
                double a = ordered[j - 1][p], b = ordered[j][p];
                ordered[j - 1][p] = a > b ? a : b;
                ordered[j][p] = a > b ? b : a;
            }
    for (int p = 0; p < count; p++) {
        over[0][p] = ordered[0][p];
        last[p] = 0.0;
    }
    for (int64_t l = 1; l < layers; l++)
        for (int p = 0; p < count; p++) over[l][p] = over[l - 1][p] + ordered[l][p];
    for (int64_t l = 0; l < layers; l++)
        for (int p = 0; p < count; p++) {
            over[l][p] -= 1.0;
            last[p] += ordered[l][p] - over[l][p] / (double)(l + 1) > 0.0 ? 1.0 : 0.0;
        }
    for (int p = 0; p < count; p++) by[p] = over[(int64_t)last[p] - 1][p] / last[p];
    for (int64_t l = 0; l < layers; l++)
        for (int p = 0; p < count; p++) {
            double x = at[l][p] - by[p];
            at[l][p] = x > 0.0 ? x : 0.0;
        }
}

/* Indicators x (layers, rows, columns) of many labels after so many steps, from those given. `across` (rows, columns - 1) and `down`
   (rows - 1, columns) are halves of the costs of a boundary; `work` holds three times as many numbers as x. */
KERNEL void lpcal_many_labels(int64_t layers, int64_t rows, int64_t columns, const double *cost, const double *across, const double *down,
                              int64_t steps, double dual, double primal, double *work, double *x) {
    int64_t n = rows * columns, wide = columns - 1, all = layers * n;
    double *ahead = work, *right = work + all, *below = work + 2 * all;
    memcpy(ahead, x, (size_t)all * sizeof *x);
    memset(right, 0, (size_t)(2 * all) * sizeof *x);
    for (int64_t k = 0; k < steps; k++) {
        for (int64_t l = 0; l < layers; l++)
            for (int64_t y = 0; y < rows; y++) {
                const double *from = ahead + l * n + y * columns, *under = from + columns, *most = across + y * wide, *deep = down + y * columns;
                double *flow = right + l * n + y * columns, *fall = below + l * n + y * columns;
                for (int64_t i = 0; i < wide; i++) flow[i] = held(flow[i] + dual * (from[i + 1] - from[i]), most[i]);
                if (y + 1 < rows)
                    for (int64_t i = 0; i < columns; i++) fall[i] = held(fall[i] + dual * (under[i] - from[i]), deep[i]);
            }
        for (int64_t y = 0; y < rows; y++)
            for (int64_t first = 0; first < columns; first += BLOCK) {
                int64_t some = columns - first < BLOCK ? columns - first : BLOCK;
                double moved[MOST_LAYERS][BLOCK] = {{0.0}};
                for (int64_t l = 0; l < layers; l++) {
                    int64_t at = l * n + y * columns + first;
                    const double *flow = right + at, *fall = below + at;
                    for (int64_t i = 0; i < some; i++) {
                        double pull = -cost[at + i];
                        if (first + i < wide) pull += flow[i];
                        if (first + i) pull -= flow[i - 1];
                        if (y + 1 < rows) pull += fall[i];
                        if (y) pull -= fall[i - columns];
                        moved[l][i] = x[at + i] + primal * pull;
                    }
                }
                on_the_simplex(layers, moved);
                for (int64_t l = 0; l < layers; l++) {
                    int64_t at = l * n + y * columns + first;
                    for (int64_t i = 0; i < some; i++) {
                        double before = x[at + i];
                        x[at + i] = moved[l][i];
                        ahead[at + i] = 2.0 * moved[l][i] - before;
                    }
                }
            }
    }
}
