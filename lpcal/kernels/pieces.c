/* Connected components of a graph of pixels. Twin: integration/pieces.py (_connected). */

#include "kernel.h"

static int64_t first_of(int64_t *of, int64_t p) {
    while (of[p] != p) p = of[p] = of[of[p]];
    return p;
}

/* Labels (P) from 0 of the components connected by the unbroken edges a, b, in the order of their first
   pixels (sets by union, halving the paths: Tarjan and van Leeuwen 1984). */
KERNEL void lpcal_connected(int64_t P, int64_t edges, const int64_t *a, const int64_t *b, const bool *is_whole, int64_t *label) {
    for (int64_t p = 0; p < P; p++) label[p] = p;
    for (int64_t e = 0; e < edges; e++) {
        if (!is_whole[e]) continue;
        int64_t one = first_of(label, a[e]), other = first_of(label, b[e]);
        if (one < other) label[other] = one;
        else label[one] = other;
    }
    int64_t count = 0;
    for (int64_t p = 0; p < P; p++) /* the first pixel of a set comes before its others, and by then holds its label, as all before p do */
        label[p] = label[p] == p ? count++ : label[label[p]];
}
