/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Void and cluster (Ulichney 1993) in space and time: the energy of a voxel is the sum of Gaussians (standard
 * deviation 1.5 voxels along each axis, on the torus, cut off at 4 voxels) about the voxels that are set. The steps
 * are those of void_cluster.c: a tenth of the voxels is set at random, clusters are moved to voids, these voxels are
 * ranked by removing the tightest cluster again and again, and the others by filling the largest void.
 *
 * The largest void and the tightest cluster are found by a tournament over all voxels: node i of a binary tree has
 * the better voxel of nodes 2 i and 2 i + 1. A change of a voxel updates the paths above up to 9^3 voxels around it.
 * Ties go to the voxel with the lowest index.
 */
#include <koksma/mask.h>

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { REACH = 4, SPAN = 2 * REACH + 1 };

typedef struct volume {
    int sides[3]; /* along x, y, time */
    uint32_t n, leaves;
    double *energy;
    uint32_t *winner; /* best voxel of each node, or n if there is none; the leaves are nodes leaves .. 2 leaves - 1
                         */
    bool *set, clusters;
    double gauss[SPAN];
} volume;

/* Returns the better of two voxels: the one with more energy when clusters are searched, with less when voids are
   searched. */
static uint32_t better(const volume *v, uint32_t a, uint32_t b)
{
    if (a == v->n || b == v->n) {
        return a == v->n ? b : a;
    }
    const double difference = v->clusters ? v->energy[b] - v->energy[a] : v->energy[a] - v->energy[b];
    return difference > 0 ? b : a;
}

static void renew_leaf(volume *v, uint32_t at)
{
    v->winner[v->leaves + at] = v->set[at] == v->clusters ? at : v->n;
}

/* Updates all nodes above `count` leaves, level by level. Neighbours in a row share most of their paths, so each
   level has about half the nodes of the level below. `nodes` has the numbers of the leaves and is overwritten. */
static void renew_above(volume *v, uint32_t *nodes, int count)
{
    while (nodes[0] > 1) {
        int parents = 0;
        for (int i = 0; i < count; i++) {
            const uint32_t node = nodes[i] / 2;
            if (!parents || nodes[parents - 1] != node) {
                v->winner[node] = better(v, v->winner[2 * node], v->winner[2 * node + 1]);
                nodes[parents++] = node;
            }
        }
        count = parents;
    }
}

/* Finds the set voxel with the most energy (clusters) or the unset voxel with the least (voids). */
static uint32_t look_for(volume *v, bool clusters)
{
    if (v->clusters != clusters) {
        v->clusters = clusters;
        for (uint32_t i = 0; i < v->leaves; i++) {
            v->winner[v->leaves + i] = v->n;
            if (i < v->n) {
                renew_leaf(v, i);
            }
        }
        for (uint32_t node = v->leaves - 1; node; node--) {
            v->winner[node] = better(v, v->winner[2 * node], v->winner[2 * node + 1]);
        }
    }
    return v->winner[1];
}

/* Lists the coordinates within REACH of c on the torus, each once with its shortest offset; returns how many. */
static int neighbours(int c, int side, int *at, int *offset)
{
    int count = 0;
    for (int d = -REACH; d <= REACH; d++) {
        if (2 * d > -side && 2 * d <= side) {
            at[count] = (c + d + side) % side;
            offset[count++] = d + REACH;
        }
    }
    return count;
}

static void change(volume *v, uint32_t at, bool on)
{
    int places[3][SPAN], offsets[3][SPAN], counts[3];
    uint32_t rest = at, nodes[SPAN * SPAN * SPAN];
    for (int k = 0; k < 3; k++) {
        counts[k] = neighbours((int)(rest % (uint32_t)v->sides[k]), v->sides[k], places[k], offsets[k]);
        rest /= (uint32_t)v->sides[k];
    }
    v->set[at] = on;
    renew_leaf(v, at);
    int count = 0;
    for (int z = 0; z < counts[2]; z++) {
        for (int y = 0; y < counts[1]; y++) {
            const int row = (places[2][z] * v->sides[1] + places[1][y]) * v->sides[0];
            for (int x = 0; x < counts[0]; x++) {
                const double weight = v->gauss[offsets[0][x]] * v->gauss[offsets[1][y]] * v->gauss[offsets[2][z]];
                const uint32_t voxel = (uint32_t)(row + places[0][x]);
                v->energy[voxel] += on ? weight : -weight;
                nodes[count++] = v->leaves + voxel;
            }
        }
    }
    renew_above(v, nodes, count);
}

static koksma_status begin(volume *v, uint64_t seed, const koksma_run *run, uint32_t *count)
{
    *count = v->n / 10 ? v->n / 10 : 1;
    for (uint32_t placed = 0, i = 0; placed < *count; i++) {
        const uint32_t at = koksma__below(koksma__random(seed, KOKSMA__PURPOSE_DART, i, 3).w[0], v->n);
        if (!v->set[at]) {
            change(v, at, true);
            placed++;
        }
    }
    /* Alternating searches for voids and clusters would rebuild the whole tree each time, so a scan over all voxels
       finds the void instead. */
    for (uint32_t step = 0; step < 4 * *count; step++) {
        const uint32_t cluster = look_for(v, true);
        change(v, cluster, false);
        uint32_t hole = cluster;
        for (uint32_t i = 0; i < v->n; i++) {
            if (!v->set[i] && (v->energy[i] < v->energy[hole] || (v->energy[i] == v->energy[hole] && i < hole))) {
                hole = i;
            }
        }
        change(v, hole, true);
        if (hole == cluster) {
            break;
        }
        if (step % 256 == 255 && !koksma__keep_going(run, 0)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

static koksma_status rank_all(volume *v, uint32_t count, const koksma_run *run, uint32_t *ranks)
{
    for (uint32_t i = 0; i < v->n; i++) {
        ranks[i] = UINT32_MAX;
    }
    for (uint32_t left = count; left > 0; left--) {
        const uint32_t at = look_for(v, true);
        change(v, at, false);
        ranks[at] = left - 1;
    }
    for (uint32_t i = 0; i < v->n; i++) {
        v->energy[i] = 0;
    }
    for (uint32_t i = 0; i < v->n; i++) {
        if (ranks[i] < count) {
            change(v, i, true);
        }
    }
    for (uint32_t rank = count; rank < v->n; rank++) {
        const uint32_t at = look_for(v, false);
        change(v, at, true);
        ranks[at] = rank;
        if (rank % 256 == 0 && !koksma__keep_going(run, (double)rank / v->n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma_mask_void_and_cluster_3d(int size, int frames, uint64_t seed, const koksma_run *run,
                                              uint32_t *ranks)
{
    KOKSMA__REQUIRE(ranks);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(size < KOKSMA_MASK_MIN || size > KOKSMA_MASK_MAX_3D, KOKSMA_ARGUMENT,
                    "void-and-cluster-3d: a mask of size %d; sizes are %d to %d", size, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX_3D);
    KOKSMA__FAIL_IF(frames < KOKSMA_MASK_MIN || frames > KOKSMA_MASK_MAX_3D, KOKSMA_ARGUMENT,
                    "void-and-cluster-3d: a mask of %d frames; frames are %d to %d", frames, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX_3D);
    volume v = {.sides = {size, size, frames}, .n = (uint32_t)(size * size * frames), .leaves = 1};
    while (v.leaves < v.n) {
        v.leaves *= 2;
    }
    const size_t bytes = v.n * (sizeof *v.energy + sizeof *v.set) + 2 * (size_t)v.leaves * sizeof *v.winner;
    v.energy = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(v.energy, bytes);
    v.winner = (uint32_t *)(v.energy + v.n);
    v.set = (bool *)(v.winner + 2 * (size_t)v.leaves);
    for (int d = -REACH; d <= REACH; d++) {
        v.gauss[d + REACH] = koksma__exp(-(d * d) / (2 * 1.5 * 1.5));
    }
    uint32_t count = 0;
    (void)look_for(&v, true);
    koksma_status status = begin(&v, seed, run, &count);
    status = status ? status : rank_all(&v, count, run, ranks);
    free(v.energy);
    return status;
}
