/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes the rows of src/engine/patterns/data/ternary_quads.csv: the matrices N of the pattern ternary-quads, one for each
 * group of four dimensions from the second group on. A program of its own, run by hand, some minutes; the same bits on
 * every machine:
 *
 *     cc -O3 -std=c11 tools/make_ternary_quads.c -o /tmp/make_ternary_quads
 *     /tmp/make_ternary_quads
 *
 * Dimension 4 g + b has the generator matrix C_b N_g in base 3: the C_b (src/engine/patterns/ternary_quads.c has their
 * definition) make every group of four even, and N_g, upper triangular with ones on the diagonal, only decides in what
 * order. The search chooses the N_g so that dimensions of different groups are even in pairs. It takes the groups in
 * order and the columns of each in order: column c changes nothing in the first 3^c points. The value of a column is
 *
 *     sum over pairs (one dimension of an earlier group, one of this) and k of 3^d,
 *
 * where k and m - k rows of their matrices, m = c + 1 columns wide, have rank m - d; the pair that two groups have in
 * common (4 g - 1 and 4 g) counts as many times as there are earlier dimensions. Without column c each of these systems
 * has a space of dependencies y, at least one; the last column lowers d by one when it breaks one of them, which is an
 * affine condition on column c of N_g. Coordinate descent from random starts then minimises the sum.
 */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIM = 128, COLUMNS = 33, EARLY = 20, QUAD = 4, STARTS = 96, LATE_STARTS = 4 };

/* A vector over GF(3): bit i of `one` or `two` is set where entry i is 1 or 2. */
typedef struct trits {
    uint64_t one, two;
} trits;

static trits sum(trits a, trits b)
{
    const uint64_t t = (a.one | b.two) ^ (a.two | b.one);
    const trits s = {(a.two | b.two) ^ t, (a.one | b.one) ^ t};
    return s;
}

static trits times(trits a, unsigned factor)
{
    return factor == 0 ? (trits){0, 0} : factor == 1 ? a : (trits){a.two, a.one};
}

static unsigned at(trits a, int i)
{
    return (a.one >> i & 1) + 2 * (a.two >> i & 1);
}

static trits with(trits a, int i, unsigned value)
{
    const uint64_t bit = UINT64_C(1) << i;
    return (trits){(a.one & ~bit) | (value == 1 ? bit : 0), (a.two & ~bit) | (value == 2 ? bit : 0)};
}

static unsigned dot(trits a, trits b)
{
    const int same = __builtin_popcountll((a.one & b.one) | (a.two & b.two));
    const int other = __builtin_popcountll((a.one & b.two) | (a.two & b.one));
    return (unsigned)(same + 2 * other) % 3;
}

static trits quad[QUAD][COLUMNS];     /* row r of C_b */
static trits rows[MOST_DIM][COLUMNS]; /* row r of C_b N_g, as far as its columns are chosen */

static uint64_t state = 2026;

static uint64_t draw(void) /* splitmix64 */
{
    uint64_t z = state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

/* C_b for b < 3: powers of Pascal's matrix, row r the coefficients of 1/(x - b)^(r+1). C_3: rows 2 q and 2 q + 1 are
   x/p^(q+1) and 1/p^(q+1), p = x^2 - x - 1. */
static void make_quad(void)
{
    unsigned series[COLUMNS + 2] = {1};
    for (unsigned b = 0; b < 3; b++) {
        unsigned entry[COLUMNS][COLUMNS] = {{1}};
        for (int c = 0; c < COLUMNS; c++) {
            for (int r = 0; r <= c; r++) {
                if (c > 0) {
                    entry[r][c] = ((r > 0 ? entry[r - 1][c - 1] : 0) + b * (r < c ? entry[r][c - 1] : 0)) % 3;
                }
                quad[b][r] = with(quad[b][r], c, entry[r][c]);
            }
        }
    }
    for (int q = 0; 2 * q < COLUMNS; q++) {
        unsigned next[COLUMNS + 2] = {0};
        for (int i = 1; i < COLUMNS + 2; i++) {
            next[i] = next[i - 1] + (i > 1 ? series[i - 2] + next[i - 2] : 0);
            next[i] %= 3;
        }
        memcpy(series, next, sizeof series);
        for (int c = 0; c < COLUMNS; c++) {
            quad[3][2 * q] = with(quad[3][2 * q], c, series[c + 2]);
            if (2 * q + 1 < COLUMNS) {
                quad[3][2 * q + 1] = with(quad[3][2 * q + 1], c, series[c + 1]);
            }
        }
    }
}

/* Dependencies of one system: the column n breaks number i if base[i] + dot(slope[i], n) is not 0. */
typedef struct condition {
    uint32_t base;
    trits slope;
} condition;

typedef struct shape {
    int first, count; /* its conditions: it gains when one of them holds */
    double gain;
} shape;

static condition conditions[MOST_DIM * QUAD * COLUMNS * COLUMNS];
static shape shapes[MOST_DIM * QUAD * COLUMNS];
static int n_shapes, n_conditions;

/* Adds the system of k rows of dimension a and m - k rows of the b-th of the group at `first`. */
static void add_system(int a, int first, int b, int k, int c, double weight)
{
    const int m = c + 1;
    const uint64_t mask = (UINT64_C(1) << c) - 1;
    trits pivot[COLUMNS], track[COLUMNS];
    int has[COLUMNS] = {0};
    shape s = {n_conditions, 0, weight};
    for (int i = 0; i < m; i++) {
        trits row = i < k ? rows[a][i] : rows[first + b][i - k];
        trits y = {UINT64_C(1) << i, 0};
        row.one &= mask;
        row.two &= mask;
        while (row.one | row.two) {
            const int top = 63 - __builtin_clzll(row.one | row.two);
            if (!has[top]) {
                const unsigned inverse = at(row, top);
                pivot[top] = times(row, inverse);
                track[top] = times(y, inverse);
                has[top] = 1;
                break;
            }
            const unsigned factor = 3 - at(row, top);
            row = sum(row, times(pivot[top], factor));
            y = sum(y, times(track[top], factor));
        }
        if (!(row.one | row.two)) {
            condition d = {0, {0, 0}};
            for (int j = 0; j < m; j++) {
                if (j < k) {
                    d.base += at(y, j) * at(rows[a][j], c);
                } else {
                    d.slope = sum(d.slope, times(quad[b][j - k], at(y, j)));
                }
            }
            d.base = (d.base + at(d.slope, c)) % 3; /* the diagonal of N is 1 */
            d.slope = with(d.slope, c, 0);
            d.slope.one &= mask;
            d.slope.two &= mask;
            conditions[n_conditions++] = d;
            s.count++;
            s.gain *= s.count > 1 ? 3 : 2; /* 3^e - 3^(e-1) */
        }
    }
    shapes[n_shapes++] = s;
}

static double value(trits n)
{
    double total = 0;
    for (int s = 0; s < n_shapes; s++) {
        int broken = 0;
        for (int i = shapes[s].first; i < shapes[s].first + shapes[s].count && !broken; i++) {
            broken = (conditions[i].base + dot(conditions[i].slope, n)) % 3 != 0;
        }
        total += broken ? 0 : shapes[s].gain;
    }
    return total;
}

static trits search(int c)
{
    const int starts = c < EARLY ? STARTS : LATE_STARTS;
    trits best = {0, 0};
    double least = 0;
    for (int start = 0; start < starts; start++) {
        trits n = {0, 0};
        for (int i = 0; i < c; i++) {
            n = with(n, i, (unsigned)(draw() % 3));
        }
        double now = value(n);
        for (int idle = 0, i = 0; idle < c; i = (i + 1) % c) {
            idle++;
            for (unsigned v = 1; v <= 2; v++) {
                const trits other = with(n, i, (at(n, i) + v) % 3);
                const double then = value(other);
                if (then < now) {
                    now = then;
                    n = other;
                    idle = 0;
                    break;
                }
            }
        }
        if (start == 0 || now < least) {
            least = now;
            best = n;
        }
    }
    return best;
}

/* Chooses column c for the group at `first` and returns it. */
static trits choose(int first, int c)
{
    trits n = {0, 0};
    n_shapes = n_conditions = 0;
    for (int a = 0; a < first; a++) {
        for (int b = 0; b < QUAD; b++) {
            for (int k = 1; k <= c; k++) {
                add_system(a, first, b, k, c, a == first - 1 && b == 0 ? first : 1);
            }
        }
    }
    if (first > 0 && c > 0) {
        n = search(c);
    }
    n = with(n, c, 1);
    for (int b = 0; b < QUAD; b++) {
        for (int r = 0; r <= c; r++) {
            rows[first + b][r] = with(rows[first + b][r], c, dot(quad[b][r], n));
        }
    }
    return n;
}

/* Chooses columns from .. end - 1 for all groups, and prints those of the groups from the second on. The columns above
   EARLY have fewer starts, because a search among so many rows takes long. */
static void choose_columns(int dims, int from, int end)
{
    char separator = ',';
    for (int first = 0; first < dims; first += QUAD) {
        for (int c = from; c < end; c++) {
            const trits n = choose(first, c);
            uint64_t number = 0;
            for (int r = c - 1; r >= 0; r--) {
                number = 3 * number + at(n, r);
            }
            if (first > 0 && c > 0) {
                printf("%c%" PRIu64, separator, number);
                separator = ' ';
            }
        }
        fprintf(stderr, "%d\n", first);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    const int dims = argc > 1 ? atoi(argv[1]) : MOST_DIM;
    make_quad();
    printf("early");
    choose_columns(dims, 0, EARLY);
    printf("late");
    choose_columns(dims, EARLY, COLUMNS);
    return 0;
}
