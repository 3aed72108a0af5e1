/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Owen's nested uniform scrambling (1995) of point sets that combine the coordinate i/n with digital sequences.
 *
 * With n = 2^m, i/n is the radical inverse of i with its m binary digits reversed: the coordinate is the scrambled
 * van der Corput sequence, made by stochastic generation (shared/grow.h), in bit-reversed order. This coordinate uses
 * random words of another purpose than the other coordinates, so that it is independent of them.
 */
#include "patterns/nets/nets.h"

#include <koksma/sampler.h>

#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "patterns/grids/grids.h"

static koksma_status fill_net(uint64_t seed, const koksma_run *run, int m, uint32_t *v, koksma_points *out)
{
    /* The partner of a point is the earlier point in its stratum (shared/grow.h). The matrix of van der Corput's
       sequence is the identity, which makes all partners 0: point 2^l + i joins point i. */
    static const uint32_t partners[32] = {0};
    const koksma_status status = koksma__grow_column(seed, KOKSMA__PURPOSE_POINT, partners, run, out->n, v);
    for (size_t i = 0; i < out->n && !status; i++) {
        const uint32_t mirrored = m ? koksma_mirror((uint32_t)i) >> (32 - m) : 0;
        out->xs[i * (size_t)out->dim] = v[mirrored] * 0x1p-32;
    }
    return status;
}

koksma_status koksma__owen_equidistant(uint64_t seed, const koksma_run *run, koksma_points *out)
{
    const size_t n = out->n;
    const int m = koksma__levels_of(n);
    void *memory = malloc(n * sizeof(double));
    KOKSMA__REQUIRE_MEMORY(memory, n * sizeof(double));
    koksma_status status;
    if ((size_t)1 << m == n) {
        status = fill_net(seed, run, m, memory, out);
    } else {
        double *u = memory;
        status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, run, n, u);
        for (size_t i = 0; i < n && !status; i++) {
            out->xs[i * (size_t)out->dim] = koksma__in_cell((double)i, u[i], (double)n);
        }
    }
    free(memory);
    return status;
}

koksma_status koksma__owen_hammersley(uint64_t seed, const koksma_run *run, koksma_points *out)
{
    koksma_status status = koksma__owen_equidistant(seed, run, out);
    if (status || out->dim == 1) {
        return status;
    }
    const size_t rest = (size_t)out->dim - 1;
    koksma_points others;
    status = koksma_points_init(&others, out->n, out->dim - 1);
    status = status ? status : koksma__owen_digits(seed, run, &others);
    for (size_t i = 0; i < out->n && !status; i++) {
        memcpy(out->xs + i * (rest + 1) + 1, others.xs + i * rest, rest * sizeof *others.xs);
    }
    koksma_points_fini(&others);
    return status;
}
