/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_sets and koksma_evaluate_sets: many small sets in one call, cut into blocks of sets that run on several
 * threads. Within a set there is one thread. Only the caller's thread may call keep_going; the others learn of its answer
 * from a flag.
 */
#include <koksma/koksma.h>

#include <pthread.h>
#include <stdatomic.h>

#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"

enum { BLOCK_COORDINATES = 1 << 13 };

typedef struct batch {
    const koksma_spec *spec;
    const koksma_run *run; /* the caller's; may be NULL */
    koksma_points set;     /* the first */
    size_t sets, block;    /* block: sets of one block */
    uint64_t seed;
    double *values; /* NULL: the sets are generated */
    pthread_t caller;
    atomic_bool stopped;
    atomic_size_t done;
} batch;

static bool keep_going(void *context, double fraction_done)
{
    batch *b = context;
    (void)fraction_done;
    if (pthread_equal(b->caller, pthread_self()) &&
        !koksma__keep_going(b->run, (double)atomic_load(&b->done) / (double)b->sets)) {
        atomic_store(&b->stopped, true);
    }
    return !atomic_load_explicit(&b->stopped, memory_order_relaxed);
}

static koksma_status do_block(void *context, size_t block)
{
    batch *b = context;
    const koksma_run run = {1, b->run ? b->run->time_limit_s : 0, b->run && b->run->keep_going ? keep_going : NULL,
                            b};
    const size_t end = (block + 1) * b->block < b->sets ? (block + 1) * b->block : b->sets;
    koksma_points set = b->set;
    set.xs += block * b->block * set.n * (size_t)set.dim;
    for (size_t s = block * b->block; s < end; s++, set.xs += set.n * (size_t)set.dim) {
        if (b->values) {
            koksma_value value;
            KOKSMA__TRY(koksma_evaluate(b->spec, &set, &run, &value));
            b->values[s] = value.value;
        } else {
            KOKSMA__TRY(koksma_generate(b->spec, b->seed + s, &run, &set));
        }
    }
    atomic_fetch_add(&b->done, end - block * b->block);
    return KOKSMA_OK;
}

/* Divides points into sets and runs do_block. */
static koksma_status do_all(const char *caller, batch *b, const koksma_points *all, bool one_thread)
{
    KOKSMA__FAIL_IF(all->dim < 1, KOKSMA_DIM, "%s: points of %d dimensions", caller, all->dim);
    KOKSMA__FAIL_IF(!all->xs || all->n == 0 || b->sets == 0 || all->n % b->sets, KOKSMA_ARGUMENT,
                    "%s: %zu points are not %zu sets of equal numbers of points", caller, all->n, b->sets);
    b->set = (koksma_points){all->n / b->sets, all->dim, all->xs};
    b->block = 1 + BLOCK_COORDINATES / (b->set.n * (size_t)all->dim);
    b->caller = pthread_self();
    koksma_run run = b->run ? *b->run : (koksma_run){0};
    run.threads = one_thread ? 1 : run.threads;
    return koksma__parallel(&run, (b->sets + b->block - 1) / b->block, do_block, b);
}

koksma_status koksma_generate_sets(const koksma_spec *spec, uint64_t seed, size_t sets, const koksma_run *run,
                                   koksma_points *out)
{
    KOKSMA__REQUIRE(spec, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(sets && seed > UINT64_MAX - (sets - 1), KOKSMA_ARGUMENT,
                    "%s: the seeds of %zu sets from %llu on do not fit in 64 bits", __func__, sets,
                    (unsigned long long)seed);
    batch b = {.spec = spec, .run = run, .sets = sets, .seed = seed};
    return do_all(__func__, &b, out, spec->pattern && spec->pattern->runs_code);
}

koksma_status koksma_evaluate_sets(const koksma_spec *spec, const koksma_points *points, size_t sets,
                                   const koksma_run *run, double *values)
{
    KOKSMA__REQUIRE(spec, points, values);
    KOKSMA__REQUIRE_RUN(run);
    batch b = {.spec = spec, .run = run, .sets = sets, .values = values};
    return do_all(__func__, &b, points, false);
}
