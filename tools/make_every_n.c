/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes the tables src/engine/patterns/data/every_n_*.inc of the pattern every-n: sequences of 1,024 points that are
 * even in all their prefixes. Run by hand; equal arguments and an equal first table give the same bits on every machine:
 *
 *     cc -O3 -std=gnu11 -ffp-contract=off -Isrc/engine tools/make_every_n.c -lm -o /tmp/make_every_n
 *     /tmp/make_every_n l2 3 0 600 1 </dev/null >/tmp/every_n_3d.inc
 *     /tmp/make_every_n star src/engine/patterns/data/records.csv 128 3000000 1 <every_n_2d.inc >/tmp/every_n_2d.inc
 *
 *     l2 DIM FIXED SWEEPS SEED       completes the table of standard input point by point, each where the L2 star
 *                                    discrepancy of the points so far becomes small, and then anneals all points but
 *                                    the first FIXED to a small mean of (L2(n) / greedy L2(n))^2 over n = 3 .. 1024
 *     star RECORDS N PROPOSALS SEED  anneals the first N points of a table of the plane to a small mean of
 *                                    D*(n) / record(n) over n = 8 .. N, with a penalty on ratios above 2.15
 *
 * SIGINT ends a search early; the table is written all the same. A further run continues from it.
 *
 * l2: the sum over n of w_n L2(n)^2 is a sum over pairs, sum_ij W(max(i, j)) K(x_i, x_j), W(m) = sum_{n >= m} w_n / n^2
 * (Warnock 1972), less a sum over points. In one coordinate of one point it is piecewise quadratic, with its minima inside
 * pieces; one is drawn by its Boltzmann weight at a falling temperature (a Gibbs sampler), at the end the least.
 *
 * star: Metropolis moves of a coordinate or a point. A move of point i changes the prefixes beyond i. The boxes where their
 * discrepancies are reached bound the new ones from below, which rejects many moves; the others are computed exactly,
 * in O(n^2) for each prefix.
 */
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"

enum { N = 1024, MOST_DIM = 4, MOST_STAR = 256, FROM = 8, STEPS = 6, STARTS = 8 };

static const double UNIT = 0x1p24; /* coordinates are whole multiples of 1 / UNIT in the table */

static int dim;
static double x[N][MOST_DIM];
static uint64_t state;
static volatile sig_atomic_t ended;

static void end(int number)
{
    (void)number;
    ended = 1;
}

static uint64_t draw(void) /* splitmix64 */
{
    uint64_t z = state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static double unit(void)
{
    return (double)(draw() >> 11) * 0x1p-53;
}

static double clamped(double t)
{
    return fmin(fmax(t, 0), 1 - 1 / UNIT);
}

/* ---- L2 star discrepancies of all prefixes ---------------------------------------------------------------- */

static double linear_weight[N], pair_weight[N]; /* sum_{n > i} w_n / n and w_n / n^2 */

/* Returns the integral of the boxes that contain a and b, and that of the volumes of the boxes that contain a. */
static double both_in(const double *a, const double *b)
{
    double p = 1;
    for (int k = 0; k < dim; k++) {
        p *= 1 - fmax(a[k], b[k]);
    }
    return p;
}

static double volume_in(const double *a)
{
    double p = 1;
    for (int k = 0; k < dim; k++) {
        p *= (1 - a[k] * a[k]) / 2;
    }
    return p;
}

static void squares_of_prefixes(double *squares)
{
    double pairs = 0, volumes = 0, mean = 1;
    for (int k = 0; k < dim; k++) {
        mean /= 3;
    }
    for (int n = 1; n <= N; n++) {
        for (int j = 0; j < n - 1; j++) {
            pairs += 2 * both_in(x[n - 1], x[j]);
        }
        pairs += both_in(x[n - 1], x[n - 1]);
        volumes += volume_in(x[n - 1]);
        squares[n] = mean - 2 * volumes / n + pairs / n / n;
    }
}

typedef struct knot {
    double at, weight;
} knot;

static int by_place(const void *a, const void *b)
{
    const double p = ((const knot *)a)->at, q = ((const knot *)b)->at;
    return (p > q) - (p < q);
}

/* Finds the minima of the energy in coordinate k of point i among the first `count` points: up to count positions and
   energies. Between two knots it is linear * t^2 - slope * t and a constant; where it still falls at 1, that end is
   a minimum, too. */
static int minima(int i, int k, int count, double *at, double *energy)
{
    static knot knots[N];
    int m = 0, found = 0;
    double left = 0, right = 0, right_moment = 0, linear = linear_weight[i], own = pair_weight[i];
    for (int q = 0; q < dim; q++) {
        linear *= q == k ? 1 : (1 - x[i][q] * x[i][q]) / 2;
        own *= q == k ? 1 : 1 - x[i][q];
    }
    for (int j = 0; j < count; j++) {
        double w = 2 * pair_weight[j > i ? j : i];
        for (int q = 0; q < dim; q++) {
            w *= q == k ? 1 : 1 - fmax(x[i][q], x[j][q]);
        }
        if (j != i) {
            knots[m++] = (knot){x[j][k], w};
            right += w;
            right_moment += w * x[j][k];
        }
    }
    qsort(knots, (size_t)m, sizeof *knots, by_place);
    for (int j = 0; j <= m; j++) {
        const double low = j ? knots[j - 1].at : 0, high = j < m ? knots[j].at : 1;
        if (j) {
            left += knots[j - 1].weight;
            right -= knots[j - 1].weight;
            right_moment -= knots[j - 1].weight * low;
        }
        double t = (own + left) / (2 * linear);
        if (t > low && (t < high || j == m)) {
            t = clamped(t);
            at[found] = t;
            energy[found++] = -linear * (1 - t * t) + (own + left) * (1 - t) + right - right_moment;
        }
    }
    return found;
}

/* Draws a minimum of one coordinate by its Boltzmann weight; temperature 0: takes the least. */
static bool move_to_minimum(int i, int k, int count, double temperature)
{
    static double at[N], energy[N];
    const int found = minima(i, k, count, at, energy);
    int least = 0;
    if (found == 0) {
        return false;
    }
    for (int j = 1; j < found; j++) {
        least = energy[j] < energy[least] ? j : least;
    }
    if (temperature > 0) {
        double sum = 0, to = 0;
        for (int j = 0; j < found; j++) {
            sum += koksma__exp((energy[least] - energy[j]) / temperature);
        }
        to = unit() * sum;
        const double lowest = energy[least];
        for (least = 0; least < found - 1; least++) {
            to -= koksma__exp((lowest - energy[least]) / temperature);
            if (to < 0) {
                break;
            }
        }
    }
    const bool moved = x[i][k] != at[least];
    x[i][k] = at[least];
    return moved;
}

/* Adds points from number `first` on, each by coordinate descent from several random positions. */
static void add_greedily(int first)
{
    for (int i = first; i < N; i++) {
        double least = INFINITY, best[MOST_DIM] = {0};
        for (int j = 0; j <= i; j++) {
            linear_weight[j] = 1.0 / (i + 1);
            pair_weight[j] = 1.0 / (i + 1) / (i + 1);
        }
        for (int start = 0; start < STARTS * dim; start++) {
            bool moved = true;
            for (int k = 0; k < dim; k++) {
                x[i][k] = unit();
            }
            for (int s = 0; s < STEPS && moved; s++) {
                moved = false;
                for (int k = 0; k < dim; k++) {
                    moved = move_to_minimum(i, k, i + 1, 0) || moved;
                }
            }
            double energy = pair_weight[i] * both_in(x[i], x[i]) - 2 * linear_weight[i] * volume_in(x[i]);
            for (int j = 0; j < i; j++) {
                energy += 2 * pair_weight[i] * both_in(x[i], x[j]);
            }
            if (energy < least) {
                least = energy;
                memcpy(best, x[i], sizeof best);
            }
        }
        memcpy(x[i], best, sizeof best);
    }
}

static void report_l2(int sweep, const double *greedy)
{
    static double squares[N + 1];
    double mean = 0;
    squares_of_prefixes(squares);
    for (int n = 3; n <= N; n++) {
        mean += sqrt(squares[n] / greedy[n]) / (N - 2);
    }
    fprintf(stderr, "%d sweeps: mean ratio %.4f; L2 at 16 %.5f, 128 %.6f, 1024 %.7f\n", sweep, mean,
            sqrt(squares[16]), sqrt(squares[128]), sqrt(squares[N]));
}

static void anneal_l2(int fixed, int sweeps)
{
    static double greedy[N + 1];
    double linear = 0, pair = 0, temperature = 0.1 / N;
    const double fall = koksma__exp(koksma__log(1e-3) / (sweeps + 1));
    squares_of_prefixes(greedy);
    for (int n = N; n >= 1; n--) {
        const double w = n < 3 ? 0 : 1 / greedy[n] / (N - 2);
        linear_weight[n - 1] = linear += w / n;
        pair_weight[n - 1] = pair += w / n / n;
    }
    for (int sweep = 0; sweep < sweeps && !ended && fixed < N; sweep++, temperature *= fall) {
        for (int q = fixed; q < N; q++) {
            const int i = fixed + (int)(draw() % (uint64_t)(N - fixed));
            move_to_minimum(i, (int)(draw() % (uint64_t)dim), N, sweep < sweeps * 9 / 10 ? temperature : 0);
        }
        if (sweep % 20 == 0 || sweep == sweeps - 1) {
            report_l2(sweep + 1, greedy);
        }
    }
}

/* ---- Star discrepancies of all prefixes in the plane ------------------------------------------------------ */

/* The corner of a box whose discrepancy is that of a prefix. */
typedef struct corner {
    float x, y;
    bool closed;
} corner;

static int most; /* number of points that move */
static float record_of[MOST_STAR + 1], star_of[MOST_STAR + 1];
static corner corner_of[MOST_STAR + 1];
static int order[2][MOST_STAR]; /* the points by their coordinates */

static void sort_axis(int k)
{
    for (int i = 1; i < most; i++) {
        const int point = order[k][i];
        int j = i;
        for (; j > 0 && x[order[k][j - 1]][k] > x[point][k]; j--) {
            order[k][j] = order[k][j - 1];
        }
        order[k][j] = point;
    }
}

/* Finds the row where a column reaches its maximum, as an open box (sign 1) or a closed one (-1). */
static void look_at_column(float at, const float *rows, const float *counts, int n, float sign, float value,
                           corner *c)
{
    for (int j = 0; j <= n; j++) {
        if (sign * (at * rows[j] - counts[j]) == value) {
            *c = (corner){at, rows[j], sign < 0};
        }
    }
}

/* Computes the star discrepancy of the first n points: the columns of the grid from left to right, with the counts of
   points left of them below each row. */
static float star(int n, corner *c)
{
    float rows[MOST_STAR + 1], counts[MOST_STAR + 2] = {0}, value = 0;
    int rank[MOST_STAR], m = 0;
    for (int j = 0; j < most; j++) {
        if (order[1][j] < n) {
            rank[order[1][j]] = m;
            rows[m++] = (float)x[order[1][j]][1];
        }
    }
    rows[n] = 1;
    const float share = 1.0F / (float)n;
    for (int i = 0; i <= most; i++) {
        const int point = i < most ? order[0][i] : -1;
        float open = 0, closed = 0;
        if (point >= n) {
            continue;
        }
        const float at = point < 0 ? 1 : (float)x[point][0];
        for (int j = 0; j <= n; j++) {
            const float d = at * rows[j] - counts[j];
            open = d > open ? d : open;
        }
        if (open > value) {
            value = open;
            look_at_column(at, rows, counts, n, 1, value, c);
        }
        const int from = point < 0 ? n + 1 : rank[point];
        for (int j = from; j <= n; j++) {
            counts[j + 1] += share;
        }
        for (int j = from; j <= n; j++) {
            const float d = counts[j + 1] - at * rows[j];
            closed = d > closed ? d : closed;
        }
        if (closed > value) {
            value = closed;
            look_at_column(at, rows, counts + 1, n, -1, value, c);
        }
    }
    return value;
}

static double cost(int n, float value)
{
    const double ratio = value / record_of[n], over = ratio - 2.15;
    return ratio + (over > 0 ? 5 * over * over : 0);
}

static void report_star(long proposals)
{
    double mean = 0, worst = 0;
    for (int n = FROM; n <= most; n++) {
        const double ratio = star_of[n] / record_of[n];
        mean += ratio / (most - FROM + 1);
        worst = fmax(ratio, worst);
    }
    fprintf(stderr, "%ld proposals: mean ratio %.4f, worst %.4f\n", proposals, mean, worst);
}

/* Returns whether a point lies in the box of a corner. */
static bool lies_in(const corner *c, double px, double py)
{
    const float u = (float)px, v = (float)py;
    return c->closed ? u <= c->x && v <= c->y : u < c->x && v < c->y;
}

/* Decides a move of point i from `before`: accepts it if the sum of the costs stays below the limit. */
static bool decide(int i, const double *before, double limit, double *sum)
{
    float values[MOST_STAR + 1];
    corner corners[MOST_STAR + 1];
    const int first = i + 1 > FROM ? i + 1 : FROM;
    double total = *sum;
    for (int n = first; n <= most; n++) {
        const corner *c = &corner_of[n];
        const int change = lies_in(c, x[i][0], x[i][1]) - lies_in(c, before[0], before[1]);
        const float bound = star_of[n] + (c->closed ? 1.0F : -1.0F) * (float)change / (float)n;
        values[n] = bound > 0 ? bound : 0;
        total += cost(n, values[n]) - cost(n, star_of[n]);
    }
    if (total > limit) {
        return false;
    }
    sort_axis(0);
    sort_axis(1);
    for (int parity = 0; parity < 2; parity++) {
        for (int n = first + parity; n <= most; n += 2) {
            total -= cost(n, values[n]);
            values[n] = star(n, &corners[n]);
            total += cost(n, values[n]);
            if (total > limit) {
                return false;
            }
        }
    }
    for (int n = first; n <= most; n++) {
        star_of[n] = values[n];
        corner_of[n] = corners[n];
    }
    *sum = total;
    return true;
}

static void anneal_star(long proposals)
{
    static double best[N][MOST_DIM];
    double sum = 0, least, temperature = 0.06;
    const double fall = koksma__exp(koksma__log(1.0 / 30) * 256 / (double)(proposals + 1));
    for (int i = 0; i < most; i++) {
        order[0][i] = order[1][i] = i;
    }
    sort_axis(0);
    sort_axis(1);
    for (int n = FROM; n <= most; n++) {
        star_of[n] = star(n, &corner_of[n]);
        sum += cost(n, star_of[n]);
    }
    least = sum;
    memcpy(best, x, sizeof best);
    report_star(0);
    for (long p = 0; p < proposals && !ended; p++) {
        const int i = (int)(draw() % (uint64_t)most), axes = (int)(draw() % 3);
        const double reach = 0.3 * koksma__exp(koksma__log(1e-3) * unit()), before[2] = {x[i][0], x[i][1]};
        temperature *= p % 256 ? 1 : fall;
        for (int k = 0; k < 2; k++) {
            x[i][k] = axes == k ? before[k] : clamped(before[k] + reach * (2 * unit() - 1));
        }
        if (!decide(i, before, sum - temperature * koksma__log(unit() + 0x1p-53), &sum)) {
            memcpy(x[i], before, sizeof before);
            sort_axis(0);
            sort_axis(1);
        } else if (sum < least) {
            least = sum;
            memcpy(best, x, sizeof best);
        }
        if (p % 100000 == 99999) {
            report_star(p + 1);
        }
    }
    memcpy(x, best, sizeof best);
}

/* ---- Tables ----------------------------------------------------------------------------------------------- */

/* Reads the points of a table; returns their number. */
static int read_table(void)
{
    for (int c = 0; c < N * dim; c++) {
        double number;
        if (scanf("%lf ,", &number) != 1) {
            return c / dim;
        }
        x[c / dim][c % dim] = number / UNIT;
    }
    return N;
}

static void write_table(void)
{
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < dim; k++) {
            printf("%.0f,%s", floor(x[i][k] * UNIT), k + 1 < dim ? " " : "\n");
        }
    }
}

static bool read_records(const char *path)
{
    char line[1 << 16];
    int known = 0;
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file)) {
        int n;
        float value;
        if (sscanf(line, "star,2,%d,%f", &n, &value) == 2 && n >= FROM && n <= most) {
            record_of[n] = value;
            known++;
        }
    }
    if (file) {
        fclose(file);
    }
    return known == most - FROM + 1;
}

int main(int argc, char **argv)
{
    const bool of_star = argc == 6 && !strcmp(argv[1], "star");
    if (!of_star && (argc != 6 || strcmp(argv[1], "l2"))) {
        fprintf(stderr,
                "usage: make_every_n l2 DIM FIXED SWEEPS SEED | star RECORDS N PROPOSALS SEED <TABLE >TABLE\n");
        return 2;
    }
    dim = of_star ? 2 : atoi(argv[2]);
    most = of_star ? atoi(argv[3]) : 0;
    state = strtoull(argv[5], NULL, 10);
    if (dim < 2 || dim > MOST_DIM || most > MOST_STAR || (of_star && (most < FROM || !read_records(argv[2])))) {
        fprintf(stderr, "make_every_n: 2 to 4 dimensions; 8 to 256 points, all with a record in %s\n", argv[2]);
        return 2;
    }
    signal(SIGINT, end);
    const int known = read_table();
    if (of_star && known < most) {
        fprintf(stderr, "make_every_n: the table has %d of %d points\n", known, most);
        return 2;
    }
    if (of_star) {
        anneal_star(atol(argv[4]));
        write_table();
        return 0;
    }
    add_greedily(known);
    anneal_l2(atoi(argv[3]), atoi(argv[4]));
    write_table();
    return 0;
}
