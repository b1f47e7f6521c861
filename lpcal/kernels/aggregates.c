/* Coarser levels of a masked matrix: strongly coupled unknowns within 2x2 pixels are aggregated into one. Twin: integration/multigrid.py (_levels).

   Which unknowns hold together is asked of the weights, every time that they change: an aggregate over a break would tie together what stands
   at two depths, and a level of such aggregates says next to nothing of either. */

#include "multigrid.h"

/* Weights of edges upwards by those downwards. */
static void upwards(Shape shape, const real *down, real *up) {
    memset(up, 0, (size_t)shape.pixels * sizeof *up);
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *at = shape.stretch + 4 * s;
        if (at[3] != at[0])
            for (int64_t k = 0; k < at[1]; k++) up[at[3] + k] = down[at[0] + k];
    }
}

static void diagonals(const Level *at) {
    for (int64_t i = 0; i < at->shape.pixels; i++)
        at->diagonal[i] = at->hold[i] + ((at->across[i] + at->across[i - 1]) + (at->up[i] + at->down[i]));
    for (int64_t i = at->shape.pixels; i < at->parts; i++) at->diagonal[i] = at->hold[i];
    for (const Link *link = at->link; link < at->link + at->links; link++) {
        at->diagonal[link->a] += link->weight;
        at->diagonal[link->b] += link->weight;
    }
    for (int64_t i = 0; i < at->parts; i++) at->inverse[i] = 1 / at->diagonal[i];
}

static int32_t root_of(int32_t *root, int32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
}

static real larger(real a, real b) { return a > b ? a : b; }

/* Coarse pixel that an unknown lies in. */
static int32_t cell_of(const Level *at, int64_t i) { return at->shape.cell[i < at->shape.pixels ? i : at->home[i - at->shape.pixels]]; }

/* What is found of a level's unknowns: those that hold together have one root, the first of them, which knows how many they are. */
typedef struct {
    int32_t *root, *size, *best;
    Link *lone; /* of unknowns: their strongest edges, within a cell but not strong for the other end */
    int64_t lonely;
} Sets;

static void united(const Sets *sets, int32_t a, int32_t b) {
    a = root_of(sets->root, a);
    b = root_of(sets->root, b);
    if (a == b) return;
    int32_t first = a < b ? a : b, second = a < b ? b : a;
    sets->root[second] = first;
    sets->size[first] += sets->size[second];
}

/* An edge within a cell: it joins its ends where it is strong for both; else it may be all that one of them has. */
static void met(Sets *sets, const real *most, real strong, int32_t a, int32_t b, real weight) {
    if (!(weight > 0)) return;
    if (weight >= strong * larger(most[a], most[b])) united(sets, a, b);
    else if (weight >= most[a]) sets->lone[sets->lonely++] = (Link){a, b, weight};
    else if (weight >= most[b]) sets->lone[sets->lonely++] = (Link){b, a, weight};
}

/* The unknowns of a level joined within each coarse pixel: by edges that are strong for both of their ends; an unknown that none of these
   joins goes with the one at the other end of its strongest edge, which a step of smoothing puts it beside. */
static void held_together(const Level *at, real strong, Sets *sets) {
    real *most = at->y;
    for (int64_t i = 0; i < at->shape.pixels; i++)
        most[i] = larger(larger(at->across[i], at->across[i - 1]), larger(at->up[i], at->down[i]));
    for (int64_t i = at->shape.pixels; i < at->parts; i++) most[i] = 0;
    for (const Link *link = at->link; link < at->link + at->links; link++) {
        most[link->a] = larger(most[link->a], link->weight);
        most[link->b] = larger(most[link->b], link->weight);
    }
    for (int64_t i = 0; i < at->parts; i++) {
        sets->root[i] = (int32_t)i;
        sets->size[i] = 1;
    }
    sets->lonely = 0;
    const int32_t *cell = at->shape.cell;
    for (int64_t s = 0; s < at->shape.stretches; s++) {
        const int32_t *stretch = at->shape.stretch + 4 * s, first = stretch[0], below = stretch[3];
        for (int32_t i = first; i < first + stretch[1]; i++)
            if (cell[i + 1] == cell[i]) met(sets, most, strong, i, i + 1, at->across[i]);
        for (int32_t i = first, j = below; below != first && i < first + stretch[1]; i++, j++)
            if (cell[j] == cell[i]) met(sets, most, strong, i, j, at->down[i]);
    }
    for (const Link *link = at->link; link < at->link + at->links; link++)
        if (cell_of(at, link->a) == cell_of(at, link->b)) met(sets, most, strong, link->a, link->b, link->weight);
    int64_t lonely = 0;
    for (int64_t k = 0; k < sets->lonely; k++)
        if (sets->root[sets->lone[k].a] == sets->lone[k].a && sets->size[sets->lone[k].a] == 1) sets->lone[lonely++] = sets->lone[k];
    for (int64_t k = 0; k < lonely; k++) united(sets, sets->lone[k].a, sets->lone[k].b);
}

/* Numbers what holds together: the largest part of each coarse pixel, the first of several, is the pixel, others come behind. Parts that there
   is no room for are taken to be of the largest. */
static void numbered(const Level *fine, Level *coarse, int64_t room, const Sets *sets) {
    int64_t n = fine->parts, pixels = coarse->shape.pixels;
    int32_t *parent = fine->parent, *best = sets->best;
    for (int64_t c = 0; c < pixels; c++) best[c] = -1;
    for (int32_t i = 0; i < n; i++) {
        if (sets->root[i] != i) continue;
        int32_t *of_cell = best + cell_of(fine, i);
        if (*of_cell < 0 || sets->size[i] > sets->size[*of_cell]) *of_cell = i;
    }
    coarse->parts = pixels;
    for (int32_t i = 0; i < n; i++) {
        int32_t cell = cell_of(fine, i), behind = (int32_t)(coarse->parts - pixels), root = root_of(sets->root, i);
        if (root != i)
            parent[i] = parent[root];
        else if (best[cell] == i || behind >= room)
            parent[i] = cell;
        else {
            coarse->home[behind] = cell;
            parent[i] = (int32_t)coarse->parts++;
        }
    }
}

/* Adds a weight to a level's link between two of its unknowns; `table` (size a power of two) finds links by their ends, -1 where there is none. */
static void linked(Level *at, int64_t room, int32_t *table, uint32_t size, int32_t a, int32_t b, real weight) {
    int32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t slot = ((uint32_t)low * 0x9e3779b1u ^ (uint32_t)high * 0x85ebca6bu) & (size - 1);
    for (; table[slot] >= 0; slot = (slot + 1) & (size - 1)) {
        Link *link = at->link + table[slot];
        if (link->a == low && link->b == high) {
            link->weight += weight;
            return;
        }
    }
    if (at->links == room) return; /* the level holds less together then, which the conjugate gradients make good */
    table[slot] = (int32_t)at->links;
    at->link[at->links++] = (Link){low, high, weight};
}

/* The coarser level's weights: those of edges between its unknowns, and what holds these, summed (P' A P). */
static void joined(const Level *fine, Level *coarse, int64_t most, int32_t *table) {
    int64_t pixels = coarse->shape.pixels, likely = LINKS * (coarse->parts - pixels) + fine->links, room = likely < most ? likely : most;
    uint32_t size = 2;
    const int32_t *parent = fine->parent;
    while (size < 2 * room) size *= 2;
    if (room) memset(table, 0xff, size * sizeof *table);
    coarse->links = 0;
    memset(coarse->hold, 0, (size_t)coarse->parts * sizeof(real));
    memset(coarse->across, 0, (size_t)pixels * sizeof(real));
    memset(coarse->down, 0, (size_t)pixels * sizeof(real));
    for (int64_t i = 0; i < fine->parts; i++) coarse->hold[parent[i]] += fine->hold[i];
    for (int64_t s = 0; s < fine->shape.stretches; s++) {
        const int32_t *at = fine->shape.stretch + 4 * s;
        for (int64_t i = at[0]; i < at[0] + at[1]; i++) {
            int32_t own = parent[i], right = parent[i + 1], below = at[3] != at[0] ? parent[at[3] + i - at[0]] : own;
            if (fine->across[i] > 0 && right != own) {
                if (own < pixels && right < pixels) coarse->across[own] += fine->across[i];
                else linked(coarse, room, table, size, own, right, fine->across[i]);
            }
            if (below != own && fine->down[i] > 0) {
                if (own < pixels && below < pixels) coarse->down[own] += fine->down[i];
                else linked(coarse, room, table, size, own, below, fine->down[i]);
            }
        }
    }
    for (const Link *link = fine->link; link < fine->link + fine->links; link++)
        if (parent[link->a] != parent[link->b]) linked(coarse, room, table, size, parent[link->a], parent[link->b], link->weight);
    upwards(coarse->shape, coarse->down, coarse->up);
}

/* Where each unknown of the coarsest level stands in its factor: by the pixels that they lie in, so that neighbours are close. */
static void placed(const Level *at, int32_t *place, int32_t *begin) {
    int64_t pixels = at->shape.pixels;
    for (int64_t c = 0; c <= pixels; c++) begin[c] = 0;
    for (int64_t i = pixels; i < at->parts; i++) begin[at->home[i - pixels] + 1]++;
    for (int64_t c = 0; c < pixels; c++) begin[c + 1] += begin[c] + 1;
    for (int64_t c = 0; c < pixels; c++) place[c] = begin[c]++;
    for (int64_t i = pixels; i < at->parts; i++) place[i] = begin[at->home[i - pixels]]++;
}

static double *diagonal_of(const Grid *grid, int32_t place) { return grid->factor + grid->row[place] + place - grid->first[place]; }

/* An edge in the factor's matrix; while rows are counted, the later one's begins at the earlier end at the latest. */
static void entered(const Grid *grid, bool counting, int64_t a, int64_t b, double weight) {
    int32_t low = grid->place[a], high = grid->place[b];
    if (low > high) {
        low = grid->place[b];
        high = grid->place[a];
    }
    if (counting) {
        grid->first[high] = low < grid->first[high] ? low : grid->first[high];
        return;
    }
    grid->factor[grid->row[high] + low - grid->first[high]] -= weight;
    *diagonal_of(grid, low) += weight;
    *diagonal_of(grid, high) += weight;
}

static void edges_entered(const Grid *grid, bool counting) {
    const Level *at = grid->level + grid->last;
    for (int64_t s = 0; s < at->shape.stretches; s++) {
        const int32_t *stretch = at->shape.stretch + 4 * s;
        for (int64_t i = stretch[0]; i < stretch[0] + stretch[1]; i++) {
            if (at->across[i] > 0) entered(grid, counting, i, i + 1, at->across[i]);
            if (at->down[i] > 0) entered(grid, counting, i, stretch[3] + i - stretch[0], at->down[i]);
        }
    }
    for (const Link *link = at->link; link < at->link + at->links; link++) entered(grid, counting, link->a, link->b, link->weight);
}

/* The Cholesky factor of the coarsest matrix, in doubles: what holds a whole piece is little beside its edges. False where it is singular to
   rounding. */
static bool factored(const Grid *grid) {
    const Level *at = grid->level + grid->last;
    int64_t n = at->parts;
    int32_t *first = grid->first, *row = grid->row, begin = 0;
    double *factor = grid->factor;
    placed(at, grid->place, row);
    for (int64_t i = 0; i < n; i++) first[i] = (int32_t)i;
    edges_entered(grid, true);
    for (int64_t i = 0; i < n; i++) {
        row[i] = begin;
        begin += (int32_t)i + 1 - first[i];
    }
    memset(factor, 0, (size_t)begin * sizeof *factor);
    for (int64_t i = 0; i < n; i++) *diagonal_of(grid, grid->place[i]) = at->hold[i];
    edges_entered(grid, false);
    for (int32_t i = 0; i < n; i++) *diagonal_of(grid, i) *= 1 + grid->way.rounding;
    for (int64_t i = 0; i < n; i++) {
        double *own = factor + row[i] - first[i];
        for (int64_t j = first[i]; j <= i; j++) {
            const double *other = factor + row[j] - first[j];
            double sum = own[j];
            for (int64_t k = first[j] > first[i] ? first[j] : first[i]; k < j; k++) sum -= own[k] * other[k];
            if (j < i) own[j] = sum / other[j];
            else if (sum > 0.0) own[j] = sqrt(sum);
            else return false;
        }
    }
    return true;
}

/* The coarsest level's x, by its factor; by its diagonal where there is none. */
void solved_directly(const Grid *grid) {
    const Level *at = grid->level + grid->last;
    int64_t n = at->parts;
    const int32_t *first = grid->first, *place = grid->place;
    double *x = grid->solved;
    if (!grid->direct) {
        for (int64_t i = 0; i < n; i++) at->x[i] = at->right[i] * at->inverse[i];
        return;
    }
    for (int64_t i = 0; i < n; i++) x[place[i]] = at->right[i];
    for (int64_t i = 0; i < n; i++) {
        const double *own = grid->factor + grid->row[i] - first[i];
        double sum = x[i];
        for (int64_t j = first[i]; j < i; j++) sum -= own[j] * x[j];
        x[i] = sum / own[i];
    }
    for (int64_t i = n - 1; i >= 0; i--) {
        const double *own = grid->factor + grid->row[i] - first[i];
        x[i] /= own[i];
        for (int64_t j = first[i]; j < i; j++) x[j] -= own[j] * x[i];
    }
    for (int64_t i = 0; i < n; i++) at->x[i] = (real)x[place[i]];
}

/* Divides the work space, whatever it holds, among the levels (integration/multigrid.py has its sizes). `sizes` (levels, 2) are pixels and
   stretches of each, `way` the first seven numbers of a Way. */
void laid_out(Grid *grid, int64_t levels, const int64_t *sizes, const int32_t *cells, const int32_t *stretches, double *work, real *singles,
              int32_t *whole, int64_t most, const double *way) {
    double **of[8] = {&grid->across, &grid->up, &grid->down, &grid->diagonal, &grid->image, &grid->residual, &grid->direction, &grid->guess};
    for (int k = 0; k < 8; k++, work += sizes[0] + 2) {
        work[0] = work[sizes[0] + 1] = 0.0;
        *of[k] = work + 1;
    }
    memset(grid->up, 0, (size_t)sizes[0] * sizeof *work);
    memset(grid->direction, 0, (size_t)sizes[0] * sizeof *work);
    grid->way = (Way){way[0], way[1], way[2], way[3], way[4], (int64_t)way[5], (int64_t)way[6], most};
    grid->room = levels > 1 ? sizes[2] : 0;
    for (int64_t l = 0; l < levels; l++) {
        int64_t pixels = sizes[2 * l], parts = pixels + (l ? grid->room : 0);
        Level *at = grid->level + l;
        Shape shape = {pixels, sizes[2 * l + 1], cells, stretches};
        *at = (Level){.shape = shape, .parts = pixels, .parent = whole, .home = whole + parts + 1};
        whole += parts + 1;
        if (l) {
            at->link = (Link *)(whole + grid->room);
            whole += (1 + 3 * LINKS) * grid->room;
        }
        real **own[9] = {&at->across, &at->up, &at->down, &at->hold, &at->diagonal, &at->inverse, &at->x, &at->y, &at->right};
        for (int k = 0; k < 9; k++, singles += parts + 2) {
            singles[0] = 0;
            *own[k] = singles + 1;
        }
        cells += pixels;
        stretches += 4 * shape.stretches;
    }
    int64_t largest = grid->way.largest;
    grid->shapes = levels;
    grid->solved = work;
    grid->factor = work + largest;
    grid->place = whole;
    grid->first = whole + largest;
    grid->row = whole + 2 * largest;
    grid->scratch = whole + 3 * largest + 1;
    grid->table = grid->scratch + 3 * (sizes[0] + grid->room);
}

/* The equations whose weights are in the grid's `across` and `down`, with `hold` on the diagonal besides, on every level. */
void set_up(Grid *grid, const double *hold) {
    Level *at = grid->level;
    Shape shape = at->shape;
    for (int64_t s = 0; s < shape.stretches; s++) {
        const int32_t *stretch = shape.stretch + 4 * s;
        if (stretch[3] != stretch[0])
            for (int64_t k = 0; k < stretch[1]; k++) grid->up[stretch[3] + k] = grid->down[stretch[0] + k];
    }
    for (int64_t i = 0; i < shape.pixels; i++) {
        grid->diagonal[i] = hold[i] + ((grid->across[i] + grid->across[i - 1]) + (grid->up[i] + grid->down[i]));
        at->hold[i] = (real)hold[i];
        at->across[i] = (real)grid->across[i];
        at->down[i] = (real)grid->down[i];
    }
    at->x[at->parts] = at->y[at->parts] = 0;
    upwards(shape, at->down, at->up);
    diagonals(at);
    for (grid->last = 0; grid->last + 1 < grid->shapes && at->parts > grid->way.coarsest; grid->last++, at++) {
        int64_t n = at->parts;
        Sets sets = {grid->scratch, grid->scratch + n, grid->scratch + 2 * n, (Link *)grid->table, 0};
        held_together(at, (real)grid->way.strong, &sets);
        numbered(at, at + 1, grid->room, &sets);
        at[1].x[at[1].parts] = at[1].y[at[1].parts] = 0;
        joined(at, at + 1, LINKS * grid->room, grid->table);
        diagonals(at + 1);
    }
    grid->direct = at->parts <= grid->way.largest && factored(grid);
}
