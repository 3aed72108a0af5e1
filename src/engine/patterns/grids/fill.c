/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fills arrays with uniform random numbers: calls the kernel of counter-based random words for blocks of numbers, on
 * several threads.
 */
#include "patterns/grids/grids.h"

#include "core/parallel.h"
#include "core/random.h"
#include "kernels/kernels.h"

enum { BLOCK_PAIRS = 1 << 16 };

typedef struct fill {
    uint64_t seed;
    uint32_t purpose;
    uint64_t first; /* index of the first pair */
    size_t pairs;
    double *xs;
} fill;

static koksma_status fill_block(void *context, size_t block)
{
    const fill *f = context;
    const size_t first = block * BLOCK_PAIRS;
    const size_t count = f->pairs - first < BLOCK_PAIRS ? f->pairs - first : BLOCK_PAIRS;
    koksma__kernels()->uniform(f->seed, f->purpose, f->first + first, 0, count, f->xs + 2 * first);
    return KOKSMA_OK;
}

koksma_status koksma__range_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, uint64_t first,
                                    size_t count, double *xs)
{
    double pair[2];
    if (first % 2 && count) {
        koksma__random_pair(seed, purpose, first / 2, 0, pair);
        *xs++ = pair[1];
        first++;
        count--;
    }
    fill f = {seed, purpose, first / 2, count / 2, xs};
    if (count % 2) {
        koksma__random_pair(seed, purpose, f.first + f.pairs, 0, pair);
        xs[count - 1] = pair[0];
    }
    if (f.pairs <= BLOCK_PAIRS) {
        return fill_block(&f, 0);
    }
    return koksma__parallel(run, (f.pairs + BLOCK_PAIRS - 1) / BLOCK_PAIRS, fill_block, &f);
}

koksma_status koksma__fill_uniform(uint64_t seed, uint32_t purpose, const koksma_run *run, size_t count, double *xs)
{
    return koksma__range_uniform(seed, purpose, run, 0, count, xs);
}
