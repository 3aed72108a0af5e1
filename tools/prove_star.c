/* SPDX-License-Identifier: Apache-2.0 */
/*
 * prove_star N VALUE: proves that no N points in the plane have a star discrepancy below VALUE, and prints the proof, which
 * tests/optimise/check_star.py checks and defines. Exit code 1 if a permutation is found that may have less.
 *
 * Branch and bound over the ranks by y of the points in order of x (the constraints:
 * src/engine/optimise/method_star_plane.c). Of a prefix of length k the counts c(i,j), i <= k, are known and others
 * bounded, so that with F = n f
 *
 *     X_i Y_j >= low(i,j) - F,   X_i' Y_j' <= high(i'-1,j'-1) + F,   X and Y increasing,   X_n+1 Y_n+1 = n.
 *
 * The first with the second, j <= j', bounds X_i' by X_i: a graph of n + 1 nodes. A cycle of it with a product below 1
 * refutes all permutations with this prefix, and is printed (a cut); else the next rank is branched on. A transposed
 * permutation has the same discrepancy: prefixes with rank 1 at a position before p(1) are left out. Cycles found lately
 * are tried first. Cuts count only if their logarithms sum up to less than -MARGIN, so that rounding decides nothing.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX = 32, RECENT = 64 };
static const double MARGIN = 1e-12;

typedef struct cut {
    int edges, at[MAX][4]; /* i, j, i', j' of each */
} cut;

static int n, rank[MAX], prefix[MAX][MAX];        /* prefix[k][j]: of the first k points, those of rank up to j */
static double F, over[MAX][MAX], under[MAX][MAX]; /* the logarithms of the right sides; over: -HUGE_VAL for none */
static cut recent[RECENT];
static unsigned long cuts, branches;

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* How many of the first i points have rank up to j, at least or at most, after k ranks are known. */
static int count(int k, int i, int j, bool most)
{
    i = smaller(i, n);
    j = smaller(j, n);
    if (i <= k) {
        return prefix[i][j];
    }
    const int left = j - prefix[k][j], forced = left - (n - i);
    return prefix[k][j] + (most ? smaller(i - k, left) : forced > 0 ? forced : 0);
}

static void fill(int k)
{
    for (int i = 1; i <= n + 1; i++) {
        for (int j = 1; j <= n + 1; j++) {
            const bool outer = i == n + 1 && j == n + 1;
            const double a = outer ? n : count(k, i, j, false) - F;
            over[i][j] = a > 0 ? log(a) : -HUGE_VAL;
            under[i][j] = log(outer ? n : count(k, i - 1, j - 1, true) + F);
        }
    }
}

static bool refutes(const cut *c)
{
    double sum = 0;
    for (int e = 0; e < c->edges; e++) {
        sum += under[c->at[e][2]][c->at[e][3]] - over[c->at[e][0]][c->at[e][1]];
    }
    return c->edges > 0 && sum < -MARGIN;
}

/* weight[i][t]: the least log X_t - log X_i that is allowed; from[i][t] the constraints, of i' >= t. */
static void weigh(double weight[MAX][MAX], int from[MAX][MAX][4])
{
    for (int i = 1; i <= n + 1; i++) {
        for (int t = n + 1; t >= 1; t--) {
            weight[i][t] = t <= n ? weight[i][t + 1] : HUGE_VAL;
            memcpy(from[i][t], from[i][t + (t <= n)], sizeof from[i][t]);
            double least = HUGE_VAL;
            int at = n + 1;
            for (int j = n + 1; j >= 1; j--) {
                if (under[t][j] < least) {
                    least = under[t][j];
                    at = j;
                }
                if (least - over[i][j] < weight[i][t]) {
                    weight[i][t] = least - over[i][j];
                    memcpy(from[i][t], (int[]){i, j, t, at}, sizeof from[i][t]);
                }
            }
        }
    }
}

/* A cycle of negative weight (Bellman & Ford). */
static bool find_cut(cut *out)
{
    static double weight[MAX][MAX];
    static int from[MAX][MAX][4];
    double x[MAX] = {0};
    int parent[MAX] = {0}, moved = 0;
    weigh(weight, from);
    for (int round = 0; round <= n + 1; round++) {
        moved = 0;
        for (int i = 1; i <= n + 1; i++) {
            for (int t = 1; t <= n + 1; t++) {
                if (x[i] + weight[i][t] < x[t] - MARGIN) {
                    x[t] = x[i] + weight[i][t];
                    parent[t] = i;
                    moved = t;
                }
            }
        }
        if (!moved) {
            return false;
        }
    }
    for (int step = 0; step <= n; step++) {
        moved = parent[moved];
    }
    *out = (cut){0};
    for (int t = moved, i = parent[t]; out->edges == 0 || t != moved; t = i, i = parent[t]) {
        memcpy(out->at[out->edges++], from[i][t], sizeof from[i][t]);
    }
    for (int e = 0; e < out->edges / 2; e++) { /* they were found from the last to the first */
        int swapped[4];
        memcpy(swapped, out->at[e], sizeof swapped);
        memcpy(out->at[e], out->at[out->edges - 1 - e], sizeof swapped);
        memcpy(out->at[out->edges - 1 - e], swapped, sizeof swapped);
    }
    return refutes(out);
}

static void print_cut(const cut *c)
{
    putchar('c');
    for (int e = 0; e < c->edges; e++) {
        printf(" %d %d %d %d", c->at[e][0], c->at[e][1], c->at[e][2], c->at[e][3]);
    }
    putchar('\n');
    cuts++;
}

static bool is_cut(int k)
{
    cut c = {0};
    fill(k);
    for (int r = 0; r < RECENT && !c.edges; r++) {
        if (refutes(&recent[r])) {
            c = recent[r];
            memmove(recent + 1, recent, (size_t)r * sizeof c);
            recent[0] = c;
        }
    }
    if (!c.edges) {
        if (!find_cut(&c)) {
            return false;
        }
        memmove(recent + 1, recent, (RECENT - 1) * sizeof c);
        recent[0] = c;
    }
    print_cut(&c);
    return true;
}

/* Proves it for all permutations that begin with the k ranks; one by one the children of a branch, by rank. */
static void prove(int k)
{
    if (k > 1 && rank[k] == 1 && k < rank[1]) {
        puts("m");
        return;
    }
    if (is_cut(k)) {
        return;
    }
    if (k == n) {
        fprintf(stderr, "prove_star: not proved for the permutation");
        for (int i = 1; i <= n; i++) {
            fprintf(stderr, " %d", rank[i]);
        }
        fputc('\n', stderr);
        exit(1);
    }
    puts("b");
    branches++;
    for (int r = 1; r <= n; r++) {
        if (prefix[k][r] == prefix[k][r - 1]) {
            rank[k + 1] = r;
            for (int j = 0; j <= n; j++) {
                prefix[k + 1][j] = prefix[k][j] + (j >= r);
            }
            prove(k + 1);
        }
    }
}

int main(int argc, char **argv)
{
    n = argc == 3 ? atoi(argv[1]) : 0;
    const double value = argc == 3 ? atof(argv[2]) : 0;
    if (n < 1 || n > MAX - 2 || !(value > 0 && value < 1)) {
        fprintf(stderr, "usage: prove_star N VALUE; 1 to %d points, a value in (0, 1)\n", MAX - 2);
        return 2;
    }
    F = n * value;
    printf("star-plane %d %s\n", n, argv[2]);
    prove(0);
    fprintf(stderr, "%d points: at least %s; %lu branches, %lu cuts\n", n, argv[2], branches, cuts);
    return ferror(stdout) || fflush(stdout) ? 4 : 0;
}
