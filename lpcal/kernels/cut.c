/* Segmentation of an image by a primal-dual method. Twins: segmentation/cut.py (_relaxed) and segmentation/layers.py (cheapest); to the last bit. */

#include "kernel.h"

#define BLOCK 64
#define MOST_LAYERS 64
#define TOGETHER 10 /* steps of many labels that follow each other within the cache */

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

/* The point of the simplex nearest to each of BLOCK points, given and found layer by layer (layers, BLOCK): what all numbers are lowered by
   is the largest of (sum of the k largest - 1) / k (Held, Wolfe and Crowder 1974). */
static void on_the_simplex(int64_t layers, double at[][BLOCK]) {
    static const int count = BLOCK;
    double ordered[MOST_LAYERS][BLOCK], sum[BLOCK] = {0.0}, by[BLOCK];
    memcpy(ordered, at, (size_t)layers * sizeof *at);
    for (int64_t i = 1; i < layers; i++) /* the largest first */
        for (int64_t j = i; j > 0; j--)
            for (int p = 0; p < count; p++) {
                double a = ordered[j - 1][p], b = ordered[j][p];
                ordered[j - 1][p] = a > b ? a : b;
                ordered[j][p] = a > b ? b : a;
            }
    for (int p = 0; p < count; p++) by[p] = ordered[0][p] - 1.0;
    for (int64_t l = 0; l < layers; l++) {
        double share = 1.0 / (double)(l + 1);
        for (int p = 0; p < count; p++) {
            sum[p] += ordered[l][p];
            double over = (sum[p] - 1.0) * share;
            by[p] = over > by[p] ? over : by[p];
        }
    }
    for (int64_t l = 0; l < layers; l++)
        for (int p = 0; p < count; p++) {
            double x = at[l][p] - by[p];
            at[l][p] = x > 0.0 ? x : 0.0;
        }
}

/* State of the multi-label problem: images of all layers. */
typedef struct {
    int64_t layers, rows, columns;
    const double *cost, *across, *down;
    double dual, primal, *ahead, *right, *below, *x;
} Labels;

/* A step of one row: of the flows to its right and below it, then of its indicators. */
static void row_stepped(const Labels *of, int64_t y) {
    int64_t layers = of->layers, columns = of->columns, n = of->rows * columns, wide = columns - 1;
    const double *most = of->across + y * wide, *deep = of->down + y * columns;
    double dual = of->dual, primal = of->primal;
    for (int64_t l = 0; l < layers; l++) {
        const double *from = of->ahead + l * n + y * columns, *under = from + columns;
        double *flow = of->right + l * n + y * columns, *fall = of->below + l * n + y * columns;
        for (int64_t i = 0; i < wide; i++) flow[i] = held(flow[i] + dual * (from[i + 1] - from[i]), most[i]);
        if (y + 1 < of->rows)
            for (int64_t i = 0; i < columns; i++) fall[i] = held(fall[i] + dual * (under[i] - from[i]), deep[i]);
    }
    for (int64_t first = 0; first < columns; first += BLOCK) {
        int64_t some = columns - first < BLOCK ? columns - first : BLOCK;
        double moved[MOST_LAYERS][BLOCK];
        for (int64_t l = 0; l < layers; l++) {
            int64_t at = l * n + y * columns + first;
            const double *flow = of->right + at, *fall = of->below + at, *own = of->x + at, *cost = of->cost + at;
            double *to = moved[l];
            for (int64_t i = some; i < BLOCK; i++) to[i] = 0.0;
            for (int64_t i = 0; i < some; i++) to[i] = -cost[i] + flow[i]; /* nothing flows out of the last column and row */
            for (int64_t i = 0; i < some; i++) to[i] = to[i] - flow[i - 1] + fall[i];
            for (int64_t i = 0; y && i < some; i++) to[i] -= fall[i - columns];
            for (int64_t i = 0; i < some; i++) to[i] = own[i] + primal * to[i];
        }
        on_the_simplex(layers, moved);
        for (int64_t l = 0; l < layers; l++) {
            int64_t at = l * n + y * columns + first;
            for (int64_t i = 0; i < some; i++) {
                double before = of->x[at + i];
                of->x[at + i] = moved[l][i];
                of->ahead[at + i] = 2.0 * moved[l][i] - before;
            }
        }
    }
}

/* Indicators x (layers, rows, columns) of many labels after so many steps, from those given. `across` (rows, columns - 1) and `down`
   (rows - 1, columns) are halves of the costs of a boundary; `work` holds three times as many numbers as x, and one. A step asks for the
   row below as the step before has left it: TOGETHER steps follow each other two rows apart, while their rows are still at hand. */
KERNEL void lpcal_many_labels(int64_t layers, int64_t rows, int64_t columns, const double *cost, const double *across, const double *down,
                              int64_t steps, double dual, double primal, double *work, double *x) {
    int64_t all = layers * rows * columns;
    Labels of = {layers, rows, columns, cost, across, down, dual, primal, work, work + all + 1, work + 2 * all + 1, x};
    memcpy(of.ahead, x, (size_t)all * sizeof *x);
    memset(of.right - 1, 0, (size_t)(2 * all + 1) * sizeof *x);
    for (int64_t done = 0; done < steps; done += TOGETHER) {
        int64_t together = steps - done < TOGETHER ? steps - done : TOGETHER;
        for (int64_t front = 0; front < rows + 2 * (together - 1); front++)
            for (int64_t k = 0, y = front; k < together; k++, y -= 2)
                if (y >= 0 && y < rows) row_stepped(&of, y);
    }
}
