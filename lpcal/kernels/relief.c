/* A depth map as a body that stands in the way, and the light that patches throw on each other past it.
   Twins: surface/relief.py (behind, hidden) and surface/bounce.py (_received). */

#include "kernel.h"

#define PI 3.141592653589793
#define WHOLE 6755399441055744.0 /* 1.5 * 2^52: adding and taking it off rounds to the nearest whole number, halves to even */

/* How far y lies behind the front (height, width), by its depth; -1 where there is none. */
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

/* Whether a point lies in the body: more than `tolerance` of its depth behind the front, and less than `thickness`. */
static bool holds(const double y[3], int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                  double thickness) {
    double deep = behind(y, height, width, front, pixel_of_ray);
    return deep > tolerance && deep < thickness;
}

#define TOGETHER 8
#define WHOLE_SINGLE 12582912.0f /* the same for singles */

/* The body in single precision: how many places are tried of a way, and where a ray meets the image. */
typedef struct {
    int64_t steps, width;
    const double *front;
    float column[6], row[6], wide, high, each;
    double least, most; /* depths of what lies in it, as shares of the front's */
} Body;

static Body body_of(int64_t steps, int64_t height, int64_t width, const double *front, const double *pixel_of_ray, double tolerance,
                    double thickness) {
    Body body = {.steps = steps, .width = width, .front = front, .wide = (float)width, .high = (float)height, .each = 1.0f / (float)steps};
    body.least = 1.0 + tolerance;
    body.most = 1.0 + thickness;
    for (int i = 0; i < 6; i++) {
        body.column[i] = (float)pixel_of_ray[2 * i];
        body.row[i] = (float)pixel_of_ray[2 * i + 1];
    }
    return body;
}

/* Whether the surface stands between two points, TOGETHER places at a time: `holds` of each, but that its pixel is found in single precision,
   to some 1e-4 of a pixel. */
static inline bool stands_between(const Body *body, const double from[3], const double to[3]) {
    const float *x = body->column, *y = body->row;
    float begin[3], way[3];
    for (int i = 0; i < 3; i++) {
        begin[i] = (float)from[i];
        way[i] = (float)(to[i] - from[i]);
    }
    for (int64_t first = 0; first < body->steps; first += TOGETHER) {
        float depth[TOGETHER], across[TOGETHER], down[TOGETHER], at = (float)first + 0.5f;
        int32_t inside[TOGETHER], any = 0;
        bool found = false;
        for (int j = 0; j < TOGETHER; j++) {
            float share = (at + (float)j) * body->each, z = begin[2] + share * way[2], by = 1.0f / z;
            float a = (begin[0] + share * way[0]) * by, b = (begin[1] + share * way[1]) * by;
            float column = x[0] + a * (x[1] + a * x[3] + b * x[4]) + b * (x[2] + b * x[5]) + WHOLE_SINGLE - WHOLE_SINGLE;
            float row = y[0] + a * (y[1] + a * y[3] + b * y[4]) + b * (y[2] + b * y[5]) + WHOLE_SINGLE - WHOLE_SINGLE;
            inside[j] = (column >= 0.0f) & (row >= 0.0f) & (column < body->wide) & (row < body->high) & (share < 1.0f);
            across[j] = column;
            down[j] = row;
            depth[j] = z;
            any |= inside[j];
        }
        for (int j = 0; any && j < TOGETHER; j++) {
            if (!inside[j]) continue;
            double there = body->front[(int64_t)down[j] * body->width + (int64_t)across[j]], z = (double)depth[j];
            found |= z > body->least * there && z < body->most * there;
        }
        if (found) return true;
    }
    return false;
}

KERNEL void lpcal_behind(int64_t count, const double *y, int64_t height, int64_t width, const double *front, const double *pixel_of_ray,
                         double *found) {
    for (int64_t p = 0; p < count; p++) found[p] = behind(y + 3 * p, height, width, front, pixel_of_ray);
}

KERNEL void lpcal_hidden(int64_t count, const double *from, const double *to, int64_t steps, int64_t height, int64_t width,
                         const double *front, const double *pixel_of_ray, double tolerance, double thickness, bool *found) {
    Body body = body_of(steps, height, width, front, pixel_of_ray, tolerance, thickness);
    for (int64_t p = 0; p < count; p++) found[p] = stands_between(&body, from + 3 * p, to + 3 * p);
}

#define SOME 64

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

/* J (lights, count, 3) at patches of place x and normal n, from the first on up to the last, of the light of others with place and normal
   (3, others), area and signal (others, lights). */
KERNEL void lpcal_received(int64_t lights, int64_t count, int64_t others, const double *x, const double *n, const double *other_x,
                           const double *other_n, const double *area, const double *signal, double *J, int64_t height, int64_t width,
                           const double *front, const double *pixel_of_ray, int64_t steps, double tolerance, double thickness, double grazing,
                           double off, int64_t first, int64_t last) {
    Facing of = {{other_x, other_x + others, other_x + 2 * others}, {other_n, other_n + others, other_n + 2 * others}};
    Body body = body_of(steps, height, width, front, pixel_of_ray, tolerance, thickness);
    for (int64_t p = first; p < last; p++)
        for (int64_t begin = 0; begin < others; begin += SOME) {
            const double *here = x + 3 * p;
            int64_t seen[SOME], some = facing(&of, begin, others - begin < SOME ? others - begin : SOME, here, n + 3 * p, grazing, seen);
            for (int64_t j = 0; j < some; j++) {
                int64_t q = seen[j];
                double there[3] = {of.x[0][q], of.x[1][q], of.x[2][q]}, way[3], from[3], to[3];
                for (int i = 0; i < 3; i++) way[i] = there[i] - here[i];
                double square = fmax(dot3(way, way), 1e-18), far = sqrt(square), share = fmin(off * here[2] / far, 0.5);
                for (int i = 0; i < 3; i++) {
                    from[i] = here[i] + share * way[i];
                    to[i] = there[i] - share * way[i];
                }
                if (stands_between(&body, from, to)) continue;
                double leaving = -(way[0] * of.n[0][q] + way[1] * of.n[1][q] + way[2] * of.n[2][q]);
                double factor = leaving * area[q] / ((PI * square + area[q]) * square); /* the way's length is in it twice */
                for (int i = 0; i < 3; i++) way[i] *= factor;
                for (int64_t k = 0; k < lights; k++)
                    for (int i = 0; i < 3; i++) J[3 * (k * count + p) + i] += signal[q * lights + k] * way[i];
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
