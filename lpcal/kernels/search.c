/* What the samples of pixels, a palette and the view cost at candidates for b. Twins: shading/search.py (_of_candidates, _of_directions). Light comes from directions d
   (L, P, 3) with irradiances E (L, P), and as J (L, P, 3) from other surfaces. */

#include "kernel.h"

#define BLOCK 32 /* of shading/search.py's work space, too */

enum { MODEL, SHARED, DARK, THROWN_DOUBT, PRICE, HIDDEN, GLOSS_DOUBT, WIDTH2, STRENGTH, ROUGHNESS, MIDDLE, SPAN, TOWARDS };

typedef struct {
    int64_t L, P, bins;
    const double *d, *E, *J, *signal, *sigma, *v, *c, *table;
    const bool *usable, *hidden;
} Given;

/* Normals and albedos of some candidates, and what they have cost so far. */
typedef struct {
    double n[3][BLOCK], a[BLOCK], sum[BLOCK];
} Candidates;

/* Gloss of light k at the normals of some candidates: see shading/gloss.py (lobe). */
static void glosses(const Given *of, int64_t k, int64_t p, int64_t some, const Candidates *at, double shown[BLOCK]) {
    const double *d = of->d + 3 * (k * of->P + p), *v = of->v + 3 * p;
    double a2 = square(of->c[ROUGHNESS]), strength = of->c[STRENGTH] * of->E[k * of->P + p];
    for (int64_t i = 0; i < some; i++) {
        double n[3] = {at->n[0][i], at->n[1][i], at->n[2][i]};
        shown[i] = strength * lobe(d, n, v, a2);
    }
}

/* Adds what the sample of light k costs, as lit or as in shadow, whichever is less. */
static void add_sample(const Given *of, int64_t k, int64_t p, double top2, int64_t some, Candidates *at, const double shown[BLOCK]) {
    int64_t s = k * of->P + p;
    if (!of->usable[s]) return;
    static const double none[3] = {0.0, 0.0, 0.0};
    const double *d = of->d + 3 * s, *J = of->J ? of->J + 3 * s : none, *c = of->c;
    double E = of->E[s], I = of->signal[s], sigma2 = square(of->sigma[s]), narrow = 1.0 / c[WIDTH2];
    double dark_2 = square(c[DARK]) * top2, model2 = square(c[MODEL] * I) + square(c[SHARED]) * top2, gloss2 = square(c[GLOSS_DOUBT]);
    double thrown_2 = square(c[THROWN_DOUBT]);
    bool hidden = of->hidden && of->hidden[s];
    double price = hidden ? 0.0 : c[PRICE], all_the_same = hidden ? c[HIDDEN] : 0.0;
    for (int64_t i = 0; i < some; i++) {
        double x = at->n[0][i], y = at->n[1][i], z = at->n[2][i], a = at->a[i];
        double bright = a * E * greater(d[0] * x + d[1] * y + d[2] * z, 0.0), thrown = a * greater(J[0] * x + J[1] * y + J[2] * z, 0.0);
        double dark = I - thrown, left = dark - shown[i] - bright, noise2 = sigma2 + thrown_2 * (thrown * thrown);
        double by_dark = dark * dark / (noise2 + dark_2), by_left = left * left / (noise2 + model2 + gloss2 * (shown[i] * shown[i]));
        double in_shadow = by_dark / (1.0 + by_dark * narrow) + (bright > 0.0 ? price : 0.0);
        double as_lit = by_left / (1.0 + by_left * narrow) + all_the_same;
        at->sum[i] += in_shadow < as_lit ? in_shadow : as_lit;
    }
}

/* What an albedo of logarithm `level` costs by the palette. */
static inline double palette_cost(const Given *of, double level) {
    double at = (level - of->c[MIDDLE] + of->c[SPAN]) / (2.0 * of->c[SPAN]) * (double)of->bins - 0.5, last = (double)(of->bins - 1);
    at = at < 0.0 ? 0.0 : at > last ? last : at;
    int64_t low = (int64_t)at < of->bins - 2 ? (int64_t)at : of->bins - 2;
    return of->table[low] + (at - (double)low) * (of->table[low + 1] - of->table[low]);
}

/* What the view and the palette cost: a surface shows itself by the cosine of its normal to the viewer. */
static void begin(const Given *of, int64_t p, int64_t some, Candidates *at) {
    const double *v = of->v + 3 * p;
    for (int64_t i = 0; i < some; i++) {
        double towards = v[0] * at->n[0][i] + v[1] * at->n[1][i] + v[2] * at->n[2][i];
        at->sum[i] = -2.0 * logarithm(greater(towards, of->c[TOWARDS])) + palette_cost(of, logarithm(greater(at->a[i], 1e-12)));
    }
}

static double top_of(const Given *of, int64_t p) {
    double top = of->signal[p];
    for (int64_t k = 1; k < of->L; k++) top = greater(top, of->signal[k * of->P + p]);
    return square(top);
}

/* cost (P, N) of candidates b (P, N, 3). `hidden` (L, P) and J are read where they are there; c holds the constants, `table` the palette. */
KERNEL void lpcal_candidates(int64_t L, int64_t P, int64_t N, const double *d, const double *E, int64_t has_J, const double *J,
                             const double *signal, const double *sigma, const bool *usable, int64_t has_hidden, const bool *hidden,
                             const double *v, const double *c, int64_t bins, const double *table, const double *b, double *cost) {
    Given of = {L, P, bins, d, E, has_J ? J : 0, signal, sigma, v, c, table, usable, has_hidden ? hidden : 0};
    Candidates at;
    double shown[BLOCK] = {0.0};
    for (int64_t p = 0; p < P; p++) {
        double top2 = top_of(&of, p);
        for (int64_t first = 0; first < N; first += BLOCK) {
            int64_t some = N - first < BLOCK ? N - first : BLOCK;
            for (int64_t i = 0; i < some; i++) {
                const double *one = b + 3 * (p * N + first + i);
                double length = greater(sqrt(dot3(one, one)), 1e-300);
                for (int axis = 0; axis < 3; axis++) at.n[axis][i] = one[axis] / length;
                at.a[i] = length;
            }
            begin(&of, p, some, &at);
            for (int64_t k = 0; k < L; k++) {
                if (c[STRENGTH] > 0.0) glosses(&of, k, p, some, &at, shown);
                add_sample(&of, k, p, top2, some, &at, shown);
            }
            for (int64_t i = 0; i < some; i++) cost[p * N + first + i] = at.sum[i];
        }
    }
}

/* Least cost (P, D) of normals n (D, 3) over albedos, and those albedos (P, D): over `levels` (A,), and what each of the samples `by` (B, P),
   numbers of lights, says where it is lit, from `least` to `most`. `work` (L, 32) is work space. */
KERNEL void lpcal_directions(int64_t L, int64_t P, int64_t D, const double *d, const double *E, int64_t has_J, const double *J,
                             const double *signal, const double *sigma, const bool *usable, int64_t has_hidden, const bool *hidden,
                             const double *v, const double *c, int64_t bins, const double *table, const double *n, int64_t A,
                             const double *levels, int64_t B, const int64_t *by, double least, double most, double *work, double *cost,
                             double *albedo) {
    Given of = {L, P, bins, d, E, has_J ? J : 0, signal, sigma, v, c, table, usable, has_hidden ? hidden : 0};
    Candidates at;
    memset(work, 0, sizeof(double) * (size_t)(L * BLOCK));
    for (int64_t p = 0; p < P; p++) {
        double top2 = top_of(&of, p);
        for (int64_t first = 0; first < D; first += BLOCK) {
            int64_t some = D - first < BLOCK ? D - first : BLOCK;
            for (int64_t i = 0; i < some; i++)
                for (int axis = 0; axis < 3; axis++) at.n[axis][i] = n[3 * (first + i) + axis];
            for (int64_t k = 0; k < L && c[STRENGTH] > 0.0; k++) glosses(&of, k, p, some, &at, work + k * BLOCK);
            for (int64_t slot = 0; slot < A + B; slot++) {
                for (int64_t i = 0; i < some; i++) {
                    if (slot < A) {
                        at.a[i] = levels[slot];
                        continue;
                    }
                    int64_t k = by[(slot - A) * P + p], s = k * P + p;
                    double x = at.n[0][i], y = at.n[1][i], z = at.n[2][i];
                    double light = E[s] * greater(d[3 * s] * x + d[3 * s + 1] * y + d[3 * s + 2] * z, 0.0);
                    if (has_J) light += greater(J[3 * s] * x + J[3 * s + 1] * y + J[3 * s + 2] * z, 0.0);
                    double one = (signal[s] - work[k * BLOCK + i]) / greater(light, 1e-300);
                    at.a[i] = one > least ? (one < most ? one : most) : least;
                }
                begin(&of, p, some, &at);
                for (int64_t k = 0; k < L; k++) add_sample(&of, k, p, top2, some, &at, work + k * BLOCK);
                for (int64_t i = 0; i < some; i++) {
                    double *lowest = cost + p * D + first + i;
                    if (slot > 0 && at.sum[i] >= *lowest) continue;
                    *lowest = at.sum[i];
                    albedo[p * D + first + i] = at.a[i];
                }
            }
        }
    }
}

/* What neighbours with candidates y (Q, K, 3), believed by `known` (Q, K), say of candidates x (Q, N, 3): (Q, N), nothing of the likeliest.
   Twin: shading/search.py (_messages). `turn2` and `link2` are the squares at which links yield, see shading/field.py. */
KERNEL void lpcal_messages(int64_t Q, int64_t N, int64_t K, const double *x, const double *y, const double *known, double turn2, double link2,
                       double *found) {
    for (int64_t q = 0; q < Q; q++) {
        const double *there = y + 3 * K * q, *by = known + K * q;
        double least = by[0];
        for (int64_t k = 1; k < K; k++) least = by[k] < least ? by[k] : least;
        for (int64_t i = 0; i < N; i++) {
            const double *here = x + 3 * (N * q + i);
            double best = 1e300, length2 = dot3(here, here);
            for (int64_t k = 0; k < K; k++) {
                double apart[3] = {here[0] - there[3 * k], here[1] - there[3 * k + 1], here[2] - there[3 * k + 2]};
                double both = sqrt(length2 * dot3(there + 3 * k, there + 3 * k)) * turn2, far = dot3(apart, apart) / greater(both, 1e-300);
                double one = by[k] + far / (1.0 + far / link2);
                best = one < best ? one : best;
            }
            found[N * q + i] = best - least;
        }
    }
}
