/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rank 0 of an MPI run: it exchanges messages with the other ranks and works on a second thread. A batch counts as
 * assigned until its results arrive. When nothing else is left to do, rank 0 also does jobs that are still assigned:
 * if a rank is lost and MPI lets the others continue, only the work on its batch is repeated. If MPI ends all ranks,
 * the run ends, and the same command continues it from the store.
 */
#include "study/run/run.h"

#include <stdlib.h>

#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"

/* Pause between two polls for messages. Ranks may wait this long for an answer, because they request a batch while
   they still work on another. */
static const double REST_S = 1e-3;
/* How long rank 0 waits at the end of a phase for ranks that send nothing. */
static const double GOODBYE_S = 30;

typedef struct server {
    koksma__phase *phase;
    const koksma__transport *mpi;
    int size, number; /* number of ranks; number of the phase (KOKSMA__PHASES) */
    koksma__run_state state;
    double exec_s; /* the caller's time limit for programs (koksma_allow_exec) */
    /* The next two fields are used by the serving thread only. */
    koksma__request *requests; /* the most recent request of each rank */
    bool *ended;               /* whether each rank knows that the phase is over */
} server;

/* The body of the thread that does assignments on rank 0. */
static void *work_here(void *context)
{
    server *s = context;
    koksma_allow_exec(s->exec_s);
    koksma__work(&s->state, true);
    return NULL;
}

/* ---- Messages ------------------------------------------------------------------------------------------ */

static void send_pixels(server *s, int to)
{
    unsigned long long index;
    if (!s->mpi->receive(to, KOKSMA__TAG_NEED, &index, sizeof index, NULL) ||
        index >= s->phase->tasks->study->n_references) {
        return;
    }
    const koksma__reference_image *reference = &s->phase->tasks->study->references[index];
    const koksma_image *image = &reference->image;
    const koksma__image_head head = {image->width, image->height, image->channels};
    const size_t pixels = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    s->mpi->send(to, KOKSMA__TAG_PIXELS, &head, sizeof head);
    s->mpi->send(to, KOKSMA__TAG_PIXELS, image->pixels, pixels * sizeof *image->pixels);
}

static void receive_results(server *s, int from, size_t bytes)
{
    const koksma__outcomes outcomes = {.bytes = malloc(bytes ? bytes : 1), .size = bytes};
    if (!outcomes.bytes) {
        koksma__run_state_stop(&s->state, KOKSMA_MEMORY, "out of memory for a message");
    } else if (s->mpi->receive(from, KOKSMA__TAG_RESULTS, outcomes.bytes, bytes, NULL)) {
        koksma__run_state_put(&s->state, &outcomes);
    }
    free(outcomes.bytes);
}

/* Answers a rank's request for jobs; the answer is empty when no job is ready. */
static void assign(server *s, int to)
{
    koksma__request request;
    koksma__assignment assignments[KOKSMA__MAX_BATCH];
    size_t n = 0;
    s->mpi->receive(to, KOKSMA__TAG_REQUEST, &request, sizeof request, NULL);
    const bool now = (int)request.phase == s->number;
    if (now) {
        s->requests[to] = request;
        n = koksma__run_state_take_batch(&s->state, request.job_s, s->size, assignments);
    }
    if (n == 0 && (koksma__run_state_is_over(&s->state) ? (int)request.phase <= s->number || s->state.status
                                                        : (int)request.phase < s->number)) {
        assignments[n++] = (koksma__assignment){.kind = s->state.status ? KOKSMA__RUN_OVER : KOKSMA__PHASE_OVER};
        s->ended[to] = s->ended[to] || now || s->state.status;
    }
    s->mpi->send(to, KOKSMA__TAG_ASSIGNMENTS, assignments, n * sizeof *assignments);
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
    case KOKSMA__TAG_REQUEST:
        assign(s, from);
        break;
    case KOKSMA__TAG_NEED:
        send_pixels(s, from);
        break;
    case KOKSMA__TAG_RESULTS:
        receive_results(s, from, bytes);
        break;
    case KOKSMA__TAG_ERROR:
        s->mpi->receive(from, KOKSMA__TAG_ERROR, text, sizeof text, NULL);
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

/* Handles messages until all results have arrived and all ranks know that the phase is over. At the end, a rank that
   sends nothing for GOODBYE_S counts as lost. */
static void serve(server *s)
{
    double over_s = 0;
    for (;;) {
        const bool handled = serve_one(s), over = koksma__run_state_is_over(&s->state);
        over_s = !over ? 0 : over_s > 0 ? over_s : koksma__now_s();
        if (over && (all_ended(s) || koksma__now_s() - over_s > GOODBYE_S)) {
            return;
        }
        if (!over && !koksma__keep_going(&s->phase->control->run, koksma__run_state_fraction(&s->state))) {
            koksma__run_state_stop(&s->state, KOKSMA_INTERRUPTED, "interrupted");
        }
        if (!handled) {
            koksma__mpi_rest(REST_S);
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
