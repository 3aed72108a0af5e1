/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Estimators of an integral and intervals for it, from the estimates y_1 .. y_R by R independent random sets. Two tables
 * at the ends of their sections; koksma_estimate_integral combines a member of each.
 *
 * Which is right for what (docs/findings/coverage.md): linear scrambling (sobol:scramble=lms) gives smooth integrands
 * estimates that are very close to the integral, but for a few sets that are far off. The mean and its interval follow
 * those few, the median does not: it falls faster than any power of 1/n (Pan & Owen 2023). For nested scrambling and for
 * integrands with kinks and jumps the estimates are about normal, and the mean is better by up to pi/2 in variance.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/estimate.h>

#include "core/elementary.h"
#include "core/lookup.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "core/sum.h"
#include "stats/stats.h"

enum { RESAMPLES = 2000, GROUP = 3, HALVINGS = 60 };

#define SPREAD 0.7

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sort(double *values, size_t n)
{
    qsort(values, n, sizeof *values, by_value);
}

/* ---- Estimators -------------------------------------------------------------------------------------------------- */

static double mean(double *values, size_t n)
{
    koksma__sum sum = {0};
    for (size_t i = 0; i < n; i++) {
        koksma__sum_add(&sum, values[i]);
    }
    return koksma__sum_value(&sum) / (double)n;
}

static double median(double *values, size_t n)
{
    sort(values, n);
    return n % 2 ? values[n / 2] : values[n / 2 - 1] + (values[n / 2] - values[n / 2 - 1]) / 2;
}

/* The medians of the means of k groups: an odd number of groups of GROUP values or a few more. Value i is in group
   i modulo k. The means take the places of the first values, which are read before. */
static double median_of_means(double *values, size_t n)
{
    const size_t groups = n < GROUP ? 1 : n / GROUP, k = groups % 2 ? groups : groups - 1;
    for (size_t g = 0; g < k; g++) {
        koksma__sum sum = {0};
        size_t count = 0;
        for (size_t i = g; i < n; i += k) {
            koksma__sum_add(&sum, values[i]);
            count++;
        }
        values[g] = koksma__sum_value(&sum) / (double)count;
    }
    return median(values, k);
}

static double trimmed(double *values, size_t n)
{
    const size_t cut = n / 4;
    sort(values, n);
    return mean(values + cut, n - 2 * cut);
}

static const koksma_estimator median_row = {"median",
                                            "middle value of y_1 .. y_R; for even R the mean of the middle two",
                                            "goda2022 pan2023", "quantile", median};
static const koksma_estimator mean_row = {"mean", "(y_1 + .. + y_R) / R", "owen1995", "student", mean};
static const koksma_estimator median_of_means_row = {
    "median-of-means", "median of the means of an odd number of groups of three y or a few more",
    "pan2023 lugosi2019", "bootstrap", median_of_means};
static const koksma_estimator trimmed_row = {
    "trimmed", "mean of the y without the lowest and the highest quarter (R / 4 rounded down of each)", "huber1981",
    "bootstrap", trimmed};

static const koksma_estimator *const estimators[] = {&mean_row, &median_row, &median_of_means_row, &trimmed_row};

KOKSMA__LOOKUP(koksma_estimator, estimators)
KOKSMA__NAME_AT(koksma_estimator)

/* ---- Intervals --------------------------------------------------------------------------------------------------- */

/* What an interval is computed from. `values` are in the order of the sets, `scratch` has room for as many. */
typedef struct sample {
    const koksma_estimator *estimator; /* NULL: auto chooses it */
    const char *interval;              /* name of the interval that is used */
    const double *values;
    double *scratch;
    size_t n;
    double miss; /* 1 - confidence */
    double lowest, highest, share;
    const koksma_run *run;
} sample;

typedef struct interval_row {
    koksma_interval public;
    koksma_status (*of)(sample *s, double *low, double *high);
} interval_row;

/* Mean +- t sd / sqrt R, with t the quantile of Student's t of R - 1 degrees of freedom (Student 1908). */
static koksma_status student(sample *s, double *low, double *high)
{
    koksma__sum squares = {0};
    memcpy(s->scratch, s->values, s->n * sizeof *s->values);
    const double centre = mean(s->scratch, s->n), count = (double)s->n;
    for (size_t i = 0; i < s->n; i++) {
        koksma__sum_add(&squares, (s->values[i] - centre) * (s->values[i] - centre));
    }
    const double half = koksma__student_quantile(1 - s->miss / 2, count - 1) *
                        sqrt(koksma__sum_value(&squares) / (count - 1) / count);
    *low = centre - half;
    *high = centre + half;
    return KOKSMA_OK;
}

/* The order statistics y_(k) and y_(R + 1 - k), of the largest k for which 2 P(B < k) <= 1 - confidence, B of
   Binomial(R, 1/2): the interval of Clopper & Pearson for the level of a quantile, inverted. */
static koksma_status quantile(sample *s, double *low, double *high)
{
    const double n = (double)s->n, all = koksma__log_gamma(n + 1) - n * koksma__log(2);
    double below = 0;
    size_t k = 0;
    for (; 2 * (k + 1) <= s->n + 1; k++) {
        below += koksma__exp(all - koksma__log_gamma((double)k + 1) - koksma__log_gamma(n - (double)k + 1));
        if (2 * below > s->miss * (1 + 1e-12)) {
            break;
        }
    }
    KOKSMA__FAIL_IF(
        k == 0, KOKSMA_ARGUMENT,
        "replicates: %zu are too few for the interval quantile with a confidence of %.6g, which takes %.0f", s->n,
        1 - s->miss, 1 + ceil(koksma__log2(1 / s->miss) - 1e-9));
    memcpy(s->scratch, s->values, s->n * sizeof *s->values);
    sort(s->scratch, s->n);
    *low = s->scratch[k - 1];
    *high = s->scratch[s->n - k];
    return KOKSMA_OK;
}

/* Value i between its bounds, from 0 to 1. */
static double unit(const sample *s, size_t i)
{
    return fmin(fmax((s->values[i] - s->lowest) / (s->highest - s->lowest), 0), 1);
}

/* Estimates of mean and variance from the values so far, with a prior of one value of 1/2 and variance 1/4, and the
   stake that follows from them (Waudby-Smith & Ramdas 2024, equation 15). */
typedef struct running {
    double mean, variance, sum, squares, count;
} running;

static const running prior = {.mean = 0.5, .variance = 0.25, .sum = 0.5, .squares = 0.25, .count = 1};

static double stake(const sample *s, const running *r)
{
    return sqrt(2 * koksma__log(2 / s->miss) / ((double)s->n * r->variance));
}

static void look_at(running *r, double x)
{
    r->sum += x;
    r->count++;
    r->mean = r->sum / r->count;
    r->squares += (x - r->mean) * (x - r->mean);
    r->variance = r->squares / r->count;
}

/* The predictable plug-in empirical Bernstein interval (Waudby-Smith & Ramdas 2024, theorem 2): with stakes l_i,
   truncated at 1/2, the mean of the y weighted by l, +- (log(2 / miss) + sum 4 (y_i - m_i-1)^2 psi(l_i)) / sum l_i,
   where psi(l) = (-log(1 - l) - l) / 4 and m_i-1 estimates the mean from the values before. */
static koksma_status empirical_bernstein(sample *s, double *low, double *high)
{
    running r = prior;
    double stakes = 0, weighted = 0, spread = 0;
    for (size_t i = 0; i < s->n; i++) {
        const double x = unit(s, i), l = fmin(stake(s, &r), 0.5);
        stakes += l;
        weighted += l * x;
        spread += (x - r.mean) * (x - r.mean) * (-koksma__log1p(-l) - l);
        look_at(&r, x);
    }
    const double half = (koksma__log(2 / s->miss) + spread) / stakes, range = s->highest - s->lowest;
    *low = s->lowest + range * fmax(weighted / stakes - half, 0);
    *high = s->lowest + range * fmin(weighted / stakes + half, 1);
    return KOKSMA_OK;
}

/* Whether bets that the mean exceeds m, or for `mirrored` values is below 1 - m, ever made 2 / miss of a capital of 1.
   The stakes are in s->scratch. True of m below the true mean at most; monotone in m. */
static bool pays(const sample *s, bool mirrored, double m)
{
    double capital = 0;
    for (size_t i = 0; i < s->n; i++) {
        const double x = mirrored ? 1 - unit(s, i) : unit(s, i);
        capital += koksma__log1p(fmin(s->scratch[i], 0.75 / m) * (x - m));
        if (capital >= koksma__log(2 / s->miss)) {
            return true;
        }
    }
    return false;
}

/* The largest m, from 0 on, that the bets refute. */
static double refuted(const sample *s, bool mirrored)
{
    double low = 0, high = 1;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        *(pays(s, mirrored, middle) ? &low : &high) = middle;
    }
    return low;
}

/* The interval of the hedged capital process (Waudby-Smith & Ramdas 2024, theorem 3 and section 4.4): all means m
   against which neither of two gamblers, who bet on more and on less and own half of the capital each, ever reaches
   1 / miss of the whole. Stakes are truncated at 3/4 of what would risk all. */
static koksma_status betting(sample *s, double *low, double *high)
{
    running r = prior;
    for (size_t i = 0; i < s->n; i++) {
        s->scratch[i] = stake(s, &r);
        look_at(&r, unit(s, i));
    }
    const double range = s->highest - s->lowest;
    *low = s->lowest + range * refuted(s, false);
    *high = s->highest - range * refuted(s, true);
    return KOKSMA_OK;
}

/* The percentile interval of the estimator over resamples of the y (Efron 1979). */
static koksma_status bootstrap(sample *s, double *low, double *high)
{
    double *found = malloc(RESAMPLES * sizeof *found);
    KOKSMA__REQUIRE_MEMORY(found, RESAMPLES * sizeof *found);
    koksma_status status = KOKSMA_OK;
    for (uint64_t k = 0; k < RESAMPLES && !status; k++) {
        for (size_t i = 0; i < s->n; i++) {
            const uint32_t word = koksma__random(k, KOKSMA__PURPOSE_SEARCH, i, 0).w[0];
            s->scratch[i] = s->values[koksma__below(word, (uint32_t)s->n)];
        }
        found[k] = s->estimator->of(s->scratch, s->n);
        status = koksma__look(s->run, (size_t)k, 0);
    }
    sort(found, RESAMPLES);
    const size_t cut = (size_t)(s->miss / 2 * (RESAMPLES + 1));
    *low = found[cut ? cut - 1 : 0];
    *high = found[RESAMPLES - (cut ? cut : 1)];
    free(found);
    return status;
}

/* Both intervals with half of the risk; the quantile's is taken where it is narrower, and all y differ by less than
   SPREAD of a point's share. The second is for functions with jumps. Sets that differ by one point on one side
   of a jump give estimates in two clusters, of which the median's interval is one, and the integral may be between them. */
static koksma_status choose(sample *s, double *low, double *high)
{
    sample half = *s;
    double lowest, highest;
    half.miss /= 2;
    KOKSMA__TRY(quantile(&half, &lowest, &highest));
    const double spread = s->scratch[s->n - 1] - s->scratch[0]; /* quantile leaves the values in order */
    KOKSMA__TRY(student(&half, low, high));
    const bool tails = spread < SPREAD * s->share && highest - lowest < *high - *low;
    s->estimator = s->estimator ? s->estimator : tails ? &median_row : &mean_row;
    s->interval = tails ? "quantile" : "student";
    *low = tails ? lowest : *low;
    *high = tails ? highest : *high;
    return KOKSMA_OK;
}

static const interval_row interval_rows[] = {
    {{"auto",
      "the narrower of quantile and student, if the y differ by less than 0.7 of a point's share; else student",
      "clopper1934 student1908", NULL,
      "what the one that it takes assumes; each has half of the risk, so that the choice costs no coverage", false,
      false},
     choose},
    {{"quantile", "order statistics y_(k) and y_(R + 1 - k) that hold the median of an estimate's distribution",
      "clopper1934", "median",
      "the integral is the median of the distribution of y, as where that is symmetric; then proved "
      "for every R that it takes (6 for 95 %)",
      false, false},
     quantile},
    {{"student", "mean of the y, +- t sd / sqrt R", "student1908 lecuyer2023", "mean",
      "the y are normal, or R is large", false, false},
     student},
    {{"bootstrap", "percentiles of the estimator in 2000 resamples of the y", "efron1979 lecuyer2023", "mean",
      "R is large; with few replicates it is too narrow", false, false},
     bootstrap},
    {{"empirical-bernstein", "predictable plug-in empirical Bernstein interval of the mean of the y",
      "waudbysmith2024 jain2025", "mean", "the values of the integrand lie between the bounds that are given", true,
      true},
     empirical_bernstein},
    {{"betting", "means that bets on the y, with the hedged capital process, do not refute",
      "waudbysmith2024 jain2025", "mean", "the values of the integrand lie between the bounds that are given", true,
      true},
     betting},
};
enum { N_INTERVALS = sizeof interval_rows / sizeof *interval_rows };

const koksma_interval *koksma_interval_at(size_t i)
{
    return i < N_INTERVALS ? &interval_rows[i].public : NULL;
}

static const char *interval_name_at(const void *table, size_t i)
{
    (void)table;
    return i < N_INTERVALS ? interval_rows[i].public.name : NULL;
}

static const interval_row *find_interval(const char *name)
{
    for (size_t i = 0; i < N_INTERVALS; i++) {
        if (!strcmp(interval_rows[i].public.name, name)) {
            return &interval_rows[i];
        }
    }
    return NULL;
}

const koksma_interval *koksma_interval_find(const char *name)
{
    KOKSMA__REQUIRE_OR(NULL, name);
    const interval_row *found = find_interval(name);
    return found ? &found->public : NULL;
}

/* ---- Both -------------------------------------------------------------------------------------------------------- */

/* Finds the members and checks the other options. */
static koksma_status parse(const koksma_estimate_options *o, sample *s, const interval_row **interval)
{
    s->estimator = o->estimator ? koksma_estimator_find(o->estimator) : NULL;
    if (o->estimator && !s->estimator) {
        return koksma__fail_unknown("estimator", o->estimator, koksma_estimator_name_at, NULL,
                                    "'koksma list estimators' names them");
    }
    const char *name = o->interval    ? o->interval
                       : o->estimator ? s->estimator->interval
                                      : interval_rows[0].public.name;
    *interval = find_interval(name);
    if (!*interval) {
        return koksma__fail_unknown("interval", name, interval_name_at, NULL, "'koksma list intervals' names them");
    }
    const char *natural = (*interval)->public.estimator;
    s->estimator = s->estimator || !natural ? s->estimator : koksma_estimator_find(natural);
    s->interval = (*interval)->public.name;
    const bool known = o->lowest != 0 || o->highest != 0;
    const double confidence = o->confidence == 0 ? 0.95 : o->confidence;
    KOKSMA__FAIL_IF(!(confidence > 0 && confidence < 1), KOKSMA_ARGUMENT,
                    "confidence: it takes a number above 0 and below 1, not %g", confidence);
    KOKSMA__FAIL_IF(known && !(isfinite(o->lowest) && isfinite(o->highest) && o->lowest < o->highest),
                    KOKSMA_ARGUMENT, "bounds: they must be finite, the lowest below the highest, not %g and %g",
                    o->lowest, o->highest);
    KOKSMA__FAIL_IF(!known && (*interval)->public.bounded, KOKSMA_ARGUMENT,
                    "the interval %s needs bounds of the integrand's values", name);
    KOKSMA__FAIL_IF(!(o->share >= 0), KOKSMA_ARGUMENT, "share: it takes 0 or more, not %g", o->share);
    s->miss = 1 - confidence;
    s->share = o->share;
    s->lowest = known ? o->lowest : -HUGE_VAL;
    s->highest = known ? o->highest : HUGE_VAL;
    return KOKSMA_OK;
}

koksma_status koksma_estimate_integral(const koksma_estimate_options *options, const double *values, size_t n,
                                       const koksma_run *run, koksma_integral_estimate *out)
{
    KOKSMA__REQUIRE(options, values, out);
    KOKSMA__REQUIRE_RUN(run);
    sample s = {.values = values, .n = n, .run = run};
    const interval_row *interval = NULL;
    KOKSMA__TRY(parse(options, &s, &interval));
    KOKSMA__FAIL_IF(n < 2 || n > UINT32_MAX / 2, KOKSMA_ARGUMENT, "n: an interval takes 2 values or more, not %zu",
                    n);
    for (size_t i = 0; i < n; i++) {
        const double slack =
            1e-12 * fmax(fabs(s.lowest), fabs(s.highest)); /* of sums that rounding took over a bound */
        KOKSMA__FAIL_IF(!isfinite(values[i]), KOKSMA_ARGUMENT, "values: estimate %zu is %g, which has no interval", i,
                        values[i]);
        KOKSMA__FAIL_IF(isfinite(slack) && !(values[i] >= s.lowest - slack && values[i] <= s.highest + slack),
                        KOKSMA_ARGUMENT, "values: estimate %zu is %g, outside the bounds %g and %g", i, values[i],
                        s.lowest, s.highest);
    }
    s.scratch = malloc(n * sizeof *s.scratch);
    KOKSMA__REQUIRE_MEMORY(s.scratch, n * sizeof *s.scratch);
    koksma_integral_estimate e = {.confidence = 1 - s.miss};
    const koksma_status status = interval->of(&s, &e.low, &e.high);
    if (!status) {
        memcpy(s.scratch, values, n * sizeof *values);
        e.value = s.estimator->of(s.scratch, n);
        e.estimator = s.estimator->name;
        e.interval = s.interval;
        e.error = fmax(e.high - e.value, e.value - e.low);
        *out = e;
    }
    free(s.scratch);
    return status;
}
