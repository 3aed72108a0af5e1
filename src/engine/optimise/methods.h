/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_OPTIMISE_METHODS_H
#define KOKSMA_OPTIMISE_METHODS_H

#include <koksma/optimise.h>

#include "core/random.h"

#define METHOD(name) extern const koksma_method koksma__method_##name;
#include "optimise/methods.def"
#undef METHOD

/* The random numbers of one search, drawn one after the other. At first all members but the seed are 0. */
typedef struct koksma__stream {
    uint64_t seed, used;
    koksma__words words;
} koksma__stream;

static inline uint32_t koksma__next(koksma__stream *s)
{
    if (s->used % 4 == 0) {
        s->words = koksma__random(s->seed, KOKSMA__PURPOSE_SEARCH, s->used / 4, 0);
    }
    return s->words.w[s->used++ % 4];
}

/* koksma__next_unit returns a double in [0,1) with 32 random bits, koksma__next_below a random integer below n. */
static inline double koksma__next_unit(koksma__stream *s)
{
    return koksma__next(s) * 0x1p-32;
}

static inline uint32_t koksma__next_below(koksma__stream *s, size_t n)
{
    return koksma__below(koksma__next(s), (uint32_t)n);
}

#endif
