/* Lambertian shading pixel by pixel. Twins: geometry/lambert.py (weighted), shading/normals.py (_few), view/coarse.py
   (LightTable.at). Light vectors B are (L, P, 3), signals and weights (L, P). */

#include "kernel.h"

/* Accumulation and solution of normal equations: NaN where the lights do not span space. */
typedef struct {
    double M[3][3], right[3];
} Equations;

static inline void add(Equations *to, const double *light, double signal, double weight) {
    for (int i = 0; i < 3; i++) {
        double wb = weight * light[i];
        to->right[i] += wb * signal;
        for (int j = 0; j < 3; j++) to->M[i][j] += wb * light[j];
    }
}

static inline void solve(const Equations *of, double singular, double *b, double *inverse) {
    double cofactor[3][3];
    for (int i = 0; i < 3; i++) cross3(of->M[(i + 1) % 3], of->M[(i + 2) % 3], cofactor[i]);
    double determinant = dot3(of->M[0], cofactor[0]), trace = of->M[0][0] + of->M[1][1] + of->M[2][2];
    if (!(determinant > singular * (trace * trace * trace))) determinant = NAN;
    for (int i = 0; i < 3; i++) {
        double *row = inverse + 3 * i;
        for (int j = 0; j < 3; j++) row[j] = cofactor[i][j] / determinant;
        b[i] = dot3(row, of->right);
    }
}

/* b (P, 3) of least squares and the inverse (P, 3, 3) of its normal matrix. */
KERNEL void lpcal_weighted(int64_t L, int64_t P, const double *B, const double *signal, const double *weight, double singular, double *b,
                           double *inverse) {
    for (int64_t p = 0; p < P; p++) {
        Equations found = {{{0.0}}, {0.0}};
        for (int64_t k = 0; k < L; k++) add(&found, B + 3 * (k * P + p), signal[k * P + p], weight[k * P + p]);
        solve(&found, singular, b + 3 * p, inverse + 9 * p);
    }
}

#define LANES 8

/* One value of each of LANES pixels, processed together (SIMD). */
typedef double Lanes[LANES];

static inline void exchanged(double *restrict low, double *restrict high) {
    LANEWISE for (int w = 0; w < LANES; w++) {
        double one = low[w], other = high[w];
        low[w] = one < other ? one : other;
        high[w] = one < other ? other : one;
    }
}

/* Sorts rows of numbers upwards, in each lane by itself, by exchanges that are always the same (Batcher 1968, odd-even merging). */
static void sort(int64_t rows, Lanes *value) {
    for (int64_t p = 1; p < rows; p *= 2)
        for (int64_t k = p; k >= 1; k /= 2)
            for (int64_t j = k % p; j + k < rows; j += 2 * k)
                for (int64_t i = j; i < j + k && i + k < rows; i++)
                    if (((i ^ (i + k)) & -(2 * p)) == 0) exchanged(value[i], value[i + k]);
}

/* What many lights show LANES pixels: light vectors (rows, 3), signals, variances, shares of usable samples, two rows of work space. */
typedef struct {
    Lanes *light, *signal, *variance, *usable, *value, *sorted;
} Many;

/* b of least squares, as `solve` has it, by the products xx xy xz yy yz zz and the right side, and the inverse. */
static void solved(const Lanes M[6], const Lanes right[3], double singular, Lanes b[3], Lanes inverse[6]) {
    LANEWISE for (int w = 0; w < LANES; w++) {
        double xx = M[0][w], xy = M[1][w], xz = M[2][w], yy = M[3][w], yz = M[4][w], zz = M[5][w], trace = xx + yy + zz;
        double cofactor[6] = {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy, xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
        double determinant = xx * cofactor[0] + xy * cofactor[1] + xz * cofactor[2];
        double factor = determinant > singular * (trace * trace * trace) ? 1.0 / determinant : NAN;
        for (int i = 0; i < 6; i++) inverse[i][w] = cofactor[i] * factor;
        b[0][w] = inverse[0][w] * right[0][w] + inverse[1][w] * right[1][w] + inverse[2][w] * right[2][w];
        b[1][w] = inverse[1][w] * right[0][w] + inverse[3][w] * right[1][w] + inverse[4][w] * right[2][w];
        b[2][w] = inverse[2][w] * right[0][w] + inverse[4][w] * right[1][w] + inverse[5][w] * right[2][w];
    }
}

/* Normal equations with weights (rows) of the samples, for half of the lanes at a time, so that the sums stay in registers. */
static void summed(int64_t L, const Many *of, const Lanes *weight, Lanes M[6], Lanes right[3]) {
    for (int half = 0; half < LANES; half += LANES / 2) {
        double sum[9][LANES / 2] = {{0.0}};
        for (int64_t k = 0; k < L; k++) {
            const double *light_x = of->light[3 * k] + half, *light_y = of->light[3 * k + 1] + half, *light_z = of->light[3 * k + 2] + half;
            const double *signal = of->signal[k] + half, *by = weight[k] + half;
            for (int w = 0; w < LANES / 2; w++) {
                double x = by[w] * light_x[w], y = by[w] * light_y[w], z = by[w] * light_z[w];
                sum[0][w] += x * light_x[w];
                sum[1][w] += x * light_y[w];
                sum[2][w] += x * light_z[w];
                sum[3][w] += y * light_y[w];
                sum[4][w] += y * light_z[w];
                sum[5][w] += z * light_z[w];
                sum[6][w] += x * signal[w];
                sum[7][w] += y * signal[w];
                sum[8][w] += z * signal[w];
            }
        }
        for (int i = 0; i < 9; i++) memcpy((i < 6 ? M[i] : right[i - 6]) + half, sum[i], sizeof sum[i]);
    }
}

/* Weights of 1 for the samples whose rank, of `count` (lanes) usable ones by value, is in the middle; of equals the first comes first. */
static void middle_ranks(int64_t L, const Many *of, const Lanes count, double darkest, double brightest, Lanes *weight) {
    Lanes first, last, low, high, below_low = {0.0}, below_high = {0.0};
    for (int w = 0; w < LANES; w++) {
        first[w] = floor(darkest * count[w]);
        last[w] = ceil((1.0 - brightest) * count[w]);
        low[w] = first[w] < last[w] ? of->sorted[(int64_t)first[w]][w] : INFINITY;
        high[w] = first[w] < last[w] ? of->sorted[(int64_t)last[w] - 1][w] : -INFINITY;
    }
    for (int64_t k = 0; k < L; k++)
        LANEWISE for (int w = 0; w < LANES; w++) {
            below_low[w] += of->value[k][w] < low[w] ? 1.0 : 0.0;
            below_high[w] += of->value[k][w] < high[w] ? 1.0 : 0.0;
        }
    for (int64_t k = 0; k < L; k++)
        LANEWISE for (int w = 0; w < LANES; w++) {
            double v = of->value[k][w], kept = v > low[w] && v < high[w] ? 1.0 : 0.0;
            double rank = v == low[w] ? below_low[w] : v == high[w] ? below_high[w] : -1.0;
            below_low[w] += v == low[w] ? 1.0 : 0.0;
            below_high[w] += v == high[w] ? 1.0 : 0.0;
            weight[k][w] = rank >= first[w] && rank < last[w] ? 1.0 : kept;
            weight[k][w] *= of->usable[k][w];
        }
}

/* Residuals of b into `value` and, sorted, `sorted`, both infinite where a sample does not count; MAD times their median, 0 where b is unknown. */
static void spread_of(int64_t L, const Many *of, const Lanes b[3], const Lanes count, double mad, Lanes spread) {
    for (int64_t k = 0; k < L; k++) {
        const Lanes *light = of->light + 3 * k;
        LANEWISE for (int w = 0; w < LANES; w++) {
            double predicted = light[0][w] * b[0][w] + light[1][w] * b[1][w] + light[2][w] * b[2][w];
            double residual = fabs(of->signal[k][w] - (predicted < 0.0 ? 0.0 : predicted)); /* NaN stays NaN */
            of->value[k][w] = of->usable[k][w] > 0.0 ? residual : INFINITY;
        }
    }
    memcpy(of->sorted, of->value, (size_t)L * sizeof(Lanes));
    sort(L, of->sorted);
    for (int w = 0; w < LANES; w++) {
        int64_t number = (int64_t)count[w], upper = number / 2 < L ? number / 2 : L - 1;
        bool known = number && isfinite(b[0][w]) && isfinite(b[1][w]) && isfinite(b[2][w]);
        spread[w] = known ? mad * ((of->sorted[(number - 1) / 2][w] + of->sorted[upper][w]) / 2.0) : 0.0;
    }
}

/* Which samples (L, P) of some pixels from the first on agree with b, each by no less than the pixel's own spread; the squares of those (P), and
   of all that count, each `most` at most (P); whether enough agree, and b faces the camera. */
static void judged(int64_t L, int64_t P, int64_t first, int64_t some, const Many *of, const Lanes b[3], const Lanes spread, double most,
                   int64_t needed, double facing, const double *rays, bool *agree, double *chi2, double *cost, bool *good) {
    Lanes within = {0.0}, beyond = {0.0}, number = {0.0};
    for (int64_t k = 0; k < L; k++) {
        const Lanes *light = of->light + 3 * k;
        Lanes close;
        LANEWISE for (int w = 0; w < LANES; w++) {
            double predicted = light[0][w] * b[0][w] + light[1][w] * b[1][w] + light[2][w] * b[2][w], least = spread[w] * spread[w];
            double apart = of->signal[k][w] - (predicted < 0.0 ? 0.0 : predicted); /* NaN stays NaN */
            double square = apart * apart / (of->variance[k][w] > least ? of->variance[k][w] : least), counts = of->usable[k][w];
            close[w] = square < most ? counts : 0.0;
            number[w] += close[w];
            within[w] += square < most ? counts * square : 0.0;
            beyond[w] += square < most ? 0.0 : counts * most;
        }
        for (int64_t w = 0; w < some; w++) agree[k * P + first + w] = close[w] > 0.0;
    }
    for (int64_t w = 0; w < some; w++) {
        const double *ray = rays + 3 * (first + w), now[3] = {b[0][w], b[1][w], b[2][w]};
        chi2[first + w] = within[w];
        cost[first + w] = within[w] + beyond[w];
        good[w] = number[w] >= (double)needed && dot3(now, ray) < facing * sqrt(dot3(now, now)) * sqrt(dot3(ray, ray));
    }
}

/* The rows of `Many` in a work space of 8 of them a light. */
static Many lanes_of(int64_t L, Lanes *rows) {
    return (Many){rows, rows + 3 * L, rows + 4 * L, rows + 5 * L, rows + 6 * L, rows + 7 * L};
}

/* What lights show LANES pixels from the first on, the last of all pixels again where there are fewer; how many samples count of each. */
static void loaded(int64_t L, int64_t P, int64_t first, const double *B, const double *signal, const bool *usable, const double *variance,
                   const Many *to, Lanes count) {
    int64_t some = P - first < LANES ? P - first : LANES;
    memset(count, 0, sizeof(Lanes));
    for (int64_t k = 0; k < L; k++)
        for (int w = 0; w < LANES; w++) {
            int64_t at = k * P + first + (w < some ? w : some - 1);
            double counts = usable[at] ? 1.0 : 0.0;
            for (int i = 0; i < 3; i++) to->light[3 * k + i][w] = usable[at] ? B[3 * at + i] : 0.0;
            to->signal[k][w] = usable[at] ? signal[at] : 0.0;
            to->variance[k][w] = usable[at] ? variance[at] : 1.0;
            to->usable[k][w] = counts;
            count[w] += counts;
        }
}

/* What is found of LANES pixels from the first on, into the arrays of all: as `judged`, b NaN where it is not good, and the inverse. */
static void stated(int64_t L, int64_t P, int64_t first, const Many *of, const Lanes now[3], const Lanes inverted[6], const Lanes spread,
                   double most, int64_t needed, double facing, const double *rays, double *b, bool *agree, double *inverse, double *chi2,
                   double *cost) {
    static const int place[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
    int64_t some = P - first < LANES ? P - first : LANES;
    bool good[LANES];
    judged(L, P, first, some, of, now, spread, most, needed, facing, rays, agree, chi2, cost, good);
    for (int64_t w = 0; w < some; w++) {
        for (int i = 0; i < 3; i++) b[3 * (first + w) + i] = good[w] ? now[i][w] : NAN;
        for (int i = 0; i < 9; i++) inverse[9 * (first + w) + i] = inverted[place[i]][w];
    }
}

/* Estimates of many lights: from the middle of their ranked shadings, then by weights in rounds: what `lpcal_few` finds of few. `work` are
   8 LANES numbers a light. Twin: shading/normals.py (_many). */
KERNEL void lpcal_many(int64_t L, int64_t P, const double *B, const double *signal, const bool *usable, const double *variance,
                       const double *rays, double darkest, double brightest, double mad, double scale, int64_t rounds, double most,
                       int64_t needed, double facing, double singular, double *work, double *b, bool *agree, double *inverse, double *chi2,
                       double *cost) {
    double narrow = 1.0 / (scale * scale);
    Many of = lanes_of(L, (Lanes *)work);
    for (int64_t first = 0; first < P; first += LANES) {
        Lanes count, now[3], M[6], right[3], inverted[6], middle = {0.0};
        loaded(L, P, first, B, signal, usable, variance, &of, count);
        for (int64_t k = 0; k < L; k++)
            LANEWISE for (int w = 0; w < LANES; w++) {
                double x = of.light[3 * k][w], y = of.light[3 * k + 1][w], z = of.light[3 * k + 2][w], size = sqrt(x * x + y * y + z * z);
                of.value[k][w] = of.usable[k][w] > 0.0 ? of.signal[k][w] / (size > 1e-300 ? size : 1e-300) : INFINITY;
            }
        memcpy(of.sorted, of.value, (size_t)L * sizeof(Lanes));
        sort(L, of.sorted);
        middle_ranks(L, &of, count, darkest, brightest, of.sorted);
        summed(L, &of, (const Lanes *)of.sorted, M, right);
        solved((const Lanes *)M, (const Lanes *)right, singular, now, inverted);
        for (int64_t round = 0; round < rounds; round++) {
            spread_of(L, &of, (const Lanes *)now, count, mad, middle);
            for (int64_t k = 0; k < L; k++)
                LANEWISE for (int w = 0; w < LANES; w++) {
                    double least = middle[w] * middle[w], own = of.variance[k][w] > least ? of.variance[k][w] : least;
                    double residual = of.value[k][w] < INFINITY ? of.value[k][w] : 0.0, width = own + residual * residual * narrow;
                    of.sorted[k][w] = of.usable[k][w] * own / (width * width); /* 1 / own / (1 + r^2 / (scale^2 own))^2 */
                }
            summed(L, &of, (const Lanes *)of.sorted, M, right);
            solved((const Lanes *)M, (const Lanes *)right, singular, now, inverted);
        }
        stated(L, P, first, &of, (const Lanes *)now, (const Lanes *)inverted, middle, most, needed, facing, rays, b, agree, inverse, chi2, cost);
    }
}

#define FEW 8

/* b of the usable triple of lights with the least truncated misfit (at most `most` each) of the others; NaN where there is none. `weight` (L)
   is 1 over the variance of a sample that counts, else 0. */
static void best_three(int64_t L, const Many *of, const Lanes *weight, double most, double singular, Lanes best[3]) {
    Lanes crossed[FEW][FEW][3], size[FEW], least;
    for (int w = 0; w < LANES; w++) {
        least[w] = INFINITY;
        for (int i = 0; i < 3; i++) best[i][w] = NAN;
    }
    for (int k = 0; k < L; k++) {
        const Lanes *to = of->light + 3 * k;
        LANEWISE for (int w = 0; w < LANES; w++) size[k][w] = to[0][w] * to[0][w] + to[1][w] * to[1][w] + to[2][w] * to[2][w];
        for (int i = 0; i < k; i++) {
            const Lanes *from = of->light + 3 * i;
            LANEWISE for (int w = 0; w < LANES; w++) {
                crossed[i][k][0][w] = from[1][w] * to[2][w] - from[2][w] * to[1][w];
                crossed[i][k][1][w] = from[2][w] * to[0][w] - from[0][w] * to[2][w];
                crossed[i][k][2][w] = from[0][w] * to[1][w] - from[1][w] * to[0][w];
            }
        }
    }
    for (int i = 0; i < L; i++)
        for (int j = i + 1; j < L; j++)
            for (int k = j + 1; k < L; k++) {
                const Lanes *third = of->light + 3 * k, *ij = crossed[i][j], *ik = crossed[i][k], *jk = crossed[j][k];
                Lanes b[3], cost = {0.0}, spans;
                LANEWISE for (int w = 0; w < LANES; w++) {
                    double determinant = third[0][w] * ij[0][w] + third[1][w] * ij[1][w] + third[2][w] * ij[2][w];
                    double count = (weight[i][w] > 0.0 ? 1.0 : 0.0) * (weight[j][w] > 0.0 ? 1.0 : 0.0) * (weight[k][w] > 0.0 ? 1.0 : 0.0);
                    double factor = 1.0 / determinant, one = of->signal[i][w] * factor, two = of->signal[j][w] * factor;
                    double three = of->signal[k][w] * factor;
                    spans[w] = fabs(determinant) > singular * sqrt(size[i][w] * size[j][w] * size[k][w]) ? count : 0.0;
                    for (int a = 0; a < 3; a++) b[a][w] = one * jk[a][w] - two * ik[a][w] + three * ij[a][w];
                }
                for (int64_t l = 0; l < L; l++) {
                    const Lanes *light = of->light + 3 * l;
                    LANEWISE for (int w = 0; w < LANES; w++) {
                        double predicted = light[0][w] * b[0][w] + light[1][w] * b[1][w] + light[2][w] * b[2][w];
                        double apart = of->signal[l][w] - (predicted < 0.0 ? 0.0 : predicted), square = weight[l][w] * (apart * apart);
                        cost[w] += square > most ? most : square; /* NaN stays NaN */
                    }
                }
                for (int w = 0; w < LANES; w++) {
                    if (!(spans[w] > 0.0 && cost[w] < least[w])) continue;
                    least[w] = cost[w];
                    for (int a = 0; a < 3; a++) best[a][w] = b[a][w];
                }
            }
}

/* Estimates of few lights, FEW at most: b (P, 3), NaN where there is none, the samples (L, P) that agree, the inverse (P, 3, 3) of the normal
   matrix, the squares of the samples that agree (P), and of all that count, each `most` at most (P). Twin: shading/normals.py (_few). */
KERNEL void lpcal_few(int64_t L, int64_t P, const double *B, const double *signal, const bool *usable, const double *variance,
                      const double *rays, double most, int64_t rounds, int64_t needed, double facing, double singular, double *b,
                      bool *agree, double *inverse, double *chi2, double *cost) {
    Lanes rows[8 * FEW], none = {0.0};
    Many of = lanes_of(L, rows);
    Lanes *weight = of.value, *counted = of.sorted;
    for (int64_t first = 0; first < P; first += LANES) {
        Lanes count, now[3], M[6], right[3], inverted[6];
        loaded(L, P, first, B, signal, usable, variance, &of, count);
        for (int64_t k = 0; k < L; k++)
            LANEWISE for (int w = 0; w < LANES; w++) weight[k][w] = of.usable[k][w] / of.variance[k][w];
        best_three(L, &of, (const Lanes *)weight, most, singular, now);
        for (int64_t round = 0; round < rounds; round++) {
            for (int64_t k = 0; k < L; k++) {
                const Lanes *light = of.light + 3 * k;
                LANEWISE for (int w = 0; w < LANES; w++) {
                    double predicted = light[0][w] * now[0][w] + light[1][w] * now[1][w] + light[2][w] * now[2][w];
                    double apart = of.signal[k][w] - (predicted < 0.0 ? 0.0 : predicted), square = weight[k][w] * (apart * apart);
                    counted[k][w] = square < most ? weight[k][w] : 0.0;
                }
            }
            summed(L, &of, (const Lanes *)counted, M, right);
            solved((const Lanes *)M, (const Lanes *)right, singular, now, inverted);
        }
        stated(L, P, first, &of, (const Lanes *)now, (const Lanes *)inverted, none, most, needed, facing, rays, b, agree, inverse, chi2, cost);
    }
}

#define SOME 16

/* B (L, Q, 3) of a table (P, nodes, L, 3) at log depths u of pixels (Q), cubic between nodes of u evenly apart, or its `slope` by u; and the
   doubt of the nearest node. */
KERNEL void lpcal_cubic(int64_t L, int64_t nodes, int64_t slope, int64_t Q, const float *table, const float *doubts, double first,
                        double step, const double *u, const int64_t *pixel, double *B, float *doubt) {
    for (int64_t q = 0; q < Q; q++) {
        double t = fmin(fmax((u[q] - first) / step, 0.0), (double)nodes - 1.001);
        int64_t node = (int64_t)t < 1 ? 1 : (int64_t)t > nodes - 3 ? nodes - 3 : (int64_t)t, nearest = (int64_t)(t + WHOLE - WHOLE);
        double f = t - (double)node, by = exponential(-2.0 * (first + t * step));
        double weight[4] = {-f * (f - 1) * (f - 2) / 6 * by, (f + 1) * (f - 1) * (f - 2) / 2 * by, -(f + 1) * f * (f - 2) / 2 * by,
                            (f + 1) * f * (f - 1) / 6 * by};
        if (slope) { /* of the weights, and of by */
            double change[4] = {-(3 * f * f - 6 * f + 2) / 6, (3 * f * f - 4 * f - 1) / 2, -(3 * f * f - 2 * f - 2) / 2,
                                (3 * f * f - 1) / 6};
            for (int j = 0; j < 4; j++) weight[j] = change[j] * by / step - 2 * weight[j];
        }
        const float *at = table + (pixel[q] * nodes + node - 1) * 3 * L;
        for (int64_t from = 0; from < L; from += SOME) { /* some lights at a time: their numbers lie together in the table, not in B */
            int64_t some = L - from < SOME ? L - from : SOME;
            double sum[3 * SOME];
            for (int64_t i = 0; i < 3 * some; i++) {
                const float *node_0 = at + 3 * from + i;
                sum[i] = (node_0[0] * weight[0] + node_0[3 * L] * weight[1]) + (node_0[6 * L] * weight[2] + node_0[9 * L] * weight[3]);
            }
            for (int64_t l = 0; l < some; l++) {
                for (int i = 0; i < 3; i++) B[3 * ((from + l) * Q + q) + i] = sum[3 * l + i];
                doubt[(from + l) * Q + q] = doubts[(pixel[q] * nodes + nearest) * L + from + l];
            }
        }
    }
}

static inline void cubic_weights(double f, double weight[4]) {
    weight[0] = -f * (f - 1) * (f - 2) / 6;
    weight[1] = (f + 1) * (f - 1) * (f - 2) / 2;
    weight[2] = -(f + 1) * f * (f - 2) / 2;
    weight[3] = (f + 1) * f * (f - 1) / 6;
}

static inline int64_t node_before(double t, int64_t nodes) {
    int64_t node = (int64_t)t;
    return node < 1 ? 1 : node > nodes - 3 ? nodes - 3 : node;
}

/* Values (L, P) of a lattice (nodes, nodes, L) at places (P, 2) in steps, cubic along each side. Twin: segmentation/planes.py (between). */
KERNEL void lpcal_lattice(int64_t L, int64_t nodes, int64_t P, const double *lattice, const double *place, double *found) {
    for (int64_t p = 0; p < P; p++) {
        int64_t x = node_before(place[2 * p], nodes), y = node_before(place[2 * p + 1], nodes);
        double across[4], down[4];
        cubic_weights(place[2 * p] - (double)x, across);
        cubic_weights(place[2 * p + 1] - (double)y, down);
        for (int64_t from = 0; from < L; from += SOME) {
            int64_t some = L - from < SOME ? L - from : SOME;
            double sum[SOME] = {0.0};
            for (int64_t i = 0; i < 4; i++)
                for (int64_t j = 0; j < 4; j++) {
                    const double *at = lattice + ((x + i - 1) * nodes + y + j - 1) * L + from;
                    double by = across[i] * down[j];
                    for (int64_t k = 0; k < some; k++) sum[k] += by * at[k];
                }
            for (int64_t k = 0; k < some; k++) found[(from + k) * P + p] = sum[k];
        }
    }
}
