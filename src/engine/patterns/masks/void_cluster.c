/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Void and cluster (Ulichney 1993): the energy of a pixel is the sum of Gaussians (standard deviation 1.5 pixels, on
 * the torus, cut off at 9 pixels along each axis) about the pixels that are set. A tenth of the pixels is set at
 * random; then the pixel in the tightest cluster is moved to the largest void, until this changes nothing. Removing
 * the pixel in the tightest cluster again and again gives the ranks of these pixels; filling the largest void again
 * and again gives the other ranks. On the torus the largest void of the set pixels is the tightest cluster of the
 * unset pixels.
 *
 * A change of one pixel changes the energies of up to 19 x 19 pixels around it. The largest void and the tightest
 * cluster are the roots of two pyramids: a node of level 1 has the best of 2 x 2 pixels, a node of level l + 1 the
 * best of 2 x 2 nodes of level l. A change updates 100 nodes of level 1, 36 of level 2, and so on, a bounded number
 * for each level, so that a mask takes O(size^2 log(size)) time. Energies are sums of doubles in a fixed order, and
 * ties go to the pixel with the lowest index: the ranks do not depend on the instruction set.
 */
#include <koksma/mask.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { REACH = 9, LEVELS = 12 }; /* REACH is six standard deviations; 2^LEVELS >= KOKSMA_MASK_MAX */
enum { VOIDS, CLUSTERS };

typedef struct best {
    double merit; /* the energy of the pixel (CLUSTERS) or minus its energy (VOIDS); -INFINITY if there is no pixel */
    size_t at;
} best;

typedef struct mask {
    int size, levels;
    size_t n;
    double *energy;
    bool *set;
    best *pyramids[2][LEVELS + 1]; /* pyramids of unset pixels (VOIDS) and set pixels (CLUSTERS); level 0, the pixels
                                      themselves, is not stored */
    bool maintained[2];
    double gauss[2 * REACH + 1][2 * REACH + 1];
} mask;

static int width_of(const mask *m, int level)
{
    return (m->size + (1 << level) - 1) >> level;
}

static best better(best a, best b)
{
    return b.merit > a.merit || (b.merit == a.merit && b.at < a.at) ? b : a;
}

static best pixel(const mask *m, int kind, size_t at)
{
    best one = {kind == CLUSTERS ? m->energy[at] : -m->energy[at], at};
    if (m->set[at] != (kind == CLUSTERS)) {
        one.merit = -INFINITY;
    }
    return one;
}

/* Updates node (x, y) of a level from its four children, or fewer at the right and lower sides. */
static void renew_node(mask *m, int kind, int level, int x, int y)
{
    const int below = width_of(m, level - 1), right = 2 * x + 1 < below, down = 2 * y + 1 < below;
    const size_t first = (size_t)(2 * y) * (size_t)below + (size_t)(2 * x);
    best found = {-INFINITY, SIZE_MAX};
    for (int i = 0; i < 4; i++) {
        if ((i & 1) <= right && i >> 1 <= down) {
            const size_t at = first + (size_t)(i >> 1) * (size_t)below + (size_t)(i & 1);
            found = better(found, level == 1 ? pixel(m, kind, at) : m->pyramids[kind][level - 1][at]);
        }
    }
    m->pyramids[kind][level][(size_t)y * (size_t)width_of(m, level) + (size_t)x] = found;
}

/* Updates the nodes above the pixels of columns x[0] to x[1] and rows y[0] to y[1]. */
static void renew(mask *m, const int x[2], const int y[2])
{
    for (int kind = VOIDS; kind <= CLUSTERS; kind++) {
        for (int level = 1; m->maintained[kind] && level <= m->levels; level++) {
            for (int v = y[0] >> level; v <= y[1] >> level; v++) {
                for (int u = x[0] >> level; u <= x[1] >> level; u++) {
                    renew_node(m, kind, level, u, v);
                }
            }
        }
    }
}

/* Cuts the range from .. to of a ring of `size` pixels into one part, or into two parts if it wraps around. */
static int unwrap(int from, int to, int size, int parts[2][2])
{
    if (from >= 0 && to < size) {
        parts[0][0] = from;
        parts[0][1] = to;
        return 1;
    }
    parts[0][0] = 0;
    parts[0][1] = to < size ? to : to - size;
    parts[1][0] = from < 0 ? from + size : from;
    parts[1][1] = size - 1;
    return 2;
}

static void change(mask *m, size_t at, bool on)
{
    /* On a small torus each pixel is visited only once, at its shortest distance. */
    const int size = m->size, after = size / 2 < REACH ? size / 2 : REACH;
    const int before = (size - 1) / 2 < REACH ? (size - 1) / 2 : REACH;
    const int x = (int)(at % (size_t)size), y = (int)(at / (size_t)size);
    const double sign = on ? 1 : -1;
    m->set[at] = on;
    for (int v = -before; v <= after; v++) {
        double *row = m->energy + (size_t)((y + v + size) % size) * (size_t)size;
        for (int u = -before; u <= after; u++) {
            row[(x + u + size) % size] += sign * m->gauss[v + REACH][u + REACH];
        }
    }
    int columns[2][2], rows[2][2];
    const int across = unwrap(x - before, x + after, size, columns), down = unwrap(y - before, y + after, size, rows);
    for (int i = 0; i < across * down; i++) {
        renew(m, columns[i % across], rows[i / across]);
    }
}

/* Computes the pyramid of one kind. After this call a change of a pixel updates only this pyramid. */
static void maintain_only(mask *m, int kind)
{
    const int all[2] = {0, m->size - 1};
    m->maintained[1 - kind] = false;
    m->maintained[kind] = true;
    renew(m, all, all);
}

static size_t extreme(const mask *m, int kind)
{
    return m->pyramids[kind][m->levels][0].at;
}

static koksma_status begin(mask *m, uint64_t seed, const koksma_run *run, size_t *count)
{
    const int all[2] = {0, m->size - 1};
    *count = m->n / 10 ? m->n / 10 : 1;
    for (size_t placed = 0, i = 0; placed < *count; i++) {
        const size_t at = koksma__below(koksma__random(seed, KOKSMA__PURPOSE_DART, i, 0).w[0], (uint32_t)m->n);
        if (!m->set[at]) {
            change(m, at, true);
            placed++;
        }
    }
    m->maintained[VOIDS] = m->maintained[CLUSTERS] = true;
    renew(m, all, all);
    for (size_t step = 0; step < 16 * m->n; step++) {
        const size_t cluster = extreme(m, CLUSTERS);
        change(m, cluster, false);
        const size_t hole = extreme(m, VOIDS);
        change(m, hole, true);
        if (hole == cluster) {
            break;
        }
        if (step % 256 == 255 && !koksma__keep_going(run, 0)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

/* Computes the ranks of the `count` pixels that are set, by removing them one by one; then sets these pixels again. */
static void rank_first(mask *m, size_t count, uint32_t *ranks)
{
    for (size_t i = 0; i < m->n; i++) {
        ranks[i] = UINT32_MAX;
    }
    maintain_only(m, CLUSTERS);
    for (size_t left = count; left > 0; left--) {
        const size_t at = extreme(m, CLUSTERS);
        change(m, at, false);
        ranks[at] = (uint32_t)left - 1;
    }
    memset(m->energy, 0, m->n * sizeof *m->energy);
    m->maintained[CLUSTERS] = false;
    for (size_t i = 0; i < m->n; i++) {
        if (ranks[i] < count) {
            change(m, i, true);
        }
    }
}

static koksma_status fill_voids(mask *m, size_t count, const koksma_run *run, uint32_t *ranks)
{
    maintain_only(m, VOIDS);
    for (; count < m->n; count++) {
        const size_t at = extreme(m, VOIDS);
        change(m, at, true);
        ranks[at] = (uint32_t)count;
        if (count % 256 == 0 && !koksma__keep_going(run, (double)count / (double)m->n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

/* Allocates all memory of the mask as one block, which begins with m->energy. */
static koksma_status make_room(mask *m)
{
    size_t nodes = 0;
    for (m->levels = 0; width_of(m, m->levels) > 1; m->levels++) {
        const size_t width = (size_t)width_of(m, m->levels + 1);
        nodes += width * width;
    }
    const size_t bytes = m->n * (sizeof *m->energy + sizeof *m->set) + 2 * nodes * sizeof(best);
    m->energy = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(m->energy, bytes);
    best *node = (best *)(m->energy + m->n);
    for (int kind = VOIDS; kind <= CLUSTERS; kind++) {
        for (int level = 1; level <= m->levels; level++) {
            m->pyramids[kind][level] = node;
            node += (size_t)width_of(m, level) * (size_t)width_of(m, level);
        }
    }
    m->set = (bool *)node;
    return KOKSMA_OK;
}

koksma_status koksma_mask_void_and_cluster(int size, uint64_t seed, const koksma_run *run, uint32_t *ranks)
{
    KOKSMA__REQUIRE(ranks);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(size < KOKSMA_MASK_MIN || size > KOKSMA_MASK_MAX, KOKSMA_ARGUMENT,
                    "void-and-cluster: a mask of size %d; sizes are %d to %d", size, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX);
    mask m = {.size = size, .n = (size_t)size * (size_t)size};
    KOKSMA__TRY(make_room(&m));
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            m.gauss[v + REACH][u + REACH] = koksma__exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
        }
    }
    size_t count;
    koksma_status status = begin(&m, seed, run, &count);
    if (!status) {
        rank_first(&m, count, ranks);
        status = fill_voids(&m, count, run, ranks);
    }
    free(m.energy);
    return status;
}
