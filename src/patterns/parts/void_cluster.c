/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Void and cluster (Ulichney 1993): the energy of a pixel is the sum of Gaussians (standard deviation 1.5 pixels, on
 * the torus) about the pixels that are set. A tenth of the pixels is set at random, and the tightest cluster is moved
 * to the largest void until that changes nothing. The ranks of those pixels are found by taking out tightest
 * clusters, the other ranks by filling largest voids. On the torus, filling voids and taking clusters out of the rest
 * are the same.
 */
#include <koksma/mask.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { REACH = 9 }; /* six standard deviations */

typedef struct mask {
    int size;
    size_t n;
    double *energy;
    bool *set;
    double gauss[2 * REACH + 1][2 * REACH + 1];
} mask;

static void change(mask *m, size_t at, bool on)
{
    const int size = m->size, reach = size < 2 * REACH + 1 ? (size - 1) / 2 : REACH;
    const int x = (int)at % size, y = (int)at / size;
    const double sign = on ? 1 : -1;
    m->set[at] = on;
    for (int v = -reach; v <= reach; v++) {
        double *row = m->energy + (size_t)((y + v + size) % size) * (size_t)size;
        for (int u = -reach; u <= reach; u++) {
            row[(x + u + size) % size] += sign * m->gauss[v + REACH][u + REACH];
        }
    }
}

/* The set pixel with the most energy, or the other with the least. Ties go to the first. */
static size_t extreme(const mask *m, bool set)
{
    size_t best = 0;
    double value = -INFINITY;
    for (size_t i = 0; i < m->n; i++) {
        const double e = set ? m->energy[i] : -m->energy[i];
        if (m->set[i] == set && e > value) {
            value = e;
            best = i;
        }
    }
    return best;
}

static size_t begin(mask *m, uint64_t seed)
{
    const size_t count = m->n / 10 ? m->n / 10 : 1;
    for (size_t placed = 0, i = 0; placed < count; i++) {
        const size_t at = koksma__below(koksma__random(seed, KOKSMA__PURPOSE_DART, i, 0).w[0], (uint32_t)m->n);
        if (!m->set[at]) {
            change(m, at, true);
            placed++;
        }
    }
    for (size_t step = 0; step < 16 * m->n; step++) {
        const size_t cluster = extreme(m, true);
        change(m, cluster, false);
        const size_t hole = extreme(m, false);
        change(m, hole, true);
        if (hole == cluster) {
            break;
        }
    }
    return count;
}

/* The ranks of the first pixels, taken out one by one, and put back. */
static void rank_first(mask *m, size_t count, uint32_t *ranks)
{
    for (size_t i = 0; i < m->n; i++) {
        ranks[i] = UINT32_MAX;
    }
    for (size_t left = count; left > 0; left--) {
        const size_t at = extreme(m, true);
        change(m, at, false);
        ranks[at] = (uint32_t)left - 1;
    }
    memset(m->energy, 0, m->n * sizeof *m->energy);
    for (size_t i = 0; i < m->n; i++) {
        if (ranks[i] < count) {
            change(m, i, true);
        }
    }
}

static koksma_status fill_voids(mask *m, size_t count, const koksma_run *run, uint32_t *ranks)
{
    for (; count < m->n; count++) {
        const size_t at = extreme(m, false);
        change(m, at, true);
        ranks[at] = (uint32_t)count;
        if (count % 256 == 0 && !koksma__keep_going(run, (double)count / (double)m->n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma_mask_void_and_cluster(int size, uint64_t seed, const koksma_run *run, uint32_t *ranks)
{
    if (size < KOKSMA_MASK_MIN || size > KOKSMA_MASK_MAX) {
        return koksma__fail(KOKSMA_ARGUMENT, "void-and-cluster: a mask of size %d; sizes are %d to %d", size,
                            KOKSMA_MASK_MIN, KOKSMA_MASK_MAX);
    }
    mask m = {.size = size, .n = (size_t)size * (size_t)size};
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            m.gauss[v + REACH][u + REACH] = koksma__exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
        }
    }
    m.energy = calloc(m.n, sizeof *m.energy);
    m.set = calloc(m.n, sizeof *m.set);
    koksma_status status = m.energy && m.set ? KOKSMA_OK : koksma__fail_memory(m.n * 10);
    if (!status) {
        const size_t count = begin(&m, seed);
        rank_first(&m, count, ranks);
        status = fill_voids(&m, count, run, ranks);
    }
    free(m.set);
    free(m.energy);
    return status;
}
