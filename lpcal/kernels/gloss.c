/* A gloss lobe for a whole object: residuals and lobe projected onto the complement of b, and the costs of its strengths. Twin: shading/gloss.py
   (_unexplained, _costs). Values are (L, P), light vectors B (L, P, 3); weights are 1 for samples that count, else 0. */

#include "kernel.h"

#define BLOCK 64
#define HALF 32
#define TOGETHER 8 /* twice as many factors of a product before its logarithm is taken: far from the ends of what doubles hold */

/* b (2, 3) of two right sides by the same symmetric positive matrix M (its upper half, row by row), which is L D L'. */
static inline void solved(const double M[6], const double right[6], double b[6]) {
    double small = 1e-9 * (M[0] + M[3] + M[5]) + 1e-300;
    double d0 = M[0] + small, l10 = M[1] / d0, l20 = M[2] / d0;
    double d1 = M[3] + small - l10 * M[1], rest = M[4] - l20 * M[1], l21 = rest / d1;
    double d2 = M[5] + small - l20 * M[2] - l21 * rest;
    for (int v = 0; v < 6; v += 3) {
        double y0 = right[v], y1 = right[v + 1] - l10 * y0, y2 = right[v + 2] - l20 * y0 - l21 * y1;
        b[v + 2] = y2 / d2;
        b[v + 1] = y1 / d1 - l21 * b[v + 2];
        b[v] = y0 / d0 - l10 * b[v + 1] - l20 * b[v + 2];
    }
}

/* Residual and gloss lobe projected onto the complement of b: left and own (L, P), with the weights of a robust regression of the one on
   the other in so many rounds. `pull` (L, P) is work space. */
KERNEL void lpcal_unexplained(int64_t L, int64_t P, const double *residual, const double *shape, const double *weight, const double *spread2,
                              const double *B, double width2, int64_t rounds, double *pull, double *left, double *own) {
    for (int64_t s = 0; s < L * P; s++) pull[s] = weight[s] / spread2[s];
    for (int64_t round = 0; round <= rounds; round++) {
        double along[BLOCK] = {0.0}, length[BLOCK] = {0.0}, top = 0.0, bottom = 0.0;
        for (int64_t first = 0; first < P; first += BLOCK) {
            int64_t some = P - first < BLOCK ? P - first : BLOCK;
            double M[6][BLOCK] = {{0.0}}, right[6][BLOCK] = {{0.0}}, b[6][BLOCK];
            for (int64_t k = 0; k < L; k++) {
                int64_t at = k * P + first;
                for (int64_t p = 0; p < some; p++) {
                    const double *light = B + 3 * (at + p);
                    double x = light[0], y = light[1], z = light[2], w = pull[at + p], wx = w * x, wy = w * y, wz = w * z;
                    double one = residual[at + p], other = shape[at + p];
                    M[0][p] += wx * x;
                    M[1][p] += wx * y;
                    M[2][p] += wx * z;
                    M[3][p] += wy * y;
                    M[4][p] += wy * z;
                    M[5][p] += wz * z;
                    right[0][p] += wx * one;
                    right[1][p] += wy * one;
                    right[2][p] += wz * one;
                    right[3][p] += wx * other;
                    right[4][p] += wy * other;
                    right[5][p] += wz * other;
                }
            }
            for (int64_t p = 0; p < some; p++) {
                double matrix[6], sides[6], found[6];
                for (int i = 0; i < 6; i++) {
                    matrix[i] = M[i][p];
                    sides[i] = right[i][p];
                }
                solved(matrix, sides, found);
                for (int i = 0; i < 6; i++) b[i][p] = found[i];
            }
            for (int64_t k = 0; k < L; k++) {
                int64_t at = k * P + first;
                for (int64_t p = 0; p < some; p++) {
                    const double *light = B + 3 * (at + p);
                    double l = residual[at + p] - (light[0] * b[0][p] + light[1] * b[1][p] + light[2] * b[2][p]);
                    double o = shape[at + p] - (light[0] * b[3][p] + light[1] * b[4][p] + light[2] * b[5][p]);
                    left[at + p] = l;
                    own[at + p] = o;
                    along[p] += pull[at + p] * l * o;
                    length[p] += pull[at + p] * o * o;
                }
            }
        }
        if (round == rounds) return;
        for (int p = 0; p < BLOCK; p++) {
            top += along[p];
            bottom += length[p];
        }
        double best = fmax(top / fmax(bottom, 1e-300), 0.0);
        for (int64_t s = 0; s < L * P; s++)
            pull[s] = weight[s] / (square(1.0 + square(left[s] - best * own[s]) / (spread2[s] * width2)) * spread2[s]);
    }
}

/* For each strength: the misfit of left - strength own, sum of width2 log(1 + r^2 / s / width2), and the sum of log(s), with the variance
   s = spread2 + (doubt strength own)^2 (strengths, 2). `unit` is a variance of the usual size. */
KERNEL void lpcal_lobe_costs(int64_t L, int64_t P, int64_t strengths, const double *strength, const double *left, const double *own,
                             const double *weight, const double *spread2, double doubt, double width2, double unit, double *found) {
    double small = 1.0 / unit, narrow = small / width2, whole = 0.0;
    for (int64_t s = 0; s < L * P; s++) whole += weight[s];
    for (int64_t j = 0; j < strengths; j++) {
        double both[HALF] = {0.0}, alone[HALF] = {0.0}, misfit = 0.0, spread = 0.0, ks = strength[j];
        for (int64_t first = 0; first < P; first += BLOCK) {
            int64_t some = P - first < BLOCK ? P - first : BLOCK;
            for (int64_t group = 0; group < L; group += TOGETHER) {
                double with[BLOCK], without[BLOCK];
                for (int p = 0; p < BLOCK; p++) with[p] = without[p] = 1.0;
                for (int64_t k = group; k < L && k < group + TOGETHER; k++) {
                    int64_t at = k * P + first;
                    for (int64_t p = 0; p < some; p++) {
                        double shown = ks * own[at + p], r = left[at + p] - shown;
                        double s = (spread2[at + p] + square(doubt * shown)) * small, more = s + r * r * narrow;
                        bool counts = weight[at + p] > 0.0;
                        with[p] *= counts ? more : 1.0;
                        without[p] *= counts ? s : 1.0;
                    }
                }
                for (int p = 0; p < HALF; p++) {
                    both[p] += logarithm(with[p] * with[HALF + p]);
                    alone[p] += logarithm(without[p] * without[HALF + p]);
                }
            }
        }
        for (int p = 0; p < HALF; p++) {
            misfit += both[p] - alone[p];
            spread += alone[p];
        }
        found[2 * j] = width2 * misfit;
        found[2 * j + 1] = spread - whole * logarithm(small);
    }
}
