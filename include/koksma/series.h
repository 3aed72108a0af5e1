/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A measure as a function of the number of points: values over sets, the prefixes of a sequence, the slope on
 * logarithmic axes, and the exponents that theory gives.
 *
 *     size_t sizes[] = {64, 256, 1024};
 *     koksma_value values[3];
 *     koksma_tally tallies[3] = {0};
 *     for each set: koksma_evaluate_prefixes(&measure, &points, sizes, 3, NULL, values) and koksma_tally_add;
 *     koksma_log_line(3, xs, means, &line): line.slope and line.slope_error
 */
#ifndef KOKSMA_SERIES_H
#define KOKSMA_SERIES_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Values over sets (Welford 1962): all zero is none. */
typedef struct koksma_tally {
    double count, mean;
    double spread; /* the sum of squared deviations from the mean */
    double min, max;
} koksma_tally;

KOKSMA_API void koksma_tally_add(koksma_tally *tally, double value);

/* The sample's standard deviation, the mean's standard error, and half of the mean's 95 % interval by Student's t;
   NaN for fewer than two values. */
KOKSMA_API double koksma_tally_sd(const koksma_tally *tally);
KOKSMA_API double koksma_tally_error(const koksma_tally *tally);
KOKSMA_API double koksma_tally_interval(const koksma_tally *tally);

/* The 97.5 % point of Student's t with the given degrees of freedom; NaN for 0. */
KOKSMA_API double koksma_student_975(size_t degrees);

/* log y = slope log x + intercept by least squares, with the error that the residuals give the slope. */
typedef struct koksma_line {
    size_t count; /* pairs that were used: those with x, y > 0 and finite */
    double slope, slope_error, intercept;
} koksma_line;

/* False with fewer than three pairs to be used, or all at one x. */
KOKSMA_API bool koksma_log_line(size_t n, const double *xs, const double *ys, koksma_line *line);

/* Evaluates a measure of the first sizes[i] points for each i < n_sizes; a size may be up to points->n. Errors: those
   of koksma_evaluate; N for a size of 0 or beyond. */
KOKSMA_API koksma_status koksma_evaluate_prefixes(const koksma_spec *measure, const koksma_points *points,
                                                  const size_t *sizes, size_t n_sizes, const koksma_run *run,
                                                  koksma_value *values);

/* The exponent a of the measure's decay n^-a for a pattern with its parameters in dim dimensions, powers of log n
   left out, where a theorem covers what the pattern claims; else NaN. */
KOKSMA_API double koksma_rate(const koksma_spec *pattern, const koksma_measure *measure, int dim);

/* The largest exponent that any points can have, powers of log n left out; NaN where none is known. */
KOKSMA_API double koksma_best_rate(const koksma_measure *measure, int dim);

#ifdef __cplusplus
}
#endif

#endif
