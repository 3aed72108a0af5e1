/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The audit of a study: rows of the store are drawn at random, computed again by the plan in the store, and compared bit
 * for bit. The jobs run as those of a study do, on threads or MPI ranks, but their results are compared and not stored.
 * Rows that this plan, with these files and this version's revisions, does not make are counted only. Rows are drawn
 * without replacement, in the order of their ids, by selection sampling (Knuth, TAOCP 2, 3.4.2, algorithm S).
 *
 * If k of n drawn rows are wrong, the proportion of wrong rows in the store is below the Clopper & Pearson limit
 * with 95 % confidence: the p for which k or fewer wrong rows among n have the probability 5 % by the binomial
 * distribution, which is conservative for draws without replacement. For k = 0 the limit is 1 - 0.05^(1/n).
 */
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "image/formats.h"
#include "stats/stats.h"
#include "study/run/references.h"
#include "study/run/run.h"

static const double CHANCE = 0.05;

enum { NAME = 1400 }; /* capacity for the name of a row */

/* A series of the plan that the store has. */
typedef struct audited {
    long long id, trials, rows,
        end;              /* trials: of the plan; rows, end: in the store, 1 + the largest trial of these */
    unsigned char *drawn; /* one bit for each trial */
} audited;

typedef struct audit {
    const koksma_audit_options *options;
    koksma_audit *out;
    koksma_study *study;
    size_t n;
    audited *at;          /* sorted by id */
    pthread_mutex_t lock; /* guards *out, `wrong`, the bits of drawn rows, and calls of the caller's function */
    long long seen;       /* number of rows that the draw has considered */
    long long wrong;      /* number of drawn rows for which a difference was named */
} audit;

static void differ(audit *a, const char *format, ...) KOKSMA_PRINTF(2, 3);
static void differ(audit *a, const char *format, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    koksma_text_escape(text, sizeof text); /* texts of the store must not forge lines or command a terminal */
    pthread_mutex_lock(&a->lock);
    a->out->differences++;
    if (a->options->differs) {
        a->options->differs(a->options->context, text);
    }
    pthread_mutex_unlock(&a->lock);
}

/* Writes a readable name of a row, such as "image checker, jittered, n = 4, 8 x 6, a:regular@4x1, trial 2". */
static void name_row(const koksma__task *t, size_t k, long long trial, char text[NAME])
{
    char reference[KOKSMA__REFERENCE_NAME], place[64];
    const koksma__series key = koksma__task_series(t, k, reference);
    if (t->image) {
        snprintf(place, sizeof place, "%lld x %lld, ", key.width, key.height);
    } else {
        snprintf(place, sizeof place, "dim %lld, ", key.dim);
    }
    snprintf(text, NAME, "%s %.100s%s%.100s%s%.200s, n = %lld, %s%.200s%s%.100s, trial %lld", key.kind, key.scene,
             key.scene[0] ? ", " : "", key.options, key.options[0] ? ", " : "", key.pattern, key.n, place, key.what,
             key.metric[0] ? ", " : "", key.metric, trial);
}

/* ---- The series ---------------------------------------------------------------------------------------- */

static int compare_ids(const void *a, const void *b)
{
    const audited *s = a, *t = b;
    return s->id != t->id ? (s->id < t->id ? -1 : 1) : s->trials > t->trials ? -1 : s->trials < t->trials;
}

static audited *find(const audit *a, long long id)
{
    size_t low = 0, high = a->n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (a->at[middle].id == id) {
            return &a->at[middle];
        }
        *(a->at[middle].id < id ? &low : &high) = a->at[middle].id < id ? middle + 1 : middle;
    }
    return NULL;
}

/* The series of a row that the plan makes, or NULL. */
static audited *find_row(const audit *a, long long id, long long trial)
{
    audited *s = find(a, id);
    return s && trial < s->trials ? s : NULL;
}

/* Lists the series of one kind of jobs that the store has. */
static koksma_status list_series(audit *a, bool images)
{
    koksma__tasks tasks;
    KOKSMA__TRY(koksma__tasks_open(a->study, images, &tasks));
    koksma_status status = koksma__tasks_look_up(&tasks, false, NULL);
    for (size_t i = 0; i < tasks.n; i++) {
        const koksma__task *t = &tasks.at[i];
        for (size_t k = 0; !status && k < t->n_series; k++) {
            audited *s = t->series[k] ? koksma__add_one(&a->at, &a->n, sizeof *s) : NULL;
            if (s) {
                *s = (audited){.id = t->series[k], .trials = t->trials};
            }
            status = s || !t->series[k] ? KOKSMA_OK : KOKSMA_MEMORY;
        }
    }
    koksma__tasks_close(&tasks);
    return status;
}

static void count_row(void *context, long long id, long long trial)
{
    audit *a = context;
    audited *s = find_row(a, id, trial);
    if (!s) {
        a->out->other_rows++;
        return;
    }
    a->out->rows++;
    s->rows++;
    s->end = trial >= s->end ? trial + 1 : s->end;
}

/* Lists the series, and counts their rows. Blocks of a plan may share a series, which then has the most trials of these. */
static koksma_status list_all(audit *a)
{
    bool has_references;
    koksma_status status = koksma__references_folder(a->study, &has_references);
    status = status ? status : list_series(a, false);
    status = status ? status : list_series(a, true);
    size_t n = 0;
    if (a->n) {
        qsort(a->at, a->n, sizeof *a->at, compare_ids);
    }
    for (size_t i = 0; i < a->n; i++) {
        a->at[n] = a->at[i];
        n += !n || a->at[n].id != a->at[n - 1].id;
    }
    a->n = n;
    status = status ? status : koksma__store_scan(a->study->store, true, count_row, a);
    for (size_t i = 0; !status && i < a->n; i++) {
        audited *s = &a->at[i];
        a->out->rows_missing += s->end - s->rows;
        s->drawn = calloc((size_t)s->trials / 8 + 1, 1);
        status = s->drawn ? KOKSMA_OK : koksma__fail_memory((size_t)s->trials / 8);
    }
    if (!status && !a->out->rows && a->out->other_rows) {
        differ(a, "no row is one of the stored plan with the files and revisions of now: of %lld, none is compared",
               a->out->other_rows);
    }
    return status;
}

/* ---- The draw ------------------------------------------------------------------------------------------ */

static bool is_drawn(const audited *s, long long trial)
{
    return s && trial < s->trials && s->drawn[trial / 8] >> trial % 8 & 1;
}

static void draw_row(void *context, long long id, long long trial)
{
    audit *a = context;
    const audited *s = find_row(a, id, trial);
    const long long wanted = a->options->rows && a->options->rows < a->out->rows ? a->options->rows : a->out->rows;
    if (!s) {
        return;
    }
    const koksma__words r = koksma__random(a->options->seed, KOKSMA__PURPOSE_AUDIT, (uint64_t)a->seen, 0);
    const bool drawn =
        koksma__unit(r.w[0], r.w[1]) * (double)(a->out->rows - a->seen) < (double)(wanted - a->out->drawn);
    a->seen++;
    if (drawn) {
        a->out->drawn++;
        s->drawn[trial / 8] |= (unsigned char)(1u << trial % 8);
    }
}

/* Counts a row if it was drawn, once. */
static void settle(audit *a, const audited *s, long long trial, bool agrees)
{
    pthread_mutex_lock(&a->lock);
    if (is_drawn(s, trial)) {
        s->drawn[trial / 8] &= (unsigned char)~(1u << trial % 8);
        a->out->agree += agrees;
        a->wrong += !agrees;
    }
    pthread_mutex_unlock(&a->lock);
}

/* Checks that every drawn row was counted: that it agrees, differs or, if any job has failed, was left over. */
static void check_all_counted(audit *a, bool failed)
{
    const long long left = a->out->drawn - a->out->agree - a->wrong;
    long long open = 0;
    for (size_t i = 0; i < a->n; i++) {
        for (long long trial = 0; trial < a->at[i].trials; trial++) {
            open += is_drawn(&a->at[i], trial);
        }
    }
    if (left != open || (left && !failed)) {
        differ(a, "of %lld drawn rows, %lld agree and %lld differ, but the others were compared with nothing",
               a->out->drawn, a->out->agree, a->wrong);
    }
}

/* The upper 95 % confidence limit of the proportion of wrong rows if k of n drawn rows are wrong. */
static double upper_limit(long long k, long long n)
{
    double low = 0, high = 1;
    for (int i = 0; i < 60 && k < n; i++) {
        const double p = (low + high) / 2;
        double below = 0;
        for (long long j = 0; j <= k; j++) {
            below += koksma__exp(koksma__log_gamma((double)n + 1) - koksma__log_gamma((double)j + 1) -
                                 koksma__log_gamma((double)(n - j) + 1) + (double)j * koksma__log(p) +
                                 (double)(n - j) * koksma__log1p(-p));
        }
        *(below > CHANCE ? &low : &high) = p;
    }
    return high;
}

/* ---- Rows ---------------------------------------------------------------------------------------------- */

/* Checks that the row's seed is the hash of its key; if it is not, the row was not computed from that key. */
static koksma_status check_seed(audit *a, const koksma__task *t, size_t k, long long trial, bool *right)
{
    const audited *s = find(a, t->series[k]);
    koksma__result row = {.trial = trial};
    bool found;
    char name[NAME];
    const koksma_status status = koksma__store_row(a->study->store, s->id, &row, &found);
    *right = row.seed == koksma__task_seed(t, trial);
    if (!status && !*right) {
        name_row(t, k, trial, name);
        differ(a, "%s: the stored seed %llu is not the seed that runs use for this row", name,
               (unsigned long long)row.seed);
        settle(a, s, trial, false);
    }
    return status;
}

/* Marks all jobs as done, except the jobs of the drawn rows, so that only these are run. */
static koksma_status look_up(void *context, koksma__tasks *tasks)
{
    audit *a = context;
    koksma_status status = koksma__tasks_look_up(tasks, false, NULL);
    for (size_t i = 0; !status && i < tasks->n; i++) {
        koksma__task *t = &tasks->at[i];
        memset(t->done, 0xff, ((size_t)t->trials + 7) / 8);
        t->done_before = t->trials;
        for (size_t k = 0; !status && k < t->n_series; k++) {
            const audited *s = find(a, t->series[k]);
            for (long long trial = 0; s && !status && trial < t->trials; trial++) {
                bool right = false;
                status = is_drawn(s, trial) ? check_seed(a, t, k, trial, &right) : KOKSMA_OK;
                if (!status && right && koksma__task_is_done(t, trial)) {
                    t->done[trial / 8] &= (unsigned char)~(1u << trial % 8);
                    t->done_before--;
                }
            }
        }
    }
    return status;
}

/* Writes a value of the store: NaN stands for none. */
static const char *value_text(double value, char text[32])
{
    koksma__snprintf(text, 32, isnan(value) ? "none" : "%.17g", value);
    return text;
}

static bool is_same(double a, double b)
{
    return (isnan(a) && isnan(b)) || !memcmp(&a, &b, sizeof a);
}

/* Compares a job's result with the series' row in the store, if there is one. */
static koksma_status compare_row(audit *a, const koksma__task *t, size_t k, const koksma__result *made)
{
    const audited *s = find_row(a, t->series[k], made->trial);
    char name[NAME], before[32], now[32];
    koksma__result row = {.trial = made->trial};
    bool found = false;
    int v = 0;
    if (!s) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__store_row(a->study->store, s->id, &row, &found));
    while (v < KOKSMA__RESULT_VALUES && is_same(row.values[v], made->values[v])) {
        v++;
    }
    const bool same = row.seed == made->seed && v == KOKSMA__RESULT_VALUES;
    if (found && !same) {
        name_row(t, k, row.trial, name);
        differ(a, "%s: the stored value is %s, but computing it again gives %s", name,
               value_text(row.values[v % KOKSMA__RESULT_VALUES], before),
               value_text(made->values[v % KOKSMA__RESULT_VALUES], now));
    }
    if (found) {
        settle(a, s, row.trial, same);
    }
    return KOKSMA_OK;
}

/* Compares a job's results with the store. A job may also compute series that were not drawn: they are compared, but
   not counted as drawn rows that agree. */
static koksma_status put_job(void *context, const koksma__task *t, const koksma__result *results)
{
    for (size_t k = 0; k < t->n_series; k++) {
        KOKSMA__TRY(compare_row(context, t, k, &results[k]));
    }
    return KOKSMA_OK;
}

/* ---- References ---------------------------------------------------------------------------------------- */

/* Compares a reference image's file, if there is one, with the hash of the pixels rendered now; sets *same to false
   if they differ. A file that cannot be read counts as a difference. */
static koksma_status check_file(audit *a, const koksma__reference_image *reference, const char *pixels,
                                const char *name, bool *same)
{
    char path[KOKSMA__PATH], found[KOKSMA__SHA256_TEXT];
    koksma_image image;
    bool exists;
    KOKSMA__TRY(koksma__reference_find(a->study, reference, &exists));
    if (!exists) {
        pthread_mutex_lock(&a->lock);
        a->out->references_missing++;
        pthread_mutex_unlock(&a->lock);
        return KOKSMA_OK;
    }
    koksma__reference_path(a->study, reference, path, sizeof path);
    const koksma_status status = koksma__image_read(path, KOKSMA__FILE_IMAGE, KOKSMA__BY_FILE, &image);
    if (koksma__ends_all(status)) {
        return status;
    }
    if (status) {
        *same = false;
        differ(a, "reference %s of %s: %s", name, reference->scene->name, koksma_error_text());
        return KOKSMA_OK;
    }
    koksma__reference_pixels(&image, found);
    koksma_image_fini(&image);
    if (strcmp(found, pixels) != 0) {
        *same = false;
        differ(a, "reference %s of %s: the pixels of the file %s differ from those rendered now", name,
               reference->scene->name, path);
    }
    return KOKSMA_OK;
}

/* Compares the standard error of a reference, which is NaN if it has none. */
static bool check_standard_error(audit *a, const koksma__reference_image *reference, const char *name,
                                 double stored_error, double made)
{
    char before[32], now[32];
    const bool same = is_same(stored_error, made);
    if (!same) {
        differ(a, "reference %s of %s: its stored standard error is %s, but computing it again gives %s", name,
               reference->scene->name, value_text(stored_error, before), value_text(made, now));
    }
    return same;
}

static koksma_status put_reference(void *context, const koksma__reference_image *reference,
                                   const koksma__reference_row *made)
{
    audit *a = context;
    char name[KOKSMA__REFERENCE_NAME];
    const koksma__series key = koksma__reference_key(reference, name);
    koksma__reference_row row;
    bool same = true;
    KOKSMA__TRY(koksma__store_reference(a->study->store, &key, &row));
    if (!row.pixels[0]) { /* no run has rendered it */
        return KOKSMA_OK;
    }
    if (strcmp(row.pixels, made->pixels) != 0) {
        same = false;
        differ(a, "reference %s of %s: the stored hash is not that of its pixels", name, reference->scene->name);
    }
    same = check_standard_error(a, reference, name, row.standard_error, made->standard_error) && same;
    const koksma_status status = check_file(a, reference, made->pixels, name, &same);
    pthread_mutex_lock(&a->lock);
    a->out->references++;
    a->out->references_agree += same;
    pthread_mutex_unlock(&a->lock);
    return status;
}

/* ---- The whole audit ----------------------------------------------------------------------------------- */

/* Estimates the work of all references in samples. The tasks of the images must have been listed before. */
static double work_of_references(const koksma_study *study)
{
    double sum = 0;
    for (size_t i = 0; i < study->n_references; i++) {
        const koksma__reference_image *r = &study->references[i];
        sum += (double)r->width * r->height * (double)r->reference->spp * (double)r->reference->replicates;
    }
    return sum;
}

static koksma_status compare(audit *a, const koksma_run *run)
{
    koksma__run_control control;
    koksma_study_summary summary = {0};
    koksma__failures failures = {.n = 0};
    koksma__run_control_begin(run, 0, &control);
    if (koksma_study_mpi_rank() > 0) {
        return koksma__mpi_work(a->study, &control.job);
    }
    koksma_status status = koksma__store_scan(a->study->store, true, draw_row, a);
    const double drawn = a->out->rows ? (double)a->out->drawn / (double)a->out->rows : 0;
    const double sets = drawn * koksma__run_work(a->study, false),
                 images = drawn * koksma__run_work(a->study, true) + work_of_references(a->study);
    control.share = sets > 0 ? sets / (sets + images) : 0;
    status = koksma__run_kind(a->study, false, &control, status, &summary, &failures);
    control.begin = control.share;
    control.share = 1 - control.begin;
    status = koksma__run_kind(a->study, true, &control, status, &summary, &failures);
    if (!status) {
        check_all_counted(a, failures.n);
    }
    if (failures.n) {
        differ(a, "%zu rows can't be computed again, such as %s", failures.n, failures.text);
    }
    koksma__failures_fini(&failures);
    const long long wrong = a->out->drawn - a->out->agree;
    const bool all = a->out->drawn == a->out->rows;
    a->out->bound = !a->out->drawn ? 1
                    : all          ? (double)wrong / (double)a->out->rows
                                   : upper_limit(wrong, a->out->drawn);
    return status;
}

koksma_status koksma_study_audit(const koksma_audit_options *options, const koksma_run *run, koksma_audit *out)
{
    audit a = {.options = options, .out = out};
    const koksma__sink sink = {&a, look_up, put_job, put_reference};
    KOKSMA__REQUIRE(options, out);
    KOKSMA__REQUIRE_RUN(run);
    *out = (koksma_audit){0};
    KOKSMA__FAIL_IF(!options->folder, KOKSMA_ARGUMENT, "an audit needs a study's folder");
    KOKSMA__FAIL_IF(options->rows < 0, KOKSMA_ARGUMENT, "rows = %lld: it must be 0 (all rows) or more",
                    options->rows);
    pthread_mutex_init(&a.lock, NULL);
    koksma_status status = koksma__study_open_stored(options->folder, &a.study);
    status = status ? status : list_all(&a);
    if (!status) {
        a.study->sink = &sink;
        status = compare(&a, run);
    }
    koksma__mpi_release();
    koksma_study_close(a.study);
    for (size_t i = 0; i < a.n; i++) {
        free(a.at[i].drawn);
    }
    free(a.at);
    pthread_mutex_destroy(&a.lock);
    return status;
}
