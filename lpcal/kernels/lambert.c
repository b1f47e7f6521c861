/* Lambertian shading pixel by pixel. Twins: geometry/lambert.py (weighted), surface/normals.py (_few), surface/coarse.py
   (LightTable.at). Light vectors B are (L, P, 3), signals and weights (L, P). */

#include "kernel.h"

/* Normal equations in the making, and what solves them: NaN where the lights do not span space. */
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

/* Sorts values, and the indices beside them, upwards; of equals the lower index comes first (Shell 1959). */
static void sort(int64_t count, double *value, int64_t *index) {
    static const int64_t gaps[] = {1750, 701, 301, 132, 57, 23, 10, 4, 1};
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++)
        for (int64_t i = gaps[g]; i < count; i++) {
            double v = value[i];
            int64_t at = index[i], j = i;
            for (; j >= gaps[g] && (value[j - gaps[g]] > v || (value[j - gaps[g]] == v && index[j - gaps[g]] > at)); j -= gaps[g]) {
                value[j] = value[j - gaps[g]];
                index[j] = index[j - gaps[g]];
            }
            value[j] = v;
            index[j] = at;
        }
}

/* b (P, 3), the inverse (P, 3, 3) of its normal matrix and the spread (P) of the residuals of many lights: from the middle of their ranked
   shadings, then by weights in rounds. `value` and `index` (L) are work space. */
KERNEL void lpcal_many(int64_t L, int64_t P, const double *B, const double *signal, const bool *usable, const double *variance,
                       double darkest, double brightest, double mad, double scale, int64_t rounds, double singular, double *value,
                       int64_t *index, double *b, double *inverse, double *spread) {
    for (int64_t p = 0; p < P; p++) {
        Equations start = {{{0.0}}, {0.0}};
        int64_t count = 0;
        for (int64_t k = 0; k < L; k++)
            if (usable[k * P + p]) {
                const double *light = B + 3 * (k * P + p);
                value[count] = signal[k * P + p] / fmax(sqrt(dot3(light, light)), 1e-300);
                index[count++] = k;
            }
        sort(count, value, index);
        for (int64_t rank = (int64_t)floor(darkest * (double)count); rank < (int64_t)ceil((1.0 - brightest) * (double)count); rank++)
            add(&start, B + 3 * (index[rank] * P + p), signal[index[rank] * P + p], 1.0);
        solve(&start, singular, b + 3 * p, inverse + 9 * p);
        for (int64_t round = 0; round < rounds; round++) {
            Equations found = {{{0.0}}, {0.0}};
            const double *now = b + 3 * p;
            bool known = isfinite(now[0]) && isfinite(now[1]) && isfinite(now[2]);
            count = 0;
            if (known)
                for (int64_t k = 0; k < L; k++)
                    if (usable[k * P + p]) {
                        value[count] = fabs(signal[k * P + p] - fmax(dot3(B + 3 * (k * P + p), now), 0.0));
                        index[count++] = k;
                    }
            sort(count, value, index);
            double middle = count ? mad * ((value[(count - 1) / 2] + value[count / 2 < L ? count / 2 : L - 1]) / 2.0) : 0.0;
            for (int64_t k = 0; k < L; k++)
                if (usable[k * P + p]) {
                    double s = signal[k * P + p], residual = known ? fabs(s - fmax(dot3(B + 3 * (k * P + p), now), 0.0)) : 0.0;
                    double own = fmax(variance[k * P + p], middle * middle), q = 1.0 + residual * residual / (scale * scale * own);
                    add(&found, B + 3 * (k * P + p), s, 1.0 / (q * q) / own);
                }
            solve(&found, singular, b + 3 * p, inverse + 9 * p);
            spread[p] = middle;
        }
    }
}

/* What a pixel's few lights show it, gathered: light vectors, signals, weights 1 / variance (0 where a sample does not count). */
typedef struct {
    double light[8][3], signal[8], weight[8];
} Few;

static inline double square_residual(const Few *of, int64_t k, const double b[3]) {
    double predicted = dot3(of->light[k], b), apart = of->signal[k] - (predicted < 0.0 ? 0.0 : predicted); /* NaN stays NaN */
    return of->weight[k] * (apart * apart);
}

/* b (3) of the three lights that count whose proposal the others contradict least, a light by no more than `most`; NaN where none are. */
static void best_three(int64_t L, const Few *of, double most, double singular, double best[3]) {
    double crossed[8][8][3], size[8], least = INFINITY;
    for (int i = 0; i < 3; i++) best[i] = NAN;
    for (int k = 0; k < L; k++) {
        size[k] = dot3(of->light[k], of->light[k]);
        for (int i = 0; i < k; i++) cross3(of->light[i], of->light[k], crossed[i][k]);
    }
    for (int i = 0; i < L; i++)
        for (int j = i + 1; j < L; j++)
            for (int k = j + 1; k < L; k++) {
                if (!(of->weight[i] > 0.0 && of->weight[j] > 0.0 && of->weight[k] > 0.0)) continue;
                double determinant = dot3(of->light[k], crossed[i][j]), b[3], cost = 0.0;
                if (!(fabs(determinant) > singular * sqrt(size[i] * size[j] * size[k]))) continue;
                double factor = 1 / determinant;
                for (int a = 0; a < 3; a++)
                    b[a] = of->signal[i] * factor * crossed[j][k][a] - of->signal[j] * factor * crossed[i][k][a] +
                           of->signal[k] * factor * crossed[i][j][a];
                for (int64_t l = 0; l < L; l++) {
                    double square = square_residual(of, l, b);
                    cost += square > most ? most : square;
                }
                if (cost < least) {
                    least = cost;
                    memcpy(best, b, sizeof b);
                }
            }
}

/* Estimates of few lights: b (P, 3), NaN where there is none, the samples (L, P) that agree, the inverse (P, 3, 3) of the normal matrix, the
   squares of the samples that agree (P), and of all that count, each `most` at most (P). Twin: surface/normals.py (_few). */
KERNEL void lpcal_few(int64_t L, int64_t P, const double *B, const double *signal, const bool *usable, const double *variance,
                      const double *rays, double most, int64_t rounds, int64_t needed, double facing, double singular, double *b,
                      bool *agree, double *inverse, double *chi2, double *cost) {
    for (int64_t p = 0; p < P; p++) {
        Few of;
        double *now = b + 3 * p;
        for (int64_t k = 0; k < L; k++) {
            int64_t at = k * P + p;
            memcpy(of.light[k], B + 3 * at, sizeof of.light[k]);
            of.signal[k] = signal[at];
            of.weight[k] = usable[at] ? 1.0 / variance[at] : 0.0;
        }
        best_three(L, &of, most, singular, now);
        for (int64_t round = 0; round < rounds; round++) {
            Equations found = {{{0.0}}, {0.0}};
            for (int64_t k = 0; k < L; k++)
                add(&found, of.light[k], of.signal[k], square_residual(&of, k, now) < most ? of.weight[k] : 0.0);
            solve(&found, singular, now, inverse + 9 * p);
        }
        int64_t count = 0;
        chi2[p] = cost[p] = 0.0;
        for (int64_t k = 0; k < L; k++) {
            double square = square_residual(&of, k, now);
            bool counts = of.weight[k] > 0.0, close = counts && square < most;
            agree[k * P + p] = close;
            count += close;
            chi2[p] += close ? square : 0.0;
            cost[p] += close ? square : counts ? most : 0.0;
        }
        const double *ray = rays + 3 * p;
        if (count < needed || !(dot3(now, ray) < facing * sqrt(dot3(now, now)) * sqrt(dot3(ray, ray))))
            for (int i = 0; i < 3; i++) now[i] = NAN;
    }
}

/* B (L, Q, 3) of a table (P, nodes, L, 3) at log depths u of pixels (Q), cubic between nodes of u evenly apart, and the doubt of the nearest
   node. */
KERNEL void lpcal_cubic(int64_t L, int64_t nodes, int64_t P, int64_t Q, const float *table, const float *doubts, double first, double step,
                        const double *u, const int64_t *pixel, double *B, float *doubt) {
    (void)P;
    for (int64_t q = 0; q < Q; q++) {
        double t = fmin(fmax((u[q] - first) / step, 0.0), (double)nodes - 1.001);
        int64_t node = (int64_t)t < 1 ? 1 : (int64_t)t > nodes - 3 ? nodes - 3 : (int64_t)t, nearest = (int64_t)(t + WHOLE - WHOLE);
        double f = t - (double)node, by = exponential(-2.0 * (first + t * step));
        double weight[4] = {-f * (f - 1) * (f - 2) / 6 * by, (f + 1) * (f - 1) * (f - 2) / 2 * by, -(f + 1) * f * (f - 2) / 2 * by,
                            (f + 1) * f * (f - 1) / 6 * by};
        const float *at = table + (pixel[q] * nodes + node - 1) * 3 * L;
        for (int64_t l = 0; l < L; l++) {
            for (int64_t i = 3 * l; i < 3 * l + 3; i++)
                B[3 * (l * Q + q) + i - 3 * l] =
                    (at[i] * weight[0] + at[3 * L + i] * weight[1]) + (at[6 * L + i] * weight[2] + at[9 * L + i] * weight[3]);
            doubt[l * Q + q] = doubts[(pixel[q] * nodes + nearest) * L + l];
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

/* Values (L, P) of a lattice (nodes, nodes, L) at places (P, 2) in steps, cubic along each side. Twin: surface/planes.py (between). */
KERNEL void lpcal_lattice(int64_t L, int64_t nodes, int64_t P, const double *lattice, const double *place, double *found) {
    for (int64_t p = 0; p < P; p++) {
        int64_t x = node_before(place[2 * p], nodes), y = node_before(place[2 * p + 1], nodes);
        double across[4], down[4];
        cubic_weights(place[2 * p] - (double)x, across);
        cubic_weights(place[2 * p + 1] - (double)y, down);
        for (int64_t k = 0; k < L; k++) found[k * P + p] = 0.0;
        for (int64_t i = 0; i < 4; i++)
            for (int64_t j = 0; j < 4; j++) {
                const double *at = lattice + ((x + i - 1) * nodes + y + j - 1) * L;
                double by = across[i] * down[j];
                for (int64_t k = 0; k < L; k++) found[k * P + p] += by * at[k];
            }
    }
}
