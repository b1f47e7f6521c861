/* What near light says of each pixel's own distance. Twin: surface/distance.py (_own). Light vectors B (L, P, 3), their slope by log depth,
   signals (L, P), b (P, 3). */

#include "kernel.h"

enum { MODEL, GLOSS_DOUBT, WEAK, FURTHEST, SCORE, SINGULAR };

/* Curvature (P) and optimum (P) of log depth about depths (P), by the samples that agree (L, P); gloss (L, P) is read where there is one. */
KERNEL void lpcal_own_distance(int64_t L, int64_t P, const double *B, const double *slope, const double *signal, const double *sigma,
                               int64_t has_gloss, const double *gloss, const bool *agree, const double *b, const double *depth,
                               const double *c, double *curvature, double *optimum) {
    for (int64_t p = 0; p < P; p++) {
        double own[3], M[3][3] = {{0.0}}, cofactor[3][3], along[3] = {0.0}, taken[3], H = 0.0, pull = 0.0;
        bool known = isfinite(b[3 * p]);
        for (int i = 0; i < 3; i++) own[i] = b[3 * p + i] == b[3 * p + i] ? b[3 * p + i] : 0.0;
        for (int pass = 0; pass < 2; pass++) {
            for (int64_t k = 0; k < L; k++) {
                int64_t at = k * P + p;
                if (!known || !agree[at]) continue;
                double s = signal[at], shine = has_gloss ? gloss[at] : 0.0;
                double variance = sigma[at] * sigma[at] + (c[MODEL] * s) * (c[MODEL] * s) + (c[GLOSS_DOUBT] * shine) * (c[GLOSS_DOUBT] * shine);
                double w = 1.0 / sqrt(variance), J = -w * dot3(slope + 3 * at, own), A[3];
                for (int i = 0; i < 3; i++) A[i] = w * B[3 * at + i];
                if (pass) {
                    double rest = J - dot3(A, taken);
                    H += rest * rest;
                    pull += rest * (w * (s - shine) - dot3(A, own));
                } else
                    for (int i = 0; i < 3; i++) {
                        along[i] += A[i] * J;
                        for (int j = 0; j < 3; j++) M[i][j] += A[i] * A[j];
                    }
            }
            if (pass) break;
            for (int i = 0; i < 3; i++) cross3(M[(i + 1) % 3], M[(i + 2) % 3], cofactor[i]);
            double determinant = dot3(M[0], cofactor[0]), trace = M[0][0] + M[1][1] + M[2][2];
            bool spans = determinant > c[SINGULAR] * (trace * trace * trace);
            for (int i = 0; i < 3; i++) taken[i] = spans ? dot3(cofactor[i], along) / determinant : 0.0;
        }
        H += c[WEAK];
        double most = fmin(c[FURTHEST], c[SCORE] / sqrt(H)), move = -pull / H;
        curvature[p] = H;
        optimum[p] = logarithm(depth[p]) + fmin(fmax(move, -most), most);
    }
}
