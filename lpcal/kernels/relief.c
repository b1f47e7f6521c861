/* Occlusion by a depth map taken as a solid, and interreflection between patches with that occlusion.
   Twins: surface/relief.py (behind, hidden) and surface/interreflection.py (_received). */

#include "kernel.h"

#define PI 3.141592653589793
#define WHOLE 6755399441055744.0 /* 1.5 * 2^52: adding and taking it off rounds to the nearest whole number, halves to even */

/* Depth of y behind the front (height, width), relative to the front's depth; -1 where there is none. */
static double behind(const double y[3], int64_t height, int64_t width, const double *front, const double *pixel_of_ray) {
    double a = y[0] / y[2], b = y[1] / y[2];
    double power[6] = {1.0, a, b, a * a, a * b, b * b};
    double column = 0.0, row = 0.0;
    for (int k = 0; k < 6; k++) {
        column += power[k] * pixel_of_ray[2 * k];
        row += power[k] * pixel_of_ray[2 * k + 1];
    }
    column = column + WHOLE - WHOLE;
    row = row + WHOLE - WHOLE;
    if (!(column >= 0 && row >= 0 && column < (double)width && row < (double)height)) return -1.0;
    return y[2] / front[(int64_t)row * width + (int64_t)column] - 1.0;
}

/* Whether a point lies in the solid: more than `tolerance` of its depth behind the front, and less than `thickness`. */
static bool holds(const double y[3], int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                  double thickness) {
    double deep = behind(y, height, width, front, pixel_of_ray);
    return deep > tolerance && deep < thickness;
}

#define SOME 64                  /* ways that are tried together */
#define WHOLE_SINGLE 12582912.0f /* WHOLE for singles */

/* The body in single precision: how many places are tried of a way, and where a ray meets the image. */
typedef struct {
    int64_t steps, width;
    const double *front;
    float column[6], row[6], wide, high;
    double least, most; /* depths of what lies in it, as shares of the front's */
} Body;

static Body body_of(int64_t steps, int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                    double thickness) {
    Body body = {.steps = steps, .width = width, .front = front, .wide = (float)width, .high = (float)height};
    body.least = 1.0 + tolerance;
    body.most = 1.0 + thickness;
    for (int i = 0; i < 6; i++) {
        body.column[i] = (float)pixel_of_ray[2 * i];
        body.row[i] = (float)pixel_of_ray[2 * i + 1];
    }
    return body;
}

/* Where ways begin and how far they lead, each coordinate of all by itself. */
typedef struct {
    float x[SOME], y[SOME], z[SOME], along_x[SOME], along_y[SOME], along_z[SOME];
} Ways;

/* Whether the surface stands on some ways (at most SOME): `holds` of each of their places, but that its pixel is found in single precision, to
   some 1e-4 of a pixel. */
static void stands_between(const Body *body, int64_t some, const Ways *way, int32_t *stands) {
    const float *x = body->column, *y = body->row, each = 1.0f / (float)body->steps;
    float depth[SOME];
    int32_t pixel[SOME];
    for (int64_t j = 0; j < some; j++) stands[j] = 0;
    for (int64_t step = 0; step < body->steps; step++) {
        float share = ((float)step + 0.5f) * each;
        int32_t width = (int32_t)body->width, any = 0;
        for (int64_t j = 0; j < some; j++) {
            float z = way->z[j] + share * way->along_z[j], by = 1.0f / z;
            float a = (way->x[j] + share * way->along_x[j]) * by, b = (way->y[j] + share * way->along_y[j]) * by;
            float column = x[0] + a * (x[1] + a * x[3] + b * x[4]) + b * (x[2] + b * x[5]) + WHOLE_SINGLE - WHOLE_SINGLE;
            float row = y[0] + a * (y[1] + a * y[3] + b * y[4]) + b * (y[2] + b * y[5]) + WHOLE_SINGLE - WHOLE_SINGLE;
            int32_t inside = (column >= 0.0f) & (row >= 0.0f) & (column < body->wide) & (row < body->high);
            pixel[j] = inside ? (int32_t)row * width + (int32_t)column : 0;
            depth[j] = inside ? z : 0.0f; /* in front of everything */
            any |= inside;
        }
        for (int64_t j = 0; any && j < some; j++) {
            double there = body->front[pixel[j]], z = (double)depth[j];
            stands[j] |= (z > body->least * there) & (z < body->most * there);
        }
    }
}

KERNEL void lpcal_behind(int64_t count, const double *y, int64_t height, int64_t width, const double *front, const double *pixel_of_ray,
                         double *found) {
    for (int64_t p = 0; p < count; p++) found[p] = behind(y + 3 * p, height, width, front, pixel_of_ray);
}

KERNEL void lpcal_hidden(int64_t count, const double *from, const double *to, int64_t steps, int64_t height, int64_t width,
                         const double *front, const double *pixel_of_ray, double tolerance, double thickness, bool *found) {
    Body body = body_of(steps, height, width, front, pixel_of_ray, tolerance, thickness);
    for (int64_t first = 0; first < count; first += SOME) {
        int64_t some = count - first < SOME ? count - first : SOME;
        int32_t stands[SOME];
        Ways way;
        for (int64_t j = 0; j < some; j++) {
            const double *begin = from + 3 * (first + j), *end = to + 3 * (first + j);
            way.x[j] = (float)begin[0];
            way.y[j] = (float)begin[1];
            way.z[j] = (float)begin[2];
            way.along_x[j] = (float)(end[0] - begin[0]);
            way.along_y[j] = (float)(end[1] - begin[1]);
            way.along_z[j] = (float)(end[2] - begin[2]);
        }
        stands_between(&body, some, &way, stands);
        for (int64_t j = 0; j < some; j++) found[first + j] = stands[j] != 0;
    }
}

/* Places and normals of patches, each coordinate of all patches by itself. */
typedef struct {
    const double *x[3], *n[3];
} Facing;

/* Which of some patches (at most SOME, from the first on) face a place of normal n, and it them, by more than a cosine: their numbers. */
static int64_t facing(const Facing *of, int64_t first, int64_t some, const double here[3], const double n[3], double grazing, int64_t *found) {
    bool face[SOME];
    double least = grazing * grazing;
    int64_t count = 0;
    for (int64_t j = 0; j < some; j++) {
        int64_t q = first + j;
        double x = of->x[0][q] - here[0], y = of->x[1][q] - here[1], z = of->x[2][q] - here[2];
        double far = x * x + y * y + z * z, square = (far > 1e-18 ? far : 1e-18) * least;
        double arriving = x * n[0] + y * n[1] + z * n[2], leaving = -(x * of->n[0][q] + y * of->n[1][q] + z * of->n[2][q]);
        face[j] = (arriving > 0.0) & (leaving > 0.0) & (arriving * arriving > square) & (leaving * leaving > square);
    }
    for (int64_t j = 0; j < some; j++) {
        found[count] = first + j;
        count += face[j];
    }
    return count;
}

/* What patches give a place that they face, if nothing stands between: their numbers, the ways to them, and by how much these weigh. */
typedef struct {
    Ways way;
    int64_t number[SOME];
    double weight[3][SOME]; /* unit vectors to them times form factors */
} Giving;

/* The ways to `some` patches, of the numbers that it holds, from a place, less a share at both ends; patches' normals and areas. */
static void giving(Giving *to, int64_t some, const Facing *of, const double *area, const double here[3], double skipped) {
    double x[SOME], y[SOME], z[SOME], n[3][SOME], size[SOME];
    for (int64_t j = 0; j < some; j++) {
        int64_t q = to->number[j];
        x[j] = of->x[0][q];
        y[j] = of->x[1][q];
        z[j] = of->x[2][q];
        for (int i = 0; i < 3; i++) n[i][j] = of->n[i][q];
        size[j] = area[q];
    }
    for (int64_t j = 0; j < some; j++) {
        double along[3] = {x[j] - here[0], y[j] - here[1], z[j] - here[2]};
        double far2 = dot3(along, along), square = far2 > 1e-18 ? far2 : 1e-18, share = skipped / sqrt(square);
        share = share < 0.5 ? share : 0.5;
        double begin[3] = {here[0] + share * along[0], here[1] + share * along[1], here[2] + share * along[2]};
        to->way.x[j] = (float)begin[0];
        to->way.y[j] = (float)begin[1];
        to->way.z[j] = (float)begin[2];
        to->way.along_x[j] = (float)(x[j] - share * along[0] - begin[0]);
        to->way.along_y[j] = (float)(y[j] - share * along[1] - begin[1]);
        to->way.along_z[j] = (float)(z[j] - share * along[2] - begin[2]);
        double leaving = -(along[0] * n[0][j] + along[1] * n[1][j] + along[2] * n[2][j]);
        double factor = leaving * size[j] / ((PI * square + size[j]) * square); /* the way's length is in it twice */
        for (int i = 0; i < 3; i++) to->weight[i][j] = along[i] * factor;
    }
}

/* J (lights, count, 3) at patches of place x and normal n, from the first on up to the last, of the light of others with place and normal
   (3, others), area and signal (others, lights; zeros up to a multiple of LANES). */
KERNEL void lpcal_received(int64_t lights, int64_t count, int64_t others, const double *x, const double *n, const double *other_x,
                           const double *other_n, const double *area, const double *signal, double *J, int64_t height, int64_t width,
                           const double *front, const double *pixel_of_ray, int64_t steps, double tolerance, double thickness, double grazing,
                           double off, int64_t first, int64_t last) {
    Facing of = {{other_x, other_x + others, other_x + 2 * others}, {other_n, other_n + others, other_n + 2 * others}};
    Body body = body_of(steps, height, width, front, pixel_of_ray, tolerance, thickness);
    int64_t lanes = (lights + LANES - 1) / LANES * LANES;
    for (int64_t p = first; p < last; p++)
        for (int64_t begin = 0; begin < others; begin += SOME) {
            const double *here = x + 3 * p;
            int32_t stands[SOME], free[SOME], count_free = 0;
            Giving by;
            int64_t some = facing(&of, begin, others - begin < SOME ? others - begin : SOME, here, n + 3 * p, grazing, by.number);
            if (some == 0) continue;
            giving(&by, some, &of, area, here, off * here[2]);
            stands_between(&body, some, &by.way, stands);
            for (int32_t j = 0; j < (int32_t)some; j++) {
                free[count_free] = j;
                count_free += !stands[j];
            }
            for (int64_t k = 0; k < lights; k += LANES) {
                double sum[3][LANES] = {{0.0}};
                for (int32_t f = 0; f < count_free; f++) {
                    int32_t j = free[f];
                    const double *shown = signal + by.number[j] * lanes + k;
                    for (int i = 0; i < 3; i++)
                        for (int lane = 0; lane < LANES; lane++) sum[i][lane] += shown[lane] * by.weight[i][j];
                }
                for (int64_t lane = 0; lane < LANES && k + lane < lights; lane++)
                    for (int i = 0; i < 3; i++) J[3 * ((k + lane) * count + p) + i] += sum[i][lane];
            }
        }
}

/* Whether a way from each place x meets the body within the reaches, shares of its depth, and how far it goes until then, by halvings between
   the first reach in the body and the last before it. Twin: surface/relief.py (_entries). */
KERNEL void lpcal_entries(int64_t count, const double *x, const double *way, int64_t reaches, const double *reach, int64_t halvings,
                          int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                          double thickness, bool *met, double *far) {
    for (int64_t p = 0; p < count; p++) {
        const double *from = x + 3 * p, *along = way + 3 * p;
        double low = 0.0, high = 0.0, y[3];
        met[p] = false;
        for (int64_t k = 0; k < reaches && !met[p]; k++) {
            double r = reach[k] * from[2];
            for (int i = 0; i < 3; i++) y[i] = from[i] + r * along[i];
            if (holds(y, height, width, front, pixel_of_ray, tolerance, thickness)) {
                high = r;
                met[p] = true;
            } else
                low = r;
        }
        for (int64_t k = 0; k < halvings && met[p]; k++) {
            double middle = (low + high) / 2;
            for (int i = 0; i < 3; i++) y[i] = from[i] + middle * along[i];
            if (holds(y, height, width, front, pixel_of_ray, tolerance, thickness)) high = middle;
            else low = middle;
        }
        far[p] = high;
    }
}
