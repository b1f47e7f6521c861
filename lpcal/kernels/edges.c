/* Misfit of edge models to profiles across a curve, at all positions of a window at once. */

#include "kernel.h"

/* Squared misfits (K, O) of profiles (K, S) to T orthonormal terms over N places each, Q (T, N), whose first spans their mean: at O windows,
   the first from place `first` on and each a place further. `work` (T, O) is work space. Twin: detect/edge_profile.py (misfits). */
KERNEL void lpcal_slid(int64_t K, int64_t S, int64_t first, int64_t O, int64_t T, int64_t N, const double *profile, const double *Q,
                       double *work, double *found) {
    for (int64_t k = 0; k < K; k++) {
        const double *row = profile + k * S + first;
        double *left = found + k * O;
        for (int64_t o = 0; o < O; o++) left[o] = 0.0;
        for (int64_t i = 0; i < T * O; i++) work[i] = 0.0;
        for (int64_t j = 0; j < N; j++) {
            for (int64_t o = 0; o < O; o++) left[o] += row[j + o] * row[j + o];
            for (int64_t t = 0; t < T; t++) {
                double *along = work + t * O, by = Q[t * N + j];
                for (int64_t o = 0; o < O; o++) along[o] += by * row[j + o];
            }
        }
        for (int64_t t = 0; t < T; t++)
            for (int64_t o = 0; o < O; o++) left[o] -= work[t * O + o] * work[t * O + o];
    }
}
