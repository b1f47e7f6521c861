/* Corners of a chessboard in an image of singles. Twins: detect/saddle.py (_greatest, _moved, likeness, _levenberg_marquardt). */

#include "kernel.h"

#define BLOCK 256

/* The greatest of five numbers beside each other, `way` apart, of which x is the middle one. */
static inline float greatest(const float *x, int64_t way) {
    float first = x[-2 * way] > x[-way] ? x[-2 * way] : x[-way], second = x[way] > x[2 * way] ? x[way] : x[2 * way];
    first = first > second ? first : second;
    return first > *x ? first : *x;
}

/* Sixteen times -det of the Hessian (rows, columns), 0 on the rim, by Sobel's derivatives; and the pixels `at`, `found` of them, that are
   `rim` or more within, where it is over `least` and no less than in the 5 x 5 pixels about. */
KERNEL void lpcal_curved(int64_t rows, int64_t columns, const float *light, double least, int64_t rim, float *strength, int64_t *at,
                         int64_t *found) {
    float floor = (float)least;
    memset(strength, 0, (size_t)(rows * columns) * sizeof *strength);
    *found = 0;
    for (int64_t row = 1; row < rows - 1; row++) {
        const float *b = light + row * columns, *a = b - columns, *c = b + columns;
        float *to = strength + row * columns;
        for (int64_t x = 1; x < columns - 1; x++) {
            float left = a[x - 1] + 2.0f * b[x - 1] + c[x - 1], middle = a[x] + 2.0f * b[x] + c[x];
            float right = a[x + 1] + 2.0f * b[x + 1] + c[x + 1];
            float above = a[x - 1] + 2.0f * a[x] + a[x + 1], below = c[x - 1] + 2.0f * c[x] + c[x + 1];
            float level = b[x - 1] + 2.0f * b[x] + b[x + 1], xy = c[x + 1] - c[x - 1] - a[x + 1] + a[x - 1];
            to[x] = xy * xy - (left - 2.0f * middle + right) * (above - 2.0f * level + below);
        }
    }
    rim = rim > 2 ? rim : 2;
    for (int64_t row = rim; row < rows - rim; row++)
        for (int64_t first = rim; first < columns - rim; first += BLOCK) {
            int64_t some = columns - rim - first < BLOCK ? columns - rim - first : BLOCK;
            const float *here = strength + row * columns + first;
            float most[BLOCK + 4];
            bool is[BLOCK];
            for (int64_t x = 0; x < some + 4; x++) most[x] = greatest(here + x - 2, columns);
            for (int64_t x = 0; x < some; x++) is[x] = (here[x] > floor) & (here[x] >= greatest(most + x + 2, 1));
            for (int64_t x = 0; x < some; x++) {
                at[*found] = row * columns + first + x;
                *found += is[x];
            }
        }
}

/* Where (count, 2) the gradient is 0 about the pixels `at`, no further than `most` along an axis, and the Hessian xx xy yy (count, 3). */
KERNEL void lpcal_moved(int64_t count, int64_t columns, const float *light, const int64_t *at, double most, double *places, double *hessian) {
    for (int64_t p = 0; p < count; p++) {
        double of[3][3], *H = hessian + 3 * p;
        for (int y = 0; y < 3; y++)
            for (int x = 0; x < 3; x++) of[y][x] = (double)light[at[p] + (y - 1) * columns + x - 1] / 4;
        double left = of[0][0] + 2 * of[1][0] + of[2][0], middle = of[0][1] + 2 * of[1][1] + of[2][1];
        double right = of[0][2] + 2 * of[1][2] + of[2][2], above = of[0][0] + 2 * of[0][1] + of[0][2];
        double level = of[1][0] + 2 * of[1][1] + of[1][2], below = of[2][0] + 2 * of[2][1] + of[2][2];
        H[0] = left - 2 * middle + right;
        H[1] = of[2][2] - of[2][0] - of[0][2] + of[0][0];
        H[2] = above - 2 * level + below;
        double beside = 2 * (of[1][2] - of[1][0]), down = 2 * (of[2][1] - of[0][1]), scale = H[0] * H[2] - H[1] * H[1];
        double step[2] = {(H[1] * down - H[2] * beside) / scale, (H[1] * beside - H[0] * down) / scale};
        for (int i = 0; i < 2; i++) step[i] = step[i] > most ? most : step[i] < -most ? -most : step[i];
        places[2 * p] = (double)(at[p] % columns) + step[0];
        places[2 * p + 1] = (double)(at[p] / columns) + step[1];
    }
}

#define RING 24 /* samples on a ring, as in detect/saddle.py */

/* Between the pixels of a picture; the place is within it. */
static inline double sample(const float *light, int64_t rows, int64_t columns, double x, double y) {
    int64_t column = (int64_t)x, row = (int64_t)y;
    column = column < columns - 2 ? column : columns - 2;
    row = row < rows - 2 ? row : rows - 2;
    const float *at = light + row * columns + column;
    double u = x - (double)column, v = y - (double)row;
    double above = (1 - u) * (double)at[0] + u * (double)at[1], below = (1 - u) * (double)at[columns] + u * (double)at[columns + 1];
    return (1 - v) * above + v * below;
}

/* How much the light about places (count, 2) is a corner's on rings of radii (count), and its range; -1 and 0 outside the picture.
   `compass` (RING, 2) are the ring's directions. */
KERNEL void lpcal_ring(int64_t count, int64_t rows, int64_t columns, const float *light, const double *compass, const double *places,
                       const double *radius, int64_t quarters, double *like, double *span) {
    for (int64_t p = 0; p < count; p++) {
        double x = places[2 * p], y = places[2 * p + 1], r = radius[p], value[RING], mean = 0.0, low = INFINITY, high = -INFINITY;
        like[p] = -1.0;
        span[p] = 0.0;
        if (!(x - r >= 0 && x + r <= (double)(columns - 1) && y - r >= 0 && y + r <= (double)(rows - 1))) continue;
        for (int k = 0; k < RING; k++) {
            value[k] = sample(light, rows, columns, x + r * compass[2 * k], y + r * compass[2 * k + 1]);
            mean += value[k] / RING;
        }
        double same = 0.0, all = 0.0;
        int64_t sides = 0;
        for (int k = 0; k < RING; k++) {
            double about = value[k] - mean;
            low = value[k] < low ? value[k] : low;
            high = value[k] > high ? value[k] : high;
            same += about * (value[(k + RING / 2) % RING] - mean);
            all += about * about;
            sides += (about > 0) != (value[(k + 1) % RING] - mean > 0);
        }
        if (sides == quarters) like[p] = same / (all > 1e-9 ? all : 1e-9);
        span[p] = high - low;
    }
}

#define NUMBERS 10
#define ROOM 384 /* pixels of a window, at most */
#define LANES 8

/* A corner's window: places about its middle pixel, light, and whether it is in the picture; filled up with pixels of no weight. */
typedef struct {
    float x[ROOM], y[ROOM], light[ROOM], weight[ROOM];
    int64_t pixels;
} Window;

/* J'J, J'r and r'r. */
typedef struct {
    double N[NUMBERS][NUMBERS], right[NUMBERS], cost;
} Normal;

static double summed(const float *a, const float *b, int64_t pixels) {
    float sum[LANES] = {0.0f};
    for (int64_t p = 0; p < pixels; p += LANES)
        LANEWISE for (int k = 0; k < LANES; k++) sum[k] += a[p + k] * b[p + k];
    return (double)((sum[0] + sum[4]) + (sum[1] + sum[5])) + (double)((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

/* The profile of an edge at the scaled distance x, whose bell exp(-x^2) is known: erf by Abramowitz & Stegun 7.1.26. */
static inline float profile_of(float x, float bell) {
    float t = 1.0f / (1.0f + 0.3275911f * fabsf(x)), tail = 1.061405429f;
    tail = tail * t - 1.453152027f;
    tail = tail * t + 1.421413741f;
    tail = tail * t - 0.284496736f;
    tail = tail * t + 0.254829592f;
    float size = 1.0f - tail * t * bell;
    return x < 0 ? -size : size;
}

/* The edges' product over a window, the mean light and the contrast that fit best to it. */
static void first_light(const Window *of, double n[NUMBERS]) {
    float cosine[2], sine[2], inverse = expf((float)-n[4]), pattern[ROOM], weighted[ROOM], x0 = (float)n[0], y0 = (float)n[1];
    for (int e = 0; e < 2; e++) {
        cosine[e] = cosf((float)n[2 + e]);
        sine[e] = sinf((float)n[2 + e]);
    }
    for (int64_t p = 0; p < of->pixels; p++) {
        float x = of->x[p] - x0, y = of->y[p] - y0, product = 1.0f;
        for (int e = 0; e < 2; e++) {
            float scaled = (cosine[e] * y - sine[e] * x) * (inverse * 0.70710678f);
            product *= profile_of(scaled, exponential_single(-scaled * scaled));
        }
        pattern[p] = product;
    }
    double pixels = 0.0, light = 0.0, mean = 0.0;
    for (int64_t p = 0; p < of->pixels; p++) {
        pixels += (double)of->weight[p];
        light += (double)(of->weight[p] * of->light[p]);
        mean += (double)(of->weight[p] * pattern[p]);
    }
    light /= pixels;
    mean /= pixels;
    for (int64_t p = 0; p < of->pixels; p++) {
        pattern[p] -= (float)mean;
        weighted[p] = of->weight[p] * pattern[p];
    }
    double spread = summed(weighted, pattern, of->pixels);
    n[6] = summed(weighted, of->light, of->pixels) / (spread > 1e-9 ? spread : 1e-9);
    n[5] = light - n[6] * mean;
}

/* The normal equations of the model at some numbers: place, angles, log blur, mean, contrast, slope of the light, spread. */
static void linearised(const Window *of, const double n[NUMBERS], Normal *found) {
    float J[NUMBERS][ROOM], left[ROOM], cosine[2], sine[2], inverse = expf((float)-n[4]), s[NUMBERS];
    for (int i = 0; i < NUMBERS; i++) s[i] = (float)n[i];
    for (int e = 0; e < 2; e++) {
        cosine[e] = cosf(s[2 + e]);
        sine[e] = sinf(s[2 + e]);
    }
    for (int64_t p = 0; p < of->pixels; p++) {
        float x = of->x[p] - s[0], y = of->y[p] - s[1], across[2], along[2], profile[2], slope[2], weight = of->weight[p];
        for (int e = 0; e < 2; e++) {
            across[e] = cosine[e] * y - sine[e] * x;
            along[e] = cosine[e] * x + sine[e] * y;
            float scaled = across[e] * (inverse * 0.70710678f), bell = exponential_single(-scaled * scaled);
            profile[e] = profile_of(scaled, bell);
            slope[e] = bell * (inverse * 0.79788456f);
        }
        float shade = (1.0f + s[7] * of->x[p] + s[8] * of->y[p]) * weight, pattern = profile[0] * profile[1];
        float spread = 1.0f - pattern * pattern, board = s[5] + s[6] * pattern + s[9] * spread;
        float contrast = (s[6] - 2.0f * s[9] * pattern) * shade;
        float first = contrast * slope[0] * profile[1], second = contrast * slope[1] * profile[0];
        J[0][p] = first * sine[0] + second * sine[1];
        J[1][p] = -first * cosine[0] - second * cosine[1];
        J[2][p] = -first * along[0];
        J[3][p] = -second * along[1];
        J[4][p] = -first * across[0] - second * across[1];
        J[5][p] = shade;
        J[6][p] = shade * pattern;
        J[7][p] = board * weight * of->x[p];
        J[8][p] = board * weight * of->y[p];
        J[9][p] = shade * spread;
        left[p] = weight * of->light[p] - board * shade;
    }
    for (int i = 0; i < NUMBERS; i++) {
        for (int j = 0; j <= i; j++) found->N[i][j] = found->N[j][i] = summed(J[i], J[j], of->pixels);
        found->right[i] = summed(J[i], left, of->pixels);
    }
    found->cost = summed(left, left, of->pixels);
}

/* x of N x = x by elimination, the largest of a column first. N is lost. */
static void eliminated(double N[NUMBERS][NUMBERS], double x[NUMBERS]) {
    for (int k = 0; k < NUMBERS; k++) {
        int largest = k;
        for (int i = k + 1; i < NUMBERS; i++)
            if (fabs(N[i][k]) > fabs(N[largest][k])) largest = i;
        for (int j = 0; j < NUMBERS; j++) {
            double kept = N[k][j];
            N[k][j] = N[largest][j];
            N[largest][j] = kept;
        }
        double kept = x[k];
        x[k] = x[largest];
        x[largest] = kept;
        for (int i = k + 1; i < NUMBERS; i++) {
            double share = N[i][k] / N[k][k];
            for (int j = k + 1; j < NUMBERS; j++) N[i][j] -= share * N[k][j];
            x[i] -= share * x[k];
        }
    }
    for (int k = NUMBERS - 1; k >= 0; k--) {
        for (int j = k + 1; j < NUMBERS; j++) x[k] -= N[k][j] * x[j];
        x[k] /= N[k][k];
    }
}

/* The half trace of the place's covariance by the scatter of the fit. */
static double variance_of(const Normal *at, double tiny, double pixels) {
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        double N[NUMBERS][NUMBERS], column[NUMBERS] = {0.0};
        memcpy(N, at->N, sizeof N);
        for (int k = 0; k < NUMBERS; k++) N[k][k] += tiny;
        column[i] = 1.0;
        eliminated(N, column);
        sum += column[i] / 2;
    }
    double free = pixels - NUMBERS;
    return sum * at->cost / (free > 1 ? free : 1);
}

/* Levenberg-Marquardt in each window (count, P): numbers (count, 10), of which place and angles are given, and the place's variance (count).
   `limits`: the steps of the first five numbers that end it (5), largest step, log blur from and to, largest damping, what is added to N. */
KERNEL void lpcal_saddles(int64_t count, int64_t P, int64_t steps, const double *limits, const float *offsets, const float *light,
                          const float *weight, double *numbers, double *variance) {
    Window of = {.pixels = (P + LANES - 1) / LANES * LANES};
    double most = limits[5], tiny = limits[9];
    for (int64_t p = 0; p < P; p++) {
        of.x[p] = offsets[2 * p];
        of.y[p] = offsets[2 * p + 1];
    }
    for (int64_t c = 0; c < count; c++) {
        double *n = numbers + NUMBERS * c, damping = 1e-3, pixels = 0.0;
        memcpy(of.light, light + P * c, (size_t)P * sizeof *light);
        memcpy(of.weight, weight + P * c, (size_t)P * sizeof *weight);
        for (int64_t p = 0; p < P; p++) pixels += (double)of.weight[p];
        first_light(&of, n);
        Normal at, then;
        linearised(&of, n, &at);
        bool moving = true;
        for (int64_t step = 0; step < steps && moving; step++) {
            double N[NUMBERS][NUMBERS], by[NUMBERS], trial[NUMBERS];
            memcpy(N, at.N, sizeof N);
            memcpy(by, at.right, sizeof by);
            for (int k = 0; k < NUMBERS; k++) N[k][k] += damping * N[k][k] + tiny;
            eliminated(N, by);
            moving = false;
            for (int k = 0; k < NUMBERS; k++) {
                by[k] = by[k] < -most ? -most : by[k] > most ? most : by[k];
                trial[k] = n[k] + by[k];
                moving |= k < 5 && fabs(by[k]) > limits[k];
            }
            trial[4] = trial[4] < limits[6] ? limits[6] : trial[4] > limits[7] ? limits[7] : trial[4];
            linearised(&of, trial, &then);
            bool better = then.cost < at.cost;
            if (better) {
                at = then;
                memcpy(n, trial, sizeof trial);
            }
            damping *= better ? 0.2 : 10.0;
            moving &= damping < limits[8];
        }
        variance[c] = variance_of(&at, tiny, pixels);
    }
}
