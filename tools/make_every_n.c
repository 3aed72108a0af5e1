/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Continues the search for the first 128 points of every-n in the plane: reads src/engine/patterns/data/every_n.csv from
 * standard input and prints its row `plane` with better points. Run by hand; equal arguments and an equal table give the
 * same bits on every machine. The shipped row, from the one of an earlier search:
 *
 *     cc -O3 -march=native -ffp-contract=off -ffinite-math-only -fno-signed-zeros -std=gnu11 -Isrc/engine \
 *         tools/make_every_n.c -lm -o /tmp/make_every_n
 *     git show 069480af:src/engine/patterns/data/every_n.csv |
 *         /tmp/make_every_n src/engine/patterns/data/records.csv 1500000 1 >/tmp/plane
 *
 * The points after them are those of `l2 2 128 300 1` of the earlier program (git show bf89f9bf^:tools/make_every_n.c),
 * with these 128 as its table.
 *
 * Simulated annealing of the sum of D*(n) / record(n) over n = 8 .. 128, with a penalty on ratios above 2.2. A proposal
 * moves a coordinate or both of a point, exchanges the places of two points in the order or one coordinate of theirs, or
 * takes a point to another place in the order. The boxes where the discrepancies of the changed prefixes are reached bound
 * the new ones from below, which rejects many proposals; the others are computed exactly, in O(n^2) for each prefix, until
 * their sum is too large. SIGINT ends the search early; the row is printed all the same.
 */
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"

enum { ALL = 1024, MOST = 128, FROM = 8, EVERY = 256 };
enum { MOVE, EXCHANGE, INSERT, CROSS };

static const double UNIT = 0x1p24, HOT = 0.03, COLD = 0.0015; /* coordinates are whole multiples of 1 / UNIT */

/* The corner of a box whose discrepancy is that of a prefix. */
typedef struct corner {
    float x, y;
    bool closed;
} corner;

/* What a proposal changes: the prefixes first .. last, by points i and j. */
typedef struct proposal {
    int kind, i, j, first, last;
} proposal;

static double x[ALL][2], old[MOST][2];
static float record_of[MOST + 1], star_of[MOST + 1];
static corner corner_of[MOST + 1];
static int order[2][MOST]; /* the points by their coordinates */
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

static void sort_axis(int k)
{
    for (int i = 1; i < MOST; i++) {
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

/* Computes the star discrepancy of the first n points: the columns of the grid from left to right, with the shares of
   points left of them below each row. */
static float star(int n, corner *c)
{
    float rows[MOST + 1], counts[MOST + 2] = {0}, value = 0;
    int rank[MOST], m = 0;
    for (int j = 0; j < MOST; j++) {
        if (order[1][j] < n) {
            rank[order[1][j]] = m;
            rows[m++] = (float)x[order[1][j]][1];
        }
    }
    rows[n] = 1;
    const float share = 1.0F / (float)n;
    for (int i = 0; i <= MOST; i++) {
        const int point = i < MOST ? order[0][i] : -1;
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
    const double ratio = value / record_of[n], over = ratio - 2.2;
    return ratio + (over > 0 ? 10 * over * over : 0);
}

static void report(long proposals)
{
    double mean = 0, worst = 0;
    for (int n = FROM; n <= MOST; n++) {
        const double ratio = star_of[n] / record_of[n];
        mean += ratio / (MOST - FROM + 1);
        worst = fmax(ratio, worst);
    }
    fprintf(stderr, "%ld proposals: mean ratio %.4f, worst %.4f\n", proposals, mean, worst);
}

/* Returns whether a point lies in the box of a corner. */
static int lies_in(const corner *c, const double *p)
{
    const float u = (float)p[0], v = (float)p[1];
    return c->closed ? u <= c->x && v <= c->y : u < c->x && v < c->y;
}

/* By how much the number of points in the box of prefix n grows. */
static int growth(const proposal *p, int n)
{
    const corner *c = &corner_of[n];
    switch (p->kind) {
    case EXCHANGE:
        return lies_in(c, old[p->j]) - lies_in(c, old[p->i]);
    case INSERT:
        return p->j > p->i ? lies_in(c, old[n]) - lies_in(c, old[p->i])
                           : lies_in(c, old[p->i]) - lies_in(c, old[n - 1]);
    default:
        return lies_in(c, x[p->i]) - lies_in(c, old[p->i]) +
               (n > p->j ? lies_in(c, x[p->j]) - lies_in(c, old[p->j]) : 0);
    }
}

/* Changes x by a random proposal. */
static proposal propose(void)
{
    const int i = (int)(draw() % MOST), kind = (int)(draw() % 16);
    if (kind < 11) {
        const int axes = (int)(draw() % 3);
        const double reach = 0.3 * koksma__exp(koksma__log(2e-4) * unit());
        for (int k = 0; k < 2; k++) {
            const double t = floor((x[i][k] + reach * (2 * unit() - 1)) * UNIT) / UNIT;
            x[i][k] = axes == k ? x[i][k] : fmin(fmax(t, 0), 1 - 1 / UNIT);
        }
        return (proposal){MOVE, i, MOST, i + 1, MOST};
    }
    const int step = 1 + (int)koksma__exp(koksma__log(40) * unit()), to = draw() & 1 ? i + step : i - step;
    const int j = to < 0 ? 0 : to < MOST ? to : MOST - 1, low = i < j ? i : j, high = i < j ? j : i;
    if (kind < 13) {
        memcpy(x[low], old[high], sizeof *x);
        memcpy(x[high], old[low], sizeof *x);
        return (proposal){EXCHANGE, low, high, low + 1, high};
    }
    if (kind < 15) {
        memmove(x[j < i ? j + 1 : i], x[j < i ? j : i + 1], (size_t)(high - low) * sizeof *x);
        memcpy(x[j], old[i], sizeof *x);
        return (proposal){INSERT, i, j, low + 1, high};
    }
    const int k = (int)(draw() & 1);
    x[low][k] = old[high][k];
    x[high][k] = old[low][k];
    return (proposal){CROSS, low, high, low + 1, MOST};
}

/* Accepts the proposal if the sum of the costs stays below the limit. */
static bool decide(const proposal *p, double limit, double *sum)
{
    float values[MOST + 1];
    corner corners[MOST + 1];
    const int first = p->first > FROM ? p->first : FROM;
    double total = *sum;
    for (int n = first; n <= p->last; n++) {
        const float sign = corner_of[n].closed ? 1 : -1, bound = star_of[n] + sign * (float)growth(p, n) / (float)n;
        values[n] = bound > 0 ? bound : 0;
        total += cost(n, values[n]) - cost(n, star_of[n]);
    }
    if (total > limit) {
        return false;
    }
    sort_axis(0);
    sort_axis(1);
    for (int parity = 0; parity < 2; parity++) {
        for (int n = first + parity; n <= p->last; n += 2) {
            total -= cost(n, values[n]);
            values[n] = star(n, &corners[n]);
            total += cost(n, values[n]);
            if (total > limit) {
                return false;
            }
        }
    }
    for (int n = first; n <= p->last; n++) {
        star_of[n] = values[n];
        corner_of[n] = corners[n];
    }
    *sum = total;
    return true;
}

static void anneal(long proposals)
{
    static double best[MOST][2];
    double sum = 0, least, temperature = HOT;
    const double fall = koksma__exp(koksma__log(COLD / HOT) * EVERY / (double)proposals);
    for (int i = 0; i < MOST; i++) {
        order[0][i] = order[1][i] = i;
    }
    sort_axis(0);
    sort_axis(1);
    for (int n = FROM; n <= MOST; n++) {
        star_of[n] = star(n, &corner_of[n]);
        sum += cost(n, star_of[n]);
    }
    least = sum;
    memcpy(best, x, sizeof best);
    report(0);
    for (long done = 1; done <= proposals && !ended; done++) {
        memcpy(old, x, sizeof old);
        const proposal p = propose();
        if (!decide(&p, sum - temperature * koksma__log(unit() + 0x1p-53), &sum)) {
            memcpy(x, old, sizeof old);
        } else if (sum < least) {
            least = sum;
            memcpy(best, x, sizeof best);
        }
        temperature *= done % EVERY ? 1 : fall;
        if (done % 100000 == 0) {
            report(done);
        }
    }
    memcpy(x, best, sizeof best);
}

/* Reads the points of the row `plane`; returns their number. */
static int read_points(void)
{
    static char line[1 << 16];
    int c = 0;
    while (fgets(line, sizeof line, stdin) && strncmp(line, "plane,", 6)) {
    }
    for (char *at = line + 6, *next; c < 2 * ALL; at = next, c++) {
        x[c / 2][c % 2] = strtod(at, &next) / UNIT;
        if (next == at) {
            break;
        }
    }
    return c / 2;
}

static bool read_records(const char *path)
{
    char line[1 << 16];
    int known = 0;
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file)) {
        int n;
        float value;
        if (sscanf(line, "star,2,%d,%f", &n, &value) == 2 && n >= FROM && n <= MOST) {
            record_of[n] = value;
            known++;
        }
    }
    if (file) {
        fclose(file);
    }
    return known == MOST - FROM + 1;
}

int main(int argc, char **argv)
{
    const long proposals = argc == 4 ? atol(argv[2]) : 0;
    if (proposals < 1 || !read_records(argv[1]) || read_points() != ALL) {
        fprintf(stderr,
                "usage: make_every_n RECORDS PROPOSALS SEED <TABLES >ROW, with the records of 8 to 128 points in "
                "the plane, and a row `plane` of 1024 points\n");
        return 2;
    }
    state = strtoull(argv[3], NULL, 10);
    signal(SIGINT, end);
    anneal(proposals);
    for (int i = 0; i < ALL; i++) {
        printf("%s%.0f %.0f", i ? " " : "plane,", x[i][0] * UNIT, x[i][1] * UNIT);
    }
    printf("\n");
    return 0;
}
