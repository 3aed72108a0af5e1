/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes a row of src/engine/patterns/data/sobol.csv: direction numbers of Sobol' sequences (sobol:numbers=groups) whose
 * consecutive pairs and quadruples are even in all prefixes of 2^m points, m = 4 .. 12. A program of its own, run by
 * hand, some ten minutes; the same bits on every machine:
 *
 *     cc -O3 -std=c11 -ffp-contract=off -Iinclude tools/make_sobol_groups.c build/release/src/libkoksma.a -lm -pthread \
 *         -o /tmp/make_sobol_groups
 *     /tmp/make_sobol_groups
 *
 * Dimension k has the primitive polynomial number k, in the order of Joe & Kuo: by degree, then by value. The initial
 * numbers m_2 .. m_s of four dimensions at a time, 4 g .. 4 g + 3, are searched by threshold accepting, which flips one
 * bit of one number; all earlier dimensions stay. Smaller is better:
 *
 *     E = sum over m of 2 P(first pair) + 2 P(second pair) + 1/2 sum of the other four P + 3 Q
 *                       + P(the last dimension of the group before, the first of this one) + mean P(earlier, each of these)
 *     P = mean of 2^d - 1 over the elementary intervals k_1 + k_2 = m of a pair; Q the same of k_1 + ... + k_4 = m
 *
 * d is the rank that is lacking: the first k_j rows of matrix j, all dimensions together, are m rows of m bits, and
 * where these have rank m - d, only 2^-d of the intervals of that shape have points, 2^d each. P = 0 is t = 0.
 * The best of RESTARTS is refined, once the star discrepancies D* of its two pairs, measured exactly, and those of the
 * quadruple for up to 2^MOST_STAR_4D points, count, too: three times each, in units of the first pair and quadruple.
 */
#include <koksma/koksma.h>
#include <koksma/sampler.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIM = 128, LEAST_M = 4, MOST_M = 12, GROUP = 4, MOST_STAR_4D = 6, RESTARTS = 4 };

static uint64_t counter;

static uint32_t below(uint32_t n)
{
    uint32_t w[4];
    koksma_words(2026, KOKSMA_FOR_POINT, counter++, 0, w);
    return (uint32_t)((uint64_t)w[0] * n >> 32);
}

/* ---- Matrices ---------------------------------------------------------------------------------------------- */

typedef struct numbers {
    uint32_t polynomial;
    int degree;
    uint32_t m[16];
} numbers;

/* Row r of the first MOST_M columns: bit b is the digit of column b. */
typedef struct matrix {
    uint32_t row[MOST_M];
} matrix;

static numbers table[MOST_DIM];
static matrix matrices[MOST_DIM];

static int is_primitive(uint32_t polynomial, int degree)
{
    uint32_t x = 1, order = 0;
    do {
        x <<= 1;
        x ^= x >> degree & 1 ? polynomial : 0;
        order++;
    } while (x > 1);
    return x == 1 && order == (1u << degree) - 1;
}

static void make_polynomials(void)
{
    uint32_t polynomial = 3;
    for (int k = 1; k < MOST_DIM; polynomial += 2) {
        int degree = 0;
        while (polynomial >> (degree + 1)) {
            degree++;
        }
        if (is_primitive(polynomial, degree)) {
            table[k++] = (numbers){polynomial, degree, {1}};
        }
    }
}

/* Columns by the recurrence of Sobol' (1967), as in src/engine/patterns/nets/sobol_table.c; then their rows. */
static void expand(const numbers *n, matrix *out)
{
    uint32_t columns[MOST_M];
    memset(out, 0, sizeof *out);
    for (int i = 0; i < MOST_M; i++) {
        if (i < n->degree || n->degree == 0) {
            columns[i] = (n->degree ? n->m[i] : 1) << (MOST_M - 1 - i);
        } else {
            columns[i] = columns[i - n->degree] ^ columns[i - n->degree] >> n->degree;
            for (int j = 1; j < n->degree; j++) {
                columns[i] ^= n->polynomial >> (n->degree - j) & 1 ? columns[i - j] : 0;
            }
        }
        for (int r = 0; r < MOST_M; r++) {
            out->row[r] |= (columns[i] >> (MOST_M - 1 - r) & 1) << i;
        }
    }
}

/* ---- Elementary intervals ---------------------------------------------------------------------------------- */

typedef struct basis {
    uint32_t at[MOST_M]; /* the vector whose highest bit is this one, or 0 */
    int lacking;
} basis;

static void insert(basis *b, uint32_t v)
{
    while (v) {
        const int top = 31 - __builtin_clz(v);
        if (!b->at[top]) {
            b->at[top] = v;
            return;
        }
        v ^= b->at[top];
    }
    b->lacking++;
}

typedef struct sum {
    double total, shapes;
} sum;

/* Adds 2^d - 1 of all shapes that cut `left` further times along the last `dims` dimensions. */
static void shapes(const matrix *const *of, int dims, uint32_t mask, int left, basis b, sum *out)
{
    if (dims == 1) {
        for (int r = 0; r < left; r++) {
            insert(&b, of[0]->row[r] & mask);
        }
        out->total += (double)((1u << b.lacking) - 1);
        out->shapes += 1;
        return;
    }
    for (int k = 0; k <= left; k++) {
        shapes(of + 1, dims - 1, mask, left - k, b, out);
        if (k < left) {
            insert(&b, of[0]->row[k] & mask);
        }
    }
}

static double uneven(const matrix *const *of, int dims)
{
    double total = 0;
    for (int m = LEAST_M; m <= MOST_M; m++) {
        const basis empty = {{0}, 0};
        sum all = {0, 0};
        shapes(of, dims, (1u << m) - 1, m, empty, &all);
        total += all.total / all.shapes;
    }
    return total;
}

static double pair(const matrix *a, const matrix *b)
{
    const matrix *of[2] = {a, b};
    return uneven(of, 2);
}

/* ---- Groups ------------------------------------------------------------------------------------------------ */

typedef struct group {
    int first;
    numbers n[GROUP];
    matrix x[GROUP];
    double pairs[GROUP][GROUP], before[GROUP], quadruple;
} group;

/* Brings the group up to date after a change of dimension c of it. */
static void change(group *g, int c)
{
    const matrix *of[GROUP];
    expand(&g->n[c], &g->x[c]);
    for (int k = 0; k < GROUP; k++) {
        of[k] = &g->x[k];
        if (k != c) {
            g->pairs[k < c ? k : c][k < c ? c : k] = pair(&g->x[k], &g->x[c]);
        }
    }
    g->quadruple = uneven(of, GROUP);
    g->before[c] = 0;
    for (int j = 0; j < g->first; j++) {
        const double p = pair(&matrices[j], &g->x[c]);
        g->before[c] += p / g->first + (c == 0 && j == g->first - 1 ? p : 0);
    }
}

static double energy(const group *g)
{
    double e = 3 * g->quadruple;
    for (int b = 0; b < GROUP; b++) {
        for (int a = 0; a < b; a++) {
            e += (b % 2 && a == b - 1 ? 2 : 0.5) * g->pairs[a][b];
        }
        e += g->before[b];
    }
    return e;
}

/* Sum over m of D* of the dimensions a .. a + dims - 1 of the group, in units of `units` (which it sets if `set`). */
static double star(const group *g, int a, int dims, int most, double *units, int set)
{
    koksma_spec spec;
    double total = 0;
    if (koksma_measure_spec("star", &spec)) {
        exit(4);
    }
    for (int m = LEAST_M; m <= most; m++) {
        koksma_points points;
        koksma_value value;
        if (koksma_points_init(&points, (size_t)1 << m, dims)) {
            exit(4);
        }
        for (uint32_t i = 0; i < 1u << m; i++) {
            for (int k = 0; k < dims; k++) {
                double x = 0;
                for (int r = 0; r < MOST_M; r++) {
                    x += __builtin_parity(g->x[a + k].row[r] & i) / (double)(2u << r);
                }
                points.xs[i * (size_t)dims + (size_t)k] = x;
            }
        }
        if (koksma_evaluate(&spec, &points, NULL, &value)) {
            exit(4);
        }
        units[m] = set ? value.value : units[m];
        total += value.value / units[m];
        koksma_points_fini(&points);
    }
    return total;
}

static double stars(const group *g)
{
    static double pairs[MOST_M + 1], quadruples[MOST_M + 1];
    const int set = pairs[LEAST_M] == 0; /* the first group is measured first */
    return 3 * star(g, 0, 2, MOST_M, pairs, set) + 3 * star(g, 2, 2, MOST_M, pairs, 0) +
           3 * star(g, 0, GROUP, MOST_STAR_4D, quadruples, set);
}

static int flip(group *g)
{
    const int c = (int)below(GROUP);
    if (g->n[c].degree < 2) {
        return 0;
    }
    const int i = 1 + (int)below((uint32_t)g->n[c].degree - 1);
    g->n[c].m[i] ^= 2u << below((uint32_t)i);
    change(g, c);
    return 1;
}

/* Threshold accepting; the threshold falls linearly from `start` to 0. */
static double search(group *g, int steps, double start, int with_stars)
{
    double now = energy(g) + (with_stars ? stars(g) : 0), best = now;
    group least = *g;
    for (int i = 0; i < steps; i++) {
        const group old = *g;
        if (!flip(g)) {
            continue;
        }
        const double threshold = start * (steps - i) / steps;
        double then = energy(g);
        if (with_stars && then <= now + threshold) { /* D* is the dear part, and never negative */
            then += stars(g);
        }
        if (then > now + threshold) {
            *g = old;
            continue;
        }
        now = then;
        if (now < best) {
            best = now;
            least = *g;
        }
    }
    *g = least;
    return best;
}

static void search_group(int first, int steps, int refinements)
{
    double least = 0;
    group best;
    for (int s = 0; s < RESTARTS; s++) {
        group g = {.first = first};
        for (int c = 0; c < GROUP; c++) {
            g.n[c] = table[first + c];
            for (int i = 1; i < g.n[c].degree; i++) {
                g.n[c].m[i] = 1 | below(1u << i) << 1;
            }
        }
        for (int c = 0; c < GROUP; c++) {
            expand(&g.n[c], &g.x[c]);
        }
        for (int c = 0; c < GROUP; c++) {
            change(&g, c);
        }
        const double e = search(&g, steps, 6, 0);
        if (s == 0 || e < least) {
            least = e;
            best = g;
        }
    }
    const double before = energy(&best), stars_before = stars(&best);
    search(&best, refinements, 0.5, 1);
    fprintf(stderr, "%d: E %.2f, D* %.2f; refined %.2f, %.2f\n", first, before, stars_before, energy(&best),
            stars(&best));
    for (int c = 0; c < GROUP; c++) {
        table[first + c] = best.n[c];
        matrices[first + c] = best.x[c];
    }
}

int main(int argc, char **argv)
{
    const int dims = argc > 1 ? atoi(argv[1]) : MOST_DIM, steps = argc > 2 ? atoi(argv[2]) : 8000;
    make_polynomials();
    for (int first = 0; first < dims; first += GROUP) {
        search_group(first, steps, steps / 16);
    }
    for (int k = 1; k < dims; k++) {
        printf("%s%u", k == 1 ? "groups," : " ", table[k].polynomial);
        for (int i = 0; i < table[k].degree; i++) {
            printf(" %u", table[k].m[i]);
        }
    }
    printf("\n");
    return 0;
}
