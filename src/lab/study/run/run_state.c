/* SPDX-License-Identifier: Apache-2.0 */
/* The state of a phase: two queues under one lock. One holds tiles of reference images; the other holds jobs, which are
   ready when the references that they are compared with are complete. */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"

/* ---- Queues --------------------------------------------------------------------------------------------- */

static koksma_status open_queue(size_t n, koksma__work_queue *queue)
{
    *queue = (koksma__work_queue){.n = n, .left = n, .taken = calloc(n / 8 + 1, 1)};
    return queue->taken ? KOKSMA_OK : koksma__fail_memory(n / 8);
}

static bool is_taken(const koksma__work_queue *queue, size_t i)
{
    return queue->taken[i / 8] >> i % 8 & 1;
}

static void take(koksma__work_queue *queue, size_t i)
{
    queue->taken[i / 8] |= (unsigned char)(1u << i % 8);
    while (queue->next < queue->n && is_taken(queue, queue->next)) {
        queue->next++;
    }
}

/* ---- Tiles ---------------------------------------------------------------------------------------------- */

/*
 * Cuts the missing references into tiles of whole rows. The number of tiles depends on the size of the reference,
 * not on the number of threads. A tile is rendered as the sum of all replicates of its rows, added in their order;
 * when the sums of all tiles of a reference have been copied into one array, the reference is complete. So the bits
 * of a reference do not depend on which thread or rank renders which tile.
 */

/* The size of a tile: about 20 ms of rendering for a simple scene, so that jobs do not wait long for the last tile of
   their reference. */
static const double SAMPLES_A_TILE = 1 << 19;

static koksma_status add_tile(koksma__reference_tiles *tiles, size_t reference, int first_row, int rows)
{
    koksma__reference_tile *at = koksma__add_one(&tiles->at, &tiles->n, sizeof *at);
    if (at) {
        *at = (koksma__reference_tile){reference, first_row, rows};
    }
    return at ? KOKSMA_OK : KOKSMA_MEMORY;
}

static koksma_status add_tiles(koksma__reference_tiles *tiles, size_t reference)
{
    const koksma__reference_image *r = &tiles->study->references[reference];
    const double row = (double)r->width * (double)r->reference->spp * (double)r->reference->replicates;
    bool alone;
    koksma_status status = koksma__reference_rows_stand_alone(r, &alone);
    int rows = r->height;
    if (alone && row * rows > SAMPLES_A_TILE) {
        rows = row < SAMPLES_A_TILE ? (int)(SAMPLES_A_TILE / row) : 1;
    }
    for (int y = 0; !status && y < r->height; y += rows) {
        status = add_tile(tiles, reference, y, r->height - y < rows ? r->height - y : rows);
    }
    tiles->rows_left[reference] = r->height;
    return status;
}

/* Finds whether the study's folder has the reference's file, and its store has the row with the file's hash and the
   reference's own error. If the database was removed, or predates the hashes, the reference is rendered again. */
static koksma_status find_kept(const koksma_study *study, const koksma__reference_image *reference, bool *kept)
{
    char name[KOKSMA__REFERENCE_NAME];
    const koksma__series key = koksma__reference_key(reference, name);
    koksma__reference_row row;
    const koksma_status status = koksma__reference_find(study, reference, kept);
    *kept = !status && *kept && !koksma__store_reference(study->store, &key, &row) && row.pixels[0];
    return status;
}

static void close_tiles(koksma__reference_tiles *tiles)
{
    for (size_t i = 0; tiles->sums && i < tiles->study->n_references; i++) {
        free(tiles->sums[i].sum);
    }
    KOKSMA__FREE(tiles->sums, tiles->rows_left, tiles->at);
    *tiles = (koksma__reference_tiles){0};
}

/* Reads the references that the tasks' jobs need and that have a file; lists the tiles of the others. */
static koksma_status open_tiles(const koksma__tasks *tasks, koksma__reference_tiles *tiles)
{
    koksma_study *study = tasks->study;
    koksma_status status = KOKSMA_OK;
    *tiles = (koksma__reference_tiles){.study = study};
    tiles->sums = calloc(study->n_references + 1, sizeof *tiles->sums);
    tiles->rows_left = calloc(study->n_references + 1, sizeof *tiles->rows_left);
    if (!tiles->sums || !tiles->rows_left) {
        status = koksma__fail_memory((study->n_references + 1) * sizeof *tiles->sums);
    }
    for (size_t i = 0; !status && i < tasks->n; i++) {
        const koksma__task *task = &tasks->at[i];
        const bool needed = task->image && (study->sink || task->done_before < task->trials);
        for (size_t r = 0; needed && !status && r < task->n_series; r++) {
            const size_t index = task->references[r];
            if (study->references[index].image.pixels || tiles->rows_left[index]) {
                continue;
            }
            bool kept = false;
            status = study->sink ? KOKSMA_OK : find_kept(study, &study->references[index], &kept);
            status = status ? status
                     : kept ? koksma__reference_read(study, &study->references[index])
                            : add_tiles(tiles, index);
        }
    }
    if (status) {
        close_tiles(tiles);
    }
    return status;
}

static koksma_status fail_reference(const koksma__reference_image *r, koksma_status status)
{
    char name[KOKSMA__REFERENCE_NAME], text[KOKSMA__REFERENCE_NAME + 96];
    koksma__reference_name(r->reference, name);
    snprintf(text, sizeof text, "reference %s of %.64s", name, r->scene->name);
    return koksma__fail_in(status, text);
}

/* Renders a tile into *out, the sums of its rows. The caller frees out->sum. */
static koksma_status render_tile(const koksma_study *study, const koksma__reference_tile *tile, const koksma_run *run,
                                 koksma__replicates *out)
{
    koksma__reference_image *r = &study->references[tile->reference];
    koksma_status status = KOKSMA_OK;
    *out = (koksma__replicates){0};
    for (long long i = 0; !status && i < r->reference->replicates; i++) {
        koksma_image image;
        status = koksma__reference_replicate(r, i, (int)tile->first_row, (int)tile->rows, run, &image);
        if (!status) {
            status = koksma__replicates_add(out, &image);
            koksma_image_fini(&image);
        }
    }
    if (status) {
        free(out->sum);
        *out = (koksma__replicates){0};
    }
    return koksma__is_impossible(status) ? fail_reference(r, KOKSMA_IMPOSSIBLE) : status;
}

/* Copies a tile's sums into those of its reference; *complete tells whether this was the reference's last tile. Calls must
   not overlap, and each tile must be put only once. */
static koksma_status add_sums(koksma__reference_tiles *tiles, const koksma__reference_tile *tile,
                              const koksma__replicates *from, bool *complete)
{
    const koksma__reference_image *r = &tiles->study->references[tile->reference];
    koksma__replicates *all = &tiles->sums[tile->reference];
    const size_t width = from->pixels / (size_t)tile->rows, first = (size_t)tile->first_row * width;
    KOKSMA__TRY(all->sum ? KOKSMA_OK : koksma__replicates_init(all, width * (size_t)r->height, from->channels));
    all->n = r->reference->replicates;
    memcpy(all->sum + first * from->channels, from->sum, from->pixels * from->channels * sizeof *from->sum);
    memcpy(all->luminance + first, from->luminance, from->pixels * sizeof *from->sum);
    memcpy(all->squares + first, from->squares, from->pixels * sizeof *from->sum);
    tiles->rows_left[tile->reference] -= tile->rows;
    *complete = tiles->rows_left[tile->reference] == 0;
    return KOKSMA_OK;
}

/* ---- The state ------------------------------------------------------------------------------------------ */

void koksma__run_state_stop(koksma__run_state *state, koksma_status status, const char *text)
{
    pthread_mutex_lock(&state->lock);
    if (!state->status) {
        state->status = status;
        snprintf(state->text, sizeof state->text, "%s", text);
    }
    pthread_mutex_unlock(&state->lock);
}

bool koksma__run_state_is_over(koksma__run_state *state)
{
    pthread_mutex_lock(&state->lock);
    const bool over = state->status || (state->tile_queue.left == 0 && state->jobs.left == 0);
    pthread_mutex_unlock(&state->lock);
    return over;
}

double koksma__run_state_fraction(koksma__run_state *state)
{
    pthread_mutex_lock(&state->lock);
    const double left =
        state->tile_work * (double)state->tile_queue.left + state->job_work * (double)state->jobs.left;
    pthread_mutex_unlock(&state->lock);
    return state->work > 0 ? 1 - left / state->work : 1;
}

koksma_status koksma__run_state_status(const koksma__run_state *state)
{
    return state->status ? koksma__fail(state->status, "%s", state->text) : KOKSMA_OK;
}

/* ---- Handing out assignments --------------------------------------------------------------------------- */

static bool job_is_ready(const koksma__run_state *state, size_t job)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(state->phase->tasks, job, &trial);
    bool ready = true;
    for (size_t r = 0; task->image && r < task->n_series; r++) {
        ready &= state->ready[task->references[r]];
    }
    return ready;
}

bool koksma__run_state_take(koksma__run_state *state, koksma__assignment *assignment)
{
    koksma__work_queue *tiles = &state->tile_queue, *jobs = &state->jobs;
    bool found = false;
    *assignment = (koksma__assignment){0};
    pthread_mutex_lock(&state->lock);
    if (!state->status && tiles->next < tiles->n) {
        const size_t i = tiles->next;
        *assignment = (koksma__assignment){.kind = KOKSMA__ASSIGN_TILE, .number = i, .tile = state->tiles.at[i]};
        take(tiles, i);
        found = true;
    } else if (!state->status) {
        const size_t reach =
            jobs->n - jobs->next < state->phase->tasks->n ? jobs->n : jobs->next + state->phase->tasks->n;
        size_t i = jobs->next;
        while (i < reach && (is_taken(jobs, i) || !job_is_ready(state, i))) {
            i++;
        }
        found = i < reach;
        if (found) {
            *assignment = (koksma__assignment){.kind = KOKSMA__ASSIGN_JOB, .number = i};
            take(jobs, i);
        }
    }
    pthread_mutex_unlock(&state->lock);
    return found;
}

size_t koksma__run_state_take_batch(koksma__run_state *state, double job_s, int ranks,
                                    koksma__assignment assignments[KOKSMA__MAX_BATCH])
{
    pthread_mutex_lock(&state->lock);
    const koksma__work_queue *queue =
        state->tile_queue.next < state->tile_queue.n ? &state->tile_queue : &state->jobs;
    const size_t share = (queue->n - queue->next) / (size_t)(4 * ranks) + 1;
    const double fit = queue == &state->tile_queue ? 6 : job_s > 0 ? KOKSMA__BATCH_S / job_s : 1;
    pthread_mutex_unlock(&state->lock);
    size_t batch = fit < 1 ? 1 : fit > KOKSMA__MAX_BATCH ? KOKSMA__MAX_BATCH : (size_t)fit, n = 0;
    batch = batch < share ? batch : share;
    while (n < batch && koksma__run_state_take(state, &assignments[n])) {
        n++;
    }
    return n;
}

/* ---- Receiving results --------------------------------------------------------------------------------- */

/* Counts a job as done: its results, or the text of its failure. */
static void put_job(koksma__run_state *state, const koksma__outcome *head, const void *payload)
{
    koksma__phase *phase = state->phase;
    long long trial;
    const bool failed = head->kind == KOKSMA__OUTCOME_FAILURE;
    koksma_status status = KOKSMA_OK;
    if (!failed) {
        status =
            koksma__task_put(phase->tasks->study, koksma__tasks_job(phase->tasks, head->number, &trial), payload);
    }
    pthread_mutex_lock(&state->lock);
    if (failed) {
        status = koksma__failures_count(phase->tasks, head->number, payload, &phase->failures);
    }
    state->jobs.left--;
    pthread_mutex_unlock(&state->lock);
    if (status) {
        koksma__run_state_stop(state, status, koksma_error_text());
    } else {
        atomic_fetch_add(&phase->done, !failed);
    }
}

/* A reference is ready when its file has been written, some time after its last tile was put. A run cannot end between
   these two moments, because the jobs that need the reference are not done yet. An audit may have no such jobs: its
   phase ends when all its threads have returned from here. */
static void put_tile(koksma__run_state *state, size_t i, const koksma__replicates *sums)
{
    const koksma__reference_tile tile = state->tiles.at[i];
    koksma_study *study = state->phase->tasks->study;
    bool complete = false;
    koksma_status status;
    pthread_mutex_lock(&state->lock);
    state->tile_queue.left--;
    status = add_sums(&state->tiles, &tile, sums, &complete);
    pthread_mutex_unlock(&state->lock);
    status = !status && complete ? koksma__replicates_finish(&state->tiles.sums[tile.reference], study,
                                                             &study->references[tile.reference])
                                 : status;
    if (status) {
        koksma__run_state_stop(state, status, koksma_error_text());
        return;
    }
    pthread_mutex_lock(&state->lock);
    state->ready[tile.reference] |= complete;
    pthread_mutex_unlock(&state->lock);
}

static void put_one(koksma__run_state *state, const koksma__outcome *head, void *payload)
{
    if (head->kind != KOKSMA__OUTCOME_TILE && head->number < state->phase->tasks->n_jobs) {
        put_job(state, head, payload);
    } else if (head->kind == KOKSMA__OUTCOME_TILE && head->number < state->tiles.n) {
        const koksma__reference_tile *tile = &state->tiles.at[head->number];
        const size_t width = (size_t)state->phase->tasks->study->references[tile->reference].width;
        const koksma__replicates sums =
            koksma__replicates_over(payload, head->size / sizeof(double), width * (size_t)tile->rows);
        put_tile(state, head->number, &sums);
    }
}

void koksma__run_state_put(koksma__run_state *state, const koksma__outcomes *outcomes)
{
    koksma__outcome head;
    for (size_t at = 0; at + sizeof head <= outcomes->size; at += sizeof head + head.size) {
        memcpy(&head, outcomes->bytes + at, sizeof head);
        put_one(state, &head, outcomes->bytes + at + sizeof head);
    }
}

/* ---- Opening and closing ------------------------------------------------------------------------------- */

/* Marks the jobs that were done before, and estimates the work of those that are left and of the tiles. */
static void count_work(koksma__run_state *state)
{
    const koksma__tasks *tasks = state->phase->tasks;
    double jobs = 0, tiles = 0;
    for (size_t i = 0; i < tasks->n_jobs; i++) {
        long long trial;
        const koksma__task *task = koksma__tasks_job(tasks, i, &trial);
        if (koksma__task_is_done(task, trial)) {
            take(&state->jobs, i);
            state->jobs.left--;
        } else {
            jobs += task->image ? (double)task->n * task->width * task->height : 1;
        }
    }
    for (size_t i = 0; i < state->tiles.n; i++) {
        const koksma__reference_image *r = &tasks->study->references[state->tiles.at[i].reference];
        tiles +=
            (double)state->tiles.at[i].rows * r->width * (double)r->reference->spp * (double)r->reference->replicates;
    }
    const size_t counted = tasks->study->sink ? state->jobs.left : tasks->n_jobs;
    state->job_work = state->jobs.left ? jobs / (double)state->jobs.left : 0;
    state->tile_work = state->tiles.n ? tiles / (double)state->tiles.n : 0;
    state->work = state->job_work * (double)counted + tiles;
}

koksma_status koksma__run_state_open(koksma__phase *phase, koksma__run_state *state)
{
    const koksma__tasks *tasks = phase->tasks;
    const size_t n_references = tasks->study->n_references;
    *state = (koksma__run_state){.phase = phase};
    pthread_mutex_init(&state->lock, NULL);
    state->ready = calloc(n_references + 1, sizeof *state->ready);
    koksma_status status = state->ready ? KOKSMA_OK : koksma__fail_memory(n_references + 1);
    status = status ? status : open_tiles(tasks, &state->tiles);
    status = status ? status : open_queue(state->tiles.n, &state->tile_queue);
    status = status ? status : open_queue(tasks->n_jobs, &state->jobs);
    for (size_t i = 0; i < n_references && !status; i++) {
        state->ready[i] = tasks->study->references[i].image.pixels != NULL;
    }
    if (!status) {
        count_work(state);
    }
    /* tasks may lack series in the store if the run stopped while they were looked up: no worker may take a job */
    if (atomic_load(&phase->control->stop)) {
        koksma__run_state_stop(state, KOKSMA_INTERRUPTED, "interrupted");
    }
    return status;
}

void koksma__run_state_close(koksma__run_state *state)
{
    free(state->tile_queue.taken);
    free(state->jobs.taken);
    if (state->tiles.sums) {
        close_tiles(&state->tiles);
    }
    free(state->ready);
    pthread_mutex_destroy(&state->lock);
}

/* ---- Workers ------------------------------------------------------------------------------------------- */

/* A worker takes an assignment of the run state, does it, and puts the result back, until nothing is left. A run
   without MPI has as many workers as threads; rank 0 of an MPI run has one worker beside the thread that serves the
   other ranks (mpi_work.c). A worker that finds no assignment, because the jobs wait for the last tiles of a
   reference, sleeps briefly. A result depends only on its job, not on the worker or the time. */

static const double REST_S = 1e-4;

static koksma_status append(koksma__outcomes *to, koksma__outcome_kind kind, size_t number, const void *payload,
                            size_t size)
{
    const koksma__outcome head = {kind, number, size};
    KOKSMA__TRY(koksma__reserve(&to->bytes, &to->capacity, to->size + sizeof head + size, 1));
    memcpy(to->bytes + to->size, &head, sizeof head);
    memcpy(to->bytes + to->size + sizeof head, payload, size);
    to->size += sizeof head + size;
    return KOKSMA_OK;
}

static koksma_status append_failure(koksma__outcomes *to, size_t number)
{
    char text[KOKSMA__FAILURE_TEXT] = "";
    snprintf(text, sizeof text, "%s", koksma_error_text());
    return append(to, KOKSMA__OUTCOME_FAILURE, number, text, sizeof text);
}

static koksma_status do_job(const koksma__tasks *tasks, size_t job, const koksma_run *run, koksma__outcomes *to)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(tasks, job, &trial);
    const size_t size = task->n_series * sizeof(koksma__result);
    koksma__result *results = calloc(1, size);
    KOKSMA__REQUIRE_MEMORY(results, size);
    koksma_status status = koksma__task_do(tasks->study, task, trial, run, results);
    if (koksma__task_failed_alone(tasks->study, status)) {
        status = append_failure(to, job);
    } else if (!status) {
        status = append(to, KOKSMA__OUTCOME_RESULTS, job, results, size);
    }
    free(results);
    return status;
}

static koksma_status do_tile(const koksma__tasks *tasks, const koksma__assignment *assignment, const koksma_run *run,
                             koksma__outcomes *to)
{
    koksma__replicates sums = {0};
    koksma_status status = render_tile(tasks->study, &assignment->tile, run, &sums);
    if (!status) {
        status = append(to, KOKSMA__OUTCOME_TILE, assignment->number, sums.sum,
                        koksma__replicates_numbers(&sums) * sizeof *sums.sum);
    }
    free(sums.sum);
    return status;
}

koksma_status koksma__do_assignment(const koksma__tasks *tasks, const koksma__assignment *assignment,
                                    const koksma_run *run, koksma__outcomes *to)
{
    return assignment->kind == KOKSMA__ASSIGN_JOB ? do_job(tasks, assignment->number, run, to)
                                                  : do_tile(tasks, assignment, run, to);
}

void koksma__work(koksma__run_state *state)
{
    koksma__run_control *control = state->phase->control;
    const bool asks = pthread_equal(pthread_self(), control->caller);
    koksma__assignment assignment;
    koksma__outcomes outcomes = {0};
    for (;;) {
        if (asks && !koksma__keep_going(&control->run, koksma__run_state_fraction(state))) {
            koksma__run_state_stop(state, KOKSMA_INTERRUPTED, "interrupted");
        }
        if (koksma__run_state_take(state, &assignment)) {
            const double start_s = koksma__now_s();
            outcomes.size = 0;
            const koksma_status status =
                koksma__do_assignment(state->phase->tasks, &assignment, &control->job, &outcomes);
            if (status) {
                koksma__run_state_stop(state, status, koksma_error_text());
            } else {
                koksma__run_state_put(state, &outcomes);
            }
            atomic_fetch_add(&state->phase->busy_ns, (unsigned long long)(1e9 * (koksma__now_s() - start_s)));
        } else if (koksma__run_state_is_over(state)) {
            free(outcomes.bytes);
            return;
        } else {
            koksma__mpi_rest(REST_S);
        }
    }
}

static koksma_status work_block(void *context, size_t i)
{
    (void)i;
    koksma__work(context);
    return KOKSMA_OK;
}

koksma_status koksma__work_threads(koksma__phase *phase)
{
    koksma__run_state state;
    const koksma_run threads = {.threads = phase->control->run.threads};
    koksma_status status = koksma__run_state_open(phase, &state);
    status = status ? status : koksma__parallel(&threads, (size_t)threads.threads, work_block, &state);
    status = status ? status : koksma__run_state_status(&state);
    koksma__run_state_close(&state);
    return status;
}
