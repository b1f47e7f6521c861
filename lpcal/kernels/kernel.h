/* What every source begins with. Arrays are contiguous, the last index runs fastest; L lights, P pixels. */

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(_WIN32)
#define KERNEL __declspec(dllexport)
#else
#define KERNEL
#endif

#define LANES 4 /* doubles that are worked on together, to a multiple of which some arrays are filled up (kernels/library.py) */

/* Before a loop of few rounds that are all alike: clang would write it out, a number at a time. */
#if defined(__clang__)
#define LANEWISE _Pragma("clang loop vectorize(enable) unroll(disable)")
#else
#define LANEWISE
#endif

static inline double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void cross3(const double a[3], const double b[3], double found[3]) {
    found[0] = a[1] * b[2] - a[2] * b[1];
    found[1] = a[2] * b[0] - a[0] * b[2];
    found[2] = a[0] * b[1] - a[1] * b[0];
}

#define LN2 0.693147180559945309417
#define LN2_HIGH 6.93147180369123816490e-01 /* its first 32 bits, so that whole multiples are exact (fdlibm) */
#define LN2_LOW 1.90821492927058770002e-10
#define WHOLE 6755399441055744.0 /* 1.5 * 2^52: the lowest bits of a number plus this are the number's nearest whole one */
#define LEAST (-708.0)           /* under this an exponential is no normal number any more: 0 */

static inline uint64_t bits_of(double x) {
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

static inline double of_bits(uint64_t u) {
    double x;
    memcpy(&x, &u, sizeof x);
    return x;
}

static inline uint32_t bits_of_single(float x) {
    uint32_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

static inline float of_bits_single(uint32_t u) {
    float x;
    memcpy(&x, &u, sizeof x);
    return x;
}

/* Of a number up to 700: a power of two times the Taylor series within half of ln 2. */
static inline double exponential(double y) {
    double within = y < LEAST ? LEAST : y, shifted = within * (1.0 / LN2) + WHOLE, whole = shifted - WHOLE;
    double r = (within - whole * LN2_HIGH) - whole * LN2_LOW, sum = 1.0 / 6227020800.0;
    sum = sum * r + 1.0 / 479001600.0;
    sum = sum * r + 1.0 / 39916800.0;
    sum = sum * r + 1.0 / 3628800.0;
    sum = sum * r + 1.0 / 362880.0;
    sum = sum * r + 1.0 / 40320.0;
    sum = sum * r + 1.0 / 5040.0;
    sum = sum * r + 1.0 / 720.0;
    sum = sum * r + 1.0 / 120.0;
    sum = sum * r + 1.0 / 24.0;
    sum = sum * r + 1.0 / 6.0;
    sum = sum * r + 0.5;
    sum = sum * r + 1.0;
    sum = sum * r + 1.0;
    double scaled = of_bits(bits_of(sum) + (bits_of(shifted) << 52));
    return y < LEAST ? 0.0 : scaled;
}

/* The same in single precision: of a number up to 80, right to 1e-7 of itself. */
static inline float exponential_single(float y) {
    float within = y < -87.0f ? -87.0f : y, shifted = within * 1.44269504f + 12582912.0f, whole = shifted - 12582912.0f;
    float r = (within - whole * 0.693359375f) + whole * 2.12194440e-4f, sum = 1.0f / 5040.0f;
    sum = sum * r + 1.0f / 720.0f;
    sum = sum * r + 1.0f / 120.0f;
    sum = sum * r + 1.0f / 24.0f;
    sum = sum * r + 1.0f / 6.0f;
    sum = sum * r + 0.5f;
    sum = sum * r + 1.0f;
    sum = sum * r + 1.0f;
    float scaled = of_bits_single(bits_of_single(sum) + (bits_of_single(shifted) << 23));
    return y < -87.0f ? 0.0f : scaled;
}

/* Of a normal positive number: exponent times ln 2, and 2 atanh((f - 1) / (f + 1)) of its fraction f about 1. */
static inline double logarithm(double x) {
    uint64_t u = bits_of(x);
    double exponent = of_bits((u >> 52) | 0x4330000000000000u) - (4503599627370496.0 + 1023.0);
    double fraction = of_bits((u & 0x000fffffffffffffu) | 0x3ff0000000000000u);
    bool large = fraction > 1.4142135623730951;
    fraction = large ? 0.5 * fraction : fraction;
    exponent = large ? exponent + 1.0 : exponent;
    double s = (fraction - 1.0) / (fraction + 1.0), z = s * s, sum = 1.0 / 21.0;
    sum = sum * z + 1.0 / 19.0;
    sum = sum * z + 1.0 / 17.0;
    sum = sum * z + 1.0 / 15.0;
    sum = sum * z + 1.0 / 13.0;
    sum = sum * z + 1.0 / 11.0;
    sum = sum * z + 1.0 / 9.0;
    sum = sum * z + 1.0 / 7.0;
    sum = sum * z + 1.0 / 5.0;
    sum = sum * z + 1.0 / 3.0;
    return exponent * LN2 + (2.0 * s + 2.0 * s * z * sum);
}

static inline double square(double x) { return x * x; }

static inline double greater(double a, double b) { return a > b ? a : b; }

#define STEEPEST 0.03 /* LEAST_COSINE of view/constants.py */
#define TAU_HALF 3.14159265358979323846

/* Gloss of a light from d at a normal n, seen from v: see shading/gloss.py (lobe); all its quotients in one. */
static inline double lobe(const double d[3], const double n[3], const double v[3], double a2) {
    double h[3] = {d[0] + v[0], d[1] + v[1], d[2] + v[2]}, nh = greater(dot3(h, n), 0.0), lit = greater(dot3(d, n), 0.0);
    double q = nh * nh / greater(dot3(h, h), 1e-18) * (a2 - 1.0) + 1.0, nv = greater(dot3(v, n), STEEPEST);
    double along = lit + sqrt(a2 + (1.0 - a2) * (lit * lit)) + 1e-12, back = nv + sqrt(a2 + (1.0 - a2) * (nv * nv)) + 1e-12;
    return a2 * lit / (TAU_HALF * (q * q) * along * back);
}

#define MOST_BESIDE 64 /* pixels of a block at most */

/* Directions (some, 3) and irradiances (some) of a light at pixels from the first on: of distant lights, which are alike everywhere, one each
   is given, and repeated here. */
typedef struct {
    const double *d, *E;
    double way[3 * MOST_BESIDE], level[MOST_BESIDE];
} Light;

static inline void lit(Light *to, const double *d, const double *E, int64_t alike, int64_t P, int64_t k, int64_t first, int64_t some) {
    to->d = alike ? to->way : d + 3 * (k * P + first);
    to->E = alike ? to->level : E + k * P + first;
    for (int64_t p = 0; alike && p < some; p++) {
        to->level[p] = E[k];
        for (int i = 0; i < 3; i++) to->way[3 * p + i] = d[3 * k + i];
    }
}
