/* SPDX-License-Identifier: Apache-2.0 */
/* Does a job: generates and measures one point set, or renders one image and compares it with its references, with the
   last one by several metrics. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <koksma/integrate.h>
#include <koksma/warp.h>

#include "core/status.h"
#include "image/coherence.h"
#include "image/metrics/metrics.h"
#include "patterns/files/files.h"
#include "study/run/tasks.h"

/* Bounds of a value that are at most this far apart count as exact; the limit is larger than the rounding error. */
static const double AS_GOOD_AS_EXACT = 2e-12;

/* Checks that a value can be stored: it must be finite. The store has one number for each value, not a lower and an
   upper bound. So the value of a measure that promises exact values is rejected if its search was cut short; the
   estimates or bounds of a measure that promises only these are stored. */
static koksma_status check_value(const koksma_spec *measure, const koksma_value *value)
{
    char text[KOKSMA_MAX_SPEC];
    if (!isfinite(value->value)) {
        koksma_spec_text(measure, text);
        return koksma__fail(KOKSMA_IMPOSSIBLE, "%s: its value is %g, but a study can store only finite values", text,
                            value->value);
    }
    if (value->exact || measure->measure->answer != KOKSMA_ANSWER_EXACT ||
        value->upper - value->lower <= AS_GOOD_AS_EXACT) {
        return KOKSMA_OK;
    }
    koksma_spec_text(measure, text);
    return koksma__fail(KOKSMA_IMPOSSIBLE,
                        "%s: the value is only known to be from %.9g to %.9g, because the search was cut short, but "
                        "a study needs exact values; leave out that measure or n",
                        text, value->lower, value->upper);
}

/* Integrates a test integrand by the mean over the points; *error: its absolute error. */
static koksma_status integrate(const char *spec, const koksma_points *points, const koksma_run *run, double *error)
{
    koksma_integral *integral;
    koksma_integral_facts facts;
    double mean = NAN;
    KOKSMA__TRY(koksma_integral_open(spec, points->dim, &integral));
    koksma_integral_about(integral, &facts);
    koksma_status status = koksma_integrate(integral, points, run, &mean);
    koksma_integral_close(integral);
    *error = fabs(mean - facts.value);
    KOKSMA__FAIL_IF(!status && !isfinite(*error), KOKSMA_IMPOSSIBLE,
                    "%s: its error is %g, but a study can store only finite values", spec, *error);
    return status;
}

static koksma_status measure(const koksma__task *t, const koksma_points *points, const koksma_run *run,
                             koksma__result *results)
{
    const koksma_warp *warp = t->variant[0] ? koksma_warp_find(t->variant) : NULL;
    koksma_status status = KOKSMA_OK;
    for (size_t m = 0; !status && m < t->n_series; m++) {
        koksma_spec spec;
        koksma_value value = {0};
        const char *integrand = koksma__integrand_of(t->measures[m]);
        results[m].values[1] = results[m].values[2] = results[m].values[3] = NAN;
        if (integrand) {
            status = integrate(integrand, points, run, &results[m].values[0]);
            continue;
        }
        status = koksma_measure_spec(t->measures[m], &spec);
        if (!status) {
            status = warp ? koksma_warp_evaluate(warp, &spec, points, run, &value)
                          : koksma_evaluate(&spec, points, run, &value);
        }
        status = status ? status : check_value(&spec, &value);
        results[m].values[0] = value.value;
    }
    return status;
}

static koksma_status do_discrepancy(const koksma__task *t, uint64_t seed, const koksma_run *run,
                                    koksma__result *results)
{
    koksma_spec pattern;
    koksma_points points;
    KOKSMA__TRY(koksma_pattern_spec(t->pattern, &pattern));
    KOKSMA__TRY(koksma_points_init(&points, (size_t)t->n, t->discrepancy->dim));
    koksma_status status = koksma__file_gap(&pattern, points.n, koksma_generate(&pattern, seed, run, &points));
    status = status ? status : measure(t, &points, run, results);
    koksma_points_fini(&points);
    return status;
}

/* The coherence of one image's error. An error that is equal in all pixels has no peak, and neither has an image too
   small for two frequencies; the coherence is then stored as 0, which is below that of any noise. */
static koksma_status find_coherence(const koksma_image *image, const koksma_image *reference,
                                    double values[KOKSMA__RESULT_VALUES])
{
    koksma_coherence coherence;
    koksma_coherence_values found;
    koksma_status status = koksma_coherence_init(&coherence, image->width, image->height);
    status = status ? status : koksma_coherence_add(&coherence, image, reference);
    if (!status) {
        koksma_coherence_find(&coherence, &found);
        const double none[] = {0, 1, 0, 0}, peak[] = {found.coherence, found.p, found.frequency_x, found.frequency_y};
        memcpy(values, isnan(found.coherence) ? none : peak, sizeof none);
    }
    koksma_coherence_fini(&coherence);
    return status;
}

/* Evaluates the metrics of an image block; results[m] is that of metric m. */
static koksma_status evaluate_metrics(const koksma__texts *metrics, const koksma_image *image,
                                      const koksma_image *reference, koksma__result *results)
{
    koksma_metric_spec specs[KOKSMA__MOST_METRICS];
    koksma_metric_value found[KOKSMA__MOST_METRICS];
    koksma_status status = KOKSMA_OK;
    for (size_t m = 0; !status && m < metrics->n; m++) {
        status = koksma_metric_parse(metrics->at[m], &specs[m]);
    }
    status = status || !metrics->n ? status : koksma__metrics_evaluate(specs, metrics->n, image, reference, found);
    for (size_t m = 0; !status && m < metrics->n; m++) {
        const double values[KOKSMA__RESULT_VALUES] = {found[m].value, found[m].robust, found[m].top_share, NAN};
        memcpy(results[m].values, values, sizeof values);
    }
    return status;
}

static koksma_status do_image(const koksma_study *study, const koksma__task *t, uint64_t seed, const koksma_run *run,
                              koksma__result *results)
{
    koksma_image image;
    const koksma__picture picture = {.pattern = t->pattern,
                                     .variant = t->variant,
                                     .spp = t->n,
                                     .width = t->width,
                                     .height = t->height,
                                     .seed = seed};
    const size_t last = t->image->n_references;
    KOKSMA__TRY(koksma__study_render(t->scene, &picture, run, &image));
    koksma_status status = KOKSMA_OK;
    const koksma_image *const reference = &study->references[t->references[last]].image;
    for (size_t r = 0; !status && r < last; r++) {
        koksma_image_error error = {0};
        status = koksma_image_compare(&image, &study->references[t->references[r]].image, &error);
        const double values[KOKSMA__RESULT_VALUES] = {error.mean, error.sd, error.max, error.rmse};
        memcpy(results[r].values, values, sizeof values);
    }
    status = status ? status : find_coherence(&image, reference, results[last].values);
    status = status ? status : evaluate_metrics(&t->image->metrics, &image, reference, &results[last + 1]);
    koksma_image_fini(&image);
    return status;
}

void koksma__task_name(const koksma_study *study, const koksma__task *t, long long trial, char name[KOKSMA__JOB_NAME])
{
    const koksma__plan *plan = &study->plan;
    if (t->image) {
        snprintf(name, KOKSMA__JOB_NAME, "images[%td], %.64s%s%s, %s, %lld samples a pixel, trial %lld",
                 t->image - plan->images, t->scene->name, t->variant[0] ? ", " : "", t->variant, t->pattern, t->n,
                 trial);
    } else {
        snprintf(name, KOKSMA__JOB_NAME, "discrepancies[%td], %s%s%s, n = %lld, trial %lld",
                 t->discrepancy - plan->discrepancies, t->pattern, t->variant[0] ? " through " : "", t->variant, t->n,
                 trial);
    }
}

/* Puts the job's name before the error text. */
static koksma_status fail_job(const koksma_study *study, const koksma__task *t, long long trial, koksma_status status)
{
    char name[KOKSMA__JOB_NAME];
    koksma__task_name(study, t, trial, name);
    return koksma__fail_in(status, name);
}

koksma_status koksma__task_do(const koksma_study *study, const koksma__task *t, long long trial,
                              const koksma_run *run, koksma__result *results)
{
    const uint64_t seed = koksma__task_seed(t, trial);
    for (size_t k = 0; k < t->n_series; k++) {
        results[k].trial = trial;
        results[k].seed = seed;
    }
    const koksma_status status =
        t->image ? do_image(study, t, seed, run, results) : do_discrepancy(t, seed, run, results);
    const bool by_itself =
        !status || status == KOKSMA_INTERRUPTED || status == KOKSMA_MEMORY; /* not a failure of this job */
    return by_itself ? status : fail_job(study, t, trial, status);
}
