/* Normal equations of each pixel's own samples, with their states and weights at the current b. Twin: shading/field.py
   (_gathered). Light comes from directions d (L, P, 3) with irradiances E (L, P), and as J (L, P, 3) from other surfaces. */

#include "kernel.h"

#define BLOCK 64

enum { MODEL, SHARED, DARK, THROWN_DOUBT, PRICE, HIDDEN, GLOSS_DOUBT, WIDTH2, STRENGTH, ROUGHNESS, WARMTH };

/* Derivative of the lobe by the normal, in the tangent plane: see shading/gloss.py (turned). */
static inline void turned(const double d[3], const double n[3], const double v[3], double a2, double found[3]) {
    double h[3] = {d[0] + v[0], d[1] + v[1], d[2] + v[2]}, length = greater(sqrt(dot3(h, h)), 1e-9);
    double nh = greater(dot3(h, n) / length, 0.0), nd = greater(dot3(d, n), 0.0), nv = greater(dot3(v, n), STEEPEST);
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

/* The lobe (L, P) of directions d (L, P, 3) at normals n, seen from directions v (P, 3). Twin: shading/gloss.py (lobe). */
KERNEL void lpcal_lobe(int64_t L, int64_t P, const double *d, const double *n, const double *v, double roughness, double *found) {
    for (int64_t k = 0; k < L; k++)
        for (int64_t p = 0; p < P; p++) found[k * P + p] = lobe(d + 3 * (k * P + p), n + 3 * p, v + 3 * p, roughness * roughness);
}

/* A block of pixels: b, its length, normals, directions to the viewer, brightest samples, and their accumulating normal equations. */
typedef struct {
    double b[3][BLOCK], albedo[BLOCK], n[BLOCK][3], top[BLOCK], M[6][BLOCK], right[3][BLOCK];
} Pixels;

/* Further inputs of one light's samples of a block: interreflected light, occlusion, gloss and its derivative. */
typedef struct {
    double thrown[3][BLOCK], hidden[BLOCK], shown[BLOCK], change[3][BLOCK];
} Besides;

/* Adds a light's samples of some pixels: those `usable`, by directions d (some, 3). */
static void added(Pixels *to, int64_t some, const double *d, const double *E, const double *signal, const double *sigma, const bool *usable,
                  const Besides *with, const double *c) {
    double model2 = square(c[MODEL]), shared2 = square(c[SHARED]), dark_2 = square(c[DARK]), thrown_2 = square(c[THROWN_DOUBT]);
    double gloss2 = square(c[GLOSS_DOUBT]), price = c[PRICE], against_hidden = -c[HIDDEN];
    double cold = 1.0 / (2.0 * c[WARMTH]), narrow = 1.0 / c[WIDTH2];
    for (int64_t p = 0; p < some; p++) {
        double J[3] = {with->thrown[0][p], with->thrown[1][p], with->thrown[2][p]}, at[3] = {to->b[0][p], to->b[1][p], to->b[2][p]};
        double B[3] = {d[3 * p] * E[p], d[3 * p + 1] * E[p], d[3 * p + 2] * E[p]}, direct = dot3(B, at), bright = greater(direct, 0.0);
        double thrown = greater(dot3(J, at), 0.0), shown = with->shown[p], seen = signal[p];
        double dark = seen - thrown, left = dark - shown - bright;
        double noise2 = square(sigma[p]) + thrown_2 * square(thrown), top2 = square(to->top[p]), dark2 = noise2 + dark_2 * top2;
        double spread2 = noise2 + model2 * square(seen) + shared2 * top2 + gloss2 * square(shown);
        double as_shadow = square(dark) / dark2, as_direct = square(left) / spread2;
        double cost = with->hidden[p] > 0.0 ? against_hidden : bright > 0.0 ? price : 0.0, against = (as_shadow - as_direct + cost) * cold;
        against = against > -30.0 ? against : -30.0;
        double chance = 1.0 / (1.0 + exponential(-(against < 30.0 ? against : 30.0)));
        double lit = chance / (square(1.0 + as_direct * narrow) * spread2);
        double shade = (1.0 - chance) / (square(1.0 + as_shadow * narrow) * dark2);
        lit = usable[p] ? lit : 0.0;
        shade = usable[p] ? shade : 0.0;
        for (int i = 0; i < 3; i++) B[i] = (direct > 0.0 ? B[i] : 0.0) + J[i] + with->change[i][p];
        double by = lit * (seen - shown), by_shade = shade * seen;
        for (int i = 0; i < 3; i++) to->right[i][p] += by * B[i] + by_shade * J[i];
        for (int i = 0, slot = 0; i < 3; i++)
            for (int j = i; j < 3; j++, slot++) to->M[slot][p] += lit * B[i] * B[j] + shade * J[i] * J[j];
    }
}

/* own (P, 3, 3) and right (P, 3) of the normal equations, of pixels from the first to the last. `hidden` (L, P) and J are read where they are there; c holds the constants. */
KERNEL void lpcal_gathered(int64_t L, int64_t P, int64_t alike, const double *d, const double *E, int64_t has_J, const double *J,
                           const double *signal, const double *sigma, const bool *usable, int64_t has_hidden, const bool *hidden,
                           const double *b, const double *v, const double *c, int64_t first, int64_t last, double *own,
                           double *right) {
    bool glossy = c[STRENGTH] > 0.0;
    double a2 = c[ROUGHNESS] * c[ROUGHNESS];
    Besides with;
    Pixels of;
    Light light;
    memset(&with, 0, sizeof with);
    for (; first < last; first += BLOCK) {
        int64_t some = last - first < BLOCK ? last - first : BLOCK;
        memset(of.M, 0, sizeof of.M);
        memset(of.right, 0, sizeof of.right);
        for (int64_t p = 0; p < some; p++) {
            const double *at = b + 3 * (first + p);
            double length = greater(sqrt(dot3(at, at)), 1e-300);
            for (int i = 0; i < 3; i++) {
                of.b[i][p] = at[i];
                of.n[p][i] = at[i] / length;
            }
            of.albedo[p] = greater(length, 1e-12);
            of.top[p] = signal[first + p];
        }
        for (int64_t k = 1; k < L; k++)
            for (int64_t p = 0; p < some; p++) of.top[p] = greater(of.top[p], signal[k * P + first + p]);
        for (int64_t k = 0; k < L; k++) {
            int64_t at = k * P + first;
            lit(&light, d, E, alike, P, k, first, some);
            for (int64_t p = 0; has_J && p < some; p++)
                for (int i = 0; i < 3; i++) with.thrown[i][p] = J[3 * (at + p) + i];
            for (int64_t p = 0; has_hidden && p < some; p++) with.hidden[p] = hidden[at + p] ? 1.0 : 0.0;
            for (int64_t p = 0; glossy && p < some; p++) {
                double change[3], strength = c[STRENGTH] * light.E[p];
                with.shown[p] = strength * lobe(light.d + 3 * p, of.n[p], v + 3 * (first + p), a2);
                turned(light.d + 3 * p, of.n[p], v + 3 * (first + p), a2, change);
                for (int i = 0; i < 3; i++) with.change[i][p] = strength / of.albedo[p] * change[i];
            }
            added(&of, some, light.d, light.E, signal + at, sigma + at, usable + at, &with, c);
        }
        for (int64_t p = 0; p < some; p++) {
            double *to = own + 9 * (first + p);
            for (int i = 0, slot = 0; i < 3; i++) {
                right[3 * (first + p) + i] = of.right[i][p];
                for (int j = i; j < 3; j++, slot++) to[3 * i + j] = to[3 * j + i] = of.M[slot][p];
            }
        }
    }
}
