/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Masks for patterns over the whole image: tables that choose for each pixel its copy of a pattern, so that the
 * errors of neighbouring pixels differ and average out to the eye.
 *
 *     void-and-cluster masks   koksma_mask_2d: each pixel has its own scrambled (0,2)-sequence, chosen by three
 * masks; or threshold images with one koksma_z_rank            (koksma/sampler.h) gives pixel (x, y) the samples rank
 * * spp .. rank * spp + spp - 1 of one sequence (Ahmed & Wonka 2020)
 *
 * Georgiev & Fajardo (2016) shift each pixel's copy on the torus. That breaks the nets at the seam: from 4 samples a
 * pixel on, the error in each pixel is up to several times that of independently scrambled pixels. koksma_mask_2d
 * keeps the nets. For any number of samples a pixel's points have the law of independently scrambled Sobol' points,
 * and so has its error; only the errors of neighbours are related. In one tile of 64 x 64 pixels, the share of the
 * error below a quarter of the highest frequency is, where white noise has 1:
 *
 *     samples a pixel        1     4     16    64
 *     x                      .04   .04   .04   .04
 *     exp(-x^2 - y^2)        .08   .11   .14   .23
 *     step in x              .09   .09   .20   .07
 *     quarter disk           .36   .34   .41   .43
 *
 * It helps most with a power of two of samples; with 3, 5, 6, 7, 12 the shares are .05 to .9. What oscillates more
 * than once over the square gains little with 1 to 3 samples.
 */
#ifndef KOKSMA_MASK_H
#define KOKSMA_MASK_H

#include <koksma/koksma.h>
#include <koksma/sampler.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { KOKSMA_MASK_MIN = 4, KOKSMA_MASK_MAX = 1024 };

/* The void-and-cluster mask of Ulichney (1993): ranks[y * size + x] is a permutation of 0 .. size^2 - 1 such that the
   pixels below any rank are spread evenly on the torus. size is KOKSMA_MASK_MIN to KOKSMA_MASK_MAX; time grows with
   size^2 log(size): about 15 ms for 64, 0.25 s for 256, 5 s for 1024. run may be NULL.
   Errors: ARGUMENT, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_void_and_cluster(int size, uint64_t seed, const koksma_run *run,
                                                      uint32_t *ranks);

#ifdef __cplusplus
}
#endif

/* A pixel's value of a mask of `pixels` pixels, as a 32-bit fraction: a random place in the stratum of its rank. The
   random word is the pixel's and the mask's: koksma_words(key, KOKSMA_FOR_SHIFT, pixel, 1, w) gives four. */
KOKSMA_INLINE uint32_t koksma_mask_value(uint32_t rank, uint32_t pixels, uint32_t random)
{
    return (uint32_t)(((uint64_t)rank << 32 | random) / pixels);
}

/* Sample s of the spp of a pixel in whose place three masks, made with three seeds, have these values. The sequence
   is that of the image, or of one use of its samples: koksma_sobol_of(domain). It is the pattern mask-offset.

   With 2^m the largest power of two that divides spp, each 2^m samples are a (0,m,2)-net in base 2. Two values are
   the digital shifts (XOR) of the digits that follow the first m: where the samples are within their strata. The
   third one chooses which stratum in y each stratum in x goes with: it is a digital shift of the first m digits of y
   before they are scrambled. So the error depends on the masks alone, and its parts that depend on one of them are as
   blue as it is. */
KOKSMA_INLINE void koksma_mask_2d(const koksma_sobol *sequence, const uint32_t values[3], uint32_t s, uint32_t spp,
                                  double xy[2])
{
    const uint32_t i = koksma_mirror(koksma_owen_hash(koksma_mirror_index(s), sequence->order));
    const uint32_t net = (spp & (0u - spp)) - 1; /* 2^m - 1 */
    const uint32_t pairing = koksma_mirror(values[2] ^ values[2] >> 1) & net;
    const uint32_t x = koksma_mirror(koksma_owen_hash(i, sequence->seeds[0]));
    const uint32_t y = koksma_mirror(koksma_owen_hash(koksma_pascal(i) ^ pairing, sequence->seeds[1]));
    uint32_t shifts[2], m;
    shifts[0] = values[0];
    shifts[1] = values[1];
    for (m = net; m; m >>= 1) {
        shifts[0] >>= 1;
        shifts[1] >>= 1;
    }
    xy[0] = koksma_fraction(x ^ shifts[0]);
    xy[1] = koksma_fraction(y ^ shifts[1]);
}

#endif
