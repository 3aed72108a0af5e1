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
 * cluster are the roots of two trees: a node of level 1 has the best of 8 x 8 pixels, a node of level l + 1 the best of
 * 8 x 8 nodes of level l. A change updates at most 16 nodes of level 1, and 4 of each other level, so that a mask takes
 * O(size^2 log(size)) time. Energies are sums of doubles in a fixed order, and ties go to the pixel with the lowest
 * index: the ranks do not depend on the instruction set.
 */
#include <koksma/mask.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { REACH = 9, LEVELS = 4 }; /* REACH is six standard deviations; FAN^LEVELS >= KOKSMA_MASK_MAX */
enum { FAN = 8, FAN_BITS = 3 }; /* a node has FAN x FAN children */
enum { VOIDS, CLUSTERS };

/* The best pixel of a kind is the one with the least value: the energy of an unset pixel (VOIDS), minus the energy of a set
   one (CLUSTERS), INFINITY of other pixels, which no change of energies alters. */
typedef struct mask {
    int size, levels;
    size_t n;
    double *trees[2][LEVELS + 1]; /* level 0: the pixels */
    bool maintained[2];
    double gauss[2 * REACH + 1][2 * REACH + 1];
} mask;

static int width_of(const mask *m, int level)
{
    return (m->size + (1 << FAN_BITS * level) - 1) >> FAN_BITS * level;
}

/* The children of node (x, y) of a level: the first, and the numbers of columns and rows, which are less than FAN at the
   right and lower sides. */
static size_t children_of(const mask *m, int level, int x, int y, int *columns, int *rows)
{
    const int below = width_of(m, level - 1);
    *columns = below - FAN * x < FAN ? below - FAN * x : FAN;
    *rows = below - FAN * y < FAN ? below - FAN * y : FAN;
    return (size_t)(FAN * y) * (size_t)below + (size_t)(FAN * x);
}

static void renew_node(mask *m, int kind, int level, int x, int y)
{
    int columns, rows;
    const double *row = m->trees[kind][level - 1] + children_of(m, level, x, y, &columns, &rows);
    double least[FAN];
    for (int c = 0; c < FAN; c++) {
        least[c] = INFINITY;
    }
    for (int r = 0; r < rows; r++, row += width_of(m, level - 1)) {
        if (columns == FAN) { /* in lanes */
            for (int c = 0; c < FAN; c++) {
                least[c] = row[c] < least[c] ? row[c] : least[c];
            }
        } else {
            for (int c = 0; c < columns; c++) {
                least[c] = row[c] < least[c] ? row[c] : least[c];
            }
        }
    }
    for (int c = 1; c < FAN; c++) {
        least[0] = least[c] < least[0] ? least[c] : least[0];
    }
    m->trees[kind][level][(size_t)y * (size_t)width_of(m, level) + (size_t)x] = least[0];
}

/* Updates the nodes above the pixels of columns x[0] to x[1] and rows y[0] to y[1]. */
static void renew(mask *m, int kind, const int x[2], const int y[2])
{
    for (int level = 1; level <= m->levels; level++) {
        for (int v = y[0] >> FAN_BITS * level; v <= y[1] >> FAN_BITS * level; v++) {
            for (int u = x[0] >> FAN_BITS * level; u <= x[1] >> FAN_BITS * level; u++) {
                renew_node(m, kind, level, u, v);
            }
        }
    }
}

/* The first pixel below node (x, y) of a level that has the value of the root. */
static size_t first_best(const mask *m, int kind, int level, int x, int y)
{
    if (!level) {
        return (size_t)y * (size_t)m->size + (size_t)x;
    }
    int columns, rows;
    size_t best = SIZE_MAX;
    const double *row = m->trees[kind][level - 1] + children_of(m, level, x, y, &columns, &rows);
    for (int r = 0; r < rows; r++, row += width_of(m, level - 1)) {
        for (int c = 0; c < columns; c++) {
            if (row[c] == *m->trees[kind][m->levels]) {
                const size_t at = first_best(m, kind, level - 1, FAN * x + c, FAN * y + r);
                best = at < best ? at : best;
            }
        }
    }
    return best;
}

static size_t extreme(const mask *m, int kind)
{
    return first_best(m, kind, m->levels, 0, 0);
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

/* Adds a set pixel's Gaussian to the energies in columns x[0] to x[1] and rows y[0] to y[1], times sign. */
static void add_gauss(mask *m, int kind, size_t at, double sign, const int x[2], const int y[2], int reach)
{
    const int size = m->size, width = x[1] - x[0] + 1, x0 = (int)(at % (size_t)size), y0 = (int)(at / (size_t)size);
    const int u = x[0] - x0 > reach ? x[0] - x0 - size : x[0] - x0 < -reach ? x[0] - x0 + size : x[0] - x0;
    for (int j = y[0]; j <= y[1]; j++) {
        const int v = j - y0 > reach ? j - y0 - size : j - y0 < -reach ? j - y0 + size : j - y0;
        const double *gauss = m->gauss[v + REACH] + u + REACH;
        double *row = m->trees[kind][0] + (size_t)j * (size_t)size + (size_t)x[0];
        for (int i = 0; i < width; i++) {
            row[i] += sign * gauss[i];
        }
    }
}

/* Sets or unsets a pixel, in the trees that are maintained; their nodes, too, if `nodes`. */
static void change(mask *m, size_t at, bool on, bool nodes)
{
    /* On a small torus each pixel is visited only once, at its shortest distance. */
    const int size = m->size, after = size / 2 < REACH ? size / 2 : REACH;
    const int before = (size - 1) / 2 < REACH ? (size - 1) / 2 : REACH;
    const int x = (int)(at % (size_t)size), y = (int)(at / (size_t)size);
    double *of[2] = {m->trees[VOIDS][0] + at, m->trees[CLUSTERS][0] + at};
    const double energy = on ? *of[VOIDS] : -*of[CLUSTERS];
    int columns[2][2], rows[2][2];
    const int across = unwrap(x - before, x + after, size, columns), down = unwrap(y - before, y + after, size, rows);
    *of[VOIDS] = on ? INFINITY : energy;
    *of[CLUSTERS] = on ? -energy : INFINITY;
    for (int kind = VOIDS; kind <= CLUSTERS; kind++) {
        for (int i = 0; m->maintained[kind] && i < across * down; i++) {
            add_gauss(m, kind, at, on == (kind == VOIDS) ? 1 : -1, columns[i % across], rows[i / across], after);
        }
        for (int i = 0; m->maintained[kind] && nodes && i < across * down; i++) {
            renew(m, kind, columns[i % across], rows[i / across]);
        }
    }
}

/* Computes the tree of one kind. After this call a change of a pixel updates only this tree. */
static void maintain_only(mask *m, int kind)
{
    const int all[2] = {0, m->size - 1};
    m->maintained[1 - kind] = false;
    m->maintained[kind] = true;
    renew(m, kind, all, all);
}

/* Unsets all pixels. */
static void clear(mask *m)
{
    for (size_t i = 0; i < m->n; i++) {
        m->trees[VOIDS][0][i] = 0;
        m->trees[CLUSTERS][0][i] = INFINITY;
    }
}

static koksma_status begin(mask *m, uint64_t seed, const koksma_run *run, size_t *count)
{
    const int all[2] = {0, m->size - 1};
    *count = m->n / 10 ? m->n / 10 : 1;
    clear(m);
    m->maintained[VOIDS] = m->maintained[CLUSTERS] = true;
    for (size_t placed = 0, i = 0; placed < *count; i++) {
        const size_t at = koksma__below(koksma__random(seed, KOKSMA__PURPOSE_DART, i, 0).w[0], (uint32_t)m->n);
        if (m->trees[CLUSTERS][0][at] == INFINITY) {
            change(m, at, true, false);
            placed++;
        }
    }
    renew(m, VOIDS, all, all);
    renew(m, CLUSTERS, all, all);
    for (size_t step = 0; step < 16 * m->n; step++) {
        const size_t cluster = extreme(m, CLUSTERS);
        change(m, cluster, false, true);
        const size_t hole = extreme(m, VOIDS);
        change(m, hole, true, true);
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
        change(m, at, false, true);
        ranks[at] = (uint32_t)left - 1;
    }
    clear(m);
    m->maintained[VOIDS] = true;
    m->maintained[CLUSTERS] = false;
    for (size_t i = 0; i < m->n; i++) {
        if (ranks[i] < count) {
            change(m, i, true, false);
        }
    }
}

static koksma_status fill_voids(mask *m, size_t count, const koksma_run *run, uint32_t *ranks)
{
    maintain_only(m, VOIDS);
    for (; count < m->n; count++) {
        const size_t at = extreme(m, VOIDS);
        change(m, at, true, true);
        ranks[at] = (uint32_t)count;
        if (count % 256 == 0 && !koksma__keep_going(run, (double)count / (double)m->n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

/* Allocates all memory of the mask as one block, which begins with the pixels of m->trees[VOIDS]. */
static koksma_status make_room(mask *m)
{
    size_t values = m->n;
    for (m->levels = 0; width_of(m, m->levels) > 1;) {
        const size_t width = (size_t)width_of(m, ++m->levels);
        values += width * width;
    }
    double *at = malloc(2 * values * sizeof *at);
    KOKSMA__REQUIRE_MEMORY(at, 2 * values * sizeof *at);
    for (int i = 0; i <= 2 * m->levels + 1; i++) {
        const size_t width = (size_t)width_of(m, i / 2);
        m->trees[i % 2][i / 2] = at;
        at += width * width;
    }
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
    free(m.trees[VOIDS][0]);
    return status;
}
