/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs the rounds of a contest (ranking_contest.h). Long because it makes the references too, whose stages follow the
 * rounds. Of the patterns with an undecided pair that bears on the goal,
 * those with the fewest complete rounds make their next round together: only the decisions determine which patterns
 * make a round. The clock has two effects only: the time limit may end the contest, and a pattern whose first round
 * takes more thread time than its share (the time left times the threads, divided by the number of patterns) is
 * postponed. The other patterns continue without a postponed one until their leader is decided; the postponed
 * patterns get the time that is left. Because the decision about a pair after a round depends only on the errors,
 * the clock changes how far the ranking gets, but never a decision.
 *
 * The coherence of a pattern's error is measured on the trials of round 0, however long the ranking runs, because
 * the noise of a coherence depends on the number of trials. The trials are added in their order, whichever thread
 * rendered them: a trial that is complete too early waits.
 */
#include "study/ranking/ranking_contest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/c_locale.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "image/coherence.h"
#include "image/doubt.h"
#include "image/formats.h"
#include "image/image.h"

/* ---- The reference ----------------------------------------------------------------------------------------------- */

/*
 * The reference of a ranking is the mean of sixteen replicates. At stage 0 each has as many samples as the patterns, and
 * at least 16; at each further stage 4 times as many, as far as KOKSMA_MAX_SPP allows: at stage 2 the reference has 256
 * times as many samples as a trial. Where errors fall as slowly as 1/sqrt N, its error is then 1/16 of that of an image
 * with the same pattern; where they fall as N^-3/4, it is 1/32. Stage 1 begins with 24 trials of a pattern and stage 2
 * with 96, so that a reference costs at most about as much as the trials of the closest patterns so far, and a ranking
 * shows its first results after the time of 16 trials and of the first rounds. The mean without replicate r is computed
 * as mean - (replicate r - mean) / (k - 1) for k replicates, so that equal replicates give exactly equal means.
 */

enum { REPLICATES = KOKSMA__RANK_REPLICATES, LEAST_SPP = 16, STAGE_1 = 3, STAGE_2 = 7, LEAST_PIXELS = 256 };

/* The stage of the reference against which the trials of a round are measured. */
static int stage_of(int round)
{
    return round < STAGE_1 ? 0 : round < STAGE_2 ? 1 : 2;
}

long long koksma__rank_reference_spp(int spp, int stage)
{
    const long long least = (long long)(spp > LEAST_SPP ? spp : LEAST_SPP) << 2 * stage;
    long long side = 1;
    while (side * side < least && side * side < KOKSMA_MAX_SPP) {
        side++;
    }
    return side * side;
}

/* The luminance of pixel p of the mean so far. */
static double luminance(const koksma__rank_reference *reference, size_t p)
{
    const double *v = reference->mean + p * (size_t)reference->metric.metric->channels;
    return reference->metric.metric->channels == 1 ? v[0] : KOKSMA__LUMINANCE(v);
}

/* Adds a replicate by Welford's method (1962). squares: sums of the squared deviations of each pixel's luminance.
   Returns whether all pixels are finite. */
static bool add_replicate(koksma__rank_reference *reference, const koksma_image *image, double *squares)
{
    bool finite = true;
    const int r = reference->made++;
    const size_t channels = (size_t)reference->metric.metric->channels;
    double *const values = reference->without + (size_t)r * reference->values;
    koksma__metric_values(reference->metric.metric, image, values);
    for (size_t p = 0; p < reference->pixels; p++) {
        const double y = koksma__luminance(image, p), off = y - luminance(reference, p);
        for (size_t v = p * channels; v < (p + 1) * channels; v++) {
            reference->mean[v] += (values[v] - reference->mean[v]) / (r + 1);
            finite &= (bool)isfinite(values[v]);
        }
        squares[p] += off * (y - luminance(reference, p));
    }
    return finite;
}

/* Computes the expected error of the reference and its means without each replicate. A normal error of standard
   deviation s / sqrt k has the mean absolute value sqrt(2/pi) s / sqrt k. */
static void finish(koksma__rank_reference *reference, const double *squares)
{
    double total = 0;
    for (size_t p = 0; p < reference->pixels; p++) {
        total += sqrt(2 / M_PI * squares[p] / (REPLICATES - 1) / REPLICATES);
    }
    for (size_t i = 0; i < REPLICATES * reference->values; i++) {
        const double mean = reference->mean[i % reference->values];
        reference->without[i] = mean - (reference->without[i] - mean) / (REPLICATES - 1);
    }
    reference->error = total / (double)reference->pixels;
}

/* Allocates a reference without replicates. Errors: MEMORY. */
static koksma_status begin(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                           const koksma__study_scene *scene)
{
    const size_t pixels = (size_t)scene->width * (size_t)scene->height;
    *reference = (koksma__rank_reference){.metric = metric ? *metric : (koksma_metric_spec){&koksma__metric_mae, {0}},
                                          .width = scene->width,
                                          .height = scene->height,
                                          .pixels = pixels};
    reference->values = pixels * (size_t)reference->metric.metric->channels;
    reference->mean = calloc(reference->values, sizeof *reference->mean);
    reference->without = calloc(reference->values, REPLICATES * sizeof *reference->without);
    return reference->mean && reference->without
               ? KOKSMA_OK
               : koksma__fail_memory(reference->values * (REPLICATES + 1) * sizeof *reference->mean);
}

static koksma_status fail_of_pixels(const koksma__study_scene *scene)
{
    return koksma__fail(KOKSMA_IMPOSSIBLE, "%s: pixels of the reference are not finite numbers", scene->name);
}

static koksma_status render_replicate(koksma__rank_reference *reference, const koksma__study_scene *scene,
                                      koksma__picture *picture, int stage, double *squares, const koksma_run *run)
{
    koksma_image image;
    picture->seed = koksma__job_seed("rank-reference|%s|%s|%dx%d|%d|%d", scene->hash, picture->variant, scene->width,
                                     scene->height, stage, reference->made);
    KOKSMA__TRY(koksma__study_render(scene, picture, run, &image));
    const koksma_status status = add_replicate(reference, &image, squares) ? KOKSMA_OK : fail_of_pixels(scene);
    koksma_image_fini(&image);
    return status;
}

/* Renders the replicates, never adaptively. metric: NULL for mae; variant: that of the trials. The reference has the
   scene's width and height. Errors: those of rendering, IMPOSSIBLE (a pixel is not a finite number, or another renderer
   makes equal pictures for all seeds), MEMORY, INTERRUPTED. koksma__rank_reference_fini also accepts a zeroed reference
   and one whose init failed. */
static koksma_status init_reference(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                    const koksma__study_scene *scene, const char *pattern, const char *of_trials,
                                    int spp, int stage, const koksma_run *run)
{
    char variant[KOKSMA__VARIANT_TEXT];
    koksma__variant_of_reference(of_trials, variant);
    koksma_status status = begin(reference, metric, scene);
    double *squares = calloc(reference->pixels, sizeof *squares);
    koksma__picture picture = {.pattern = pattern,
                               .variant = variant,
                               .spp = koksma__rank_reference_spp(spp, stage),
                               .width = scene->width,
                               .height = scene->height};
    status = status || squares ? status : koksma__fail_memory(reference->pixels * sizeof *squares);
    while (!status && reference->made < REPLICATES) {
        status = render_replicate(reference, scene, &picture, stage, squares, run);
    }
    if (!status) {
        finish(reference, squares);
        status = scene->render && reference->error == 0
                     ? koksma__fail(KOKSMA_IMPOSSIBLE,
                                    "%s: %s makes the same picture for every seed, but a reference needs a pattern "
                                    "that depends on the seed",
                                    scene->name, pattern)
                     : KOKSMA_OK;
    }
    free(squares);
    return status;
}

/* Takes a finished image as the reference, as if it had no error. Errors: ARGUMENT (another size), MEMORY. */
static koksma_status take_reference(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                    const koksma__study_scene *scene, const koksma_image *image)
{
    KOKSMA__TRY(koksma__image_usable(image));
    KOKSMA__FAIL_IF(image->width != scene->width || image->height != scene->height, KOKSMA_ARGUMENT,
                    "the reference has %d x %d pixels, and the images of the patterns %d x %d: choose its size",
                    image->width, image->height, scene->width, scene->height);
    KOKSMA__TRY(begin(reference, metric, scene));
    koksma__metric_values(reference->metric.metric, image, reference->mean);
    bool finite = true;
    for (size_t v = 0; v < reference->values; v++) {
        finite &= (bool)isfinite(reference->mean[v]);
    }
    for (size_t i = 0; i < REPLICATES * reference->values; i++) {
        reference->without[i] = reference->mean[i % reference->values];
    }
    reference->made = REPLICATES;
    reference->error = NAN;
    return finite ? KOKSMA_OK : fail_of_pixels(scene);
}

void koksma__rank_reference_fini(koksma__rank_reference *reference)
{
    free(reference->mean);
    free(reference->without);
    *reference = (koksma__rank_reference){0};
}

/* Measures the errors of an image against the reference. Errors: MEMORY. */
static koksma_status compare_with(const koksma__rank_reference *reference, const koksma_image *image,
                                  double errors[KOKSMA__RANK_ERRORS])
{
    const koksma_metric_spec *spec = &reference->metric;
    const size_t size = (reference->values + reference->pixels) * sizeof(double);
    double *const values = malloc(size);
    KOKSMA__REQUIRE_MEMORY(values, size);
    double *const map = values + reference->values;
    koksma__metric_values(spec->metric, image, values);
    koksma_status status = KOKSMA_OK;
    for (int r = REPLICATES; !status && r >= 0; r--) {
        const koksma_metric_input in = {spec->params, reference->width, reference->height, values,
                                        r ? reference->without + (size_t)(r - 1) * reference->values
                                          : reference->mean};
        const char kept = koksma__call_begin();
        status = koksma__call_end(kept, spec->metric->errors(&in, map), "koksma_metric.errors");
        if (!status) {
            const koksma_metric_value value = koksma__metric_pool(spec->metric, map, reference->pixels);
            errors[r] = value.value;
            errors[KOKSMA__RANK_ROBUST + r] = value.robust;
            errors[KOKSMA__RANK_TOP_SHARE] = value.top_share; /* at last against the whole reference */
        }
    }
    free(values);
    return status;
}

/* Computes the signed luminance error of each pixel of the image. */
static void subtract_from(const koksma__rank_reference *reference, const koksma_image *image, double *errors)
{
    for (size_t p = 0; p < reference->pixels; p++) {
        errors[p] = koksma__luminance(image, p) - luminance(reference, p);
    }
}

enum { BATCH = 64, FIRST = KOKSMA__RANK_FIRST_ROUND, ERRORS = KOKSMA__RANK_ERRORS };

/* Trials of one round that are rendered in parallel. */
typedef struct batch {
    koksma__contest *contest;
    const koksma__rank_reference *reference;
    const size_t *active; /* indices of the contestants that make the round */
    size_t n_active, first, count;
    bool first_round;
    /* The errors of trial first + t of contestant active[a], at (a * count + t) * ERRORS. In the first round
       `errors` is NULL, and the contestants hold the errors. */
    double *errors;
} batch;

/* A piece of work that counts against a contestant's share of the time. */
typedef struct timed {
    koksma__contest *contest;
    koksma__contestant *contestant;
    double start_s, fraction; /* fraction: the part of the image that is done */
    bool late;
} timed;

static unsigned long long since_ns(double start_s)
{
    return (unsigned long long)fmax(1e9 * (koksma__now_s() - start_s), 0);
}

static bool keep_in_share(void *context, double fraction)
{
    timed *t = context;
    const koksma__contest *c = t->contest;
    t->fraction = fraction;
    if (!koksma__keep_going(&c->control->job, fraction)) {
        return false;
    }
    t->late = t->late || (c->share_ns && atomic_load(&t->contestant->busy_ns) + since_ns(t->start_s) > c->share_ns);
    return !t->late;
}

static koksma_run run_in_share(timed *t)
{
    return (koksma_run){.threads = 1, .keep_going = keep_in_share, .context = t};
}

/* Excludes or postpones the contestant after a failure that concerns only this contestant, and returns OK; returns
   other failures unchanged. */
static koksma_status take_out(const timed *t, size_t trial, koksma_status status)
{
    koksma__contest *c = t->contest;
    koksma__contestant *p = t->contestant;
    if (status == KOKSMA_INTERRUPTED && t->late) {
        atomic_store(&p->late, true);
        return KOKSMA_OK;
    }
    if (!koksma__rank_leaves_out(status)) {
        return status;
    }
    pthread_mutex_lock(&c->lock);
    if (!atomic_load(&p->refused) || trial < p->refused_trial) {
        snprintf(p->reason, sizeof p->reason, "%s", koksma_error_text());
        p->refused_trial = trial;
        atomic_store(&p->refused, true);
    }
    pthread_mutex_unlock(&c->lock);
    return KOKSMA_OK;
}

/* ---- Trials --------------------------------------------------------------------------------------------- */

/* Adds the pixel errors of a trial to the sums of the coherence, in the order of the trials. If an earlier trial is
   missing, the errors are kept until it has been added; otherwise they are added now, and after them the kept errors of
   the next trials. Takes ownership of `errors`. */
static koksma_status add_coherence(const koksma__contest *c, koksma__contestant *p, size_t trial, double *errors)
{
    koksma_status status = KOKSMA_OK;
    pthread_mutex_lock(&p->lock);
    p->waiting[trial] = errors;
    if (!p->sums.error) {
        status = koksma_coherence_init(&p->sums, c->scene.width, c->scene.height);
    }
    while (!status && p->added < FIRST && p->waiting[p->added]) {
        status = koksma__coherence_add_errors(&p->sums, p->waiting[p->added]);
        free(p->waiting[p->added]);
        p->waiting[p->added++] = NULL;
    }
    if (!status && p->added == FIRST) {
        koksma_coherence_find(&p->sums, &p->coherence);
        koksma_coherence_fini(&p->sums);
    }
    pthread_mutex_unlock(&p->lock);
    return status;
}

static koksma_status measure_coherence(const batch *b, koksma__contestant *p, size_t trial, const koksma_image *image)
{
    double *errors = malloc(b->reference->pixels * sizeof *errors);
    KOKSMA__REQUIRE_MEMORY(errors, b->reference->pixels * sizeof *errors);
    subtract_from(b->reference, image, errors);
    return add_coherence(b->contest, p, trial, errors);
}

/* Replaces the image of a trial by what options->process makes of it; frees it after an error. */
static koksma_status process(const koksma__contest *c, const koksma_run *run, koksma_image *image)
{
    koksma_image out = {0};
    const char kept = koksma__call_begin();
    koksma_status status = koksma__call_end(kept, c->options->process(c->options->process_context, image, run, &out),
                                            "options->process");
    if (!status && (out.width != image->width || out.height != image->height)) {
        status = koksma__fail(KOKSMA_IMPOSSIBLE, "the processed image has %d x %d pixels instead of %d x %d",
                              out.width, out.height, image->width, image->height);
        koksma_image_fini(&out);
    }
    koksma_image_fini(image);
    *image = out;
    return status;
}

/* Renders the image of a trial, or takes it from the first look. */
static koksma_status make_image(const koksma__contest *c, koksma__contestant *p, size_t trial, const koksma_run *run,
                                koksma_image *image)
{
    const char *pattern = c->options->patterns[p->pattern];
    const koksma__picture picture = {.pattern = pattern,
                                     .variant = c->variant,
                                     .spp = c->options->spp,
                                     .width = c->scene.width,
                                     .height = c->scene.height,
                                     .seed = koksma__job_seed("rank|%s|%s|%s|%d|%dx%d|%zu", c->scene.hash, pattern,
                                                              c->variant, c->options->spp, c->scene.width,
                                                              c->scene.height, trial)};
    if (trial < KOKSMA__RANK_LOOKS && p->seen[trial].pixels) {
        *image = p->seen[trial];
        p->seen[trial] = (koksma_image){0};
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__study_render(&c->scene, &picture, run, image);
    return status || !c->options->process ? status : process(c, run, image);
}

/* Notes what a picture tells of a reference that was given, or of a process. */
static koksma_status doubt(const batch *b, const koksma_image *image)
{
    koksma__contest *c = b->contest;
    const char *made = c->options->process ? "processed picture" : "picture";
    koksma_image mean;
    double number;
    KOKSMA__TRY(koksma_image_init(&mean, image->width, image->height, image->channels));
    for (size_t i = 0; i < b->reference->pixels * (size_t)image->channels; i++) {
        mean.pixels[i] = (float)luminance(b->reference, i / (size_t)image->channels);
    }
    const koksma__likeness like = koksma__image_likeness(image, &mean, false, &number);
    koksma_image_fini(&mean);
    if (like == KOKSMA__LIKE_SCALED) {
        koksma__snprintf(c->doubt, sizeof c->doubt,
                         "a %s of %s has %.4g times the light of the reference; do the units differ?", made,
                         c->scene.name, number);
    } else if (like == KOKSMA__LIKE_WHOLE) {
        koksma__snprintf(c->doubt, sizeof c->doubt,
                         "%.0f pixels of the reference are black, and not in a %s of %s: was it interrupted, or is "
                         "it of direct light?",
                         number, made, c->scene.name);
    } else if (like == KOKSMA__LIKE_ANOTHER) {
        snprintf(c->doubt, sizeof c->doubt,
                 "a %s of %s differs from the reference by more than noise: another scene, view or exposure?", made,
                 c->scene.name);
    }
    return KOKSMA_OK;
}

/* Whether doubts about a given reference, or a process, are wanted. */
static bool doubts(const koksma__contest *c)
{
    return c->options->doubt && (c->options->reference_image || c->options->process) && !c->asked;
}

/* After the first round, notes that a part of the error of every unbiased pattern is the same in all its pictures: the
   reference has it. If it leaves bands in all, it is no noise, and even a small part tells. A fifth of the squared error
   is noise of a quarter of the pictures' variance. */
static void doubt_reference(koksma__contest *c)
{
    double least = 1;
    size_t n = 0, n_bands = 0;
    for (size_t i = 0; i < c->n; i++) {
        const koksma__contestant *p = &c->contestants[i];
        const bool biased = !c->options->render && koksma__image_pattern_is_biased(c->options->patterns[p->pattern]);
        if (p->coherence.images && !biased) {
            least = fmin(least, p->coherence.common);
            n_bands += p->coherence.coherent;
            n++;
        }
    }
    const bool bands = n && n_bands == n;
    if (c->doubt[0] || c->options->process || c->options->adaptive || c->references[0].pixels < LEAST_PIXELS ||
        least < (bands && n > 1 ? 1e-3 : 0.2) || least > 0.999) {
        return;
    }
    if (bands) {
        snprintf(
            c->doubt, sizeof c->doubt,
            "the pictures of each pattern agree with each other, but not with the reference: another integrator, "
            "depth, filter or exposure?");
    } else {
        koksma__snprintf(c->doubt, sizeof c->doubt,
                         "the reference has noise: at least %.0f %% of each pattern's squared error is in all its "
                         "pictures, so that errors are too large by %.0f %% or more",
                         100 * least, 100 * (sqrt(1 / (1 - least)) - 1));
    }
}

/* Measures the errors of a trial. In the first round, also adds the errors of its pixels to the sums from
   which the coherence of the pattern's error is computed. */
static koksma_status measure_trial(const batch *b, koksma__contestant *p, size_t trial, const koksma_run *run,
                                   double errors[ERRORS])
{
    koksma_image image;
    koksma_status status = make_image(b->contest, p, trial, run, &image);
    if (!status) {
        const bool tells = !trial && p == &b->contest->contestants[b->active[0]] && doubts(b->contest);
        status = compare_with(b->reference, &image, errors);
        status = status || !tells ? status : doubt(b, &image);
        status = status || isfinite(errors[0])
                     ? status
                     : koksma__fail(KOKSMA_IMPOSSIBLE, "pixels of trial %zu are not finite numbers", trial);
        status = status || trial >= FIRST ? status : measure_coherence(b, p, trial, &image);
        koksma_image_fini(&image);
    }
    return status;
}

static koksma_status do_trial(void *context, size_t i)
{
    const batch *b = context;
    const size_t a = i % b->n_active, t = i / b->n_active;
    koksma__contest *c = b->contest;
    koksma__contestant *p = &c->contestants[b->active[a]];
    if (atomic_load(&p->late) || atomic_load(&p->refused) || (b->first_round && atomic_load(&p->done[t]))) {
        return KOKSMA_OK;
    }
    timed work = {.contest = c, .contestant = p, .start_s = koksma__now_s()};
    const koksma_run run = run_in_share(&work);
    double *errors = b->first_round ? p->first[t] : b->errors + (a * b->count + t) * ERRORS;
    const koksma_status status = measure_trial(b, p, b->first + t, &run, errors);
    atomic_fetch_add(&p->busy_ns, since_ns(work.start_s));
    if (!status && b->first_round) {
        atomic_store(&p->done[t], true);
    }
    return take_out(&work, b->first + t, status);
}

/* Divides the given fraction of the remaining thread time evenly among the patterns. */
static void set_share(koksma__contest *c, double part)
{
    const double left_s = c->control->end_s - koksma__now_s();
    c->share_ns =
        c->control->end_s > 0 && c->n > 1
            ? (unsigned long long)fmin(fmax(1e9 * part * left_s * c->control->run.threads / (double)c->n, 1), 1e18)
            : 0;
}

/* ---- The first look --------------------------------------------------------------------------------------------- */

#define MOST_SEEN ((size_t)1 << 28) /* bytes */

static koksma_status look_at_trial(void *context, size_t i)
{
    koksma__contest *c = context;
    const size_t trial = i / c->n;
    koksma__contestant *p = &c->contestants[i % c->n];
    const koksma__rank_entrant *e = &c->table.entrants[i % c->n];
    if (e->out || e->aside || koksma__image_pattern_is_biased(c->options->patterns[p->pattern])) {
        return KOKSMA_OK;
    }
    timed work = {.contest = c, .contestant = p, .start_s = koksma__now_s()};
    const koksma_run run = run_in_share(&work);
    koksma_image image = {0};
    const koksma_status status = make_image(c, p, trial, &run, &image);
    atomic_fetch_add(&c->looked, (unsigned long long)(1e6 * (status ? work.fraction : 1)));
    if (!status) {
        p->seen[trial] = image;
        atomic_fetch_add(&p->busy_ns, since_ns(work.start_s));
    }
    return koksma__rank_leaves_out(status) || (status == KOKSMA_INTERRUPTED && work.late) ? KOKSMA_OK : status;
}

koksma_status koksma__contest_look(koksma__contest *c, double *errors)
{
    const size_t pixels = (size_t)c->scene.width * (size_t)c->scene.height, pictures = KOKSMA__RANK_LOOKS * c->n;
    set_share(c, 0.5);
    if (pixels * pictures <= MOST_SEEN / (3 * sizeof(float))) {
        KOKSMA__TRY(koksma__parallel(&c->control->run, pictures, look_at_trial, c));
    }
    for (size_t i = 0; i < c->n; i++) {
        const koksma_image *seen = c->contestants[i].seen;
        koksma__sum sum = {0};
        for (size_t p = 0; seen[0].pixels && seen[1].pixels && p < pixels; p++) {
            const double difference = koksma__luminance(&seen[0], p) - koksma__luminance(&seen[1], p);
            koksma__sum_add(&sum, difference * difference);
        }
        const double error = sqrt(koksma__sum_value(&sum) / 2 / (double)pixels);
        errors[i] = error > 0 && isfinite(error) ? error : (double)NAN;
    }
    c->control->fraction = 0;
    return KOKSMA_OK;
}

/* ---- Sums of errors --------------------------------------------------------------------------------------------- */

/* Updates the running mean and the squared deviations by Welford's method (1962). */
static void add_errors(koksma__rank_sums *sums, size_t n, const double *errors)
{
    const double off = errors[0] - sums->mean;
    sums->mean += off / (double)n;
    sums->squares += off * (errors[0] - sums->mean);
    for (int r = 0; r < KOKSMA__RANK_REPLICATES; r++) {
        sums->without[r] += errors[1 + r];
    }
}

/* Trials are added in their order. */
static void add_trial(koksma__contestant *p, const double errors[ERRORS])
{
    p->n++;
    p->top_share += errors[KOKSMA__RANK_TOP_SHARE];
    add_errors(&p->all, p->n, errors);
    add_errors(&p->robust, p->n, errors + KOKSMA__RANK_ROBUST);
}

/* sums: those of p of all pixels, or without a few. */
static koksma__rank_errors summary(const koksma__contestant *p, const koksma__rank_sums *sums)
{
    koksma__rank_errors e = {.n = p->n, .mean = sums->mean};
    e.robust = p->n ? p->robust.mean : (double)NAN;
    e.top_share = p->n ? p->top_share / (double)p->n : (double)NAN;
    e.variance = p->n > 1 ? sums->squares / (double)(p->n - 1) : (double)NAN;
    for (int r = 0; r < KOKSMA__RANK_REPLICATES; r++) {
        e.without[r] = p->n ? sums->without[r] / (double)p->n : (double)NAN;
    }
    return e;
}

koksma__rank_errors koksma__contest_errors(const koksma__contest *c, size_t i)
{
    koksma__contestant sums = {.n = 0};
    const koksma__rank_errors *latest = koksma__rank_latest(&c->table, i);
    for (size_t t = 0; !latest && t < FIRST && atomic_load(&c->contestants[i].done[t]); t++) {
        add_trial(&sums, c->contestants[i].first[t]);
    }
    return latest ? *latest : summary(&sums, &sums.all);
}

/* ---- Rounds --------------------------------------------------------------------------------------------- */

static koksma_status do_batch(batch *b)
{
    const koksma_status status = koksma__parallel(&b->contest->control->run, b->n_active * b->count, do_trial, b);
    for (size_t a = 0; !status && a < b->n_active; a++) {
        koksma__contestant *p = &b->contest->contestants[b->active[a]];
        for (size_t t = 0; !atomic_load(&p->late) && !atomic_load(&p->refused) && t < b->count; t++) {
            add_trial(p, b->first_round ? p->first[t] : b->errors + (a * b->count + t) * ERRORS);
        }
    }
    return status;
}

static const char *reference_pattern(const koksma_rank_options *options)
{
    return !options->render ? "sobol:scramble=owen" : options->reference ? options->reference : options->patterns[0];
}

koksma_status koksma__contest_make_reference(const koksma_rank_options *options, const koksma__study_scene *scene,
                                             const char *variant, int stage, const koksma_run *run,
                                             koksma__rank_reference *reference)
{
    return options->reference_image ? take_reference(reference, options->metric, scene, options->reference_image)
                                    : init_reference(reference, options->metric, scene, reference_pattern(options),
                                                     variant, options->spp, stage, run);
}

/* Makes the reference of a stage, unless it has been made. */
static koksma_status make_reference(koksma__contest *c, int stage)
{
    return c->references[stage].pixels ? KOKSMA_OK
                                       : koksma__contest_make_reference(c->options, &c->scene, c->variant, stage,
                                                                        &c->control->run, &c->references[stage]);
}

static koksma_status do_round(koksma__contest *c, int round, const size_t *active, size_t n_active)
{
    const int stage = c->options->reference_image ? 0 : stage_of(round);
    KOKSMA__TRY(make_reference(c, stage));
    const size_t end = koksma__rank_trials(round);
    batch b = {.contest = c,
               .reference = &c->references[stage],
               .active = active,
               .n_active = n_active,
               .first = round ? koksma__rank_trials(round - 1) : 0};
    b.first_round = round == 0;
    b.errors = b.first_round ? NULL : malloc(n_active * BATCH * ERRORS * sizeof *b.errors);
    koksma_status status =
        b.errors || b.first_round ? KOKSMA_OK : koksma__fail_memory(n_active * BATCH * ERRORS * sizeof *b.errors);
    for (; !status && b.first < end; b.first += b.count) {
        b.count = end - b.first < BATCH ? end - b.first : BATCH;
        status = do_batch(&b);
    }
    free(b.errors);
    if (!status && !round && doubts(c)) {
        doubt_reference(c);
    }
    if (c->doubt[0]) {
        c->options->doubt(c->options->doubt_context, c->doubt);
        c->doubt[0] = '\0';
    }
    for (size_t a = 0; !status && a < n_active; a++) {
        koksma__rank_entrant *e = &c->table.entrants[active[a]];
        koksma__contestant *p = &c->contestants[active[a]];
        e->out = atomic_load(&p->refused);
        e->aside = atomic_load(&p->late);
        if (!e->out && !e->aside) {
            e->coherent = (c->asked ? &c->asked->contestants[p->pattern] : p)->coherence.coherent;
            c->robust.entrants[active[a]].rounds[e->n_rounds] = summary(p, &p->robust);
            e->rounds[e->n_rounds++] = summary(p, &p->all);
        }
    }
    return status ? status : koksma__rank_decide(&c->table, &c->control->job);
}

/* Whether contestant i needs another round to reach the goal. */
static bool needs_round(const koksma__contest *c, size_t i, koksma__rank_goal goal)
{
    const koksma__rank_entrant *e = &c->table.entrants[i];
    bool needs = !e->n_rounds;
    for (size_t j = 0; !needs && j < c->n; j++) {
        needs = !c->table.entrants[j].aside && koksma__rank_matters(&c->table, i, j, goal);
    }
    return needs && !e->out && !e->aside && e->n_rounds < c->max_rounds;
}

/* Stores the contestants that make the next round in `active` and returns the round's number; -1 if none needs
   one. */
static int next_round(const koksma__contest *c, koksma__rank_goal goal, size_t *active, size_t *n_active)
{
    int round = -1;
    *n_active = 0;
    for (size_t i = 0; i < c->n; i++) {
        const int mine = c->table.entrants[i].n_rounds;
        if (!needs_round(c, i, goal) || (round >= 0 && mine > round)) {
            continue;
        }
        if (mine < round) {
            *n_active = 0;
        }
        round = mine;
        active[(*n_active)++] = i;
    }
    return round;
}

/* Whether some patterns are postponed and the best of all other patterns is decided. */
static bool others_are_led(const koksma__contest *c)
{
    bool led = false, any = false;
    for (size_t i = 0; i < c->n; i++) {
        any |= c->table.entrants[i].aside;
        led |= !c->table.entrants[i].aside && koksma__rank_leads_present(&c->table, i);
    }
    return any && led;
}

/* Readmits the postponed patterns, without a limit on their share of the time. Returns whether any pattern was
   postponed. */
static bool call_back(koksma__contest *c)
{
    bool any = false;
    c->share_ns = 0;
    for (size_t i = 0; i < c->n; i++) {
        any |= c->table.entrants[i].aside;
        c->table.entrants[i].aside = false;
        atomic_store(&c->contestants[i].late, false);
    }
    return any;
}

koksma_status koksma__contest_run(koksma__contest *c, koksma__rank_goal goal)
{
    koksma_status status = KOKSMA_OK;
    size_t *active = malloc(c->n * sizeof *active), n_active;
    KOKSMA__REQUIRE_MEMORY(active, c->n * sizeof *active);
    if (!c->references[0].pixels) {
        status = make_reference(c, 0);
        set_share(c, 1);
    }
    while (!status && !koksma__rank_reached(&c->table, goal)) {
        const int round = others_are_led(c) ? -1 : next_round(c, goal, active, &n_active);
        if (round >= 0) {
            status = do_round(c, round, active, n_active);
        } else if (!call_back(c)) {
            break;
        }
    }
    free(active);
    return status;
}

/* ---- The whole ------------------------------------------------------------------------------------------ */

/* Whether a pattern's failure is a mistake in the command, a file or a program that is missing, malformed or not
   allowed to run, rather than a set that does not exist: it ends the ranking before anything is rendered. */
static bool is_mistake(koksma_status status)
{
    return status == KOKSMA_MISSING || status == KOKSMA_MALFORMED || status == KOKSMA_FORBIDDEN;
}

koksma_status koksma__contest_try_patterns(koksma__contest *c)
{
    koksma__variant variant = {0};
    koksma_status status = koksma__variant_apply(c->variant, false, &variant);
    const int spp = koksma__variant_first_spp(&variant, c->options->spp);
    set_share(c, 0.25);
    for (size_t i = 0; !status && i < c->n; i++) {
        timed work = {.contest = c, .contestant = &c->contestants[i], .start_s = koksma__now_s()};
        const koksma_run run = run_in_share(&work);
        char text[KOKSMA_MAX_SPEC];
        if (!c->options->render) {
            status = koksma__image_pattern_text(c->options->patterns[work.contestant->pattern], text);
        }
        if (!status && !c->options->render) {
            status = koksma__image_pattern_try(text, (size_t)spp, &run);
            status = is_mistake(status) ? status : take_out(&work, 0, status);
        }
        c->table.entrants[i].out = atomic_load(&work.contestant->refused);
        c->table.entrants[i].aside = atomic_load(&work.contestant->late);
    }
    return status;
}

koksma_status koksma__contest_init(koksma__contest *c, const koksma_rank_options *options,
                                   const koksma__study_scene *scene, const char *variant,
                                   koksma__run_control *control, const size_t *patterns, size_t n, double alpha)
{
    const size_t most = options->max_trials ? (size_t)options->max_trials : 4096;
    *c = (koksma__contest){.options = options,
                           .scene = *scene,
                           .variant = variant,
                           .control = control,
                           .n = n,
                           .contestants = calloc(n, sizeof *c->contestants)};
    pthread_mutex_init(&c->lock, NULL);
    while (c->max_rounds < KOKSMA__RANK_ROUNDS && koksma__rank_trials(c->max_rounds) <= most) {
        c->max_rounds++;
    }
    KOKSMA__REQUIRE_MEMORY(c->contestants, n * sizeof *c->contestants);
    for (size_t i = 0; i < n; i++) {
        c->contestants[i].pattern = patterns[i];
        pthread_mutex_init(&c->contestants[i].lock, NULL);
        koksma_coherence_find(&c->contestants[i].sums, &c->contestants[i].coherence);
    }
    KOKSMA__TRY(koksma__rank_table_init(&c->table, n, alpha));
    return koksma__rank_table_init(&c->robust, n, alpha);
}

void koksma__contest_fini(koksma__contest *c)
{
    for (size_t i = 0; c->contestants && i < c->n; i++) {
        for (size_t t = 0; t < FIRST; t++) {
            free(c->contestants[i].waiting[t]);
        }
        for (size_t t = 0; t < KOKSMA__RANK_LOOKS; t++) {
            koksma_image_fini(&c->contestants[i].seen[t]);
        }
        koksma_coherence_fini(&c->contestants[i].sums);
        pthread_mutex_destroy(&c->contestants[i].lock);
    }
    if (c->contestants) {
        pthread_mutex_destroy(&c->lock);
    }
    for (int stage = 0; stage < KOKSMA__RANK_STAGES; stage++) {
        koksma__rank_reference_fini(&c->references[stage]);
    }
    koksma__rank_table_fini(&c->table);
    koksma__rank_table_fini(&c->robust);
    free(c->contestants);
    *c = (koksma__contest){0};
}
