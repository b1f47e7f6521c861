/* Costs of samples with unknown ambient light, for a surface of free normal or a plane. Twin: segmentation/ambient_sample_costs.py (free,
   planar). Signals are (L, P), at most MOST_LIGHTS of them a pixel; the room's light A of a pixel is share[k] A in the signal of light k. */

#include "kernel.h"

#define BLOCK 64
#define MOST_LIGHTS 32

enum { MODEL2, BRIGHTER, DARKER, OUTLIER, DARK, HALF_DARK, DARK_SHARE, SHADOW, WIDTH2, DEEP, SPREAD, TIE };

static inline double lesser(double a, double b) { return a < b ? a : b; }

/* A block of pixels: signals, variance but for the signal's part, share of the signal's square in the variance, and whether they count. */
typedef struct {
    double signal[MOST_LIGHTS][BLOCK], noise2[MOST_LIGHTS][BLOCK], lacks[MOST_LIGHTS][BLOCK], counts[MOST_LIGHTS][BLOCK];
} Block;

static void load(Block *to, int64_t L, int64_t P, int64_t first, int64_t some, const double *signal, const double *sigma,
                 const bool *usable, const float *doubt, const double *c) {
    for (int64_t k = 0; k < L; k++)
        for (int64_t p = 0; p < BLOCK; p++) {
            int64_t at = k * P + first + (p < some ? p : some - 1);
            to->signal[k][p] = signal[at];
            to->noise2[k][p] = square(sigma[at]);
            to->lacks[k][p] = c[MODEL2] + square((double)doubt[at]);
            to->counts[k][p] = usable[at] ? 1.0 : 0.0;
        }
}

static inline double prior_weight(double size, double level, const double *c) {
    return 1.0 / square(greater(c[SPREAD] * level * size, 1e-12));
}

/* Cost and square residual of what the lamp adds to a sample, by its variance and the pixel's brightest. */
static inline double costs(double lamps, double spread2, double top, double predicted, const double *c, double *square_residual) {
    double indirect = (lamps > predicted ? c[BRIGHTER] : c[DARKER]) * top;
    double residual2 = square(lamps - predicted) / (spread2 + square(indirect));
    double below = lesser(square(lesser(lamps, 0.0)) / (spread2 + square(c[DEEP] * top)), c[OUTLIER]);
    double shadow = (lamps < c[DARK_SHARE] * predicted ? c[DARK] : c[HALF_DARK]) + below;
    *square_residual = residual2;
    return lesser(residual2, lamps < predicted ? shadow : c[OUTLIER]);
}

/* x[4] of a symmetric positive matrix (its upper half, row by row) and right side, and what that makes of (0, 0, 0, 1) in the last place:
   M = L D L'. */
static inline double solved(const double M[10], const double right[4], double x[4]) {
    double d0 = M[0], l10 = M[1] / d0, l20 = M[2] / d0, l30 = M[3] / d0;
    double d1 = M[4] - l10 * M[1], m21 = M[5] - l20 * M[1], m31 = M[6] - l30 * M[1], l21 = m21 / d1, l31 = m31 / d1;
    double d2 = M[7] - l20 * M[2] - l21 * m21, m32 = M[8] - l30 * M[2] - l31 * m21, l32 = m32 / d2;
    double d3 = M[9] - l30 * M[3] - l31 * m31 - l32 * m32;
    double y1 = right[1] - l10 * right[0], y2 = right[2] - l20 * right[0] - l21 * y1;
    double y3 = right[3] - l30 * right[0] - l31 * y1 - l32 * y2;
    x[3] = y3 / d3;
    x[2] = y2 / d2 - l32 * x[3];
    x[1] = y1 / d1 - l21 * x[2] - l31 * x[3];
    x[0] = right[0] / d0 - l10 * x[1] - l20 * x[2] - l30 * x[3];
    return 1.0 / d3;
}

/* b (P, 3), A (P), cost (P) and information (P) of pixels as surfaces of free normal, lit by B (L, P, 3). */
KERNEL void lpcal_room_free(int64_t L, int64_t P, const double *signal, const double *sigma, const bool *usable, const double *B,
                            const float *doubt, const double *share, double level, const double *c, int64_t steps, double *b, double *A,
                            double *cost, double *information) {
    for (int64_t first = 0; first < P; first += BLOCK) {
        int64_t some = P - first < BLOCK ? P - first : BLOCK;
        Block of;
        double light[MOST_LIGHTS][3][BLOCK], E[MOST_LIGHTS][BLOCK], lamps[MOST_LIGHTS][BLOCK], shading[MOST_LIGHTS][BLOCK];
        double room[BLOCK], n[3][BLOCK], x[3][BLOCK], known[BLOCK], high[BLOCK], next[BLOCK], high_E[BLOCK], next_E[BLOCK], top[BLOCK];
        load(&of, L, P, first, some, signal, sigma, usable, doubt, c);
        for (int p = 0; p < BLOCK; p++) {
            room[p] = INFINITY;
            high[p] = next[p] = high_E[p] = next_E[p] = -INFINITY;
            known[p] = 0.0;
        }
        for (int64_t k = 0; k < L; k++)
            for (int64_t p = 0; p < BLOCK; p++) {
                const double *from = B + 3 * (k * P + first + (p < some ? p : some - 1));
                for (int i = 0; i < 3; i++) light[k][i][p] = from[i];
                E[k][p] = sqrt(dot3(from, from));
                room[p] = of.counts[k][p] > 0.0 ? lesser(of.signal[k][p] / share[k], room[p]) : room[p];
            }
        for (int p = 0; p < BLOCK; p++) room[p] = (room[p] < INFINITY ? greater(room[p], 0.0) : 0.0) / 2;
        for (int64_t k = 0; k < L; k++)
            for (int p = 0; p < BLOCK; p++) {
                double one = of.counts[k][p] > 0.0 ? of.signal[k][p] - share[k] * room[p] : 0.0, e = of.counts[k][p] > 0.0 ? E[k][p] : 0.0;
                next[p] = greater(next[p], lesser(high[p], one));
                high[p] = greater(high[p], one);
                next_E[p] = greater(next_E[p], lesser(high_E[p], e));
                high_E[p] = greater(high_E[p], e);
            }
        for (int p = 0; p < BLOCK; p++) {
            n[0][p] = n[1][p] = x[0][p] = x[1][p] = 0.0;
            n[2][p] = -1.0;
            x[2][p] = -next[p] / greater(next_E[p], 1e-12);
        }
        for (int64_t step = 0; step < steps; step++) {
            double M[10][BLOCK] = {{0.0}}, right[4][BLOCK] = {{0.0}};
            for (int p = 0; p < BLOCK; p++) high[p] = next[p] = top[p] = -INFINITY;
            for (int64_t k = 0; k < L; k++)
                for (int p = 0; p < BLOCK; p++) {
                    lamps[k][p] = of.signal[k][p] - share[k] * room[p];
                    double one = of.counts[k][p] > 0.0 ? lamps[k][p] / greater(E[k][p], 1e-12) : 0.0;
                    shading[k][p] = one;
                    next[p] = greater(next[p], lesser(high[p], one));
                    high[p] = greater(high[p], one);
                    top[p] = greater(top[p], lamps[k][p]);
                }
            for (int64_t k = 0; k < L; k++)
                for (int p = 0; p < BLOCK; p++) {
                    double lit = shading[k][p] < c[SHADOW] * next[p] ? 0.0 : 1.0, s = of.signal[k][p], h = share[k], raised = level * h;
                    double u = lit * light[k][0][p], v = lit * light[k][1][p], w = lit * light[k][2][p];
                    double spread2 = of.noise2[k][p] + of.lacks[k][p] * square(lamps[k][p]) + square(c[DEEP] * top[p]);
                    double predicted = greater(u * x[0][p] + v * x[1][p] + w * x[2][p], 0.0);
                    double off = step ? square(1.0 + square(lamps[k][p] - predicted) / spread2 / c[WIDTH2]) : 1.0;
                    double weight = of.counts[k][p] / spread2 / off;
                    u += raised * n[0][p];
                    v += raised * n[1][p];
                    w += raised * n[2][p];
                    double wu = weight * u, wv = weight * v, ww = weight * w, wh = weight * h;
                    M[0][p] += wu * u;
                    M[1][p] += wu * v;
                    M[2][p] += wu * w;
                    M[3][p] += wu * h;
                    M[4][p] += wv * v;
                    M[5][p] += wv * w;
                    M[6][p] += wv * h;
                    M[7][p] += ww * w;
                    M[8][p] += ww * h;
                    M[9][p] += wh * h;
                    right[0][p] += wu * s;
                    right[1][p] += wv * s;
                    right[2][p] += ww * s;
                    right[3][p] += wh * s;
                }
            for (int p = 0; p < BLOCK; p++) {
                double size = sqrt(square(x[0][p]) + square(x[1][p]) + square(x[2][p])), prior = prior_weight(size, level, c);
                double trace = M[0][p] + M[4][p] + M[7][p] + (M[9][p] + prior), scale2 = greater(trace, 1e-30), scale = sqrt(scale2);
                double matrix[10], side[4], found[4];
                for (int i = 0; i < 10; i++) matrix[i] = M[i][p] / scale / scale;
                matrix[9] = (M[9][p] + prior) / scale / scale;
                matrix[0] += c[TIE];
                matrix[4] += c[TIE];
                matrix[7] += c[TIE];
                matrix[9] += c[TIE];
                for (int i = 0; i < 4; i++) side[i] = right[i][p] / scale;
                double inverse = solved(matrix, side, found) / scale;
                for (int i = 0; i < 3; i++) x[i][p] = found[i] / scale;
                known[p] = lesser(greater(1.0 - prior * inverse / scale, 0.0), 1.0);
                double facing = n[0][p] * x[0][p] + n[1][p] * x[1][p] + n[2][p] * x[2][p];
                room[p] = greater(level * facing + found[3] / scale, 0.0);
                double length = sqrt(square(x[0][p]) + square(x[1][p]) + square(x[2][p])), by = greater(length, 1e-20);
                for (int i = 0; i < 3; i++) n[i][p] = length > 0.0 ? x[i][p] / by : n[i][p];
            }
        }
        double total[BLOCK] = {0.0};
        for (int p = 0; p < BLOCK; p++) top[p] = -INFINITY;
        for (int64_t k = 0; k < L; k++)
            for (int p = 0; p < BLOCK; p++) {
                lamps[k][p] = of.signal[k][p] - share[k] * room[p];
                top[p] = greater(top[p], of.counts[k][p] > 0.0 ? lamps[k][p] : 0.0);
            }
        for (int64_t k = 0; k < L; k++)
            for (int p = 0; p < BLOCK; p++) {
                double predicted = greater(light[k][0][p] * x[0][p] + light[k][1][p] * x[1][p] + light[k][2][p] * x[2][p], 0.0), residual2;
                double spread2 = of.noise2[k][p] + of.lacks[k][p] * square(lamps[k][p]);
                double one = costs(lamps[k][p], spread2, top[p], predicted, c, &residual2);
                total[p] += of.counts[k][p] > 0.0 ? one : 0.0;
            }
        for (int64_t p = 0; p < some; p++) {
            double size = sqrt(square(x[0][p]) + square(x[1][p]) + square(x[2][p]));
            for (int i = 0; i < 3; i++) b[3 * (first + p) + i] = x[i][p];
            A[first + p] = room[p];
            information[first + p] = known[p];
            cost[first + p] = total[p] + lesser(square(room[p] - level * size) * prior_weight(size, level, c), c[OUTLIER]);
        }
    }
}

/* The best explanation so far of a block's pixels as parts of a plane. */
typedef struct {
    double cost[BLOCK], albedo[BLOCK], room[BLOCK], lit[MOST_LIGHTS][BLOCK];
} Best;

/* Take what an albedo and a room's light explain better where that is allowed. */
static void consider(Best *best, const Block *of, const double m[][BLOCK], int64_t L, const double *albedo, const double *room,
                     const bool *allowed, const double *share, double level, const double *c) {
    double lit[MOST_LIGHTS][BLOCK], total[BLOCK] = {0.0}, agree[BLOCK] = {0.0}, top[BLOCK];
    for (int p = 0; p < BLOCK; p++) top[p] = -INFINITY;
    for (int64_t k = 0; k < L; k++)
        for (int p = 0; p < BLOCK; p++)
            top[p] = greater(top[p], of->counts[k][p] > 0.0 ? of->signal[k][p] - share[k] * room[p] : 0.0);
    for (int64_t k = 0; k < L; k++)
        for (int p = 0; p < BLOCK; p++) {
            double lamps = of->signal[k][p] - share[k] * room[p], residual2;
            double one = costs(lamps, of->noise2[k][p] + of->lacks[k][p] * square(lamps), top[p], albedo[p] * m[k][p], c, &residual2);
            bool counts = of->counts[k][p] > 0.0;
            lit[k][p] = counts && residual2 < c[WIDTH2] && m[k][p] > 0.0 ? 1.0 : 0.0;
            agree[p] += lit[k][p];
            total[p] += counts ? one : 0.0;
        }
    for (int p = 0; p < BLOCK; p++) {
        double prior = lesser(square(room[p] - level * albedo[p]) * prior_weight(albedo[p], level, c), c[OUTLIER]);
        bool better = allowed[p] && albedo[p] > 0.0 && agree[p] >= 2.0 && total[p] + prior < best->cost[p];
        if (!better) continue;
        best->cost[p] = total[p] + prior;
        best->albedo[p] = albedo[p];
        best->room[p] = room[p];
        for (int64_t k = 0; k < L; k++) best->lit[k][p] = lit[k][p];
    }
}

/* Cost (P), albedo (P), lit samples (L, P) and A (P) of pixels on a plane of signals m (L, P). */
KERNEL void lpcal_room_planar(int64_t L, int64_t P, const double *signal, const double *sigma, const bool *usable, const double *m,
                              const float *doubt, const double *share, double level, const double *c, int64_t rounds, double *cost,
                              double *albedo, bool *lit, double *A) {
    for (int64_t first = 0; first < P; first += BLOCK) {
        int64_t some = P - first < BLOCK ? P - first : BLOCK;
        Block of;
        Best best;
        double white[MOST_LIGHTS][BLOCK], one[BLOCK], room[BLOCK], count[BLOCK] = {0.0};
        bool allowed[BLOCK];
        load(&of, L, P, first, some, signal, sigma, usable, doubt, c);
        for (int p = 0; p < BLOCK; p++) {
            best.cost[p] = INFINITY;
            best.albedo[p] = best.room[p] = 0.0;
        }
        for (int64_t k = 0; k < L; k++)
            for (int64_t p = 0; p < BLOCK; p++) {
                white[k][p] = m[k * P + first + (p < some ? p : some - 1)];
                best.lit[k][p] = 0.0;
                count[p] += of.counts[k][p];
            }
        const double(*shown)[BLOCK] = (const double(*)[BLOCK])white;
        for (int64_t k = 0; k < L; k++) {
            for (int p = 0; p < BLOCK; p++) {
                one[p] = of.signal[k][p] / greater(white[k][p] + level * share[k], 1e-12);
                room[p] = level * one[p];
                allowed[p] = of.counts[k][p] > 0.0 && white[k][p] > 0.0;
            }
            consider(&best, &of, shown, L, one, room, allowed, share, level, c);
        }
        for (int64_t round = 0; round < rounds; round++) {
            double top[BLOCK], tie[BLOCK], mm[BLOCK], ms[BLOCK], ss[BLOCK], my[BLOCK] = {0.0}, sy[BLOCK] = {0.0};
            for (int p = 0; p < BLOCK; p++) {
                tie[p] = prior_weight(best.albedo[p], level, c);
                mm[p] = ms[p] = ss[p] = 0.0;
                top[p] = -INFINITY;
            }
            for (int64_t k = 0; k < L; k++)
                for (int p = 0; p < BLOCK; p++) top[p] = greater(top[p], of.signal[k][p] - share[k] * best.room[p]);
            for (int64_t k = 0; k < L; k++)
                for (int p = 0; p < BLOCK; p++) {
                    double s = of.signal[k][p], lamps = s - share[k] * best.room[p], h = share[k];
                    bool is_lit = best.lit[k][p] > 0.0;
                    bool dark = of.counts[k][p] > 0.0 && !is_lit && lamps < c[DARK_SHARE] * best.albedo[p] * white[k][p];
                    double spread2 = of.noise2[k][p] + of.lacks[k][p] * square(lamps) + square(c[DEEP] * top[p]);
                    double weight = is_lit || dark ? 1.0 / spread2 : 0.0, v = dark ? 0.0 : white[k][p];
                    mm[p] += weight * v * v;
                    ms[p] += weight * v * h;
                    ss[p] += weight * square(h);
                    my[p] += weight * v * s;
                    sy[p] += weight * h * s;
                }
            for (int p = 0; p < BLOCK; p++) {
                double a = mm[p] + tie[p] * square(level), b = ms[p] - tie[p] * level, d = ss[p] + tie[p];
                double over = greater(a * d - square(b), 1e-30);
                one[p] = (d * my[p] - b * sy[p]) / over;
                room[p] = greater((a * sy[p] - b * my[p]) / over, 0.0);
                allowed[p] = one[p] > 0.0;
            }
            consider(&best, &of, shown, L, one, room, allowed, share, level, c);
        }
        for (int64_t p = 0; p < some; p++) {
            cost[first + p] = count[p] < 2.0 ? 0.0 : best.cost[p] < INFINITY ? best.cost[p] : c[OUTLIER] * (double)L;
            albedo[first + p] = best.albedo[p];
            A[first + p] = best.room[p];
            for (int64_t k = 0; k < L; k++) lit[k * P + first + p] = best.lit[k][p] > 0.0;
        }
    }
}
