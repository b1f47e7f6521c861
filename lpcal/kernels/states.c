/* What the field asks of samples and neighbours beside its normal equations (field.c). Twins: shading/field.py (_System.at, _by_pixels,
   _evidence). Light comes from directions d (L, P, 3) with irradiances E (L, P), and as J (L, P, 3) from other surfaces. */

#include "kernel.h"

#define BLOCK 64
#define PARTS 3 /* of the light of surfaces: see surface/interreflection.py (Thrown.parts) */

enum { MODEL, SHARED, DARK, THROWN_DOUBT, PRICE, HIDDEN, GLOSS_DOUBT, WIDTH2, STRENGTH, ROUGHNESS };

typedef struct {
    int64_t L, P, alike;
    const double *d, *E, *J, *signal, *sigma, *b, *v, *c;
    const bool *usable, *hidden;
} Given;

/* A block of pixels: b, normals, brightest samples. */
typedef struct {
    double b[3][BLOCK], n[BLOCK][3], top[BLOCK];
} Pixels;

/* A light's samples of a block: all light vectors, gloss, and by b the residual as lit, its variance, and by how much being lit is cheaper. */
typedef struct {
    Light light;
    double B[3][BLOCK], shown[BLOCK], direct[BLOCK], left[BLOCK], spread2[BLOCK], cheaper[BLOCK];
} Samples;

static void begun(const Given *of, int64_t first, int64_t some, Pixels *at) {
    for (int64_t p = 0; p < some; p++) {
        const double *b = of->b + 3 * (first + p);
        double length = greater(sqrt(dot3(b, b)), 1e-300);
        for (int i = 0; i < 3; i++) {
            at->b[i][p] = b[i];
            at->n[p][i] = b[i] / length;
        }
        at->top[p] = of->signal[first + p];
    }
    for (int64_t k = 1; k < of->L; k++)
        for (int64_t p = 0; p < some; p++) at->top[p] = greater(at->top[p], of->signal[k * of->P + first + p]);
}

/* The states of light k's samples: see shading/field.py (states). */
static void stated(const Given *of, int64_t k, int64_t first, int64_t some, const Pixels *at, Samples *to) {
    const double *c = of->c, *d, *E, *J = of->J + 3 * (k * of->P + first);
    const double *signal = of->signal + k * of->P + first, *sigma = of->sigma + k * of->P + first;
    double model2 = square(c[MODEL]), shared2 = square(c[SHARED]), dark_2 = square(c[DARK]), thrown_2 = square(c[THROWN_DOUBT]);
    double gloss2 = square(c[GLOSS_DOUBT]), a2 = square(c[ROUGHNESS]), price = c[PRICE], against_hidden = -c[HIDDEN];
    double thrown[BLOCK] = {0.0}, hidden[BLOCK] = {0.0};
    lit(&to->light, of->d, of->E, of->alike, of->P, k, first, some);
    d = to->light.d, E = to->light.E;
    for (int64_t p = 0; p < some; p++) {
        to->shown[p] = 0.0;
        for (int i = 0; i < 3; i++) to->B[i][p] = d[3 * p + i] * E[p];
        to->direct[p] = to->B[0][p] * at->b[0][p] + to->B[1][p] * at->b[1][p] + to->B[2][p] * at->b[2][p];
    }
    for (int64_t p = 0; of->J && p < some; p++) {
        thrown[p] = greater(J[3 * p] * at->b[0][p] + J[3 * p + 1] * at->b[1][p] + J[3 * p + 2] * at->b[2][p], 0.0);
        for (int i = 0; i < 3; i++) to->B[i][p] += J[3 * p + i];
    }
    for (int64_t p = 0; c[STRENGTH] > 0.0 && p < some; p++)
        to->shown[p] = c[STRENGTH] * E[p] * lobe(d + 3 * p, at->n[p], of->v + 3 * (first + p), a2);
    for (int64_t p = 0; of->hidden && p < some; p++) hidden[p] = of->hidden[k * of->P + first + p] ? 1.0 : 0.0;
    for (int64_t p = 0; p < some; p++) {
        double seen = signal[p], bright = greater(to->direct[p], 0.0), dark = seen - thrown[p], left = dark - to->shown[p] - bright;
        double noise2 = square(sigma[p]) + thrown_2 * square(thrown[p]), top2 = square(at->top[p]);
        double spread2 = noise2 + model2 * square(seen) + shared2 * top2 + gloss2 * square(to->shown[p]), dark2 = noise2 + dark_2 * top2;
        double cost = hidden[p] > 0.0 ? against_hidden : bright > 0.0 ? price : 0.0;
        to->left[p] = left;
        to->spread2[p] = spread2;
        to->cheaper[p] = square(dark) / dark2 + cost - square(left) / spread2;
    }
}

/* b of a pixel by its normal equations, M the upper half row by row, and the inverse: see geometry/lambert.py (weighted). */
static bool solved(const double M[6], const double right[3], double singular, double b[3], double inverse[9]) {
    double rows[3][3] = {{M[0], M[1], M[2]}, {M[1], M[3], M[4]}, {M[2], M[4], M[5]}}, cofactor[3][3];
    for (int i = 0; i < 3; i++) cross3(rows[(i + 1) % 3], rows[(i + 2) % 3], cofactor[i]);
    double determinant = dot3(rows[0], cofactor[0]), trace = M[0] + M[3] + M[5];
    bool sound = determinant > singular * (trace * trace * trace);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) inverse[3 * i + j] = sound ? cofactor[i][j] / determinant : NAN;
        b[i] = sound ? dot3(inverse + 3 * i, right) : 0.0;
    }
    return sound;
}

/* What each pixel's own samples say, of pixels from the first to the last: b and covariance, NaN where they say nothing, the samples that
   agree, sums of their squares and of those of all that are lit, gloss. `work` (3, L, 64) is work space. */
KERNEL void lpcal_agreeing(int64_t L, int64_t P, int64_t alike, const double *d, const double *E, int64_t has_J, const double *J, const double *signal,
                           const double *sigma, const bool *usable, int64_t has_hidden, const bool *hidden, const double *b,
                           const double *v, const double *c, double singular, int64_t first, int64_t last, double *work, double *own,
                           bool *inliers, double *covariance, double *chi2, double *cost, double *shown) {
    Given of = {L, P, alike, d, E, has_J ? J : 0, signal, sigma, b, v, c, usable, has_hidden ? hidden : 0};
    double width2 = c[WIDTH2];
    Pixels at;
    Samples now;
    for (; first < last; first += BLOCK) {
        int64_t some = last - first < BLOCK ? last - first : BLOCK;
        double M[6][BLOCK] = {{0.0}}, right[3][BLOCK] = {{0.0}}, found[3][BLOCK], total[BLOCK] = {0.0}, agree[BLOCK] = {0.0}, count[BLOCK] = {0.0};
        begun(&of, first, some, &at);
        for (int64_t k = 0; k < L; k++) {
            double *spread2 = work + k * BLOCK, *reached = work + (L + k) * BLOCK, *counted = work + (2 * L + k) * BLOCK;
            stated(&of, k, first, some, &at, &now);
            for (int64_t p = 0; p < some; p++) {
                bool is_reached = (usable[k * P + first + p] != 0) & (now.direct[p] > 0.0);
                bool counts = is_reached & (now.cheaper[p] > 0.0) & (square(now.left[p]) < width2 * now.spread2[p]);
                double weight = counts ? 1.0 / now.spread2[p] : 0.0, matte = signal[k * P + first + p] - now.shown[p];
                spread2[p] = now.spread2[p];
                reached[p] = is_reached ? 1.0 : 0.0;
                counted[p] = counts ? 1.0 : 0.0;
                count[p] += counted[p];
                for (int i = 0, slot = 0; i < 3; i++) {
                    right[i][p] += weight * now.B[i][p] * matte;
                    for (int j = i; j < 3; j++, slot++) M[slot][p] += weight * now.B[i][p] * now.B[j][p];
                }
            }
            for (int64_t p = 0; p < some; p++) inliers[k * P + first + p] = counted[p] > 0.0;
            for (int64_t p = 0; c[STRENGTH] > 0.0 && p < some; p++) shown[k * P + first + p] = now.shown[p];
        }
        for (int64_t p = 0; p < some; p++) {
            double matrix[6], side[3] = {right[0][p], right[1][p], right[2][p]}, one[3];
            for (int i = 0; i < 6; i++) matrix[i] = M[i][p];
            bool sound = solved(matrix, side, singular, one, covariance + 9 * (first + p));
            bool good = sound && count[p] >= 3.0 && one[0] * at.b[0][p] + one[1] * at.b[1][p] + one[2] * at.b[2][p] >= 0.0;
            for (int i = 0; i < 3; i++) {
                found[i][p] = one[i];
                own[3 * (first + p) + i] = good ? one[i] : NAN;
            }
        }
        for (int64_t k = 0; k < L; k++) {
            const double *spread2 = work + k * BLOCK, *reached = work + (L + k) * BLOCK, *counted = work + (2 * L + k) * BLOCK;
            lit(&now.light, d, E, alike, P, k, first, some);
            for (int64_t p = 0; p < some; p++) {
                int64_t s = k * P + first + p;
                const double *way = now.light.d + 3 * p;
                double E_p = now.light.E[p], light[3] = {way[0] * E_p, way[1] * E_p, way[2] * E_p};
                if (has_J)
                    for (int i = 0; i < 3; i++) light[i] += J[3 * s + i];
                double said = greater(light[0] * found[0][p] + light[1] * found[1][p] + light[2] * found[2][p], 0.0);
                double matte = c[STRENGTH] > 0.0 ? signal[s] - shown[s] : signal[s], off = square(matte - said) / spread2[p];
                agree[p] += counted[p] * off;
                total[p] += reached[p] * (off < width2 ? off : width2);
            }
        }
        for (int64_t p = 0; p < some; p++) {
            chi2[first + p] = agree[p];
            cost[first + p] = total[p];
        }
    }
}

/* Of pixels from the first to the last: own (P, 3, 3), pull (P, 3) and across (3, P, 3) of the normal equations of b and of the strengths
   of three parts of the light (L, P, 3) each, and summed over the pixels what they say of the strengths: sums (3 x 3, then 3). */
KERNEL void lpcal_evidence(int64_t L, int64_t P, int64_t alike, const double *d, const double *E, int64_t has_J, const double *J, const double *signal,
                           const double *sigma, const bool *usable, int64_t has_hidden, const bool *hidden, const double *b,
                           const double *v, const double *c, const double *part0, const double *part1, const double *part2, int64_t first,
                           int64_t last, double *own, double *pull, double *across, double *sums) {
    Given of = {L, P, alike, d, E, has_J ? J : 0, signal, sigma, b, v, c, usable, has_hidden ? hidden : 0};
    const double *parts[PARTS] = {part0, part1, part2};
    double narrow = 1.0 / c[WIDTH2];
    Pixels at;
    Samples now;
    for (int i = 0; i < PARTS * PARTS + PARTS; i++) sums[i] = 0.0;
    for (; first < last; first += BLOCK) {
        int64_t some = last - first < BLOCK ? last - first : BLOCK;
        double M[6][BLOCK] = {{0.0}}, to_b[3][BLOCK] = {{0.0}}, both[PARTS][3][BLOCK] = {{{0.0}}}, column[PARTS][BLOCK];
        double strengths[PARTS * PARTS + PARTS][BLOCK] = {{0.0}};
        begun(&of, first, some, &at);
        for (int64_t k = 0; k < L; k++) {
            stated(&of, k, first, some, &at, &now);
            for (int n = 0; n < PARTS; n++)
                for (int64_t p = 0; p < some; p++) {
                    const double *of_part = parts[n] + 3 * (k * P + first + p);
                    column[n][p] = of_part[0] * at.b[0][p] + of_part[1] * at.b[1][p] + of_part[2] * at.b[2][p];
                }
            for (int64_t p = 0; p < some; p++) {
                double cheaper = now.cheaper[p] / 2.0, within = cheaper < -30.0 ? -30.0 : cheaper > 30.0 ? 30.0 : cheaper;
                double chance = 1.0 / (1.0 + exponential(-within)), off = square(now.left[p]) / now.spread2[p];
                double weight = usable[k * P + first + p] ? chance / (square(1.0 + off * narrow) * now.spread2[p]) : 0.0;
                double pulled = weight * now.left[p];
                for (int i = 0, slot = 0; i < 3; i++) {
                    to_b[i][p] += pulled * now.B[i][p];
                    for (int j = i; j < 3; j++, slot++) M[slot][p] += weight * now.B[i][p] * now.B[j][p];
                }
                for (int n = 0; n < PARTS; n++) {
                    double by = weight * column[n][p];
                    for (int i = 0; i < 3; i++) both[n][i][p] += by * now.B[i][p];
                    for (int m = 0; m < PARTS; m++) strengths[PARTS * n + m][p] += by * column[m][p];
                    strengths[PARTS * PARTS + n][p] += pulled * column[n][p];
                }
            }
        }
        for (int64_t p = 0; p < some; p++)
            for (int i = 0, slot = 0; i < 3; i++) {
                pull[3 * (first + p) + i] = to_b[i][p];
                for (int n = 0; n < PARTS; n++) across[3 * (n * P + first + p) + i] = both[n][i][p];
                for (int j = i; j < 3; j++, slot++) own[9 * (first + p) + 3 * i + j] = own[9 * (first + p) + 3 * j + i] = M[slot][p];
            }
        for (int i = 0; i < PARTS * PARTS + PARTS; i++)
            for (int64_t p = 0; p < some; p++) sums[i] += strengths[i][p];
    }
}

/* Weights of the links (edges) between neighbouring pixels `first` and `last` at b (P, 3), and block (P, 3, 3): `own` with the weights of a
   pixel's links on its diagonal. Twin: shading/field.py (_System.at). */
KERNEL void lpcal_links(int64_t edges, int64_t P, const int64_t *first, const int64_t *last, const double *b, const double *own,
                        double turn2, double link2, double *total, double *link, double *block) {
    for (int64_t p = 0; p < P; p++) total[p] = 0.0;
    for (int64_t e = 0; e < edges; e++) {
        const double *x = b + 3 * first[e], *y = b + 3 * last[e];
        double off[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]}, x_long = greater(sqrt(dot3(x, x)), 1e-12), y_long = greater(sqrt(dot3(y, y)), 1e-12);
        double both = x_long * y_long * turn2, apart = dot3(off, off) / both;
        link[e] = 1.0 / (both * square(1.0 + apart / link2));
        total[first[e]] += link[e];
        total[last[e]] += link[e];
    }
    for (int64_t p = 0; p < P; p++) {
        memcpy(block + 9 * p, own + 9 * p, 9 * sizeof(double));
        for (int i = 0; i < 9; i += 4) block[9 * p + i] += total[p];
    }
}
