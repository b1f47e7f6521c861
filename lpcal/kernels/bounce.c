/* Likelihood of shadowed samples under a reflectance. Twin: surface/interreflection.py (_fits). */

#include "kernel.h"

#define BLOCK 64

/* Log likelihoods (T) of signals (N) of variance noise2 (N): each of T trials predicts `by` (T, 3) times the three parts (3, N), which are
   in doubt by a share; a share of the samples shows anything up to `top` (N). */
KERNEL void lpcal_thrown_fits(int64_t T, int64_t N, const double *by, const double *parts, const double *signal, const double *noise2,
                              const double *top, double doubt, double other, double *found) {
    for (int64_t t = 0; t < T; t++) {
        const double *strength = by + 3 * t;
        double sum[BLOCK] = {0.0}, total = 0.0;
        for (int64_t first = 0; first < N; first += BLOCK) {
            int64_t some = N - first < BLOCK ? N - first : BLOCK;
            for (int64_t p = 0; p < some; p++) {
                int64_t i = first + p;
                double thrown = strength[0] * parts[i] + strength[1] * parts[N + i] + strength[2] * parts[2 * N + i];
                double variance = noise2[i] + (doubt * thrown) * (doubt * thrown), apart = signal[i] - thrown;
                double density = exponential(-(apart * apart) / (2.0 * variance)) / sqrt(6.28318530717958647693 * variance);
                sum[p] += logarithm((1.0 - other) * density + other / top[i]);
            }
        }
        for (int p = 0; p < BLOCK; p++) total += sum[p];
        found[t] = total;
    }
}
