/* The cheapest cut of a grid of pixels in two, by augmenting paths between two trees that are kept (Boykov and Kolmogorov 2004, IEEE Trans.
   Pattern Analysis and Machine Intelligence 26), after a sweep each way. Twin: integration/cuts.py, by scipy.sparse.csgraph.maximum_flow. */

#include "kernel.h"

enum { FREE, SOURCE, SINK };               /* what tree a pixel is of */
enum { NOWHERE = 6, TERMINAL = 4, LOST };  /* where a pixel hangs, beside the four ways to its neighbours */

typedef struct {
    int64_t pixels;
    const int32_t *beside; /* (4, P) neighbours to the right, left, below and above; -1: none */
    double *left;          /* (4, P) what may still flow from a pixel that way */
    double *ends;          /* (P,) what may still flow from the source, or less than 0: to the sink */
    int32_t *next;         /* the queue of pixels that may grow; -1: not in it, a pixel itself: the last */
    int32_t *lost;         /* pixels whose way to their terminal has been cut, as a stack */
    int32_t *away, *seen;  /* arcs to the terminal, and when that was known */
    int8_t *tree, *way;
    int64_t first, last, losses;
    int32_t now;
} Graph;

static void may_grow(Graph *g, int64_t p) {
    if (g->next[p] >= 0) return;
    g->next[p] = (int32_t)p;
    if (g->last >= 0)
        g->next[g->last] = (int32_t)p;
    else
        g->first = p;
    g->last = p;
}

static int64_t growing(Graph *g) {
    while (g->first >= 0) {
        int64_t p = g->first, after = g->next[p];
        if (g->tree[p] != FREE) return p;
        g->next[p] = -1;
        g->first = after == p ? -1 : after;
        if (after == p) g->last = -1;
    }
    return -1;
}

static void grown(Graph *g, int64_t p) {
    int64_t after = g->next[p];
    g->next[p] = -1;
    g->first = after == p ? -1 : after;
    if (after == p) g->last = -1;
}

/* What may flow along the arc between a pixel and its neighbour in way d, in the direction of its tree: away from the source, to the sink. */
static double *arc(Graph *g, int64_t p, int d, bool outwards) {
    return outwards ? &g->left[d * g->pixels + p] : &g->left[(d ^ 1) * g->pixels + g->beside[d * g->pixels + p]];
}

static void lose(Graph *g, int64_t p) {
    g->way[p] = LOST;
    g->lost[g->losses++] = (int32_t)p;
}

/* Lets as much flow as a path holds: up from p, of the source's tree, through way d, and on from there to the sink. */
static void augment(Graph *g, int64_t p, int d) {
    int64_t n = g->pixels, q = g->beside[d * n + p];
    double most = g->left[d * n + p];
    for (int side = 0; side < 2; side++) {
        int64_t x = side ? q : p;
        for (; g->way[x] != TERMINAL; x = g->beside[g->way[x] * n + x]) {
            double here = *arc(g, x, g->way[x], side);
            if (here < most) most = here;
        }
        if (fabs(g->ends[x]) < most) most = fabs(g->ends[x]);
    }
    g->left[d * n + p] -= most;
    g->left[(d ^ 1) * n + q] += most;
    for (int side = 0; side < 2; side++) {
        int64_t x = side ? q : p;
        while (g->way[x] != TERMINAL) {
            int up = g->way[x];
            int64_t parent = g->beside[up * n + x];
            *arc(g, x, up, side) -= most;
            *arc(g, x, up, !side) += most;
            if (!(*arc(g, x, up, side) > 0)) lose(g, x);
            x = parent;
        }
        g->ends[x] += side ? most : -most;
        if (!(fabs(g->ends[x]) > 0)) lose(g, x);
    }
}

/* Arcs from a pixel to its terminal; -1 where its way leads to a lost pixel. */
static int64_t reach(Graph *g, int64_t p) {
    int64_t n = g->pixels, x = p, count = 0;
    while (g->seen[x] != g->now && g->way[x] != TERMINAL) {
        if (g->way[x] == LOST || g->way[x] == NOWHERE) return -1;
        x = g->beside[g->way[x] * n + x];
        count++;
    }
    int64_t found = count + (g->seen[x] == g->now ? g->away[x] : 1);
    int64_t far = found;
    for (x = p; g->seen[x] != g->now; x = g->beside[g->way[x] * n + x]) {
        g->seen[x] = g->now;
        g->away[x] = (int32_t)far--;
        if (g->way[x] == TERMINAL) break;
    }
    return found;
}

/* Hangs a lost pixel on the neighbour that is nearest to the terminal, or frees it and what hangs on it. */
static void adopt(Graph *g, int64_t p) {
    int64_t n = g->pixels, nearest = -1;
    int best = NOWHERE;
    bool outwards = g->tree[p] == SINK;
    for (int d = 0; d < 4; d++) {
        int64_t q = g->beside[d * n + p];
        if (q < 0 || g->tree[q] != g->tree[p] || !(*arc(g, p, d, outwards) > 0)) continue;
        int64_t far = reach(g, q);
        if (far >= 0 && (nearest < 0 || far < nearest)) nearest = far, best = d;
    }
    if (nearest >= 0) {
        g->way[p] = (int8_t)best;
        g->seen[p] = g->now;
        g->away[p] = (int32_t)nearest + 1;
        return;
    }
    for (int d = 0; d < 4; d++) {
        int64_t q = g->beside[d * n + p];
        if (q < 0 || g->tree[q] != g->tree[p]) continue;
        if (*arc(g, p, d, outwards) > 0) may_grow(g, q);
        if (g->way[q] == (d ^ 1)) lose(g, q);
    }
    g->tree[p] = FREE;
    g->way[p] = NOWHERE;
}

/* The first neighbour that p's tree takes, or the way on which it meets the other tree; NOWHERE: it has grown. */
static int grow(Graph *g, int64_t p) {
    int64_t n = g->pixels;
    bool outwards = g->tree[p] == SOURCE;
    for (int d = 0; d < 4; d++) {
        int64_t q = g->beside[d * n + p];
        if (q < 0 || !(*arc(g, p, d, outwards) > 0)) continue;
        if (g->tree[q] == FREE) {
            g->tree[q] = g->tree[p];
            g->way[q] = (int8_t)(d ^ 1);
            g->seen[q] = g->seen[p];
            g->away[q] = g->away[p] + 1;
            may_grow(g, q);
        } else if (g->tree[q] != g->tree[p]) {
            return d;
        }
    }
    return NOWHERE;
}

/* Lets what pixels gain by being 1 flow to their neighbours one way, as much as may, on through those that lose less by it. Any such flow
   leaves the cheapest cuts as they are; most of it ends a few pixels on, which takes trees five times as long. */
static void sweep(Graph *g, int d) {
    int64_t n = g->pixels;
    const int32_t *beside = g->beside + d * n;
    double *left = g->left + d * n, *back = g->left + (d ^ 1) * n;
    for (int64_t i = 0; i < n; i++) {
        int64_t p = d & 1 ? n - 1 - i : i; /* to the right and down from the first pixel on, to the left and up from the last */
        double most = g->ends[p] < left[p] ? g->ends[p] : left[p];
        if (!(most > 0)) continue;
        left[p] -= most;
        back[beside[p]] += most;
        g->ends[p] -= most;
        g->ends[beside[p]] += most;
    }
}

/* Which pixels (P,) are cut off on the side of 1, where being so costs `ends` (P,) and a neighbour's being so alone `left`: (4, P), what
   it costs that a pixel is 1 and its neighbour `beside` (4, P) that way is 0. `number` (4, P) and `small` (2, P) hold the trees. */
KERNEL void lpcal_cheapest_cut(int64_t P, const int32_t *beside, double *left, double *ends, int32_t *number, int8_t *small, bool *is_one) {
    Graph g = {P, beside, left, ends, number, number + P, number + 2 * P, number + 3 * P, small, small + P, -1, -1, 0, 0};
    for (int64_t p = 0; p < P; p++) ends[p] = -ends[p]; /* what it gains to be 1 flows from the source */
    for (int d = 0; d < 4; d++) sweep(&g, d);
    for (int64_t p = 0; p < P; p++) {
        g.next[p] = -1;
        g.seen[p] = 0;
        g.away[p] = 1;
        g.tree[p] = ends[p] > 0 ? SOURCE : ends[p] < 0 ? SINK : FREE;
        g.way[p] = g.tree[p] == FREE ? NOWHERE : TERMINAL;
    }
    for (int64_t p = 0; p < P; p++)
        if (g.tree[p] != FREE) may_grow(&g, p);
    for (int64_t p; (p = growing(&g)) >= 0;) {
        int d = grow(&g, p);
        if (d == NOWHERE) {
            grown(&g, p);
            continue;
        }
        g.now++;
        if (g.tree[p] == SOURCE)
            augment(&g, p, d);
        else
            augment(&g, g.beside[d * P + p], d ^ 1);
        while (g.losses) adopt(&g, g.lost[--g.losses]);
    }
    for (int64_t p = 0; p < P; p++) is_one[p] = g.tree[p] == SOURCE;
}
