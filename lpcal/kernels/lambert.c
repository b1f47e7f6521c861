/* Lambertian shading pixel by pixel. Twins: geometry/lambert.py (weighted), surface/normals.py (_best_three), surface/coarse.py
   (LightTable.at). Light vectors B are (L, P, 3), signals and weights (L, P). */

#include "kernel.h"

/* b (P, 3) of least squares and the inverse (P, 3, 3) of its normal matrix; NaN where the weighted lights do not span space. */
KERNEL void lpcal_weighted(int64_t L, int64_t P, const double *B, const double *signal, const double *weight, double singular, double *b,
                           double *inverse) {
    for (int64_t p = 0; p < P; p++) {
        double M[3][3] = {{0.0}}, right[3] = {0.0}, cofactor[3][3];
        for (int64_t k = 0; k < L; k++) {
            const double *light = B + 3 * (k * P + p);
            double w = weight[k * P + p], s = signal[k * P + p];
            for (int i = 0; i < 3; i++) {
                double wb = w * light[i];
                right[i] += wb * s;
                for (int j = 0; j < 3; j++) M[i][j] += wb * light[j];
            }
        }
        for (int i = 0; i < 3; i++) cross3(M[(i + 1) % 3], M[(i + 2) % 3], cofactor[i]);
        double determinant = dot3(M[0], cofactor[0]), trace = M[0][0] + M[1][1] + M[2][2];
        if (!(determinant > singular * (trace * trace * trace))) determinant = NAN;
        for (int i = 0; i < 3; i++) {
            double *row = inverse + 9 * p + 3 * i;
            for (int j = 0; j < 3; j++) row[j] = cofactor[i][j] / determinant;
            b[3 * p + i] = dot3(row, right);
        }
    }
}

/* b (P, 3) of the three usable lights whose proposal the others contradict least, a light by no more than `most`; NaN where none are. */
KERNEL void lpcal_best_three(int64_t L, int64_t P, const double *B, const double *signal, const bool *usable, const double *variance,
                             double most, double singular, double *best) {
    double light[8][3], crossed[8][8][3], size[8], s[8], weight[8];
    for (int64_t p = 0; p < P; p++) {
        double least = INFINITY;
        for (int i = 0; i < 3; i++) best[3 * p + i] = NAN;
        for (int k = 0; k < L; k++) {
            memcpy(light[k], B + 3 * (k * P + p), sizeof light[k]);
            size[k] = dot3(light[k], light[k]);
            s[k] = signal[k * P + p];
            weight[k] = usable[k * P + p] ? 1.0 / variance[k * P + p] : 0.0;
            for (int i = 0; i < k; i++) cross3(light[i], light[k], crossed[i][k]);
        }
        for (int i = 0; i < L; i++)
            for (int j = i + 1; j < L; j++)
                for (int k = j + 1; k < L; k++) {
                    if (!(usable[i * P + p] && usable[j * P + p] && usable[k * P + p])) continue;
                    double determinant = dot3(light[k], crossed[i][j]), b[3], cost = 0.0;
                    if (!(fabs(determinant) > singular * sqrt(size[i] * size[j] * size[k]))) continue;
                    double factor = 1 / determinant;
                    for (int a = 0; a < 3; a++)
                        b[a] = s[i] * factor * crossed[j][k][a] - s[j] * factor * crossed[i][k][a] + s[k] * factor * crossed[i][j][a];
                    for (int l = 0; l < L; l++) {
                        double apart = s[l] - fmax(dot3(light[l], b), 0.0), square = weight[l] * (apart * apart);
                        cost += square > most ? most : square;
                    }
                    if (cost < least) {
                        least = cost;
                        memcpy(best + 3 * p, b, sizeof b);
                    }
                }
    }
}

/* Light vectors B (L, Q, 3) and doubts (L, Q) from tables (L, nodes, 3, P) and (L, nodes, P), cubic between nodes k - 1 to k + 2. */
KERNEL void lpcal_cubic(int64_t L, int64_t nodes, int64_t P, int64_t Q, const float *table, const float *doubts, const int64_t *node,
                        const int64_t *nearest, const double *weight, const double *square, const int64_t *pixel, double *B, float *doubt) {
    for (int64_t l = 0; l < L; l++)
        for (int64_t q = 0; q < Q; q++) {
            for (int i = 0; i < 3; i++) {
                double sum = 0.0;
                for (int64_t j = 0; j < 4; j++) sum += (double)table[((l * nodes + node[q] + j - 1) * 3 + i) * P + pixel[q]] * weight[j * Q + q];
                B[3 * (l * Q + q) + i] = sum / square[q];
            }
            doubt[l * Q + q] = doubts[(l * nodes + nearest[q]) * P + pixel[q]];
        }
}
