/* Levels of a masked matrix, from fine to coarse (multigrid.c, aggregates.c).

   Level 0 holds the pixels of the mask, and level l + 1 what aggregates of level l make. Most unknowns are the pixels of a picture, fine or
   coarse, numbered row by row, and touch those beside, above and below them alone: the right neighbour is the next number, and those above
   and below lie side by side along stretches of a row. Where the unknowns within a coarse pixel hardly hold together, as on both sides of a
   break, it has several parts. The largest stands in the picture; the others are numbered behind the pixels, and have links of their own.
   Vectors have a number more at both ends. */

#include "kernel.h"

typedef float real;

/* What the mask alone says of a level. */
typedef struct {
    int64_t pixels, stretches;
    const int32_t *cell;    /* of each pixel: the coarse pixel that it lies in */
    const int32_t *stretch; /* (stretches, 4): first pixel, how many, the first one above and below them; their own first where none is */
} Shape;

typedef struct {
    int32_t a, b;
    real weight;
} Link;

typedef struct {
    Shape shape;
    int64_t parts, links; /* unknowns, pixels first; links between any two besides the pixels' own */
    int32_t *parent;      /* of each unknown, on the next coarser level */
    int32_t *home;        /* of each part behind the pixels: the pixel that it lies in */
    Link *link;
    real *across, *up, *down, *hold, *diagonal, *inverse; /* weights to the next pixel, to those above and below; 1 over the diagonal */
    real *x, *y, *right;
} Level;

/* How the equations are solved. */
typedef struct {
    double first, second, over; /* shares of the two steps that smooth, factor of what a coarser level says */
    double strong;              /* least share of the largest weight of either end by which an edge holds an aggregate together */
    double rounding;            /* raise of the coarsest diagonal */
    int64_t coarsest, largest;  /* unknowns at most of a level that is not made coarser, and of one that is solved directly */
    int64_t most;               /* steps of the conjugate gradients */
} Way;

typedef struct {
    Level level[64];
    int64_t shapes, last, room; /* levels that the mask has, the coarsest in use, parts behind the pixels that a level has room for */
    double *factor;             /* Cholesky factor of the coarsest matrix, rows one behind the other, each from its first number that is not 0 */
    int32_t *scratch, *table, *place, *first, *row; /* place of each unknown in the factor; of each of its rows: first column, begin */
    bool direct;                                    /* whether there is a factor; else the diagonal stands for the coarsest matrix */
    Way way;
    double *across, *up, *down, *diagonal, *image, *residual, *direction, *guess, *solved; /* of the finest, in doubles */
} Grid;

#define LINKS 6 /* links that a level has room for, a part behind its pixels: in the plane there are no more (library.py) */

void laid_out(Grid *grid, int64_t levels, const int64_t *sizes, const int32_t *cells, const int32_t *stretches, double *work, real *singles,
              int32_t *whole, int64_t most, const double *way);
void set_up(Grid *grid, const double *hold);
void solved_directly(const Grid *grid);
