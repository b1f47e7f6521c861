/* Each pixel's own distance from near light (variable projection). Twin: surface/distance.py (_own). Light vectors B (L, P, 3), their slope by log depth,
   signals (L, P), b (P, 3). */

#include "kernel.h"

enum { MODEL, GLOSS_DOUBT, WEAK, FURTHEST, SCORE, SINGULAR };

#define BLOCK 64

/* Curvature (P) and optimum (P) of log depth about depths (P), by the samples that agree (L, P); gloss (L, P) is read where there is one. */
KERNEL void lpcal_own_distance(int64_t L, int64_t P, const double *B, const double *slope, const double *signal, const double *sigma,
                               int64_t has_gloss, const double *gloss, const bool *agree, const double *b, const double *depth,
                               const double *c, double *curvature, double *optimum) {
    double model2 = c[MODEL] * c[MODEL], gloss2 = c[GLOSS_DOUBT] * c[GLOSS_DOUBT];
    for (int64_t first = 0; first < P; first += BLOCK) {
        int64_t some = P - first < BLOCK ? P - first : BLOCK;
        double own[3][BLOCK], known[BLOCK], M[6][BLOCK] = {{0.0}}, along[3][BLOCK] = {{0.0}}, taken[3][BLOCK], shine[BLOCK] = {0.0};
        double H[BLOCK] = {0.0}, pull[BLOCK] = {0.0};
        for (int64_t p = 0; p < some; p++) {
            known[p] = isfinite(b[3 * (first + p)]) ? 1.0 : 0.0;
            for (int i = 0; i < 3; i++) own[i][p] = b[3 * (first + p) + i] == b[3 * (first + p) + i] ? b[3 * (first + p) + i] : 0.0;
        }
        for (int pass = 0; pass < 2; pass++) {
            for (int64_t k = 0; k < L; k++) {
                int64_t at = k * P + first;
                for (int64_t p = 0; has_gloss && p < some; p++) shine[p] = gloss[at + p];
                for (int64_t p = 0; p < some; p++) {
                    const double *light = B + 3 * (at + p), *turn = slope + 3 * (at + p);
                    double s = signal[at + p], counts = agree[at + p] ? known[p] : 0.0;
                    double weight = 1.0 / (sigma[at + p] * sigma[at + p] + model2 * (s * s) + gloss2 * (shine[p] * shine[p]));
                    double J = -(turn[0] * own[0][p] + turn[1] * own[1][p] + turn[2] * own[2][p]); /* unweighted: the weights are squared */
                    if (pass) {
                        double rest = J - (light[0] * taken[0][p] + light[1] * taken[1][p] + light[2] * taken[2][p]);
                        double left = s - shine[p] - (light[0] * own[0][p] + light[1] * own[1][p] + light[2] * own[2][p]);
                        H[p] += counts > 0.0 ? weight * rest * rest : 0.0;
                        pull[p] += counts > 0.0 ? weight * rest * left : 0.0;
                    } else {
                        double by = counts > 0.0 ? weight : 0.0, x = by * light[0], y = by * light[1], z = by * light[2];
                        M[0][p] += x * light[0];
                        M[1][p] += x * light[1];
                        M[2][p] += x * light[2];
                        M[3][p] += y * light[1];
                        M[4][p] += y * light[2];
                        M[5][p] += z * light[2];
                        along[0][p] += x * J;
                        along[1][p] += y * J;
                        along[2][p] += z * J;
                    }
                }
            }
            for (int p = 0; p < BLOCK && !pass; p++) {
                double xx = M[0][p], xy = M[1][p], xz = M[2][p], yy = M[3][p], yz = M[4][p], zz = M[5][p], trace = xx + yy + zz;
                double c0 = yy * zz - yz * yz, c1 = xz * yz - xy * zz, c2 = xy * yz - xz * yy;
                double c3 = xx * zz - xz * xz, c4 = xy * xz - xx * yz, c5 = xx * yy - xy * xy;
                double determinant = xx * c0 + xy * c1 + xz * c2;
                double inverse = determinant > c[SINGULAR] * (trace * trace * trace) ? 1.0 / determinant : 0.0;
                taken[0][p] = (c0 * along[0][p] + c1 * along[1][p] + c2 * along[2][p]) * inverse;
                taken[1][p] = (c1 * along[0][p] + c3 * along[1][p] + c4 * along[2][p]) * inverse;
                taken[2][p] = (c2 * along[0][p] + c4 * along[1][p] + c5 * along[2][p]) * inverse;
            }
        }
        for (int64_t p = 0; p < some; p++) {
            double bend = H[p] + c[WEAK], bound = c[SCORE] / sqrt(bend), most = bound < c[FURTHEST] ? bound : c[FURTHEST];
            double move = -pull[p] / bend;
            move = move > -most ? move : -most;
            curvature[first + p] = bend;
            optimum[first + p] = logarithm(depth[first + p]) + (move < most ? move : most);
        }
    }
}
