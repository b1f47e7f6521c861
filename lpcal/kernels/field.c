/* What the samples of each pixel say of its b, by the states and the weights that they have at the b so far. Twin: surface/field.py
   (_gathered). Light comes from directions d (L, P, 3) with irradiances E (L, P), and as J (L, P, 3) from other surfaces. */

#include "kernel.h"

#define BLOCK 64
#define STEEPEST 0.05
#define TAU_HALF 3.14159265358979323846

enum { MODEL, SHARED, DARK, THROWN_DOUBT, PRICE, HIDDEN, GLOSS_DOUBT, WIDTH2, STRENGTH, ROUGHNESS, WARMTH };

static inline double square(double x) { return x * x; }

static inline double smith(double cosine, double a2) { return 2.0 * cosine / (cosine + sqrt(a2 + (1.0 - a2) * (cosine * cosine)) + 1e-12); }

/* Gloss of a light from d at a normal n, seen from v: see surface/gloss.py (lobe). */
static inline double lobe(const double d[3], const double n[3], const double v[3], double a2) {
    double h[3] = {d[0] + v[0], d[1] + v[1], d[2] + v[2]}, length = fmax(sqrt(dot3(h, h)), 1e-9);
    double nh = dot3(h, n) / length, nd = dot3(d, n), nv = fmax(dot3(v, n), STEEPEST);
    double D = a2 / (TAU_HALF * square(square(fmax(nh, 0.0)) * (a2 - 1.0) + 1.0));
    return nd > 0.0 ? D * smith(nd, a2) * smith(nv, a2) / (4.0 * nv) : 0.0;
}

/* How the lobe changes with the normal, along the tangents: see surface/gloss.py (turned). */
static inline void turned(const double d[3], const double n[3], const double v[3], double a2, double found[3]) {
    double h[3] = {d[0] + v[0], d[1] + v[1], d[2] + v[2]}, length = fmax(sqrt(dot3(h, h)), 1e-9);
    double nh = fmax(dot3(h, n) / length, 0.0), nd = fmax(dot3(d, n), 0.0), nv = fmax(dot3(v, n), STEEPEST);
    double q = square(nh) * (a2 - 1.0) + 1.0, D = a2 / (TAU_HALF * square(q));
    double s_d = sqrt(a2 + (1.0 - a2) * square(nd)), s_v = sqrt(a2 + (1.0 - a2) * square(nv));
    double S = 2.0 * nd / (nd + s_d + 1e-12), V = 0.5 / (nv + s_v);
    double by_h = nd > 0.0 ? 4.0 * D * nh * (1.0 - a2) / q * S * V : 0.0;
    double by_d = nd > 0.0 ? D * 2.0 * a2 / (s_d * square(nd + s_d) + 1e-12) * V : 0.0;
    double by_v = nv > STEEPEST ? -D * S * V * (1.0 + (1.0 - a2) * nv / s_v) / (nv + s_v) : 0.0;
    for (int i = 0; i < 3; i++) found[i] = by_h * h[i] / length + by_d * d[i] + by_v * v[i];
    double along = dot3(found, n);
    for (int i = 0; i < 3; i++) found[i] -= along * n[i];
}

/* The lobe (L, P) of directions d (L, P, 3) at normals n, seen from directions v (P, 3). Twin: surface/gloss.py (lobe). */
KERNEL void lpcal_lobe(int64_t L, int64_t P, const double *d, const double *n, const double *v, double roughness, double *found) {
    for (int64_t k = 0; k < L; k++)
        for (int64_t p = 0; p < P; p++) found[k * P + p] = lobe(d + 3 * (k * P + p), n + 3 * p, v + 3 * p, roughness * roughness);
}

/* own (P, 3, 3) and right (P, 3) of the normal equations. `hidden` (L, P) and J are read where they are there; c holds the constants. */
KERNEL void lpcal_gathered(int64_t L, int64_t P, const double *d, const double *E, int64_t has_J, const double *J, const double *signal,
                           const double *sigma, const bool *usable, int64_t has_hidden, const bool *hidden, const double *b,
                           const double *v, const double *c, double *own, double *right) {
    bool glossy = c[STRENGTH] > 0.0;
    double a2 = c[ROUGHNESS] * c[ROUGHNESS];
    for (int64_t first = 0; first < P; first += BLOCK) {
        int64_t some = P - first < BLOCK ? P - first : BLOCK;
        double top[BLOCK], albedo[BLOCK], n[BLOCK][3], M[BLOCK][6], pull[BLOCK][3];
        memset(M, 0, sizeof M);
        memset(pull, 0, sizeof pull);
        for (int64_t p = 0; p < some; p++) {
            const double *at = b + 3 * (first + p);
            double length = fmax(sqrt(dot3(at, at)), 1e-300);
            for (int i = 0; i < 3; i++) n[p][i] = at[i] / length;
            albedo[p] = fmax(length, 1e-12);
            top[p] = signal[first + p];
        }
        for (int64_t k = 1; k < L; k++)
            for (int64_t p = 0; p < some; p++) top[p] = fmax(top[p], signal[k * P + first + p]);
        for (int64_t k = 0; k < L; k++)
            for (int64_t p = 0; p < some; p++) {
                int64_t pixel = first + p, at = k * P + pixel;
                if (!usable[at]) continue;
                const double *to = d + 3 * at;
                double B[3], thrown_B[3] = {0.0, 0.0, 0.0}, thrown = 0.0, shown = 0.0;
                for (int i = 0; i < 3; i++) B[i] = to[i] * E[at];
                double direct = dot3(B, b + 3 * pixel), bright = fmax(direct, 0.0);
                if (has_J) {
                    memcpy(thrown_B, J + 3 * at, sizeof thrown_B);
                    thrown = fmax(dot3(thrown_B, b + 3 * pixel), 0.0);
                }
                if (glossy) shown = c[STRENGTH] * E[at] * lobe(to, n[p], v + 3 * pixel, a2);
                double dark = signal[at] - thrown, left = dark - shown;
                double noise2 = square(sigma[at]) + square(c[THROWN_DOUBT] * thrown), dark2 = noise2 + square(c[DARK] * top[p]);
                double spread2 = noise2 + square(c[MODEL] * signal[at]) + square(c[SHARED] * top[p]) + square(c[GLOSS_DOUBT] * shown);
                double as_shadow = square(dark) / dark2, as_direct = square(left - bright) / spread2;
                double price = has_hidden && hidden[at] ? -c[HIDDEN] : bright > 0.0 ? c[PRICE] : 0.0;
                double against = (as_shadow - as_direct + price) / (2.0 * c[WARMTH]);
                double chance = 1.0 / (1.0 + exponential(-fmin(fmax(against, -30.0), 30.0)));
                double lit = chance / square(1.0 + as_direct / c[WIDTH2]) / spread2;
                double shade = (1.0 - chance) / square(1.0 + as_shadow / c[WIDTH2]) / dark2;
                for (int i = 0; i < 3; i++) B[i] = direct > 0.0 ? B[i] + thrown_B[i] : thrown_B[i];
                if (glossy) {
                    double change[3];
                    turned(to, n[p], v + 3 * pixel, a2, change);
                    for (int i = 0; i < 3; i++) B[i] += c[STRENGTH] * E[at] / albedo[p] * change[i];
                }
                double s = signal[at] - shown;
                for (int i = 0, slot = 0; i < 3; i++) {
                    pull[p][i] += lit * s * B[i] + shade * signal[at] * thrown_B[i];
                    for (int j = i; j < 3; j++, slot++) M[p][slot] += lit * B[i] * B[j] + shade * thrown_B[i] * thrown_B[j];
                }
            }
        for (int64_t p = 0; p < some; p++) {
            double *to = own + 9 * (first + p);
            for (int i = 0, slot = 0; i < 3; i++) {
                right[3 * (first + p) + i] = pull[p][i];
                for (int j = i; j < 3; j++, slot++) to[3 * i + j] = to[3 * j + i] = M[p][slot];
            }
        }
    }
}
