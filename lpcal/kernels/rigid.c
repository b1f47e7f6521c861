/* Many small rotations at once. Twins: geometry/park.py (_rotations, _residuals). */

#include "kernel.h"

/* A B, or A' B, or A B', of 3x3 matrices whose rows are `stride` apart. */
static void product(const double *a, const double *b, int64_t stride, bool first_turned, bool second_turned, double found[9]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0.0;
            for (int k = 0; k < 3; k++) sum += a[first_turned ? k * stride + i : i * stride + k] * b[second_turned ? j * stride + k : k * stride + j];
            found[3 * i + j] = sum;
        }
}

/* Rotation vector of a rotation, by the quaternion as geometry/se3.py finds it. */
static void rotation_vector(const double R[9], double v[3]) {
    double trace = R[0] + R[4] + R[8], K[4][4], q[4], next[4];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) K[i][j] = R[3 * i + j] + R[3 * j + i] + (i == j ? 1 - trace : 0.0);
    K[3][3] = 1 + trace;
    K[0][3] = K[3][0] = R[7] - R[5];
    K[1][3] = K[3][1] = R[2] - R[6];
    K[2][3] = K[3][2] = R[3] - R[1];
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (K[i][i] > K[largest][largest]) largest = i;
    for (int i = 0; i < 4; i++) q[i] = K[i][largest];
    for (int round = 0; round < 3; round++) {
        double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        for (int i = 0; i < 4; i++) q[i] /= length;
        if (round == 2) break;
        for (int i = 0; i < 4; i++) next[i] = K[i][0] * q[0] + K[i][1] * q[1] + K[i][2] * q[2] + K[i][3] * q[3];
        memcpy(q, next, sizeof q);
    }
    double turn = q[3] < 0 ? -1.0 : 1.0, sine = sqrt(dot3(q, q));
    double factor = sine > 1e-12 ? 2 * atan2(sine, turn * q[3]) / sine : 2.0;
    for (int i = 0; i < 3; i++) v[i] = turn * q[i] * factor;
}

/* Sums (S, 3, 3) of a b' over pairs i, j of the views of S problems, a the vector of A_j' A_i, b that of B_j B_i'; A, B (S, N, 3, 3). */
KERNEL void lpcal_turns(int64_t S, int64_t N, int64_t pairs, const double *A, const double *B, const int64_t *i, const int64_t *j,
                        double *sums) {
    for (int64_t s = 0; s < S; s++) {
        double *sum = sums + 9 * s, R[9], a[3], b[3];
        memset(sum, 0, 9 * sizeof *sum);
        for (int64_t k = 0; k < pairs; k++) {
            product(A + 9 * (s * N + j[k]), A + 9 * (s * N + i[k]), 3, true, false, R);
            rotation_vector(R, a);
            product(B + 9 * (s * N + j[k]), B + 9 * (s * N + i[k]), 3, false, true, R);
            rotation_vector(R, b);
            for (int m = 0; m < 3; m++)
                for (int n = 0; n < 3; n++) sum[3 * m + n] += a[m] * b[n];
        }
    }
}

/* Residuals of A_n X_s B_n against Y_s: chord of the rotations (S, N) and distance (S, N); A, B (N, 4, 4), X, Y (S, 4, 4). */
KERNEL void lpcal_misses(int64_t S, int64_t N, const double *A, const double *B, const double *X, const double *Y, double *chord,
                         double *distance) {
    for (int64_t s = 0; s < S; s++)
        for (int64_t n = 0; n < N; n++) {
            const double *a = A + 16 * n, *b = B + 16 * n, *x = X + 16 * s, *y = Y + 16 * s;
            double ax[3][4], turned = 0.0, moved = 0.0;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 4; j++)
                    ax[i][j] = a[4 * i] * x[j] + a[4 * i + 1] * x[4 + j] + a[4 * i + 2] * x[8 + j] + (j == 3 ? a[4 * i + 3] : 0.0);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 4; j++) {
                    double off = ax[i][0] * b[j] + ax[i][1] * b[4 + j] + ax[i][2] * b[8 + j] + (j == 3 ? ax[i][3] : 0.0) - y[4 * i + j];
                    if (j < 3) turned += off * off;
                    else moved += off * off;
                }
            chord[s * N + n] = sqrt(turned);
            distance[s * N + n] = sqrt(moved);
        }
}
