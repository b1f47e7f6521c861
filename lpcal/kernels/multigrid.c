/* Conjugate gradients with a multigrid preconditioner on the pixels of a mask. Twin: surface/multigrid.py.

   A level's matrix is that of its pixels' neighbours: pixels are numbered row by row, so the right neighbour of one is the next, and those
   above and below lie side by side along stretches of a row. Nothing but weights is stored, and every inner loop goes straight through
   memory. The cycle's numbers are singles: it only says where to look next, the conjugate gradients decide in doubles. Levels from fine to
   coarse lie one behind the other; vectors have a number more at both ends. */

#include "kernel.h"

typedef float real;

typedef struct {
    int64_t pixels, stretches;
    const int32_t *parent;  /* of each pixel, on the next coarser level */
    const int32_t *stretch; /* (stretches, 4): first pixel, how many, the first one above and below them; their own first where none is */
} Shape;

typedef struct {
    Shape shape;
    real *across, *up, *down, *hold, *diagonal, *inverse; /* weights to the next pixel, to those above and below; damping over diagonal */
    real *x, *y, *right;
} Level;

typedef struct {
    Level *level;
    int64_t last, band;
    double *factor; /* banded Cholesky factor of the coarsest matrix (pixels, band + 1), the diagonal last; NULL: its diagonal alone */
    real damping, over;
} Grid;

/* A x of the finest matrix. */
static void times(Shape shape, const double *across, const double *up, const double *down, const double *diagonal, const double *x,
                  double *restrict found) {
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *at = shape.stretch + 4 * s;
        int64_t first = at[0], count = at[1];
        const double *here = x + first, *above = x + at[2], *below = x + at[3], *next = across + first;
        for (int64_t k = 0; k < count; k++) {
            double around = (next[k] * here[k + 1] + next[k - 1] * here[k - 1]) + (up[first + k] * above[k] + down[first + k] * below[k]);
            found[first + k] = diagonal[first + k] * here[k] - around;
        }
    }
}

/* y = x + damping / diagonal (right - A x) where `smooth`, else y = right - A x. */
static void swept(const Level *at, const real *x, const real *right, real *restrict y, real damping, bool smooth) {
    real keep = 1 - damping;
    for (int64_t s = 0; s < at->shape.stretches; s++) {
        const int32_t *stretch = at->shape.stretch + 4 * s;
        int64_t first = stretch[0], count = stretch[1];
        const real *here = x + first, *above = x + stretch[2], *below = x + stretch[3], *next = at->across + first;
        const real *up = at->up + first, *down = at->down + first, *inverse = at->inverse + first, *given = right + first;
        const real *diagonal = at->diagonal + first;
        real *to = y + first;
        if (smooth)
            for (int64_t k = 0; k < count; k++) {
                real around = (next[k] * here[k + 1] + next[k - 1] * here[k - 1]) + (up[k] * above[k] + down[k] * below[k]);
                to[k] = keep * here[k] + inverse[k] * (given[k] + around);
            }
        else
            for (int64_t k = 0; k < count; k++) {
                real around = (next[k] * here[k + 1] + next[k - 1] * here[k - 1]) + (up[k] * above[k] + down[k] * below[k]);
                to[k] = (given[k] + around) - diagonal[k] * here[k];
            }
    }
}

/* Weights of edges upwards by those downwards. */
static void upwards(Shape shape, const real *down, real *up) {
    memset(up, 0, (size_t)shape.pixels * sizeof *up);
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *at = shape.stretch + 4 * s;
        if (at[3] != at[0])
            for (int64_t k = 0; k < at[1]; k++) up[at[3] + k] = down[at[0] + k];
    }
}

static void diagonals(const Level *at, real damping) {
    for (int64_t i = 0; i < at->shape.pixels; i++) {
        at->diagonal[i] = at->hold[i] + ((at->across[i] + at->across[i - 1]) + (at->up[i] + at->down[i]));
        at->inverse[i] = damping / at->diagonal[i];
    }
}

/* The coarser level's weights: those of edges between its pixels, and what holds these, summed (P' A P). */
static void joined(const Level *fine, Level *coarse) {
    size_t bytes = (size_t)coarse->shape.pixels * sizeof(real);
    memset(coarse->hold, 0, bytes);
    memset(coarse->across, 0, bytes);
    memset(coarse->down, 0, bytes);
    const int32_t *parent = fine->shape.parent;
    for (int64_t s = 0; s < fine->shape.stretches; s++) {
        const int32_t *at = fine->shape.stretch + 4 * s;
        for (int64_t i = at[0]; i < at[0] + at[1]; i++) {
            int32_t own = parent[i];
            coarse->hold[own] += fine->hold[i];
            if (fine->across[i] > 0 && parent[i + 1] != own) coarse->across[own] += fine->across[i];
            if (at[3] != at[0] && parent[at[3] + i - at[0]] != own) coarse->down[own] += fine->down[i];
        }
    }
    upwards(coarse->shape, coarse->down, coarse->up);
}

/* The factor of the coarsest matrix; false where it is singular to rounding. */
static bool factored(const Level *at, double *factor, int64_t band, double rounding) {
    int64_t n = at->shape.pixels, width = band + 1;
    memset(factor, 0, (size_t)(n * width) * sizeof(double));
    for (int64_t i = 0; i < n; i++) {
        double edges = ((double)at->across[i] + (double)at->across[i - 1]) + ((double)at->up[i] + (double)at->down[i]);
        factor[i * width + band] = (at->hold[i] + edges) * (1 + rounding);
        if (i && band) factor[i * width + band - 1] = -at->across[i - 1];
    }
    for (int64_t s = 0; s < at->shape.stretches; s++) {
        const int32_t *stretch = at->shape.stretch + 4 * s;
        int64_t apart = stretch[3] - stretch[0];
        for (int64_t k = 0; apart && k < stretch[1]; k++) factor[(stretch[3] + k) * width + band - apart] -= at->down[stretch[0] + k];
    }
    for (int64_t i = 0; i < n; i++) {
        double *row = factor + i * width;
        int64_t from = i < band ? 0 : i - band;
        for (int64_t j = from; j <= i; j++) {
            const double *other = factor + j * width;
            double sum = row[band - (i - j)];
            for (int64_t k = j - band > from ? j - band : from; k < j; k++) sum -= row[band - (i - k)] * other[band - (j - k)];
            if (j < i)
                row[band - (i - j)] = sum / other[band];
            else if (!(sum > 0.0))
                return false;
            else
                row[band] = sqrt(sum);
        }
    }
    return true;
}

static void coarsest(const Grid *grid, const real *right, real *found, double *x) {
    const Level *at = grid->level + grid->last;
    int64_t n = at->shape.pixels, band = grid->band, width = band + 1;
    if (!grid->factor) {
        for (int64_t i = 0; i < n; i++) found[i] = right[i] / at->diagonal[i];
        return;
    }
    for (int64_t i = 0; i < n; i++) {
        const double *row = grid->factor + i * width;
        double sum = right[i];
        for (int64_t j = i < band ? 0 : i - band; j < i; j++) sum -= row[band - (i - j)] * x[j];
        x[i] = sum / row[band];
    }
    for (int64_t i = n - 1; i >= 0; i--) {
        const double *row = grid->factor + i * width;
        x[i] /= row[band];
        for (int64_t j = i < band ? 0 : i - band; j < i; j++) x[j] -= row[band - (i - j)] * x[i];
        found[i] = (real)x[i];
    }
}

/* One symmetric V-cycle from zero; what it finds is in the level's x. */
static void cycle(const Grid *grid, int64_t depth, double *scratch) {
    Level *at = grid->level + depth;
    if (depth == grid->last) {
        coarsest(grid, at->right, at->x, scratch);
        return;
    }
    Level *under = at + 1;
    const int32_t *parent = at->shape.parent;
    int64_t n = at->shape.pixels;
    for (int64_t i = 0; i < n; i++) at->y[i] = at->inverse[i] * at->right[i];
    swept(at, at->y, at->right, at->x, grid->damping, true);
    swept(at, at->x, at->right, at->y, grid->damping, false);
    memset(under->right, 0, (size_t)under->shape.pixels * sizeof(real));
    for (int64_t i = 0; i < n; i++) under->right[parent[i]] += at->y[i];
    cycle(grid, depth + 1, scratch);
    for (int64_t i = 0; i < n; i++) at->x[i] += grid->over * under->x[parent[i]];
    swept(at, at->x, at->right, at->y, grid->damping, true);
    swept(at, at->y, at->right, at->x, grid->damping, true);
}

/* Always summed in the same eight lanes. */
static double dot(int64_t n, const double *a, const double *b) {
    double lane[8] = {0.0};
    int64_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (int j = 0; j < 8; j++) lane[j] += a[i + j] * b[i + j];
    for (; i < n; i++) lane[0] += a[i] * b[i];
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

/* x of A x = right, from x, until the residual is no longer than `enough`. `sizes` (levels, 2): pixels and stretches of each; `across` and
   `down` (pixels) are the finest's weights, `band` is how far apart neighbours of the coarsest are numbered at most, -1 where there are too
   many. `work` is zero: eight times the finest's pixels plus two, and (band + 2) times the coarsest's; `singles` likewise: nine times the
   pixels plus two of all levels. */
KERNEL void lpcal_multigrid(int64_t levels, const int64_t *sizes, const int32_t *parents, const int32_t *stretches, const double *hold,
                            const double *across, const double *down, const double *right, double *x, double *work, float *singles,
                            int64_t band, double enough, int64_t most, double damping, double over, double rounding) {
    Level level[64];
    int64_t n = sizes[0];
    double *vector[8];
    for (int k = 0; k < 8; k++, work += n + 2) vector[k] = work + 1;
    double *next = vector[0], *above = vector[1], *below = vector[2], *diagonal = vector[3];
    double *image = vector[4], *residual = vector[5], *direction = vector[6], *guess = vector[7], before = 1.0;
    for (int64_t l = 0; l < levels; l++) {
        int64_t pixels = sizes[2 * l];
        real *own[9];
        for (int k = 0; k < 9; k++, singles += pixels + 2) own[k] = singles + 1;
        Shape shape = {pixels, sizes[2 * l + 1], parents, stretches};
        level[l] = (Level){shape, own[0], own[1], own[2], own[3], own[4], own[5], own[6], own[7], own[8]};
        parents += pixels;
        stretches += 4 * shape.stretches;
        if (l == 0) {
            for (int64_t i = 0; i < n; i++) {
                level->hold[i] = (real)hold[i];
                level->across[i] = (real)across[i];
                level->down[i] = (real)down[i];
            }
            upwards(shape, level->down, level->up);
        } else
            joined(level + l - 1, level + l);
        diagonals(level + l, (real)damping);
    }
    Shape shape = level->shape;
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *at = shape.stretch + 4 * s;
        if (at[3] != at[0])
            for (int64_t k = 0; k < at[1]; k++) above[at[3] + k] = down[at[0] + k];
    }
    for (int64_t i = 0; i < n; i++) {
        next[i] = across[i];
        below[i] = down[i];
        guess[i] = x[i];
    }
    for (int64_t i = 0; i < n; i++) diagonal[i] = hold[i] + ((next[i] + next[i - 1]) + (above[i] + below[i]));
    int64_t size = sizes[2 * levels - 2];
    Grid grid = {level, levels - 1, band, NULL, (real)damping, (real)over};
    if (band >= 0 && factored(level + levels - 1, work + size, band, rounding)) grid.factor = work + size;
    times(shape, next, above, below, diagonal, guess, image);
    for (int64_t i = 0; i < n; i++) residual[i] = right[i] - image[i];
    double length = sqrt(dot(n, residual, residual));
    for (int64_t step = 0; step < most && !(length <= enough); step++) {
        for (int64_t i = 0; i < n; i++) level->right[i] = (real)(residual[i] / length);
        cycle(&grid, 0, work);
        for (int64_t i = 0; i < n; i++) image[i] = level->x[i];
        double now = dot(n, residual, image), turn = step ? now / before : 0.0;
        for (int64_t i = 0; i < n; i++) direction[i] = image[i] + turn * direction[i];
        times(shape, next, above, below, diagonal, direction, image);
        double by = now / dot(n, direction, image);
        for (int64_t i = 0; i < n; i++) {
            guess[i] += by * direction[i];
            residual[i] -= by * image[i];
        }
        before = now;
        length = sqrt(dot(n, residual, residual));
    }
    memcpy(x, guess, (size_t)n * sizeof *x);
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

/* x (P, 3) of a system of blocks and links by conjugate gradients from x, preconditioned by the blocks (L D L', raised by `small`), until the
   residual is no longer than `enough`. `work` is zero: links and the direction with a pixel more at both ends, and 15 numbers a pixel.
   Twin: surface/field.py (_System.solved). */
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
        double *f = factor + 6 * p, d0 = M[0] + small, l10 = M[3] / d0, l20 = M[6] / d0;
        double d1 = M[4] + small - l10 * M[3], rest = M[7] - l20 * M[3], l21 = rest / d1;
        f[0] = l10;
        f[1] = l20;
        f[2] = l21;
        f[3] = 1 / d0;
        f[4] = 1 / d1;
        f[5] = 1 / (M[8] + small - l20 * M[6] - l21 * rest);
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
