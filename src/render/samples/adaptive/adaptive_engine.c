/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the rounds of adaptive sampling: draws the samples of the selected pixels, traces them with the pipeline,
   passes their values to the method, and writes the image. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/lookup.h"
#include "core/parallel.h"
#include "core/spec.h"
#include "core/status.h"
#include "render/one_image.h"
#include "render/pipelines/pipelines.h"
#include "render/samples/adaptive/adaptive.h"
#include "render/samples/samples.h"

enum { PIXELS_A_TASK = 128, SAMPLES_A_LOOK = 1 << 12 };

typedef struct job {
    koksma__adaptive *run;
    koksma__frame frame; /* a frame whose sampler draws the samples of a round */
    const koksma__pipeline *pipeline;
    koksma_layers *layers;
    bool first; /* true in the first round, which sets the layers albedo, normal and depth */
    size_t capacity;
    atomic_ullong rays;
    const koksma_run *how;
    pthread_t caller; /* the only thread that may call how->keep_going */
    /* fraction of the tasks of a round that are done, as koksma__parallel last reported it to the caller */
    double fraction;
    atomic_bool stop;
} job;

typedef struct room {
    koksma__task_scratch pixels;
    void *scratch;
} room;

/* ---- The sampler of rounds -------------------------------------------------------------------------------- */

static size_t count(const koksma__sampler *sampler, uint64_t pixel)
{
    const koksma__adaptive *run = sampler->made;
    if (!run->demands[pixel].selected) {
        return 0;
    }
    return run->probing ? run->method->family->probes(run, pixel) : run->demands[pixel].now;
}

static koksma_status draw(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room_for, float *pairs)
{
    const koksma__adaptive *run = sampler->made;
    return count(sampler, pixel) ? run->method->family->draw(run, pixel, use, offset, room_for, pairs) : KOKSMA_OK;
}

/* ---- One task of a round ---------------------------------------------------------------------------------- */

/* Passes the values of a pixel to the method and asks for its next demand. */
static void hand_over(const job *j, room *r, const koksma__group *group, size_t p)
{
    koksma__adaptive *run = j->run;
    const size_t pixel = group->first + p, first = group->start[p], end = group->start[p + 1];
    const size_t channels = (size_t)j->frame.channels;
    koksma__sample_demand demand = {0};
    const float *weights = j->frame.filter ? r->pixels.values.weights + first : NULL;
    const koksma__values *v = &r->pixels.values;
    const koksma__sample_values values = {v->rgb + channels * first, weights};
    run->method->family->take(run, pixel, &values);
    if (run->probing) {
        return;
    }
    if (j->first) {
        koksma__film_add_surface(j->layers, v, pixel, first, end);
    }
    run->taken[pixel] += (uint32_t)(end - first);
    if (run->method->decide) {
        run->method->decide(run, pixel, r->scratch, &demand);
    }
    run->demands[pixel] = demand;
}

/* Prepares pixels only here, because an interruption between groups must not leave strata without values. */
static koksma_status render_group(const job *j, room *r, const koksma__group *group)
{
    const koksma__frame *f = &j->frame;
    koksma__adaptive *run = j->run;
    koksma_status status = KOKSMA_OK;
    for (size_t pixel = group->first; !status && pixel < group->first + group->count; pixel++) {
        if (run->demands[pixel].selected && !run->probing && run->method->family->prepare) {
            status = run->method->family->prepare(run, pixel);
        }
    }
    if (status || !group->start[group->count]) {
        return status;
    }
    status = koksma__group_draw(f, group, KOKSMA__USE_PIXEL, true, &r->pixels.draw, r->pixels.values.film);
    if (!status) {
        koksma__film_place(f, group, false, &r->pixels.values);
        status = j->pipeline->trace(f, r->pixels.pipeline_scratch, group, &r->pixels.values);
    }
    for (size_t p = 0; !status && p < group->count; p++) {
        if (group->start[p] < group->start[p + 1]) {
            hand_over(j, r, group, p);
        }
    }
    return status;
}

/* Calls the caller's keep_going; if it returns false, all threads stop. look() calls this function within tasks,
   because a task may take minutes. */
static bool goes_on(void *context, double fraction)
{
    job *j = context;
    j->fraction = fraction;
    if (!koksma__keep_going(j->how, fraction)) {
        atomic_store(&j->stop, true);
    }
    return !atomic_load(&j->stop);
}

static koksma_status look(job *j)
{
    if (pthread_equal(pthread_self(), j->caller)) {
        goes_on(j, j->fraction);
    }
    return atomic_load(&j->stop) ? koksma__fail_interrupted() : KOKSMA_OK;
}

static koksma_status render_task(void *context, size_t task)
{
    job *j = context;
    koksma__adaptive *run = j->run;
    const size_t first = task * PIXELS_A_TASK;
    const size_t end = first + PIXELS_A_TASK < run->pixels ? first + PIXELS_A_TASK : run->pixels;
    koksma_status status = KOKSMA_OK;
    size_t selected = 0;
    for (size_t pixel = first; pixel < end; pixel++) {
        selected += run->demands[pixel].selected;
    }
    if (!selected) {
        return KOKSMA_OK;
    }
    size_t samples = 0; /* samples rendered since the last call of look() */
    room r = {.scratch = malloc(run->scratch + 1)};
    koksma__group group;
    status = koksma__task_scratch_init(&j->frame, j->pipeline, j->capacity, j->first, &r.pixels);
    if (!status && !r.scratch) {
        status = koksma__fail_memory(run->scratch + 1);
    }
    for (size_t pixel = first; !status && pixel < end; pixel += group.count) {
        koksma__group_fill(&j->frame, pixel, end, &group);
        status = render_group(j, &r, &group);
        samples += group.start[group.count];
        if (!status && samples >= SAMPLES_A_LOOK) {
            samples = 0;
            status = look(j);
        }
    }
    if (!run->probing) {
        atomic_fetch_add(&j->rays, r.pixels.values.rays);
    }
    koksma__task_scratch_fini(&r.pixels);
    free(r.scratch);
    return status;
}

/* ---- The choice of pixels -------------------------------------------------------------------------------- */

enum { GREEDY = 4 };

typedef struct candidate {
    float score;
    uint32_t pixel;
} candidate;

static int by_score(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->score != q->score) {
        return p->score > q->score ? -1 : 1;
    }
    /* pixels with equal scores are ordered by the pixel's number times an odd number modulo 2^32, so that no pattern
       is visible */
    return p->pixel * 2654435761u < q->pixel * 2654435761u ? -1 : 1;
}

/* Under a budget a round selects a quarter of the pixels that demand samples, in descending order of score, so
   that later rounds choose with more information. A pixel that demands more than the rest of the budget is
   skipped. */
static void select_best(koksma__adaptive *run, candidate *list, size_t n, size_t *selected)
{
    qsort(list, n, sizeof *list, by_score);
    const size_t most = (n + GREEDY - 1) / GREEDY;
    for (size_t i = 0; i < n && *selected < most; i++) {
        koksma__sample_demand *demand = &run->demands[list[i].pixel];
        const uint64_t cost = demand->now;
        if (cost <= run->budget - run->spent) {
            run->spent += cost;
            demand->selected = true;
            ++*selected;
        }
    }
}

/* Selects the pixels of the next round: all that demand samples or, under a budget, those where samples reduce the error
   most; sets *selected to their number. Errors: MEMORY. */
static koksma_status choose(koksma__adaptive *run, size_t *selected)
{
    size_t n = 0;
    *selected = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        n += run->demands[p].now > 0;
        run->demands[p].selected = run->demands[p].now > 0 && run->budget == UINT64_MAX;
    }
    if (run->budget == UINT64_MAX || !n) {
        *selected = n;
        return KOKSMA_OK;
    }
    candidate *list = malloc(n * sizeof *list);
    KOKSMA__REQUIRE_MEMORY(list, n * sizeof *list);
    n = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        if (run->demands[p].now) {
            list[n++] = (candidate){run->demands[p].score, (uint32_t)p};
        }
    }
    select_best(run, list, n, selected);
    free(list);
    return KOKSMA_OK;
}

/* ---- Rounds ----------------------------------------------------------------------------------------------- */

static koksma_status render_round(job *j, const koksma_run *how)
{
    const koksma_run outer = {.threads = koksma__threads(how), .keep_going = goes_on, .context = j};
    koksma__adaptive *run = j->run;
    size_t most = (size_t)j->frame.options->spp;
    for (size_t p = 0; p < run->pixels; p++) {
        const size_t n = run->demands[p].selected ? run->taken[p] + count(&j->frame.sampler, p) : 0;
        most = n > most ? n : most; /* a sequence that is continued is generated from its start */
    }
    j->frame.sampler.most = most;
    j->capacity = koksma__group_capacity(&j->frame, most);
    return koksma__parallel(&outer, (run->pixels + PIXELS_A_TASK - 1) / PIXELS_A_TASK, render_task, j);
}

static koksma_status render_rounds(job *j, const koksma_run *how)
{
    koksma__adaptive *run = j->run;
    size_t selected = 0;
    j->first = true;
    koksma_status status = render_round(j, how);
    j->first = false;
    for (; !status; run->report.rounds++) {
        status = choose(run, &selected);
        if (status || !selected) {
            return status;
        }
        if (run->method->family->probes && run->options->probes) {
            run->probing = true;
            status = render_round(j, how);
            run->probing = false;
        }
        status = status ? status : render_round(j, how);
    }
    return status;
}

static void write_results(const job *j)
{
    koksma__adaptive *run = j->run;
    const size_t channels = (size_t)j->frame.channels;
    for (size_t p = 0; p < run->pixels; p++) {
        double rgb[3] = {0, 0, 0}, variance = 0;
        if (run->taken[p]) {
            variance = run->method->family->result(run, p, rgb);
        }
        for (size_t k = 0; k < channels; k++) {
            j->layers->image.pixels[channels * p + k] = (float)rgb[k];
        }
        j->layers->variance.pixels[p] = (float)variance;
        j->layers->samples.pixels[p] = (float)run->taken[p];
        run->report.samples += run->taken[p];
    }
    j->layers->rays = atomic_load(&j->rays);
}

/* ---- The public function ---------------------------------------------------------------------------------- */

static koksma_status check(const koksma_render_options *options, const koksma_adaptive_options *adaptive)
{
    KOKSMA__FAIL_IF(!adaptive->method, KOKSMA_ARGUMENT, "adaptive sampling needs a method");
    const char *name = adaptive->method->name;
    KOKSMA__FAIL_IF(!name || !adaptive->method->functions, KOKSMA_ARGUMENT,
                    "the adaptive method has no %s: koksma_adaptive_find has methods", name ? "functions" : "name");
    const koksma_param *params = adaptive->method->params;
    for (int i = 0; params && params[i].name; i++) {
        KOKSMA__FAIL_IF(!(adaptive->params[i] >= params[i].min && adaptive->params[i] <= params[i].max),
                        KOKSMA_ARGUMENT, "%s: %s=%.9g: it takes %.9g to %.9g", name, params[i].name,
                        adaptive->params[i], params[i].min, params[i].max);
    }
    KOKSMA__FAIL_IF(options->splat || options->scope == KOKSMA_SCOPE_IMAGE, KOKSMA_ARGUMENT,
                    "%s: adaptive sampling keeps samples in their pixels, and so can't be used with %s", name,
                    options->splat ? "splatting" : "scope image");
    for (int g = 0; adaptive->method->own_samples && g < KOKSMA_MAX_USE_GROUPS; g++) {
        if (options->groups[g].n_uses) {
            char group[KOKSMA_MAX_SPEC];
            koksma_use_group_text(&options->groups[g], group);
            return koksma__fail(KOKSMA_ARGUMENT,
                                "%s: this method divides pixels into strata itself and takes no pattern for %s; "
                                "methods such as contrast, which draw sets of the pattern, take one",
                                name, group);
        }
    }
    KOKSMA__FAIL_IF(!(adaptive->budget >= 0 && adaptive->budget <= KOKSMA_MAX_SPP), KOKSMA_ARGUMENT,
                    "budget = %.9g: it must be 0 to %d samples a pixel", adaptive->budget, KOKSMA_MAX_SPP);
    KOKSMA__FAIL_IF(adaptive->probes < 0 || adaptive->probes > KOKSMA_MAX_PROBES, KOKSMA_ARGUMENT,
                    "probes = %d: it takes 0 to %d", adaptive->probes, KOKSMA_MAX_PROBES);
    const koksma__adaptive_method *method = adaptive->method->functions;
    KOKSMA__FAIL_IF(adaptive->probes && !method->family->probes, KOKSMA_ARGUMENT,
                    "%s splits no strata, so that probes have no effect; leave out the probes", name);
    const koksma_strata *strata = adaptive->strata;
    KOKSMA__FAIL_IF(strata && !method->family->show, KOKSMA_ARGUMENT,
                    "%s splits no strata, so that none can be shown", name);
    KOKSMA__FAIL_IF(
        strata && (strata->x < 0 || strata->y < 0 || strata->x >= options->width || strata->y >= options->height),
        KOKSMA_ARGUMENT, "pixel %d,%d is outside the image of %d x %d pixels", strata->x, strata->y, options->width,
        options->height);
    return KOKSMA_OK;
}

/* The first round is always rendered; the budget must allow for its cost. */
static koksma_status open_run(koksma__adaptive *run)
{
    run->demands = calloc(run->pixels, sizeof *run->demands);
    run->taken = calloc(run->pixels, sizeof *run->taken);
    KOKSMA__REQUIRE_MEMORY(run->demands && run->taken, run->pixels * sizeof *run->demands);
    const koksma_status status = run->method->open(run);
    for (size_t p = 0; !status && p < run->pixels; p++) {
        run->demands[p].selected = true;
        run->spent += run->demands[p].now;
        run->report.first += run->demands[p].now;
    }
    KOKSMA__FAIL_IF(!status && run->spent > run->budget, KOKSMA_ARGUMENT,
                    "%s: a budget of %.9g samples a pixel is too small: the first round takes %.9g",
                    run->options->method->name, run->options->budget, (double)run->spent / (double)run->pixels);
    return status;
}

uint64_t koksma_adaptive_size_of(const koksma_render_options *options, const koksma_adaptive_options *adaptive)
{
    KOKSMA__REQUIRE_OR(0, options, adaptive);
    KOKSMA__REQUIRE_OR(0, adaptive->method);
    const uint64_t pixels = (uint64_t)options->width * (uint64_t)options->height;
    KOKSMA__REQUIRE_OR(0, adaptive->method->functions);
    const koksma__adaptive_method *method = adaptive->method->functions;
    const size_t state = method->family->bytes(options->spp);
    return pixels * (sizeof(koksma__sample_demand) + sizeof(uint32_t) + state);
}

static koksma_status open_layers(const koksma__frame *frame, koksma_layers *out)
{
    koksma__film film;
    const koksma_status status = koksma__film_init(frame, true, 1, out, &film);
    koksma__film_fini(&film);
    return status;
}

koksma_status koksma_render_adaptive(const koksma_scene *scene, const koksma_render_options *options,
                                     const koksma_adaptive_options *adaptive, const koksma_run *how,
                                     koksma_layers *out, koksma_adaptive_report *report)
{
    KOKSMA__REQUIRE(scene, options, adaptive, out);
    KOKSMA__REQUIRE_RUN(how);
    *out = (koksma_layers){0};
    KOKSMA__TRY(check(options, adaptive));
    koksma__adaptive run = {.options = adaptive, .method = adaptive->method->functions, .budget = UINT64_MAX};
    job j = {.run = &run, .layers = out, .how = how, .caller = pthread_self()};
    koksma_status status = koksma__frame_open(scene, options, how, &j.frame);
    if (!status) {
        run.frame = &j.frame;
        run.pixels = (size_t)options->width * (size_t)options->height;
        run.base = j.frame.sampler;
        run.budget = adaptive->budget > 0 ? (uint64_t)(adaptive->budget * (double)run.pixels) : UINT64_MAX;
        j.frame.sampler = (koksma__sampler){.made = &run,
                                            .kept_dim = run.base.kept_dim,
                                            .kept_sets = run.base.kept_sets,
                                            .kept_slots = run.base.kept_slots,
                                            .count = count,
                                            .draw = draw};
        status = open_run(&run);
        status = status ? status : koksma__pipeline_for(&j.frame, &j.pipeline);
        status = status ? status : open_layers(&j.frame, out);
        status = status ? status : render_rounds(&j, how);
        if (!status || status == KOKSMA_INTERRUPTED) {
            write_results(&j);
        }
        if (!status && adaptive->strata) {
            const koksma_strata *strata = adaptive->strata;
            status = run.method->family->show(&run, (size_t)strata->y * (size_t)options->width + (size_t)strata->x,
                                              adaptive->strata);
        }
        run.method->family->close(&run);
        j.frame.sampler = run.base;
    }
    koksma__frame_close(&j.frame);
    KOKSMA__FREE(run.extra, run.demands, run.taken);
    if (status && status != KOKSMA_INTERRUPTED) {
        koksma_layers_fini(out);
        *out = (koksma_layers){0};
    }
    if (report) {
        *report = run.report;
    }
    return status;
}

/* ---- The table of methods, and their specs -------------------------------------------------------------- */

static const koksma_adaptive *const table[] = {
#define ADAPTIVE(name) &koksma__adaptive_##name,
#include "render/samples/adaptive/adaptive.def"
#undef ADAPTIVE
};

KOKSMA__LOOKUP(koksma_adaptive, table)
KOKSMA__NAME_AT(koksma_adaptive)

koksma_status koksma_adaptive_parse(const char *text, koksma_adaptive_options *out)
{
    KOKSMA__REQUIRE(text, out);
    char name[64];
    *out = (koksma_adaptive_options){0};
    const size_t length = strcspn(text, ":");
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), text);
    out->method = koksma_adaptive_find(name);
    if (!out->method) {
        return koksma__fail_unknown("adaptive method", name, koksma_adaptive_name_at, NULL,
                                    "'koksma list adaptive' names them");
    }
    return koksma__params_parse(name, out->method->params, text[length] ? text + length + 1 : "", out->params);
}

void koksma_adaptive_text(const koksma_adaptive_options *options, char *text)
{
    KOKSMA__REQUIRE_OR(, options, text);
    KOKSMA__REQUIRE_OR(, options->method);
    KOKSMA__REQUIRE_OR(, options->method->name);
    snprintf(text, KOKSMA_MAX_SPEC, "%s", options->method->name);
    koksma__params_text(options->method->params, options->params, text, KOKSMA_MAX_SPEC);
}
