/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs a job of numbered blocks on several threads: each thread takes the next number from an atomic counter, so that
 * the assignment of blocks to threads differs from run to run, and results must not depend on it. New threads are
 * made for each job, and the caller's thread takes blocks, too. The first failure stops the job, and its error text
 * is copied to the caller's thread.
 *
 * The permission to run external code is one number per thread, which a thread passes to those that it starts. Only the
 * caller of the library can give this permission; no spec, plan, scene or store can contain it.
 */
#include "core/parallel.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "core/platform/system.h"
#include "core/status.h"

enum { MAX_THREADS = 256, LOOK_EVERY = 1 << 12, MOST_EXEC_SECONDS = 86400 };

typedef struct pool {
    koksma__block_function f;
    void *context;
    size_t n_blocks;
    atomic_size_t next;
    atomic_size_t done;
    atomic_int status;
    pthread_mutex_t lock; /* guards the members below */
    pthread_cond_t ended; /* a helper has */
    int running;          /* helpers */
    double exec_s;        /* the caller's permission to run programs */
    char text[512];
} pool;

static _Thread_local double allowed_s;

double koksma_allow_exec(double seconds)
{
    const double before = allowed_s;
    allowed_s = !(seconds > 0) ? 0 : seconds < MOST_EXEC_SECONDS ? seconds : MOST_EXEC_SECONDS;
    return before;
}

double koksma__exec_seconds(void)
{
    return allowed_s;
}

int koksma__threads(const koksma_run *run)
{
    if (run && run->threads > 0) {
        return run->threads < MAX_THREADS ? run->threads : MAX_THREADS;
    }
    /* asked once: the C library reads a file of /sys for it, which takes longer than measuring a set of 16 points */
    static atomic_int known;
    int processors = atomic_load_explicit(&known, memory_order_relaxed);
    if (!processors) {
        const int online = koksma__processors();
        processors = online < MAX_THREADS ? online : MAX_THREADS;
        atomic_store_explicit(&known, processors, memory_order_relaxed);
    }
    return processors;
}

bool koksma__keep_going(const koksma_run *run, double fraction_done)
{
    return !run || !run->keep_going || run->keep_going(run->context, fraction_done);
}

koksma_status koksma__look(const koksma_run *run, size_t step, double fraction_done)
{
    return step % LOOK_EVERY < LOOK_EVERY - 1 || koksma__keep_going(run, fraction_done) ? KOKSMA_OK
                                                                                        : koksma__fail_interrupted();
}

koksma_status koksma__ask(const koksma_run *run)
{
    return koksma__keep_going(run, 0) ? KOKSMA_OK : koksma__fail_interrupted();
}

static bool keep_going_in_phase(void *context, double fraction)
{
    koksma__phases *phases = context;
    const double now = phases->begin + phases->share * fmin(fraction, 1);
    phases->reached = fmax(phases->reached, now);
    return koksma__keep_going(phases->run, phases->reached);
}

koksma_run koksma__phase_run(koksma__phases *phases, const koksma_run *run, double share)
{
    koksma_run phase = run ? *run : (koksma_run){0};
    phases->run = run;
    phases->begin += phases->share;
    phases->share = share;
    phase.keep_going = keep_going_in_phase;
    phase.context = phases;
    return phase;
}

/* POSIX's monotonic clock, or the clock that a test has set. */
typedef double (*clock_function)(void);

static _Atomic(clock_function) override;

double koksma__now_s(void)
{
    const clock_function other = atomic_load_explicit(&override, memory_order_relaxed);
    if (other) {
        return other();
    }
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void koksma__set_clock(double (*clock)(void))
{
    atomic_store(&override, clock);
}

bool koksma__paced(void *pacing, double fraction_done)
{
    koksma__pacing *p = pacing;
    const double now_s = koksma__now_s();
    if (p->next_s == 0) {
        p->next_s = now_s + p->interval_s;
    }
    if (!p->stopped && now_s >= p->next_s) {
        p->stopped = !p->keep_going(p->context, fraction_done);
        p->next_s = now_s + p->interval_s;
    }
    return !p->stopped;
}

koksma_status koksma__fail_interrupted(void)
{
    return koksma__fail(KOKSMA_INTERRUPTED, "interrupted");
}

static void stop(pool *p, koksma_status status)
{
    pthread_mutex_lock(&p->lock);
    if (atomic_load(&p->status) == KOKSMA_OK) {
        strncpy(p->text, koksma_error_text(), sizeof p->text - 1);
        atomic_store(&p->status, (int)status);
    }
    pthread_mutex_unlock(&p->lock);
}

static bool work_one(pool *p)
{
    if (atomic_load(&p->status) != KOKSMA_OK) {
        return false;
    }
    const size_t block = atomic_fetch_add(&p->next, 1);
    if (block >= p->n_blocks) {
        return false;
    }
    const koksma_status status = p->f(p->context, block);
    if (status) {
        stop(p, status);
    }
    atomic_fetch_add(&p->done, 1);
    return true;
}

static void *work(void *argument)
{
    pool *p = argument;
    koksma_allow_exec(p->exec_s);
    while (work_one(p)) {
    }
    pthread_mutex_lock(&p->lock);
    p->running--;
    pthread_cond_signal(&p->ended);
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

static void look(pool *p, const koksma_run *run)
{
    if (!koksma__keep_going(run, (double)atomic_load(&p->done) / (double)(p->n_blocks ? p->n_blocks : 1))) {
        koksma__fail_interrupted();
        stop(p, KOKSMA_INTERRUPTED);
    }
}

/* Interval at which the caller calls keep_going while the other threads finish their last blocks, which may take
   long. */
static const long LOOK_NS = 50000000;

static void wait_for_helpers(pool *p, const koksma_run *run)
{
    pthread_mutex_lock(&p->lock);
    while (p->running > 0) {
        struct timespec t;
        clock_gettime(CLOCK_REALTIME, &t);
        t.tv_nsec += LOOK_NS;
        t.tv_sec += t.tv_nsec / 1000000000;
        t.tv_nsec %= 1000000000;
        if (pthread_cond_timedwait(&p->ended, &p->lock, &t)) {
            pthread_mutex_unlock(&p->lock);
            look(p, run);
            pthread_mutex_lock(&p->lock);
        }
    }
    pthread_mutex_unlock(&p->lock);
}

koksma_status koksma__parallel(const koksma_run *run, size_t n_blocks, koksma__block_function f, void *context)
{
    pool p = {.f = f,
              .context = context,
              .n_blocks = n_blocks,
              .exec_s = koksma__exec_seconds(),
              .lock = PTHREAD_MUTEX_INITIALIZER,
              .ended = PTHREAD_COND_INITIALIZER};
    pthread_t helpers[MAX_THREADS];
    int n_helpers = 0;
    size_t wanted = (size_t)koksma__threads(run);
    wanted = wanted < n_blocks ? wanted : n_blocks;
    pthread_mutex_lock(&p.lock); /* the lock is held so that no thread ends before it is counted */
    while ((size_t)n_helpers + 1 < wanted && !pthread_create(&helpers[n_helpers], NULL, work, &p)) {
        n_helpers++; /* if a thread cannot be created, the job only takes longer */
    }
    p.running = n_helpers;
    pthread_mutex_unlock(&p.lock);
    do {
        look(&p, run);
    } while (work_one(&p));
    wait_for_helpers(&p, run);
    for (int i = 0; i < n_helpers; i++) {
        pthread_join(helpers[i], NULL);
    }
    pthread_cond_destroy(&p.ended);
    pthread_mutex_destroy(&p.lock);
    const koksma_status status = (koksma_status)atomic_load(&p.status);
    return status ? koksma__fail(status, "%s", p.text) : KOKSMA_OK;
}
