/* SPDX-License-Identifier: Apache-2.0 */
/* Opens and closes studies: parses the plan, creates the study's folder DIR, opens its store, loads each scene once,
   and records the plan in the store. In an MPI run only rank 0 has a folder. */
#include "study/run/study.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/lookup.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"
#include "study/run/mpi.h"
#include "study/store/store.h"

/* Other paths in the folder add up to 30 bytes, so that all fit into KOKSMA__PATH and nearly all systems accept them. */
enum { LONGEST_FOLDER = 1000 };

koksma_status koksma__results_path(const char *folder, char path[KOKSMA__PATH])
{
    KOKSMA__FAIL_IF(strlen(folder) > LONGEST_FOLDER, KOKSMA_ARGUMENT,
                    "the name of a study's folder is longer than %d bytes: %.40s...", LONGEST_FOLDER, folder);
    KOKSMA__FAIL_IF(!*folder, KOKSMA_ARGUMENT, "the name of a study's folder is empty");
    snprintf(path, KOKSMA__PATH, "%s/results.sqlite", folder);
    return KOKSMA_OK;
}

static const char folder_key[] = "run-folder";

static const char *plan_name_at(const void *table, size_t i)
{
    (void)table;
    return koksma_plan_name_at(i);
}

/* Whether it is a plan's text rather than its name: a file may have a name such as "{p}.json". */
static bool is_text(const char *plan)
{
    plan += strspn(plan, " \t\n\r");
    return *plan == '{' && plan[1] && strchr(" \t\n\r\"}", plan[1]);
}

/* The name of a plan in messages and in the store; its folder, if it has one, is where the plan's relative paths start. */
static const char *name_of(const char *plan)
{
    return is_text(plan) ? "(text)" : plan;
}

enum { LABEL = 32 };

/* The name of plan i in messages: of several texts each has its number. */
static const char *label_of(const koksma_study_options *options, size_t i, char label[LABEL])
{
    snprintf(label, LABEL, "(text %zu)", i + 1);
    return options->n_plans > 1 && is_text(options->plans[i]) ? label : name_of(options->plans[i]);
}

static koksma_status load_plan(const char *name, const char *label, const koksma__plan_trials *trials,
                               koksma__plan *plan, char **text_out)
{
    const size_t length = strlen(name);
    unsigned char *text = NULL;
    size_t size = 0;
    koksma_status status = KOKSMA_OK;
    if (is_text(name)) {
        size = length;
        text = (unsigned char *)strdup(name);
        status = text ? KOKSMA_OK : koksma__fail_memory(size);
    } else if (!strchr(name, '/') && !(length > 5 && !strcmp(name + length - 5, ".json"))) {
        const char *shipped = koksma__plan_shipped(name, &size);
        char meant[KOKSMA__MEANT];
        KOKSMA__FAIL_IF(!shipped, KOKSMA_UNKNOWN,
                        "koksma has no built-in plan '%s'; %sgive your own plan as a JSON file, such as ./%.*s.json",
                        name, koksma__meant(name, plan_name_at, NULL, meant), (int)strcspn(name, "."), name);
        text = (unsigned char *)strdup(shipped);
        status = text ? KOKSMA_OK : koksma__fail_memory(size);
    } else {
        status = koksma__read_file(name, KOKSMA__FILE_PLAN, KOKSMA__BY_USER, koksma__check_text, &text, &size);
    }
    status = status ? status : koksma__plan_parse(label, (const char *)text, size, trials, plan);
    *text_out = (char *)text;
    return status;
}

const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name)
{
    return koksma__scene_files_find(&study->totals.scenes, name);
}

koksma_status koksma__study_open_to_write(koksma_study *study)
{
    char path[KOKSMA__PATH];
    if (study->is_written) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__results_path(study->folder, path));
    koksma__store_close(study->store); /* while open, this store holds a lock that would make the next call fail */
    const koksma_status status = koksma__store_open(path, KOKSMA__STORE_WRITE, study->plan.name, &study->store);
    study->is_written = !status;
    if (status) {
        koksma__store_open(path, KOKSMA__STORE_READ, NULL, &study->store);
    }
    return status;
}

void koksma__study_forget_files(koksma_study *study)
{
    if (study->store) {
        koksma__store_forget_files(study->store);
    }
    for (size_t i = 0; i < study->n_references; i++) {
        koksma_image_fini(&study->references[i].image);
    }
}

static koksma_status make_folder(koksma_study *study, const char *folder, char results[KOKSMA__PATH])
{
    KOKSMA__TRY(koksma__results_path(folder, results));
    KOKSMA__TRY(koksma__atomic_folder(folder));
    study->folder = strdup(folder);
    return study->folder ? KOKSMA_OK : koksma__fail_memory(strlen(folder));
}

/* Writes the texts of the plans and the run's options for trials into the store, so that the folder alone suffices
   to make the report again, and the current folder, where the relative paths of the plan and of the rows start. */
static koksma_status keep_plan(koksma_study *study, const koksma_study_options *options, char *const *texts)
{
    char key[32], value[32], here[PATH_MAX];
    koksma_status status = koksma__store_set_text(study->store, folder_key, getcwd(here, sizeof here) ? here : "");
    for (size_t i = 0; !status && i < options->n_plans; i++) {
        snprintf(key, sizeof key, "plan-text-%zu", i);
        status = koksma__store_set_text(study->store, key, texts[i]);
        snprintf(key, sizeof key, "plan-name-%zu", i);
        status = status ? status : koksma__store_set_text(study->store, key, name_of(options->plans[i]));
    }
    snprintf(value, sizeof value, "%zu %lld %d", options->n_plans, options->trials, options->quick);
    status = status ? status : koksma__store_set_text(study->store, "plan-texts", value);
    return status ? status : koksma__store_commit(study->store);
}

koksma_status koksma__study_fail_here(koksma_study *study, koksma_status status)
{
    char here[PATH_MAX], reason[1024], *there = NULL;
    if (koksma_status_exit_code(status) != koksma_status_exit_code(KOKSMA_MISSING)) {
        return status;
    }
    snprintf(reason, sizeof reason, "%s", koksma_error_text());
    const bool failed = koksma__store_get_text(study->store, folder_key, &there);
    if (!failed && there && *there && getcwd(here, sizeof here) && strcmp(here, there) != 0) {
        koksma__fail(status, "%.600s; a relative path starts in %.300s, where the study was run", reason, there);
    } else if (failed) {
        koksma__fail(status, "%s", reason);
    }
    free(there);
    return status;
}

static koksma_status append_plan(koksma_study *study, koksma__plan *plan)
{
    if (!study->plan.name) {
        study->plan = *plan;
        *plan = (koksma__plan){0};
        return KOKSMA_OK;
    }
    return koksma__plan_append(&study->plan, plan);
}

/* Names the store before the error of a plan in it: the file whose name the plan has may be intact. Returns status,
   or MEMORY. */
static koksma_status fail_stored(koksma_study *study, koksma_status status)
{
    koksma__study_fail_here(study, status);
    char *reason = strdup(koksma_error_text());
    KOKSMA__REQUIRE_MEMORY(reason, 1);
    koksma__fail(status, "%s/results.sqlite: %s", study->folder, reason);
    free(reason);
    return status;
}

/* Reads the plan of a folder with results from its store. */
static koksma_status recall_plan(koksma_study *study)
{
    char *what, key[32];
    unsigned long n = 0;
    int quick = 0;
    koksma__plan_trials trials = {0};
    koksma_status status = koksma__store_get_text(study->store, "plan-texts", &what);
    if (!status &&
        (!what || sscanf(what, "%lu %lld %d", &n, &trials.trials, &quick) != 3 || n < 1 || trials.trials < 0)) {
        status =
            koksma__fail(KOKSMA_MALFORMED, "%s/results.sqlite: the store does not contain its plan", study->folder);
    }
    free(what);
    study->quick = trials.quick = quick;
    trials.stored = true;
    trials.totals = &study->totals;
    for (unsigned long i = 0; !status && i < n; i++) {
        koksma__plan plan = {0};
        char *text = NULL, *name = NULL; /* databases of older versions lack the plan's name */
        snprintf(key, sizeof key, "plan-text-%lu", i);
        status = koksma__store_get_text(study->store, key, &text);
        snprintf(key, sizeof key, "plan-name-%lu", i);
        status = status ? status : koksma__store_get_text(study->store, key, &name);
        if (!status) {
            status = koksma__plan_parse(name ? name : "results.sqlite", text ? text : "", text ? strlen(text) : 0,
                                        &trials, &plan);
            status = status ? fail_stored(study, status) : KOKSMA_OK;
        }
        free(text);
        free(name);
        status = status ? status : append_plan(study, &plan);
        koksma__plan_fini(&plan);
    }
    return status;
}

/* Fails if plan i has the same text as an earlier plan, because all its jobs and questions would be repeated. */
static koksma_status check_text(const koksma_study_options *options, char *const *texts, size_t i)
{
    char label[LABEL];
    for (size_t k = 0; k < i; k++) {
        KOKSMA__FAIL_IF(!strcmp(texts[k], texts[i]), KOKSMA_ARGUMENT, "plan '%s' is listed twice",
                        label_of(options, i, label));
    }
    return KOKSMA_OK;
}

static koksma_status load_plans(koksma_study *study, const koksma_study_options *options, char **texts)
{
    const koksma__plan_trials trials = {.trials = options->trials, .quick = options->quick, .totals = &study->totals};
    koksma_status status = KOKSMA_OK;
    study->quick = options->quick;
    for (size_t i = 0; !status && i < options->n_plans; i++) {
        koksma__plan plan = {0};
        char label[LABEL];
        status = load_plan(options->plans[i], label_of(options, i, label), &trials, &plan, &texts[i]);
        status = status ? status : check_text(options, texts, i);
        status = status ? status : append_plan(study, &plan);
        koksma__plan_fini(&plan);
    }
    return status;
}

/* Opens a study with the plans of the options. folder = NULL: results are not stored (estimates, and all ranks of an
   MPI run but rank 0). */
static koksma_status open_with_plans(koksma_study *study, const koksma_study_options *options)
{
    char path[KOKSMA__PATH];
    char **texts = calloc(options->n_plans, sizeof *texts);
    KOKSMA__REQUIRE_MEMORY(texts, options->n_plans * sizeof *texts);
    koksma_status status = load_plans(study, options, texts);
    if (!status && options->folder) {
        study->is_written = true;
        status = make_folder(study, options->folder, path);
        status = status ? status : koksma__store_open(path, KOKSMA__STORE_WRITE, study->plan.name, &study->store);
        status = status ? status : keep_plan(study, options, texts);
        status = status ? status : koksma__store_failed(study->store, &study->failed);
    }
    for (size_t i = 0; i < options->n_plans; i++) {
        free(texts[i]);
    }
    free(texts);
    return status;
}

static koksma_status open_folder(koksma_study *study, const char *folder)
{
    char path[KOKSMA__PATH];
    KOKSMA__TRY(koksma__results_path(folder, path));
    study->folder = strdup(folder);
    KOKSMA__REQUIRE_MEMORY(study->folder, strlen(folder));
    koksma_status status = koksma__store_open(path, KOKSMA__STORE_READ, NULL, &study->store);
    status = status ? status : recall_plan(study);
    return status ? status : koksma__store_failed(study->store, &study->failed);
}

static koksma_status check_options(const koksma_study_options *options)
{
    KOKSMA__FAIL_IF(!options->n_plans && !options->folder, KOKSMA_ARGUMENT,
                    "a study needs a plan, or a folder with results");
    KOKSMA__FAIL_IF(options->trials < 0, KOKSMA_ARGUMENT, "trials = %lld: it must be 0 (the plan's trials) or more",
                    options->trials);
    koksma_status status =
        koksma__array_check("options->plans", options->plans, options->n_plans, sizeof *options->plans);
    for (size_t i = 0; i < options->n_plans && !status; i++) {
        status = options->plans[i] ? KOKSMA_OK : koksma__fail(KOKSMA_ARGUMENT, "options->plans[%zu] is NULL", i);
    }
    return status;
}

/* keeps_ranks: whether the ranks of an MPI run stay, which only runs and audits use. */
static koksma_status open_study(const koksma_study_options *options, bool keeps_ranks, koksma_study **out)
{
    *out = NULL;
    KOKSMA__TRY(check_options(options));
    koksma_study *study = calloc(1, sizeof *study);
    KOKSMA__REQUIRE_MEMORY(study, sizeof *study);
    koksma_status status = koksma__mpi_check();
    if (!status && !keeps_ranks) {
        koksma__mpi_release();
    }
    status = status             ? status
             : options->n_plans ? open_with_plans(study, options)
                                : open_folder(study, options->folder);
    if (status) {
        koksma_study_close(study);
        return status;
    }
    *out = study;
    return KOKSMA_OK;
}

koksma_status koksma_study_open(const koksma_study_options *options, koksma_study **out)
{
    KOKSMA__REQUIRE(options, out);
    return open_study(options, options->n_plans > 0, out);
}

koksma_status koksma__study_open_stored(const char *folder, koksma_study **out)
{
    return open_study(&(koksma_study_options){.folder = folder}, true, out);
}

const char *koksma_study_left_out_at(const koksma_study *study, size_t i)
{
    KOKSMA__REQUIRE_OR(NULL, study);
    const koksma__plan *plan = &study->plan;
    for (size_t b = 0; b < plan->n_discrepancies + plan->n_images; b++) {
        const koksma__texts *lines = b < plan->n_discrepancies
                                         ? &plan->discrepancies[b].left_out.lines
                                         : &plan->images[b - plan->n_discrepancies].left_out.lines;
        if (i < lines->n) {
            return lines->at[i];
        }
        i -= lines->n;
    }
    return i < study->failed.n ? study->failed.at[i] : NULL;
}

koksma_status koksma_study_left_out(const char *folder, char **lines)
{
    KOKSMA__REQUIRE(folder, lines);
    char path[KOKSMA__PATH];
    koksma__store *store;
    *lines = NULL;
    KOKSMA__TRY(koksma__results_path(folder, path));
    KOKSMA__TRY(koksma__store_open(path, KOKSMA__STORE_READ, NULL, &store));
    koksma__texts of = {0};
    size_t size = 0;
    koksma_status status = koksma__store_left_out(store, &of);
    FILE *f = open_memstream(lines, &size);
    for (size_t i = 0; f && i < of.n; i++) {
        fprintf(f, "%s\n", of.at[i]);
    }
    status = f && !fclose(f) ? status : koksma__fail_memory(size);
    koksma__texts_fini(&of);
    koksma__store_close(store);
    if (status) {
        free(*lines);
        *lines = NULL;
    }
    return status;
}

koksma_status koksma_study_close(koksma_study *study)
{
    if (!study) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__store_close(study->store);
    for (size_t i = 0; i < study->n_references; i++) {
        koksma_image_fini(&study->references[i].image);
    }
    koksma__scene_files_fini(&study->totals.scenes);
    free(study->references);
    koksma__texts_fini(&study->failed);
    koksma__plan_fini(&study->plan);
    free(study->folder);
    free(study);
    return status;
}

/* ---- Pictures ------------------------------------------------------------------------------------------ */

/* A picture's pattern and variant become options of the renderer; variants.c calls the renderer or the adaptive method. A
   picture's seed is the hash of a text that names everything the picture depends on, so that a job has the same random
   numbers in every run, on any thread, and in any plan. */

enum { LONGEST_KEY = 8192 }; /* capacity for a key: a path, a pattern, options */

uint64_t koksma__job_seed(const char *format, ...)
{
    char key[LONGEST_KEY];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(key, sizeof key, format, arguments);
    va_end(arguments);
    return koksma__hash(key, strlen(key));
}

void koksma__block_size(const koksma__image_block *block, const koksma__study_scene *scene, int *width, int *height)
{
    *width = block->width ? block->width : scene->width;
    *height = block->height ? block->height : scene->height;
}

koksma_status koksma__picture_set(const koksma__study_scene *scene, const koksma__picture *picture,
                                  koksma__variant *variant)
{
    koksma_render_options *options = &variant->render;
    koksma_render_options_init(options, scene->scene);
    options->integrator = koksma_integrator_find("distribution"); /* a variant names another, also path */
    koksma_status status = koksma__image_pattern_set(picture->pattern, options);
    status = status ? status : koksma__variant_apply(picture->variant, picture->of_reference, variant);
    options->spp = (int)picture->spp;
    options->seed = picture->seed;
    options->width = picture->width;
    options->height = picture->height;
    return status;
}

static koksma_status render_elsewhere(const koksma__study_scene *scene, const koksma__picture *picture,
                                      const koksma_run *run, koksma_image *out)
{
    const koksma_rank_picture asked = {scene->name,    picture->pattern, (int)picture->spp,
                                       picture->width, picture->height,  picture->seed >> 33};
    *out = (koksma_image){0};
    const char kept = koksma__call_begin();
    koksma_status status =
        koksma__call_end(kept, scene->render(scene->render_context, &asked, run, out), "koksma_rank_options.render");
    if (!status && picture->width && (out->width != picture->width || out->height != picture->height)) {
        status =
            koksma__fail(KOKSMA_IMPOSSIBLE, "%s: the renderer made a picture of %d x %d pixels instead of %d x %d",
                         picture->pattern, out->width, out->height, picture->width, picture->height);
    }
    if (status) {
        koksma_image_fini(out);
    }
    return status;
}

koksma_status koksma__study_render(const koksma__study_scene *scene, const koksma__picture *picture,
                                   const koksma_run *run, koksma_image *out)
{
    if (scene->render) {
        return render_elsewhere(scene, picture, run, out);
    }
    koksma__variant variant;
    const koksma_status status = koksma__picture_set(scene, picture, &variant);
    return status ? status : koksma__variant_render(scene->scene, &variant, run, out);
}
