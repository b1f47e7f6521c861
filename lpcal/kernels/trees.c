/* Sums of decision trees. Twin: segmentation/background.py (Trees._summed). Clues are (P, C); trees are nodes that ask for a clue, -1 at a leaf. */

#include "kernel.h"

KERNEL void lpcal_trees(int64_t pixels, int64_t clues, int64_t trees, const double *clue, const int64_t *root, const int64_t *asked,
                        const int64_t *left, const int64_t *right, const double *threshold, const double *leaf, double *total) {
    for (int64_t p = 0; p < pixels; p++) {
        const double *here = clue + clues * p;
        double sum = total[p];
        for (int64_t t = 0; t < trees; t++) {
            int64_t node = root[t];
            while (asked[node] >= 0) node = here[asked[node]] <= threshold[node] ? left[node] : right[node];
            sum += leaf[node];
        }
        total[p] = sum;
    }
}
