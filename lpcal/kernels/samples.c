/* Costs of samples for a surface of free normal or a plane, and the signals of a plane from a table of the light field.
   Twins: segmentation/sample_costs.py (free, planar) and segmentation/plane_hough.py (white). Signals are (L, P), at most MOST_LIGHTS of them a pixel. */

#include "kernel.h"

#define BLOCK 64
#define MOST_LIGHTS 32

enum { MODEL2, BRIGHTER, DARKER, OUTLIER, DARK, HALF_DARK, DARK_SHARE, SHADOW, WIDTH2, SINGULAR };

/* max(x, 0); NaN stays NaN. */
static inline double from_zero(double x) { return x < 0.0 ? 0.0 : x; }

static inline double square_residual(double signal, double predicted, double spread2, double top, const double *c) {
    double apart = signal - predicted, indirect = (signal > predicted ? c[BRIGHTER] : c[DARKER]) * top;
    return apart * apart / (spread2 + indirect * indirect);
}

static inline double price(double signal, double predicted, double square, const double *c) {
    double shadow = signal < c[DARK_SHARE] * predicted ? c[DARK] : c[HALF_DARK], most = signal < predicted ? shadow : c[OUTLIER];
    return square > most ? most : square;
}

/* A block of pixels: signals, whether they count, their variance but for indirect light, and the brightest of each pixel. */
typedef struct {
    double signal[MOST_LIGHTS][BLOCK], spread2[MOST_LIGHTS][BLOCK], counts[MOST_LIGHTS][BLOCK], top[BLOCK];
} Block;

static void load(Block *to, int64_t L, int64_t P, int64_t first, int64_t some, const double *signal, const double *sigma,
                 const bool *usable, const float *doubt, const double *c) {
    for (int64_t k = 0; k < L; k++)
        for (int64_t p = 0; p < BLOCK; p++) {
            int64_t at = k * P + first + (p < some ? p : some - 1);
            double s = signal[at], off = (double)doubt[at];
            to->signal[k][p] = s;
            to->counts[k][p] = usable[at] ? 1.0 : 0.0;
            to->spread2[k][p] = sigma[at] * sigma[at] + (c[MODEL2] + off * off) * (s * s);
            to->top[p] = k && to->top[p] > s ? to->top[p] : s;
        }
}

/* b[3][BLOCK] of least squares by weights, NaN where the lights do not span space. */
static void solved(int64_t L, const double B[][3][BLOCK], const double signal[][BLOCK], const double weight[][BLOCK], double singular,
                   double b[3][BLOCK]) {
    double M[6][BLOCK] = {{0.0}}, right[3][BLOCK] = {{0.0}};
    for (int64_t k = 0; k < L; k++)
        for (int p = 0; p < BLOCK; p++) {
            double w = weight[k][p], x = w * B[k][0][p], y = w * B[k][1][p], z = w * B[k][2][p], s = signal[k][p];
            M[0][p] += x * B[k][0][p];
            M[1][p] += x * B[k][1][p];
            M[2][p] += x * B[k][2][p];
            M[3][p] += y * B[k][1][p];
            M[4][p] += y * B[k][2][p];
            M[5][p] += z * B[k][2][p];
            right[0][p] += x * s;
            right[1][p] += y * s;
            right[2][p] += z * s;
        }
    for (int p = 0; p < BLOCK; p++) {
        double xx = M[0][p], xy = M[1][p], xz = M[2][p], yy = M[3][p], yz = M[4][p], zz = M[5][p];
        double c0 = yy * zz - yz * yz, c1 = yz * xz - xy * zz, c2 = xy * yz - yy * xz;
        double c4 = zz * xx - xz * xz, c5 = xz * xy - yz * xx, c8 = xx * yy - xy * xy;
        double determinant = xx * c0 + xy * c1 + xz * c2, trace = xx + yy + zz;
        double by = 1.0 / (determinant > singular * (trace * trace * trace) ? determinant : NAN);
        b[0][p] = (c0 * right[0][p] + c1 * right[1][p] + c2 * right[2][p]) * by;
        b[1][p] = (c1 * right[0][p] + c4 * right[1][p] + c5 * right[2][p]) * by;
        b[2][p] = (c2 * right[0][p] + c5 * right[1][p] + c8 * right[2][p]) * by;
    }
}

/* b (P, 3) and the cost (P) of pixels as surfaces of free normal, lit by B (L, P, 3); c holds the constants. */
KERNEL void lpcal_free(int64_t L, int64_t P, const double *signal, const double *sigma, const bool *usable, const double *B,
                       const float *doubt, const double *c, int64_t rounds, double *b, double *cost) {
    for (int64_t first = 0; first < P; first += BLOCK) {
        int64_t some = P - first < BLOCK ? P - first : BLOCK;
        Block of;
        double light[MOST_LIGHTS][3][BLOCK], shading[MOST_LIGHTS][BLOCK], weight[MOST_LIGHTS][BLOCK], now[MOST_LIGHTS][BLOCK];
        double most[BLOCK], second[BLOCK], x[3][BLOCK], total[BLOCK];
        load(&of, L, P, first, some, signal, sigma, usable, doubt, c);
        for (int p = 0; p < BLOCK; p++) most[p] = second[p] = -INFINITY;
        for (int64_t k = 0; k < L; k++)
            for (int64_t p = 0; p < BLOCK; p++) {
                const double *from = B + 3 * (k * P + first + (p < some ? p : some - 1));
                double E = sqrt(dot3(from, from));
                for (int i = 0; i < 3; i++) light[k][i][p] = from[i];
                double one = of.counts[k][p] > 0.0 && E > 0.0 ? of.signal[k][p] / (E > 1e-12 ? E : 1e-12) : 0.0;
                double lesser = one < most[p] ? one : most[p];
                shading[k][p] = one;
                second[p] = lesser > second[p] ? lesser : second[p];
                most[p] = one > most[p] ? one : most[p];
            }
        for (int64_t k = 0; k < L; k++)
            for (int p = 0; p < BLOCK; p++)
                now[k][p] = weight[k][p] = shading[k][p] < c[SHADOW] * second[p] ? 0.0 : of.counts[k][p] / of.spread2[k][p];
        for (int64_t round = 0; round < rounds; round++) {
            if (round)
                for (int64_t k = 0; k < L; k++)
                    for (int p = 0; p < BLOCK; p++) {
                        double predicted = from_zero(light[k][0][p] * x[0][p] + light[k][1][p] * x[1][p] + light[k][2][p] * x[2][p]);
                        double q = 1.0 + square_residual(of.signal[k][p], predicted, of.spread2[k][p], of.top[p], c) / c[WIDTH2];
                        now[k][p] = weight[k][p] / (q * q);
                    }
            solved(L, (const double (*)[3][BLOCK])light, (const double (*)[BLOCK])of.signal, (const double (*)[BLOCK])now, c[SINGULAR], x);
        }
        for (int p = 0; p < BLOCK; p++) {
            total[p] = 0.0;
            for (int i = 0; i < 3; i++) x[i][p] = x[i][p] == x[i][p] ? x[i][p] : 0.0;
        }
        for (int64_t k = 0; k < L; k++)
            for (int p = 0; p < BLOCK; p++) {
                double predicted = from_zero(light[k][0][p] * x[0][p] + light[k][1][p] * x[1][p] + light[k][2][p] * x[2][p]);
                double square = square_residual(of.signal[k][p], predicted, of.spread2[k][p], of.top[p], c);
                double own = price(of.signal[k][p], predicted, square, c);
                double least = shading[k][p] < c[SHADOW] * second[p] ? c[DARK] : 0.0;
                total[p] += of.counts[k][p] * (own > least ? own : least);
            }
        for (int64_t p = 0; p < some; p++) {
            for (int i = 0; i < 3; i++) b[3 * (first + p) + i] = x[i][p];
            cost[first + p] = total[p];
        }
    }
}

/* Keep an albedo where it explains a block's signals at less cost than the best so far. */
static void consider(const Block *of, int64_t L, const double m[][BLOCK], const double one[BLOCK], const double allowed[BLOCK],
                     const double *c, double least[BLOCK], double albedo[BLOCK], double lit[][BLOCK]) {
    double total[BLOCK] = {0.0}, count[BLOCK] = {0.0}, agree[MOST_LIGHTS][BLOCK], better[BLOCK];
    for (int64_t k = 0; k < L; k++)
        for (int p = 0; p < BLOCK; p++) {
            double predicted = one[p] * m[k][p], square = square_residual(of->signal[k][p], predicted, of->spread2[k][p], of->top[p], c);
            agree[k][p] = square < c[WIDTH2] && m[k][p] > 0.0 ? of->counts[k][p] : 0.0;
            count[p] += agree[k][p];
            total[p] += of->counts[k][p] * price(of->signal[k][p], predicted, square, c);
        }
    for (int p = 0; p < BLOCK; p++) {
        better[p] = allowed[p] > 0.0 && count[p] >= 2.0 && total[p] < least[p] ? 1.0 : 0.0;
        least[p] = better[p] > 0.0 ? total[p] : least[p];
        albedo[p] = better[p] > 0.0 ? one[p] : albedo[p];
    }
    for (int64_t k = 0; k < L; k++)
        for (int p = 0; p < BLOCK; p++) lit[k][p] = better[p] > 0.0 ? agree[k][p] : lit[k][p];
}

/* Cost (P), albedo (P) and lit samples (L, P) of pixels on a plane that has signals m (L, P) at albedo 1. */
KERNEL void lpcal_planar(int64_t L, int64_t P, const double *signal, const double *sigma, const bool *usable, const double *m,
                         const float *doubt, const double *c, double *cost, double *albedo, bool *lit) {
    for (int64_t first = 0; first < P; first += BLOCK) {
        int64_t some = P - first < BLOCK ? P - first : BLOCK;
        Block of;
        double white[MOST_LIGHTS][BLOCK], shown[MOST_LIGHTS][BLOCK], least[BLOCK], found[BLOCK], one[BLOCK], allowed[BLOCK], seen[BLOCK];
        load(&of, L, P, first, some, signal, sigma, usable, doubt, c);
        for (int p = 0; p < BLOCK; p++) {
            least[p] = INFINITY;
            found[p] = seen[p] = 0.0;
        }
        for (int64_t k = 0; k < L; k++)
            for (int64_t p = 0; p < BLOCK; p++) {
                white[k][p] = m[k * P + first + (p < some ? p : some - 1)];
                shown[k][p] = 0.0;
                seen[p] += of.counts[k][p];
            }
        for (int64_t k = 0; k < L; k++) {
            for (int p = 0; p < BLOCK; p++) {
                double by = white[k][p], s = of.signal[k][p];
                one[p] = by > 0.0 ? s / (by > 1e-12 ? by : 1e-12) : 0.0;
                allowed[p] = by > 0.0 && s > 0.0 ? of.counts[k][p] : 0.0;
            }
            consider(&of, L, (const double (*)[BLOCK])white, one, allowed, c, least, found, shown);
        }
        for (int round = 0; round < 2; round++) {
            double ms[BLOCK] = {0.0}, mm[BLOCK] = {0.0};
            for (int64_t k = 0; k < L; k++)
                for (int p = 0; p < BLOCK; p++) {
                    double w = shown[k][p] / of.spread2[k][p] * white[k][p];
                    ms[p] += w * of.signal[k][p];
                    mm[p] += w * white[k][p];
                }
            for (int p = 0; p < BLOCK; p++) {
                one[p] = ms[p] / (mm[p] > 1e-12 ? mm[p] : 1e-12);
                allowed[p] = one[p] > 0.0 ? 1.0 : 0.0;
            }
            consider(&of, L, (const double (*)[BLOCK])white, one, allowed, c, least, found, shown);
        }
        for (int64_t p = 0; p < some; p++) {
            cost[first + p] = seen[p] < 2.0 ? 0.0 : least[p] < INFINITY ? least[p] : c[OUTLIER] * (double)L;
            albedo[first + p] = found[p];
            for (int64_t k = 0; k < L; k++) lit[k * P + first + p] = shown[k][p] > 0.0;
        }
    }
}

/* m (L, Q) of a plane q (3) of albedo 1 along rays (Q, 3) in pixels (Q) of a table (P, nodes, L, 3) of the field, 0 where a ray misses it or the
   table; and the doubt (L, Q) of the nearest node. */
KERNEL void lpcal_white(int64_t L, int64_t nodes, int64_t Q, const float *table, const float *doubts, double first, double step,
                        const double *q, const double *rays, const int64_t *pixel, double *m, float *doubt) {
    double length = sqrt(dot3(q, q)), n[3] = {-q[0] / length, -q[1] / length, -q[2] / length}, last = (double)nodes - 1.0;
    for (int64_t p = 0; p < Q; p++) {
        double slope = dot3(rays + 3 * p, q), u = -logarithm(slope > 1e-12 ? slope : 1e-12), t = (u - first) / step;
        bool hit = slope > 0.0 && u >= first && u <= first + step * last;
        t = t < 0.0 ? 0.0 : t > last - 0.001 ? last - 0.001 : t;
        int64_t node = (int64_t)t < 1 ? 1 : (int64_t)t > nodes - 3 ? nodes - 3 : (int64_t)t, nearest = (int64_t)(t + WHOLE - WHOLE);
        double f = t - (double)node, by = exponential(-2.0 * (first + t * step));
        double weight[4] = {-f * (f - 1) * (f - 2) / 6 * by, (f + 1) * (f - 1) * (f - 2) / 2 * by, -(f + 1) * f * (f - 2) / 2 * by,
                            (f + 1) * f * (f - 1) / 6 * by};
        const float *at = table + (pixel[p] * nodes + node - 1) * 3 * L;
        for (int64_t from = 0; from < L; from += MOST_LIGHTS) {
            int64_t some = L - from < MOST_LIGHTS ? L - from : MOST_LIGHTS;
            double B[3 * MOST_LIGHTS];
            for (int64_t i = 0; i < 3 * some; i++) {
                const float *of = at + 3 * from + i;
                B[i] = (of[0] * weight[0] + of[3 * L] * weight[1]) + (of[6 * L] * weight[2] + of[9 * L] * weight[3]);
            }
            for (int64_t k = 0; k < some; k++) {
                double shading = dot3(B + 3 * k, n);
                m[(from + k) * Q + p] = hit && shading > 0.0 ? shading : 0.0;
                doubt[(from + k) * Q + p] = doubts[(pixel[p] * nodes + nearest) * L + from + k];
            }
        }
    }
}

/* Loss (1), gradient (3) and curvature (3, 3) of Cauchy's loss of a plane q (3) by signals and weights (L, Q), the albedo of each pixel
   eliminated. Twin: segmentation/plane_hough.py (_equations). */
KERNEL void lpcal_plane(int64_t L, int64_t nodes, int64_t Q, const float *table, double first, double step, const double *q,
                        const double *rays, const int64_t *pixel, const double *signal, const double *weight, double least, double *found) {
    double length = sqrt(dot3(q, q)), n[3] = {-q[0] / length, -q[1] / length, -q[2] / length}, last = (double)nodes - 1.0;
    double *gradient = found + 1, *curvature = found + 4;
    memset(found, 0, 13 * sizeof *found);
    for (int64_t p = 0; p < Q; p++) {
        const double *ray = rays + 3 * p;
        double slope = dot3(ray, q), u = -logarithm(slope > 1e-12 ? slope : 1e-12), t = (u - first) / step;
        if (!(slope > 0.0 && u >= first && u <= first + step * last)) t = -1.0;
        bool hit = t >= 0.0;
        t = t < 0.0 ? 0.0 : t > last - 0.001 ? last - 0.001 : t;
        int64_t node = (int64_t)t < 1 ? 1 : (int64_t)t > nodes - 3 ? nodes - 3 : (int64_t)t;
        double f = t - (double)node, by = exponential(-2.0 * (first + t * step)), each = by / step;
        double value[4] = {-f * (f - 1) * (f - 2) / 6 * by, (f + 1) * (f - 1) * (f - 2) / 2 * by, -(f + 1) * f * (f - 2) / 2 * by,
                           (f + 1) * f * (f - 1) / 6 * by};
        double change[4] = {-(3 * f * f - 6 * f + 2) / 6 * each, (3 * f * f - 4 * f - 1) / 2 * each, -(3 * f * f - 2 * f - 2) / 2 * each,
                            (3 * f * f - 1) / 6 * each};
        const float *at = table + (pixel[p] * nodes + node - 1) * 3 * L;
        double m[MOST_LIGHTS], turned[MOST_LIGHTS][3], mm = 0.0, my = 0.0, da[3] = {0.0};
        for (int64_t k = 0; k < L; k++) {
            double B[3], deeper = 0.0, shading = 0.0, w = weight[k * Q + p];
            for (int64_t i = 0; i < 3; i++) {
                const float *of = at + 3 * k + i;
                B[i] = (of[0] * value[0] + of[3 * L] * value[1]) + (of[6 * L] * value[2] + of[9 * L] * value[3]);
                double dB = (of[0] * change[0] + of[3 * L] * change[1]) + (of[6 * L] * change[2] + of[9 * L] * change[3]);
                shading += B[i] * n[i];
                deeper += (dB - 2 * B[i]) * n[i];
            }
            bool lit = hit && shading > 0.0;
            m[k] = lit ? w * shading : 0.0;
            for (int i = 0; i < 3; i++) turned[k][i] = lit ? w * (-(B[i] - shading * n[i]) / length - deeper * ray[i] / slope) : 0.0;
            mm += m[k] * m[k];
            my += m[k] * (w * signal[k * Q + p]);
        }
        double most = mm > 1e-12 ? mm : 1e-12, a = my / most;
        for (int64_t k = 0; k < L; k++)
            for (int i = 0; i < 3; i++)
                da[i] += turned[k][i] * (weight[k * Q + p] * signal[k * Q + p] - (mm > 1e-12 ? 2 * a * m[k] : 0.0)) / most;
        for (int64_t k = 0; k < L; k++) {
            double r = weight[k * Q + p] * signal[k * Q + p] - a * m[k], square = r * r, held = 1.0 / (1.0 + square), dr[3];
            double curved = held - 2 * square * held * held;
            curved = curved > least ? curved : least;
            found[0] += logarithm(1.0 + square) / 2;
            for (int i = 0; i < 3; i++) dr[i] = -(da[i] * m[k] + a * turned[k][i]);
            for (int i = 0; i < 3; i++) {
                gradient[i] += dr[i] * (held * r);
                for (int j = 0; j < 3; j++) curvature[3 * i + j] += dr[i] * curved * dr[j];
            }
        }
    }
}
