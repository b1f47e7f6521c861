/* Conjugate gradients with a multigrid preconditioner on symmetric sparse matrices in compressed rows. Twin: surface/multigrid.py.

   Levels from fine to coarse lie one behind the other: sizes (levels), parents (all rows but the coarsest's) of each row on the next level,
   row starts (sizes + 1 each), and for columns and values one slot of `slot` entries a level. */

#include "kernel.h"

typedef struct {
    int64_t rows;
    const int64_t *parent, *start, *column;
    const double *value, *inverse;
    double *x, *right, *scratch;
} Level;

typedef struct {
    Level *level;
    int64_t last;
    const double *factor; /* upper Cholesky factor of the coarsest matrix; NULL: its diagonal alone */
    double damping, over;
} Grid;

/* The matrix of rows joined by their parents, P' A P; how many entries it has. `first`, `next` (rows) and `seen` (coarse) are scratch. */
static int64_t joined(int64_t rows, int64_t coarse, const int64_t *parent, const int64_t *start, const int64_t *column, const double *value,
                      int64_t *coarse_start, int64_t *coarse_column, double *coarse_value, int64_t *first, int64_t *next, int64_t *seen) {
    for (int64_t c = 0; c < coarse; c++) first[c] = seen[c] = -1;
    for (int64_t i = rows - 1; i >= 0; i--) {
        next[i] = first[parent[i]];
        first[parent[i]] = i;
    }
    int64_t count = 0;
    for (int64_t c = 0; c < coarse; c++) {
        coarse_start[c] = count;
        for (int64_t i = first[c]; i >= 0; i = next[i])
            for (int64_t k = start[i]; k < start[i + 1]; k++) {
                int64_t other = parent[column[k]];
                if (seen[other] < coarse_start[c]) {
                    seen[other] = count;
                    coarse_column[count] = other;
                    coarse_value[count++] = 0.0;
                }
                coarse_value[seen[other]] += value[k];
            }
    }
    coarse_start[coarse] = count;
    return count;
}

/* Fills the coarser levels from the finest, and the inverse diagonals of all. `scratch` holds three times the finest's rows. */
KERNEL void lpcal_hierarchy(int64_t levels, int64_t slot, const int64_t *sizes, const int64_t *parents, int64_t *start, int64_t *column,
                            double *value, double *inverse, int64_t *scratch) {
    for (int64_t l = 0; l < levels; l++) {
        int64_t rows = sizes[l];
        for (int64_t i = 0; i < rows; i++) {
            double diagonal = 0.0;
            for (int64_t k = start[i]; k < start[i + 1]; k++)
                if (column[k] == i) diagonal += value[k];
            inverse[i] = 1 / diagonal;
        }
        if (l + 1 == levels) break;
        joined(rows, sizes[l + 1], parents, start, column, value, start + rows + 1, column + slot, value + slot, scratch, scratch + sizes[0],
               scratch + 2 * sizes[0]);
        parents += rows;
        inverse += rows;
        start += rows + 1;
        column += slot;
        value += slot;
    }
}

static void times(const Level *at, const double *x, double *found) {
    for (int64_t i = 0; i < at->rows; i++) {
        double sum = 0.0;
        for (int64_t k = at->start[i]; k < at->start[i + 1]; k++) sum += at->value[k] * x[at->column[k]];
        found[i] = sum;
    }
}

/* x + damping / diagonal (right - A x), by way of the scratch. */
static void smooth(Level *at, const double *right, double *x, double damping) {
    times(at, x, at->scratch);
    for (int64_t i = 0; i < at->rows; i++) x[i] += damping * at->inverse[i] * (right[i] - at->scratch[i]);
}

static void coarsest(const Grid *grid, const double *right, double *x) {
    const Level *at = grid->level + grid->last;
    int64_t n = at->rows;
    if (!grid->factor) {
        for (int64_t i = 0; i < n; i++) x[i] = at->inverse[i] * right[i];
        return;
    }
    memcpy(x, right, (size_t)n * sizeof *x);
    for (int64_t i = 0; i < n; i++) {
        const double *row = grid->factor + i * n;
        double own = x[i] / row[i];
        x[i] = own;
        for (int64_t j = i + 1; j < n; j++) x[j] -= row[j] * own;
    }
    for (int64_t i = n - 1; i >= 0; i--) {
        const double *row = grid->factor + i * n;
        double sum = x[i];
        for (int64_t j = i + 1; j < n; j++) sum -= row[j] * x[j];
        x[i] = sum / row[i];
    }
}

/* One symmetric V-cycle from zero. */
static void cycle(const Grid *grid, int64_t depth, const double *right, double *x) {
    Level *at = grid->level + depth;
    if (depth == grid->last) {
        coarsest(grid, right, x);
        return;
    }
    Level *below = at + 1;
    for (int64_t i = 0; i < at->rows; i++) x[i] = grid->damping * at->inverse[i] * right[i];
    smooth(at, right, x, grid->damping);
    times(at, x, at->scratch);
    memset(below->right, 0, (size_t)below->rows * sizeof(double));
    for (int64_t i = 0; i < at->rows; i++) below->right[at->parent[i]] += right[i] - at->scratch[i];
    cycle(grid, depth + 1, below->right, below->x);
    for (int64_t i = 0; i < at->rows; i++) x[i] += grid->over * below->x[at->parent[i]];
    smooth(at, right, x, grid->damping);
    smooth(at, right, x, grid->damping);
}

/* Always summed in the same four lanes. */
static double dot(int64_t n, const double *a, const double *b) {
    double lane[4] = {0.0, 0.0, 0.0, 0.0};
    int64_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (int j = 0; j < 4; j++) lane[j] += a[i + j] * b[i + j];
    for (; i < n; i++) lane[0] += a[i] * b[i];
    return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

/* x of A x = right, from x, until the residual is no longer than `enough`; `work` holds three times the rows of all levels and four of the finest's. */
KERNEL void lpcal_multigrid(int64_t levels, int64_t slot, const int64_t *sizes, const int64_t *parents, const int64_t *start,
                            const int64_t *column, const double *value, const double *inverse, int64_t factored, const double *factor,
                            const double *right, double *x, double *work, double enough, int64_t most, double damping, double over) {
    Level level[64];
    int64_t n = sizes[0];
    for (int64_t l = 0; l < levels; l++) {
        int64_t rows = sizes[l];
        level[l] = (Level){rows, parents, start, column, value, inverse, work, work + rows, work + 2 * rows};
        parents += rows;
        start += rows + 1;
        column += slot;
        value += slot;
        inverse += rows;
        work += 3 * rows;
    }
    Grid grid = {level, levels - 1, factored ? factor : NULL, damping, over};
    double *residual = work, *z = work + n, *direction = work + 2 * n, *image = work + 3 * n, before = 1.0;
    times(level, x, image);
    for (int64_t i = 0; i < n; i++) {
        residual[i] = right[i] - image[i];
        direction[i] = 0.0;
    }
    for (int64_t step = 0; step < most && !(sqrt(dot(n, residual, residual)) <= enough); step++) {
        cycle(&grid, 0, residual, z);
        double now = dot(n, residual, z), turn = step ? now / before : 0.0;
        for (int64_t i = 0; i < n; i++) direction[i] = z[i] + turn * direction[i];
        times(level, direction, image);
        double length = now / dot(n, direction, image);
        for (int64_t i = 0; i < n; i++) {
            x[i] += length * direction[i];
            residual[i] -= length * image[i];
        }
        before = now;
    }
}
