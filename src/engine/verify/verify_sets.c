/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_verify_sets: unbiased and uniform-samples, properties of how the points of a random pattern are distributed,
 * tested with one set for each of many seeds.
 *
 * unbiased: the expected share of the points in any box is its volume. The mean of any integrand over the points is
 * then right in the mean over the seeds. uniform-samples: the sample of each index is uniform by itself. A pattern in
 * the order of its cells is unbiased without that; then the first k samples are no estimate.
 *
 * Boxes: of each coordinate the intervals of length 1/2 to 1/16 that begin at the multiples of half their length, also
 * those around the end of [0,1), where darts without wraparound crowd; of each pair of coordinates the products of
 * dyadic intervals with a volume of 1/16 or more.
 *
 * Tests: of N independent sets, the sample of one index is in a box of volume v in Binomial(N, v) of them, which gives
 * an exact two-sided p = 2 min(P(X <= k), P(X >= k)). The share of a set's points in a box has an unknown distribution
 * on [0,1], of mean v. Bets on it give the capital
 *
 *     product over the sets s of (1 + b_s (share_s - v)),     b_s from the shares before s,
 *
 * a martingale of mean 1, which exceeds 1/p with a probability of at most p (Ville). Betting 4 standard errors' worth
 * needs little more than a normal test would, and shares that vary less than independent points' show smaller biases.
 * The level of each property is .001 for all boxes and indices together (Bonferroni).
 * Source: Waudby-Smith and Ramdas 2024, section 4.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "verify/verify.h"

enum { FINE = 32, DEPTH = 4, SINGLES = 64, PAIRED = 8, MAX_INDICES = 64 };

#define LEVEL 0.001

/* An interval of a coordinate in units of 1/FINE, which may wrap around. */
typedef struct interval {
    int axis;
    unsigned from, length;
} interval;

/* A box: one interval, or the product of two. */
typedef struct box {
    interval sides[2];
    int count;
    double volume;
} box;

/* What the test of a box has seen: the mean share, its z, and the logarithm of 1/p. */
typedef struct evidence {
    box box;
    size_t index; /* of the sample; unused for shares of all points */
    double mean, z, weight;
} evidence;

typedef struct search {
    const koksma__verification *v;
    unsigned char *cells;  /* the coordinates of all sets in units of 1/FINE */
    double *log_factorial; /* of 0 .. n_sets */
    size_t indices[MAX_INDICES], n_indices;
    size_t n_boxes;           /* tested so far */
    bool equal;               /* all sets are the same */
    evidence shares, samples; /* the boxes with the largest weights */
} search;

static bool is_inside(const box *b, const unsigned char *cell)
{
    bool in = true;
    for (int k = 0; k < b->count; k++) {
        in = in && (cell[b->sides[k].axis] - b->sides[k].from) % FINE < b->sides[k].length;
    }
    return in;
}

/* log P(X <= k) for X of Binomial(n_sets, p): the terms from k down, in units of the first. */
static double log_at_most(const search *s, size_t k, double p)
{
    const size_t n = s->v->n_sets;
    const double first = s->log_factorial[n] - s->log_factorial[k] - s->log_factorial[n - k] +
                         (double)k * koksma__log(p) + (double)(n - k) * koksma__log1p(-p);
    double term = 1, sum = 1;
    for (size_t i = k; i > 0 && term > 1e-17 * sum; i--) {
        term *= (double)i / (double)(n - i + 1) * (1 - p) / p;
        sum += term;
    }
    return fmin(first + koksma__log(sum), 0);
}

/* Adds to the worst evidence of a property that of one box. */
static void keep_worst(evidence *worst, evidence found)
{
    if (found.weight > worst->weight || worst->box.count == 0) {
        *worst = found;
    }
}

/* The sample of one index in a box: `count` of the sets have it there. */
static void test_sample(search *s, const box *b, size_t index, size_t count)
{
    const size_t n = s->v->n_sets;
    const double less = log_at_most(s, count, b->volume), more = log_at_most(s, n - count, 1 - b->volume);
    const double mean = (double)count / (double)n;
    keep_worst(&s->samples, (evidence){.box = *b,
                                       .index = index,
                                       .mean = mean,
                                       .z = (mean - b->volume) * sqrt((double)n / (b->volume * (1 - b->volume))),
                                       .weight = -fmin(less, more) - koksma__log(2)});
}

/* The bets of one side: on shares above the volume (sign 1) or below it. */
typedef struct bets {
    double capital, sum, squares; /* log capital; of the differences from the volume */
    size_t n;
} bets;

static void bet(bets *b, double sign, double volume, double stake, double difference)
{
    /* A prior of one set with the variance of a single random point keeps the first stakes small. */
    const double mean = b->sum / (double)(b->n + 1);
    const double variance = fmax((b->squares + volume * (1 - volume)) / (double)(b->n + 1) - mean * mean, 1e-12);
    const double most = 0.75 / (sign > 0 ? volume : 1 - volume);
    b->capital += koksma__log1p(fmin(stake / sqrt(variance), most) * sign * difference);
    b->sum += difference;
    b->squares += difference * difference;
    b->n++;
}

/* Tests one box with all sets. */
static void test_box(search *s, const box *b)
{
    const koksma_points *sets = s->v->points;
    const size_t n = sets->n, dim = (size_t)sets->dim, n_sets = s->v->n_sets;
    const double stake = sqrt(2 * koksma__log(1e6) / (double)n_sets);
    size_t counts[MAX_INDICES] = {0};
    bets above = {0}, below = {0};
    for (size_t set = 0; set < n_sets; set++) {
        const unsigned char *cells = s->cells + set * n * dim;
        size_t inside = 0;
        for (size_t i = 0; i < n; i++) {
            inside += is_inside(b, cells + i * dim);
        }
        for (size_t k = 0; k < s->n_indices; k++) {
            counts[k] += is_inside(b, cells + s->indices[k] * dim);
        }
        const double difference = (double)inside / (double)n - b->volume;
        bet(&above, 1, b->volume, stake, difference);
        bet(&below, -1, b->volume, stake, difference);
    }
    const double mean = above.sum / (double)n_sets, square = above.squares / (double)n_sets;
    keep_worst(&s->shares, (evidence){.box = *b,
                                      .mean = b->volume + mean,
                                      .z = square > 0 ? mean * sqrt((double)n_sets / square) : 0,
                                      .weight = fmax(above.capital, below.capital) - koksma__log(2)});
    for (size_t k = 0; k < s->n_indices; k++) {
        test_sample(s, b, s->indices[k], counts[k]);
    }
    s->n_boxes++;
}

static void test_coordinate(search *s, int axis)
{
    for (unsigned length = FINE / 2; length >= FINE >> DEPTH; length /= 2) {
        for (unsigned from = 0; from < FINE; from += length / 2) {
            test_box(s, &(box){{{axis, from, length}}, 1, (double)length / FINE});
        }
    }
}

static void test_pair(search *s, int first, int second)
{
    for (unsigned a = FINE / 2; a >= FINE >> DEPTH; a /= 2) {
        for (unsigned b = FINE / 2; a * b >= FINE * FINE >> DEPTH; b /= 2) {
            for (unsigned i = 0; i < FINE; i += a) {
                for (unsigned j = 0; j < FINE; j += b) {
                    test_box(s, &(box){{{first, i, a}, {second, j, b}}, 2, (double)(a * b) / (FINE * FINE)});
                }
            }
        }
    }
}

static koksma_status test_boxes(search *s)
{
    const int dim = s->v->points->dim, singles = dim < SINGLES ? dim : SINGLES, paired = dim < PAIRED ? dim : PAIRED;
    for (int i = 0; i < singles; i++) {
        test_coordinate(s, i);
        for (int j = 0; j < i && i < paired; j++) {
            test_pair(s, j, i);
        }
        if (!koksma__keep_going(s->v->run, (double)(i + 1) / singles)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

/* Writes a number of FINE-ths as a fraction in lowest terms. */
static void put_fraction(char *text, size_t size, unsigned part)
{
    unsigned whole = FINE;
    while (part % 2 == 0 && whole > 1) {
        part /= 2;
        whole /= 2;
    }
    snprintf(text, size, whole == 1 ? "%u" : "%u/%u", part, whole);
}

/* Writes the sides of a box, such as "[1/4,3/4) of coordinate 0". */
static void put_box(char *text, size_t size, const box *b)
{
    size_t used = 0;
    for (int k = 0; k < b->count; k++) {
        char from[8], to[8];
        const interval *side = &b->sides[k];
        put_fraction(from, sizeof from, side->from);
        put_fraction(to, sizeof to,
                     side->from + side->length > FINE ? side->from + side->length - FINE : side->from + side->length);
        used += (size_t)snprintf(text + used, size - used, "%s[%s,%s) of coordinate %d", k ? " x " : "", from, to,
                                 side->axis);
    }
}

static koksma_status add(koksma__verification *v, const search *s)
{
    const bool of_shares = v->property == &koksma__property_unbiased;
    const evidence *e = of_shares ? &s->shares : &s->samples;
    const size_t tests = of_shares ? s->n_boxes : s->n_boxes * s->n_indices;
    char where[96], subject[48] = "all points";
    put_box(where, sizeof where, &e->box);
    if (!of_shares) {
        snprintf(subject, sizeof subject, "sample %zu", e->index);
    }
    const bool holds = e->weight < koksma__log((double)tests / LEVEL) && !s->equal;
    if (s->equal && of_shares) {
        return koksma__add_finding(v, subject, 0, false,
                                   "all %zu sets are the same: their mean is the value of one set", v->n_sets);
    }
    return of_shares ? koksma__add_finding(v, subject, e->mean - e->box.volume, holds,
                                           "%s: expected %g, mean share %.4g in %zu sets, z = %.1f", where,
                                           e->box.volume, e->mean, v->n_sets, e->z)
                     : koksma__add_finding(v, subject, e->mean - e->box.volume, holds,
                                           "%s: expected %g, seen %.0f in %zu sets, z = %.1f", where, e->box.volume,
                                           e->mean * (double)v->n_sets, v->n_sets, e->z);
}

static koksma_status prepare(search *s)
{
    const koksma__verification *v = s->v;
    const size_t n = v->points->n, size = n * (size_t)v->points->dim;
    s->cells = malloc(v->n_sets * size);
    s->log_factorial = calloc(v->n_sets + 1, sizeof *s->log_factorial);
    KOKSMA__REQUIRE_MEMORY(s->cells && s->log_factorial, v->n_sets * size);
    s->equal = true;
    for (size_t set = 0; set < v->n_sets; set++) {
        s->log_factorial[set + 1] = s->log_factorial[set] + koksma__log((double)(set + 1));
        s->equal = s->equal && !memcmp(v->points[set].xs, v->points->xs, size * sizeof *v->points->xs);
        for (size_t i = 0; i < size; i++) {
            s->cells[set * size + i] = (unsigned char)fmin(v->points[set].xs[i] * FINE, FINE - 1);
        }
    }
    for (size_t last = 0; last < n; last = 2 * last + 1) {
        s->indices[s->n_indices++] = last;
    }
    if (s->indices[s->n_indices - 1] != n - 1) {
        s->indices[s->n_indices++] = n - 1;
    }
    return KOKSMA_OK;
}

/* Adds the findings of both properties, which look at the same boxes. */
static koksma_status look(koksma__verification *v)
{
    search s = {.v = v};
    koksma_status status = prepare(&s);
    status = status ? status : test_boxes(&s);
    for (size_t i = 0; i < 2 && !status; i++) {
        v->property = i ? &koksma__property_uniform_samples : &koksma__property_unbiased;
        status = add(v, &s);
    }
    free(s.cells);
    free(s.log_factorial);
    return status;
}

const koksma__property koksma__property_unbiased = {
    .public = {.name = "unbiased",
               .meaning =
                   "over many sets, the mean share of the points in every box is its volume; value: mean share "
                   "minus volume where the evidence is strongest",
               .of_sets = true},
    .look = look,
};

const koksma__property koksma__property_uniform_samples = {
    .public = {.name = "uniform-samples",
               .meaning = "over many sets, the first, second, fourth, ... and last sample are each uniform; value: "
                          "share of the sets minus volume of the box where the evidence is strongest",
               .of_sets = true},
};
