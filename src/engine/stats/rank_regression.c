/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rank regression with cross-validation over scenes (Hastie, Tibshirani and Friedman, The Elements of Statistical
 * Learning, 2009: ridge regression 3.4.1, cross-validation 7.10; as 7.10.2 requires, every choice is made without the
 * scene that is predicted). Within a case (koksma__rank_case), ranks are shifted to mean 0 and scaled to length 1, so
 * that two matrices summarise a scene: G = Z'Z / cases, the correlations of the k measures with each other, and c =
 * Z'y / cases, their correlations with the error. A fit to several scenes uses the sums of their G and c; leaving a
 * scene out subtracts its G and c. With weights b the squared error per case is 1 - 2 b'c + b'G b.
 *
 *   single the measure with the least squared error, that is, the largest c_j^2 / G_jj; only its sign is fitted
 *   pair     the pair of measures with the largest c' G^-1 c, among all k (k - 1) / 2 pairs
 *   all      ridge: (G + penalty I) b = c, with the penalty of least error in a cross-validation among the other scenes
 */
#include "stats/stats.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

enum { PENALTIES = 9 };

static const double penalties[PENALTIES] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10};

/* The matrices G (k x k) and c (k) of each scene and of sums over scenes, with memory for the computations. */
typedef struct sums {
    size_t k, n_scenes, size; /* size: count of the numbers in G and c of a scene, k (k + 1) */
    double *of;               /* G and c of each scene, together `size` numbers for a scene */
    size_t *cases;            /* number of cases in each scene */
    /* sum over all scenes; sum over the training scenes; memory for a Cholesky factor and for k weights */
    double *all, *train, *factor, *weights;
} sums;

static void sums_fini(sums *s)
{
    free(s->of);
    free(s->cases);
}

static koksma_status sums_init(size_t k, size_t n_scenes, sums *s)
{
    const size_t size = k * (k + 1), total = (n_scenes + 2) * size + k * k + k;
    *s = (sums){.k = k, .n_scenes = n_scenes, .size = size};
    s->of = calloc(total, sizeof *s->of);
    s->cases = calloc(n_scenes + 1, sizeof *s->cases);
    if (!s->of || !s->cases) {
        sums_fini(s);
        return koksma__fail_memory(total * sizeof *s->of);
    }
    s->all = s->of + n_scenes * size;
    s->train = s->all + size;
    s->factor = s->train + size;
    s->weights = s->factor + k * k;
    return KOKSMA_OK;
}

static koksma_status add_cases(sums *s, const koksma__rank_case *cases, size_t n_cases, const koksma_run *run)
{
    const size_t k = s->k;
    for (size_t i = 0; i < n_cases; i++) {
        const koksma__rank_case *at = &cases[i];
        double *g = s->of + at->scene * s->size, *c = g + k * k;
        for (size_t a = 0; a < k; a++) {
            KOKSMA__TRY(koksma__ask(run));
            for (size_t b = 0; b < k; b++) {
                g[a * k + b] += koksma__dot_of(at->n, at->ranks + a * at->n, at->ranks + b * at->n);
            }
            c[a] += koksma__dot_of(at->n, at->ranks + a * at->n, at->ranks + k * at->n);
        }
        s->cases[at->scene]++;
    }
    for (size_t scene = 0; scene < s->n_scenes; scene++) {
        for (size_t i = 0; s->cases[scene] && i < s->size; i++) {
            s->of[scene * s->size + i] /= (double)s->cases[scene];
            s->all[i] += s->of[scene * s->size + i];
        }
    }
    return KOKSMA_OK;
}

/* Sets s->train to the sum over all scenes except `scene` and `other`, which may be equal. */
static void leave_out(sums *s, size_t scene, size_t other)
{
    for (size_t i = 0; i < s->size; i++) {
        s->train[i] = s->all[i] - s->of[scene * s->size + i] - (other != scene ? s->of[other * s->size + i] : 0);
    }
}

/* Solves (G + penalty count I) b = c for s->train by Cholesky factorisation; the matrix is positive definite
   because the penalty is positive. */
static void fit_ridge(sums *s, double penalty, size_t count)
{
    const size_t k = s->k;
    double *l = s->factor, *b = s->weights;
    for (size_t i = 0; i < k; i++) {
        for (size_t j = 0; j <= i; j++) {
            const double rest = s->train[i * k + j] + (i == j ? penalty * (double)count : 0) -
                                koksma__dot_of(j, l + i * k, l + j * k);
            l[i * k + j] = i == j ? sqrt(rest) : rest / l[j * k + j];
        }
        b[i] = (s->train[k * k + i] - koksma__dot_of(i, l + i * k, b)) / l[i * k + i];
    }
    for (size_t i = k; i-- > 0;) {
        for (size_t j = i + 1; j < k; j++) {
            b[i] -= l[j * k + i] * b[j];
        }
        b[i] /= l[i * k + i];
    }
}

/* Returns the squared error per case of a scene for s->weights, 1 - 2 b'c + b'G b, without the constant 1. */
static double error_in(const sums *s, size_t scene)
{
    const size_t k = s->k;
    const double *g = s->of + scene * s->size;
    double error = -2 * koksma__dot_of(k, s->weights, g + k * k);
    for (size_t i = 0; i < k; i++) {
        error += s->weights[i] * koksma__dot_of(k, g + i * k, s->weights);
    }
    return error;
}

/* Chooses the penalty with the least error in a cross-validation among all scenes except `scene`; among penalties
   with equal errors, the largest. */
static koksma_status choose_penalty(sums *s, size_t scene, size_t n_used, const koksma_run *run, double *best)
{
    double least = INFINITY;
    *best = penalties[PENALTIES - 1];
    for (int p = PENALTIES - 1; p >= 0; p--) {
        double error = 0;
        for (size_t other = 0; other < s->n_scenes; other++) {
            if (other != scene && s->cases[other]) {
                KOKSMA__TRY(koksma__ask(run));
                leave_out(s, scene, other);
                fit_ridge(s, penalties[p], n_used - 2);
                error += error_in(s, other);
            }
        }
        if (error < least) {
            least = error;
            *best = penalties[p];
        }
    }
    return KOKSMA_OK;
}

/* Returns the part of the squared error that a pair of measures explains in s->train, or -1 if the pair is nearly
   collinear. Also computes the weights of the pair. */
static double explained(const sums *s, size_t a, size_t b, double weights[2])
{
    const size_t k = s->k;
    const double aa = s->train[a * k + a], bb = s->train[b * k + b], ab = s->train[a * k + b];
    const double ca = s->train[k * k + a], cb = s->train[k * k + b], det = aa * bb - ab * ab;
    if (!(det > 1e-9 * aa * bb)) {
        return -1;
    }
    weights[0] = (bb * ca - ab * cb) / det;
    weights[1] = (aa * cb - ab * ca) / det;
    return weights[0] * ca + weights[1] * cb;
}

static void choose_single(const sums *s, koksma__held_out *out, double *sign)
{
    const size_t k = s->k;
    double most = -1;
    for (size_t j = 0; j < k; j++) {
        const double g = s->train[j * k + j], c = s->train[k * k + j], of = g > 0 ? c * c / g : 0;
        if (of > most) {
            most = of;
            out->single = j;
            *sign = c < 0 ? -1 : 1;
        }
    }
}

static void choose_pair(const sums *s, koksma__held_out *out, double weights[2])
{
    double most = -1, w[2] = {0, 0};
    for (size_t a = 0; a < s->k; a++) {
        for (size_t b = a + 1; b < s->k; b++) {
            const double of = explained(s, a, b, w);
            if (of > most) {
                most = of;
                out->pair[0] = a;
                out->pair[1] = b;
                weights[0] = w[0];
                weights[1] = w[1];
            }
        }
    }
}

/* Returns Spearman's correlation of the weighted sum of ranks with the ranks of the error, or 0 if all sums are equal
   and thus define no order. */
static double predict(const koksma__rank_case *at, size_t k, const size_t *which, const double *weights, size_t n,
                      double *scores)
{
    for (size_t i = 0; i < at->n; i++) {
        scores[i] = 0;
        for (size_t j = 0; j < n; j++) {
            scores[i] += weights[j] * at->ranks[(which ? which[j] : j) * at->n + i];
        }
    }
    const double rho = koksma__spearman(scores, at->ranks + k * at->n, at->n);
    return isnan(rho) ? 0 : rho;
}

static koksma_status predict_scene(sums *s, const koksma__rank_case *cases, size_t n_cases, size_t scene,
                                   size_t n_used, const koksma_run *run, double *scores, koksma__held_out *out)
{
    const size_t k = s->k;
    double sign = 1, pair[2] = {0, 0};
    *out = (koksma__held_out){.cases = s->cases[scene]};
    KOKSMA__TRY(choose_penalty(s, scene, n_used, run, &out->penalty));
    leave_out(s, scene, scene);
    fit_ridge(s, out->penalty, n_used - 1);
    choose_single(s, out, &sign);
    out->pair[0] = out->pair[1] = out->single;
    pair[0] = pair[1] = sign;
    choose_pair(s, out, pair);
    for (size_t j = 0; j < k; j++) {
        const double rho = s->of[scene * s->size + k * k + j];
        if (j == 0 || fabs(rho) > fabs(out->rho_hindsight)) {
            out->hindsight = j;
            out->rho_hindsight = rho;
        }
    }
    out->rho_hindsight = fabs(out->rho_hindsight);
    const double share = 1 / (double)out->cases;
    for (size_t i = 0; i < n_cases; i++) {
        if (cases[i].scene == scene) {
            out->rho_single += share * predict(&cases[i], k, &out->single, &sign, 1, scores);
            out->rho_pair += share * predict(&cases[i], k, out->pair, pair, 2, scores);
            out->rho_all += share * predict(&cases[i], k, NULL, s->weights, k, scores);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__rank_regression(const koksma__rank_case *cases, size_t n_cases, size_t k, size_t n_scenes,
                                      const koksma_run *run, koksma__held_out *out)
{
    sums s;
    size_t n_used = 0, most = 0;
    KOKSMA__TRY(sums_init(k, n_scenes, &s));
    koksma_status status = add_cases(&s, cases, n_cases, run);
    for (size_t scene = 0; scene < n_scenes; scene++) {
        n_used += s.cases[scene] > 0;
    }
    for (size_t i = 0; i < n_cases; i++) {
        most = cases[i].n > most ? cases[i].n : most;
    }
    double *scores = malloc((most + 1) * sizeof *scores);
    if (!status && !scores) {
        status = koksma__fail_memory((most + 1) * sizeof *scores);
    } else if (!status && n_used < 3) {
        status =
            koksma__fail(KOKSMA_ARGUMENT, "rank regression: %zu scenes have cases; at least 3 are needed", n_used);
    }
    for (size_t scene = 0; !status && scene < n_scenes; scene++) {
        out[scene] = (koksma__held_out){0};
        if (s.cases[scene]) {
            status = predict_scene(&s, cases, n_cases, scene, n_used, run, scores, &out[scene]);
        }
    }
    free(scores);
    sums_fini(&s);
    return status;
}
