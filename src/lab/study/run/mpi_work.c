/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A run on the ranks of MPI.
 *
 * Rank 0 exchanges messages with the other ranks and works on a second thread. If MPI ends all ranks, the run ends, and
 * the same command continues it from the store.
 *
 * The other ranks have the plan, make the same list of jobs as rank 0, fetch the reference images that their jobs need
 * from rank 0, and store no results. A rank requests the next batch when it begins a batch, so that the answer can arrive
 * while it works. Results are sent back together, at least every SEND_S.
 *
 * Messages to rank 0:
 *     REQUEST  request: asks for the batch after the current one, so that no rank waits for an answer
 *     RESULTS  koksma__outcomes
 *     NEED     index of a reference whose pixels the rank needs
 *     ERROR    status and text of a rank that fails; all ranks then end
 * Messages from rank 0:
 *     ASSIGNMENTS  jobs or tiles to do, or the end of the phase or of the run; if empty, the rank requests again
 *     PIXELS       a reference image: image_head; its pixels follow in a second message
 */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"

enum { TAG_REQUEST = 1, TAG_RESULTS, TAG_NEED, TAG_ERROR, TAG_ASSIGNMENTS, TAG_PIXELS };

enum { PHASES = 2 };

/* Seconds after which a rank sends its results. If the rank is lost, the results of so many seconds are lost with
   it, or of one job if that takes longer. */
#define SEND_S 0.02

typedef struct request {
    double phase;       /* 0: discrepancies, 1: images */
    double job_s;       /* mean seconds of a job in the last batch; 0: unknown */
    double busy_s;      /* seconds that this rank has worked in this phase so far */
    double processor_s; /* this rank's processor time in this phase so far */
} request;

/* The first message about a reference image. */
typedef struct image_head {
    int width, height, channels;
} image_head;

/* ---- Rank 0 ----------------------------------------------------------------------------------------------------- */

/* Pause between two polls for messages. Ranks may wait this long for an answer, because they request a batch while
   they still work on another. */
static const double SERVER_REST_S = 1e-3;

typedef struct server {
    koksma__phase *phase;
    const koksma__transport *mpi;
    int size, number; /* number of ranks; number of the phase (request) */
    koksma__run_state state;
    double exec_s; /* the caller's time limit for programs (koksma_allow_exec) */
    /* The next two fields are used by the serving thread only. */
    request *requests; /* the most recent request of each rank */
    bool *ended;       /* whether each rank knows that the phase is over */
} server;

/* The body of the thread that does assignments on rank 0. */
static void *work_here(void *context)
{
    server *s = context;
    koksma_allow_exec(s->exec_s);
    koksma__work(&s->state);
    return NULL;
}

/* ---- Messages ------------------------------------------------------------------------------------------ */

static void send_pixels(server *s, int to)
{
    unsigned long long index;
    if (!s->mpi->receive(to, TAG_NEED, &index, sizeof index, NULL) || index >= s->phase->tasks->study->n_references) {
        return;
    }
    const koksma__reference_image *reference = &s->phase->tasks->study->references[index];
    const koksma_image *image = &reference->image;
    const image_head head = {image->width, image->height, image->channels};
    const size_t pixels = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    s->mpi->send(to, TAG_PIXELS, &head, sizeof head);
    s->mpi->send(to, TAG_PIXELS, image->pixels, pixels * sizeof *image->pixels);
}

static void receive_results(server *s, int from, size_t bytes)
{
    const koksma__outcomes outcomes = {.bytes = malloc(bytes ? bytes : 1), .size = bytes};
    if (!outcomes.bytes) {
        koksma__run_state_stop(&s->state, KOKSMA_MEMORY, "out of memory for a message");
    } else if (s->mpi->receive(from, TAG_RESULTS, outcomes.bytes, bytes, NULL)) {
        koksma__run_state_put(&s->state, &outcomes);
    }
    free(outcomes.bytes);
}

/* Answers a rank's request for jobs; the answer is empty when no job is ready. */
static void assign(server *s, int to)
{
    request asked;
    koksma__assignment assignments[KOKSMA__MAX_BATCH];
    size_t n = 0;
    s->mpi->receive(to, TAG_REQUEST, &asked, sizeof asked, NULL);
    const bool now = (int)asked.phase == s->number;
    if (now) {
        s->requests[to] = asked;
        n = koksma__run_state_take_batch(&s->state, asked.job_s, s->size, assignments);
    }
    if (n == 0 && (koksma__run_state_is_over(&s->state) ? (int)asked.phase <= s->number || s->state.status
                                                        : (int)asked.phase < s->number)) {
        assignments[n++] = (koksma__assignment){.kind = s->state.status ? KOKSMA__RUN_OVER : KOKSMA__PHASE_OVER};
        s->ended[to] = s->ended[to] || now || s->state.status;
    }
    s->mpi->send(to, TAG_ASSIGNMENTS, assignments, n * sizeof *assignments);
}

/* Handles one message; false if none has arrived. */
static bool serve_one(server *s)
{
    int from, tag;
    size_t bytes;
    if (!s->mpi->probe(&from, &tag, &bytes)) {
        return false;
    }
    char text[KOKSMA__FAILURE_TEXT] = "";
    switch (tag) {
    case TAG_REQUEST:
        assign(s, from);
        break;
    case TAG_NEED:
        send_pixels(s, from);
        break;
    case TAG_RESULTS:
        receive_results(s, from, bytes);
        break;
    case TAG_ERROR:
        s->mpi->receive(from, TAG_ERROR, text, sizeof text, NULL);
        koksma__run_state_stop(&s->state, (koksma_status)text[0], text + 1);
        s->ended[from] = true;
        break;
    default:
        break;
    }
    return true;
}

static bool all_ended(const server *s)
{
    bool all = true;
    for (int r = 1; r < s->size; r++) {
        all &= s->ended[r];
    }
    return all;
}

/* Handles messages until all results have arrived and all ranks know that the phase is over. */
static void serve(server *s)
{
    for (;;) {
        const bool handled = serve_one(s), over = koksma__run_state_is_over(&s->state);
        if (over && all_ended(s)) {
            return;
        }
        if (!over && !koksma__keep_going(&s->phase->control->run, koksma__run_state_fraction(&s->state))) {
            koksma__run_state_stop(&s->state, KOKSMA_INTERRUPTED, "interrupted");
        }
        if (!handled) {
            koksma__mpi_rest(SERVER_REST_S);
        }
    }
}

/* ---- The whole phase ----------------------------------------------------------------------------------- */

static koksma_status open_server(server *s)
{
    s->requests = calloc((size_t)s->size, sizeof *s->requests);
    s->ended = calloc((size_t)s->size, sizeof *s->ended);
    const koksma_status status = koksma__run_state_open(s->phase, &s->state);
    return s->requests && s->ended ? status : koksma__fail_memory((size_t)s->size);
}

static void close_server(server *s)
{
    koksma__run_state_close(&s->state);
    free(s->requests);
    free(s->ended);
}

koksma_status koksma__mpi_serve(koksma__phase *phase)
{
    koksma__mpi *mpi = koksma__mpi_get();
    server s = {.phase = phase,
                .mpi = mpi->mpi,
                .size = mpi->size,
                .number = phase->tasks->n && phase->tasks->at[0].image,
                .exec_s = koksma__exec_seconds()};
    pthread_t helper;
    koksma_status status = open_server(&s);
    if (status && !(s.requests && s.ended)) {
        close_server(&s);
        return status;
    }
    if (status) {
        koksma__run_state_stop(&s.state, status, koksma_error_text());
    }
    const bool helped = !pthread_create(&helper, NULL, work_here, &s);
    serve(&s);
    if (helped) {
        pthread_join(helper, NULL);
    }
    for (int r = 1; r < s.size; r++) {
        atomic_fetch_add(&phase->busy_ns, (unsigned long long)(1e9 * s.requests[r].busy_s));
        phase->others_s += s.requests[r].processor_s;
    }
    mpi->released = s.state.status || phase->last;
    status = koksma__run_state_status(&s.state);
    close_server(&s);
    return status;
}

/* ---- The other ranks -------------------------------------------------------------------------------------------- */

/* The same of the other ranks. */
static const double REST_S = 2e-4;

typedef struct worker {
    const koksma__transport *mpi;
    int rank;
    koksma_study *study;
    const koksma_run *job;
    koksma__tasks tasks;
    koksma__outcomes out;   /* outcomes that are sent to rank 0 together */
    double since_s;         /* when the first of them began */
    double busy_s, began_s; /* began_s: processor time at the start of the phase */
} worker;

static koksma_status lost(const worker *w)
{
    return koksma__fail(KOKSMA_IO, "rank %d has lost rank 0", w->rank);
}

/* Waits for a message from rank 0, sleeping between polls so that the processor is free. */
static bool receive(const worker *w, int wanted, void *bytes, size_t room, size_t *size)
{
    int from, tag;
    size_t coming;
    while (!w->mpi->probe(&from, &tag, &coming)) {
        koksma__mpi_rest(REST_S);
    }
    return w->mpi->receive(0, wanted, bytes, room, size);
}

static koksma_status get_reference(worker *w, size_t index)
{
    koksma__reference_image *r = &w->study->references[index];
    const unsigned long long number = index;
    image_head head;
    if (r->image.pixels) {
        return KOKSMA_OK;
    }
    if (!w->mpi->send(0, TAG_NEED, &number, sizeof number) || !receive(w, TAG_PIXELS, &head, sizeof head, NULL)) {
        return lost(w);
    }
    KOKSMA__TRY(koksma_image_init(&r->image, head.width, head.height, head.channels));
    const size_t pixels = (size_t)head.width * (size_t)head.height * (size_t)head.channels;
    return receive(w, TAG_PIXELS, r->image.pixels, pixels * sizeof *r->image.pixels, NULL) ? KOKSMA_OK : lost(w);
}

static koksma_status send_results(worker *w)
{
    if (w->out.size && !w->mpi->send(0, TAG_RESULTS, w->out.bytes, w->out.size)) {
        return lost(w);
    }
    w->out.size = 0;
    return KOKSMA_OK;
}

/* Does a job or tile. What comes of it is sent at once if the first unsent one began some time ago. */
static koksma_status do_assignment(worker *w, const koksma__assignment *assignment)
{
    long long trial;
    koksma_status status = KOKSMA_OK;
    if (assignment->kind == KOKSMA__ASSIGN_JOB) {
        const koksma__task *task = koksma__tasks_job(&w->tasks, assignment->number, &trial);
        for (size_t r = 0; task->image && !status && r < task->n_series; r++) {
            status = get_reference(w, task->references[r]);
        }
    }
    const double start_s = koksma__now_s();
    w->since_s = w->out.size ? w->since_s : start_s;
    status = status ? status : koksma__do_assignment(&w->tasks, assignment, w->job, &w->out);
    w->busy_s += koksma__now_s() - start_s;
    return status || koksma__now_s() - w->since_s < SEND_S ? status : send_results(w);
}

/* Does the assignments. Sets *over if no work is left in this phase, and *run_over if none is left in the run. */
static koksma_status do_batch(worker *w, const koksma__assignment *assignments, size_t n, bool *over, bool *run_over)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status && !*over; i++) {
        *run_over = assignments[i].kind == KOKSMA__RUN_OVER;
        *over = *run_over || assignments[i].kind == KOKSMA__PHASE_OVER;
        if (!*over) {
            status = do_assignment(w, &assignments[i]);
        }
    }
    return status ? status : send_results(w);
}

static koksma_status ask(const worker *w, int phase, double job_s)
{
    const request next = {phase, job_s, w->busy_s, koksma__processor_s() - w->began_s};
    return w->mpi->send(0, TAG_REQUEST, &next, sizeof next) ? KOKSMA_OK : lost(w);
}

/* Requests and does assignments until the phase is over. */
static koksma_status work_phase(worker *w, int phase, bool *run_over)
{
    koksma_status status = koksma__tasks_open(w->study, phase == 1, &w->tasks);
    bool over = status || !koksma__tasks_have_work(&w->tasks, phase == 1);
    double job_s = 0;
    w->busy_s = 0;
    w->began_s = koksma__processor_s();
    status = over ? status : ask(w, phase, job_s);
    while (!over && !status) {
        koksma__assignment assignments[KOKSMA__MAX_BATCH];
        size_t got;
        if (!receive(w, TAG_ASSIGNMENTS, assignments, sizeof assignments, &got)) {
            status = lost(w);
            break;
        }
        const size_t n = got / sizeof *assignments;
        const double busy_s = w->busy_s;
        const bool ahead = n && assignments[0].kind <= KOKSMA__ASSIGN_TILE;
        status = ahead ? ask(w, phase, job_s) : KOKSMA_OK;
        status = status ? status : do_batch(w, assignments, n, &over, run_over);
        if (ahead && assignments[n - 1].kind == KOKSMA__ASSIGN_JOB) {
            job_s = (w->busy_s - busy_s) / (double)n;
        }
        if (n == 0 && !status) {
            koksma__mpi_rest(REST_S);
            status = ask(w, phase, job_s);
        }
    }
    koksma__tasks_close(&w->tasks);
    return status;
}

koksma_status koksma__mpi_work(koksma_study *study, const koksma_run *job)
{
    const koksma__mpi *mpi = koksma__mpi_get();
    worker w = {.mpi = mpi->mpi, .rank = mpi->rank, .study = study, .job = job};
    koksma_status status = KOKSMA_OK;
    KOKSMA__FAIL_IF(mpi->size < 2, KOKSMA_ARGUMENT, "a study that was opened without a folder can't be run");
    bool over = false;
    for (int phase = 0; !status && !over && phase < PHASES; phase++) {
        status = work_phase(&w, phase, &over);
    }
    free(w.out.bytes);
    if (status) { /* rank 0 reports the error and ends the other ranks */
        char text[KOKSMA__FAILURE_TEXT];
        text[0] = (char)status;
        snprintf(text + 1, sizeof text - 1, "%s", koksma_error_text());
        w.mpi->send(0, TAG_ERROR, text, sizeof text);
    }
    return status;
}
