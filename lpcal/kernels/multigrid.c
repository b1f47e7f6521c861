/* Conjugate gradients with a multigrid preconditioner on the pixels of a mask. Twin: integration/multigrid.py.

   The finest matrix is that of neighbouring pixels (multigrid.h); levels are made by aggregates.c. Nothing but weights is stored, and every
   inner loop goes straight through memory. The cycle's numbers are singles: it only says where to look next, the conjugate gradients decide
   in doubles. */

#include <float.h>

#include "multigrid.h"

/* Sums are always made in the same eight lanes. */
static double sum_of(const double lane[8]) { return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7])); }

#define DOT(name, kind)                                                      \
    static double name(int64_t n, const double *a, const kind *b) {          \
        double lane[8] = {0.0};                                              \
        int64_t i = 0;                                                       \
        for (; i + 8 <= n; i += 8)                                           \
            for (int j = 0; j < 8; j++) lane[j] += a[i + j] * b[i + j];      \
        for (; i < n; i++) lane[0] += a[i] * b[i];                           \
        return sum_of(lane);                                                 \
    }
DOT(dot, double)
DOT(dot_single, real)

/* A x of the finest matrix, and x . A x. */
static double times(const Grid *grid, const double *x, double *restrict found) {
    Shape shape = grid->level->shape;
    double lane[8] = {0.0};
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *at = shape.stretch + 4 * s;
        int64_t first = at[0], count = at[1], k = 0;
        const double *here = x + first, *above = x + at[2], *below = x + at[3], *next = grid->across + first, *up = grid->up + first;
        const double *down = grid->down + first, *diagonal = grid->diagonal + first;
        double *to = found + first;
        for (; k < count; k++) {
            double around = (next[k] * here[k + 1] + next[k - 1] * here[k - 1]) + (up[k] * above[k] + down[k] * below[k]);
            to[k] = diagonal[k] * here[k] - around;
        }
        for (k = 0; k + 8 <= count; k += 8)
            for (int j = 0; j < 8; j++) lane[j] += here[k + j] * to[k + j];
        for (; k < count; k++) lane[0] += here[k] * to[k];
    }
    return sum_of(lane);
}

/* y = x + share / diagonal (right - A x); a share of 0: y = right - A x. */
static void swept(const Level *at, const real *x, const real *right, real *restrict y, real share) {
    real keep = 1 - share;
    for (int64_t s = 0; s < at->shape.stretches; s++) {
        const int32_t *stretch = at->shape.stretch + 4 * s;
        int64_t first = stretch[0], count = stretch[1];
        const real *here = x + first, *above = x + stretch[2], *below = x + stretch[3], *next = at->across + first;
        const real *up = at->up + first, *down = at->down + first, *inverse = at->inverse + first, *given = right + first;
        const real *diagonal = at->diagonal + first;
        real *to = y + first;
        if (share != 0)
            for (int64_t k = 0; k < count; k++) {
                real around = (next[k] * here[k + 1] + next[k - 1] * here[k - 1]) + (up[k] * above[k] + down[k] * below[k]);
                to[k] = keep * here[k] + share * inverse[k] * (given[k] + around);
            }
        else
            for (int64_t k = 0; k < count; k++) {
                real around = (next[k] * here[k + 1] + next[k - 1] * here[k - 1]) + (up[k] * above[k] + down[k] * below[k]);
                to[k] = (given[k] + around) - diagonal[k] * here[k];
            }
    }
    for (int64_t i = at->shape.pixels; i < at->parts; i++)
        y[i] = share != 0 ? keep * x[i] + share * at->inverse[i] * right[i] : right[i] - at->diagonal[i] * x[i];
    for (const Link *link = at->link; link < at->link + at->links; link++) {
        real to_a = link->weight * x[link->b], to_b = link->weight * x[link->a];
        y[link->a] += share != 0 ? share * at->inverse[link->a] * to_a : to_a;
        y[link->b] += share != 0 ? share * at->inverse[link->b] * to_b : to_b;
    }
}

/* One symmetric V-cycle from zero; what it finds is in the level's x. */
static void cycle(const Grid *grid, int64_t depth) {
    const Level *at = grid->level + depth;
    if (depth == grid->last) {
        solved_directly(grid);
        return;
    }
    const Level *under = at + 1;
    const int32_t *parent = at->parent;
    int64_t n = at->parts;
    real first = (real)grid->way.first, second = (real)grid->way.second, over = (real)grid->way.over;
    for (int64_t i = 0; i < n; i++) at->y[i] = first * at->inverse[i] * at->right[i];
    swept(at, at->y, at->right, at->x, second);
    swept(at, at->x, at->right, at->y, 0);
    memset(under->right, 0, (size_t)under->parts * sizeof(real));
    for (int64_t i = 0; i < n; i++) under->right[parent[i]] += at->y[i];
    cycle(grid, depth + 1);
    for (int64_t i = 0; i < n; i++) at->x[i] += over * under->x[parent[i]];
    swept(at, at->x, at->right, at->y, second);
    swept(at, at->y, at->right, at->x, first);
}

/* From the grid's guess to a residual no longer than `enough`. */
static void improved(Grid *grid, const double *right, double enough) {
    int64_t n = grid->level->shape.pixels;
    double *residual = grid->residual, *direction = grid->direction, *image = grid->image, *guess = grid->guess, before = 1.0;
    real *asked = grid->level->right, *answer = grid->level->x;
    times(grid, guess, image);
    for (int64_t i = 0; i < n; i++) residual[i] = right[i] - image[i];
    double length = sqrt(dot(n, residual, residual)), unit = 1.0 / length; /* singles hold what is about one */
    for (int64_t i = 0; i < n; i++) asked[i] = (real)(residual[i] * unit);
    for (int64_t step = 0; step < grid->way.most && !(length <= enough); step++) {
        cycle(grid, 0);
        double now = dot_single(n, residual, answer), turn = step ? now / before : 0.0;
        for (int64_t i = 0; i < n; i++) direction[i] = answer[i] + turn * direction[i];
        double by = now / times(grid, direction, image), lane[8] = {0.0};
        int64_t i = 0;
        before = now;
        unit = 1.0 / length; /* the answer to any multiple of the residual serves */
        for (; i + 8 <= n; i += 8)
            for (int j = 0; j < 8; j++) {
                guess[i + j] += by * direction[i + j];
                residual[i + j] -= by * image[i + j];
                asked[i + j] = (real)(residual[i + j] * unit);
                lane[j] += residual[i + j] * residual[i + j];
            }
        for (; i < n; i++) {
            guess[i] += by * direction[i];
            residual[i] -= by * image[i];
            asked[i] = (real)(residual[i] * unit);
            lane[0] += residual[i] * residual[i];
        }
        length = sqrt(sum_of(lane));
    }
}

/* x of A x = right, from x, until the residual is no longer than `enough`. `across` and `down` (pixels) are the finest's weights; the rest as
   `laid_out` has it. */
KERNEL void lpcal_multigrid(int64_t levels, const int64_t *sizes, const int32_t *cells, const int32_t *stretches, const double *hold,
                            const double *across, const double *down, const double *right, double *x, double *work, float *singles,
                            int32_t *whole, double enough, int64_t most, const double *way) {
    Grid grid;
    size_t bytes = (size_t)sizes[0] * sizeof *x;
    laid_out(&grid, levels, sizes, cells, stretches, work, singles, whole, most, way);
    memcpy(grid.across, across, bytes);
    memcpy(grid.down, down, bytes);
    memcpy(grid.guess, x, bytes);
    set_up(&grid, hold);
    improved(&grid, right, enough);
    memcpy(x, grid.guess, bytes);
}

/* The middle of values, the mean of the two middle ones where their number is even; they change places (Hoare 1961, FIND). */
static double median(int64_t count, double *value) {
    int64_t low = 0, high = count - 1, middle = count / 2;
    while (low < high) {
        double pivot = value[(low + high) / 2];
        int64_t i = low, j = high;
        while (i <= j) {
            while (value[i] < pivot) i++;
            while (pivot < value[j]) j--;
            if (i <= j) {
                double other = value[i];
                value[i++] = value[j];
                value[j--] = other;
            }
        }
        if (middle <= j) high = j;
        else if (middle >= i) low = i;
        else break;
    }
    if (count % 2) return value[middle];
    double below = value[0];
    for (int64_t i = 1; i < middle; i++) below = value[i] > below ? value[i] : below;
    return (below + value[middle]) / 2.0;
}

/* Edges to the right and downwards at their first pixels: their steps, the costs of their breaks, the reciprocals of their sigmas (0: no edge),
   their weights. */
typedef struct {
    const double *step[2], *break_cost[2];
    double *closeness[2], *weight[2], *residual;
} Edges;

/* Weights from the residuals e of the steps: (B / (B + e^2))^2, where B is C^2 times the edge's break cost, C no less than `spread` medians
   of abs(e). */
static void weighed(const Edges *edges, Shape shape, const double *x, double robust, double spread, double least) {
    int64_t count = 0, close = 0;
    double narrow = robust / spread;
    for (int way = 0; way < 2; way++)
        for (int64_t s = 0; s < shape.stretches; s++) {
            const int32_t *at = shape.stretch + 4 * s;
            const double *here = x + at[0], *there = x + (way ? at[3] : at[0] + 1), *step = edges->step[way] + at[0];
            const double *closeness = edges->closeness[way] + at[0];
            double *weight = edges->weight[way] + at[0];
            for (int64_t k = 0; k < at[1]; k++) weight[k] = fabs((there[k] - here[k] - step[k]) * closeness[k]);
            for (int64_t k = 0; k < at[1]; k++)
                if (closeness[k] > 0) {
                    edges->residual[count++] = weight[k];
                    close += weight[k] <= narrow;
                }
        }
    double scale = 2 * close > count + 1 ? robust : fmax(robust, spread * (count ? median(count, edges->residual) : 0.0));
    double square = scale * scale;
    for (int way = 0; way < 2; way++)
        for (int64_t i = 0; i < shape.pixels; i++) {
            double most = edges->closeness[way][i] > 0 ? square * edges->break_cost[way][i] : square;
            double share = most / (most + edges->weight[way][i] * edges->weight[way][i]);
            edges->weight[way][i] = share * share + least;
        }
}

/* Depth x (pixels) whose differences keep steps by their sigmas (0: no edge), robustly, tied to each pixel's optimum by its curvature times
   strengths in turn; and the last weights of the edges, one where they are `fresh`, else by x. All edges are given at their first pixels, those
   to the right and those downwards (2, pixels). `work` is that of a solve and 7 (pixels + 2) more. Twin: integration/integrate.py (integrate). */
KERNEL void lpcal_integrated(int64_t levels, const int64_t *sizes, const int32_t *cells, const int32_t *stretches, const double *step,
                             const double *sigma, const double *break_cost, const double *curvature, const double *optimum, int64_t fresh, int64_t count,
                             const double *strength, double precision, double robust, double spread, double least, double *x,
                             double *weight, double *work, float *singles, int32_t *whole, int64_t most, const double *way) {
    Grid grid;
    int64_t n = sizes[0], room = n + 2;
    Edges edges = {{step, step + n}, {break_cost, break_cost + n}, {work, work + room}, {weight, weight + n}, work + 2 * room};
    double *pull[2] = {work + 4 * room + 1, work + 5 * room + 1}, *right = work + 6 * room;
    laid_out(&grid, levels, sizes, cells, stretches, work + 7 * room, singles, whole, most, way);
    pull[0][-1] = 0.0;
    Shape shape = grid.level->shape;
    for (int way = 0; way < 2; way++)
        for (int64_t i = 0; i < n; i++) {
            edges.closeness[way][i] = sigma[way * n + i] > 0 ? 1.0 / sigma[way * n + i] : 0.0;
            edges.weight[way][i] = 1.0;
        }
    double *finest[2] = {grid.across, grid.down}, *hold = grid.direction, *ones = grid.image;
    memcpy(grid.guess, x, (size_t)n * sizeof *x);
    if (!fresh) weighed(&edges, shape, grid.guess, robust, spread, least);
    for (int64_t k = 0; k < count; k++) {
        for (int way = 0; way < 2; way++)
            for (int64_t i = 0; i < n; i++) {
                finest[way][i] = edges.weight[way][i] * (edges.closeness[way][i] * edges.closeness[way][i]);
                pull[way][i] = finest[way][i] * edges.step[way][i];
            }
        for (int64_t i = 0; i < n; i++) {
            hold[i] = curvature[i] * strength[k];
            right[i] = hold[i] * optimum[i] + pull[0][i - 1] - pull[0][i] - pull[1][i];
            ones[i] = 1.0;
        }
        for (int64_t s = 0; s < shape.stretches; s++) {
            const int32_t *at = shape.stretch + 4 * s;
            if (at[3] != at[0])
                for (int64_t j = 0; j < at[1]; j++) right[at[3] + j] += pull[1][at[0] + j];
        }
        double mean = dot(n, ones, grid.guess) / (double)n;
        for (int64_t i = 0; i < n; i++) ones[i] = right[i] - mean * hold[i];
        set_up(&grid, hold);
        improved(&grid, right, precision * sqrt(dot(n, ones, ones)) + 1e-300);
        weighed(&edges, shape, grid.guess, robust, spread, least);
    }
    memcpy(x, grid.guess, (size_t)n * sizeof *x);
}

/* right - A x of blocks (P, 3, 3) at pixels and links between neighbours; vectors (P, 3). */
static void left_over(Shape shape, const double *block, const double *across, const double *up, const double *down, const double *right,
                      const double *x, double *restrict found) {
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *at = shape.stretch + 4 * s;
        for (int64_t k = 0; k < at[1]; k++) {
            int64_t p = at[0] + k;
            const double *M = block + 9 * p, *here = x + 3 * p, *above = x + 3 * (at[2] + k), *below = x + 3 * (at[3] + k);
            for (int i = 0; i < 3; i++) {
                double around = (across[p] * here[3 + i] + across[p - 1] * here[i - 3]) + (up[p] * above[i] + down[p] * below[i]);
                double own = M[3 * i] * here[0] + M[3 * i + 1] * here[1] + M[3 * i + 2] * here[2];
                found[3 * p + i] = (right ? right[3 * p + i] : 0.0) + (around - own);
            }
        }
    }
}

/* x (P, 3) of a system of blocks and links by conjugate gradients from x, preconditioned by the blocks (L D L', each raised by the share `small` of
   its trace), until the residual is no longer than `enough`. `work` is zero: links and the direction with a pixel more at both ends, and 15 numbers a pixel.
   Twin: shading/field.py (_System.solved). */
KERNEL void lpcal_coupled(int64_t pixels, int64_t stretches, const int32_t *stretch, const double *block, const double *across,
                          const double *down, const double *right, double *x, double *work, double enough, int64_t most, double small) {
    Shape shape = {pixels, stretches, NULL, stretch};
    int64_t n = 3 * pixels;
    double *next = work + 1, *above = work + pixels + 3, *direction = work + 2 * pixels + 6 + 3, *residual = direction + n + 3;
    double *image = residual + n, *z = image + n, *factor = z + n, before = 1.0;
    memcpy(next, across, (size_t)pixels * sizeof *next);
    for (int64_t s = 0; s < stretches; s++) {
        const int32_t *at = stretch + 4 * s;
        if (at[3] != at[0])
            for (int64_t k = 0; k < at[1]; k++) above[at[3] + k] = down[at[0] + k];
    }
    for (int64_t p = 0; p < pixels; p++) {
        const double *M = block + 9 * p;
        double *f = factor + 6 * p, raise = small * (M[0] + M[4] + M[8]) + DBL_MIN, d0 = M[0] + raise, l10 = M[3] / d0, l20 = M[6] / d0;
        double d1 = M[4] + raise - l10 * M[3], rest = M[7] - l20 * M[3], l21 = rest / d1;
        f[0] = l10;
        f[1] = l20;
        f[2] = l21;
        f[3] = 1 / d0;
        f[4] = 1 / d1;
        f[5] = 1 / (M[8] + raise - l20 * M[6] - l21 * rest);
    }
    memcpy(direction, x, (size_t)n * sizeof *x);
    left_over(shape, block, next, above, down, right, direction, residual);
    memset(direction, 0, (size_t)n * sizeof *x);
    for (int64_t step = 0; step < most && !(sqrt(dot(n, residual, residual)) <= enough); step++) {
        for (int64_t p = 0; p < pixels; p++) {
            const double *f = factor + 6 * p, *r = residual + 3 * p;
            double y1 = r[1] - f[0] * r[0], y2 = r[2] - f[1] * r[0] - f[2] * y1;
            z[3 * p + 2] = y2 * f[5];
            z[3 * p + 1] = y1 * f[4] - f[2] * z[3 * p + 2];
            z[3 * p] = r[0] * f[3] - f[0] * z[3 * p + 1] - f[1] * z[3 * p + 2];
        }
        double now = dot(n, residual, z), turn = step ? now / before : 0.0;
        for (int64_t i = 0; i < n; i++) direction[i] = z[i] + turn * direction[i];
        left_over(shape, block, next, above, down, NULL, direction, image);
        double by = -now / dot(n, direction, image);
        for (int64_t i = 0; i < n; i++) {
            x[i] += by * direction[i];
            residual[i] += by * image[i];
        }
        before = now;
    }
}
