/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Blue-noise masks: tables that select for each pixel a differently scrambled copy of a pattern, such that the
 * errors of neighbouring pixels differ and average out for the eye. Part of libkoksma; koksma_mask_value and
 * koksma_mask_2d are inline.
 *
 *     koksma_mask_2d           gives each pixel a (0,2)-sequence whose scrambling three void-and-cluster masks
 *                              select; a single mask can serve as a threshold image for dithering
 *     koksma_mask_void_and_cluster_3d   computes a void-and-cluster mask in space and time
 *     koksma_mask_vectors      computes a vector mask: one sample of up to 8 dimensions for each pixel
 *     koksma_mask_optimise     arranges scalars, vectors or directions for a given filter, in any rectangle; the command
 *                              `koksma mask` writes such masks to files
 *     koksma_keys_2d           (koksma/keys.h) gives the 32 x 32 pixels of a cell different blocks of one sequence,
 *                              in an order optimised for 1, 2, 4 ... 64 samples per pixel
 *     koksma_z_rank            (koksma/sampler.h) gives pixel (x, y) the samples rank * spp .. rank * spp + spp - 1
 *                              of one sequence (Ahmed & Wonka 2020)
 *
 * Georgiev & Fajardo (2016) shift each pixel's copy of the pattern on the torus. The shift breaks the net property:
 * from 4 samples per pixel on, the error in each pixel is up to several times that of independently scrambled pixels.
 * koksma_mask_2d keeps the nets. For any number of samples, the points and the error of one pixel have the same
 * probability distribution as with independently scrambled Sobol' points; only the errors of neighbouring pixels are
 * dependent. The table has, for four integrands over the unit square, the power of the errors in one tile of 64 x 64
 * pixels at frequencies below a quarter of the highest, divided by the power of white noise:
 *
 *     samples a pixel        1     4     16    64
 *     x                      .04   .04   .04   .04
 *     exp(-x^2 - y^2)        .08   .11   .14   .23
 *     step in x              .09   .09   .20   .07
 *     quarter disk           .36   .34   .41   .43
 *
 * Numbers of samples that are powers of two gain most; with 3, 5, 6, 7 and 12 samples per pixel the ratio is .05 to
 * .9. With 1 to 3 samples per pixel an integrand that oscillates more than once over the square gains little.
 */
#ifndef KOKSMA_MASK_H
#define KOKSMA_MASK_H

#include <koksma/koksma.h>
#include <koksma/sampler.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    KOKSMA_MASK_MIN = 4,
    KOKSMA_MASK_MAX = 1024,
    KOKSMA_MASK_MAX_3D = 64,
    KOKSMA_MASK_MAX_VECTORS = 256,
    KOKSMA_MASK_MAX_DIM = 8
};

/* Computes the void-and-cluster mask of Ulichney (1993): a permutation of 0 .. size^2 - 1 whose pixels below any
   rank are spread evenly on the torus. O(size^2 log size): about 7 ms for size 64, 56 ms for 256.
     size   KOKSMA_MASK_MIN to KOKSMA_MASK_MAX
     ranks  size * size numbers; pixel (x, y) is ranks[y * size + x]
   Errors: ARGUMENT (size), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_void_and_cluster(int size, uint64_t seed, const koksma_run *run,
                                                      uint32_t *ranks);

/* Computes a void-and-cluster mask in space and time: a permutation of 0 .. size^2 frames - 1 whose voxels below
   any rank are spread evenly on the three-dimensional torus. The mask is blue noise in space and time together; at
   low frequencies a single frame has about half the power of white noise, a two-dimensional mask about a tenth. It
   takes about 1.5 s for 32 x 32 x 16 voxels.
     size    pixels a side, KOKSMA_MASK_MIN to KOKSMA_MASK_MAX_3D
     frames  number of frames, KOKSMA_MASK_MIN to KOKSMA_MASK_MAX_3D
     ranks   size * size * frames numbers; pixel (x, y) of frame f is ranks[(f * size + y) * size + x]
   Errors: ARGUMENT (size, frames), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_void_and_cluster_3d(int size, int frames, uint64_t seed, const koksma_run *run,
                                                         uint32_t *ranks);

/* Computes a vector mask (Georgiev & Fajardo 2016): each pixel of a square tile has a vector of dim numbers in [0,1),
   and neighbouring pixels have distant vectors. A pixel with one sample takes its vector as the sample; then the errors of
   neighbouring pixels differ and average out, whatever function of the vector is integrated.
   The vectors are a rank-1 lattice with a random shift: for each coordinate, each of the size^2 intervals of length
   1 / size^2 has one vector. Their arrangement minimises, by simulated annealing with 256 proposed swaps a pixel,

       sum over pixels p, q of exp(-|p - q|^2 / 2.1^2 - |v_p - v_q|^(dim/2)),  distances of pixels on the torus

   Masks of fewer dimensions have less error at low frequencies. For functions of two coordinates, its power is .01 to
   .15 of that of white noise with dim = 2, .03 to .3 with 4, .13 to .4 with 8 (docs/findings/screen-noise.md). Seeds
   differ in the shift and in the arrangement; the bits depend on neither threads nor machine. The points of the
   pattern `mask-offset:masks=vectors` are the mask with dim = 2. It takes about 1.2 s for size 64 with dim = 2 and
   1.6 s with dim = 8; the time is proportional to size^2 (22 s for 256).
     size    KOKSMA_MASK_MIN to KOKSMA_MASK_MAX_VECTORS
     dim     numbers in a vector, 1 to KOKSMA_MASK_MAX_DIM
     values  size * size * dim numbers; coordinate k of pixel (x, y) is values[(y * size + x) * dim + k]
   Errors: ARGUMENT (size, dim), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_vectors(int size, int dim, uint64_t seed, const koksma_run *run, double *values);

/* ---- Masks optimised for a filter --------------------------------------------------------------------- */

/* The numbers that the pixels of a mask have. */
typedef struct koksma_mask_space {
    const char *name, *title;
    int dim;          /* numbers a pixel, 1 to 4 */
    double low, high; /* every number lies in [low, high]; image files map this range to their levels */
} koksma_mask_space;

/* Returns space i of the table, or the space with this name, or NULL if there is none:
     scalar       uniform in [0,1)
     tent         the density 1 - |v| on [-1,1]
     gaussian     the normal distribution of mean 0 and variance 1; high is 6, which no mask reaches
     vector2 .. vector4   uniform in [0,1)^2 to [0,1)^4
     disk, circle, sphere uniform in the unit disk, on the unit circle and the unit sphere
     hemisphere   unit vectors with z >= 0 and the density z / pi */
KOKSMA_API const koksma_mask_space *koksma_mask_space_at(size_t i);
KOKSMA_API const koksma_mask_space *koksma_mask_space_find(const char *name);

enum { KOKSMA_MASK_MAX_SIDE = 65, KOKSMA_MASK_REVISION = 1 };

/* The filter that will be applied to the noise: weights[y * width + x]. It need be neither symmetric nor normalised. */
typedef struct koksma_mask_filter {
    int width, height; /* 1 to KOKSMA_MASK_MAX_SIDE */
    double weights[KOKSMA_MASK_MAX_SIDE * KOKSMA_MASK_MAX_SIDE];
} koksma_mask_filter;

/* Scales the weights to the sum 1.
   Errors: ARGUMENT (a size; a weight that is not finite; a sum of 0; a single weight, under which all arrangements are
   equal). */
KOKSMA_API koksma_status koksma_mask_filter_check(koksma_mask_filter *filter);

typedef struct koksma_mask_options {
    int width, height;              /* KOKSMA_MASK_MIN to KOKSMA_MASK_MAX */
    const koksma_mask_space *space; /* NULL: scalar */
    koksma_mask_filter filter;      /* koksma_mask_optimise normalises a copy */
    bool open;  /* false: the mask is a tile that repeats; true: it has borders, and what lies beyond
                                       them has no error */
    int levels; /* scalar only: the number of different values, (k + 1/2) / levels, of which each occurs equally
                          often (to 1, if levels does not divide the number of pixels). 0: as many as pixels */
    uint64_t seed;
    double swaps;      /* proposed swaps a pixel, 0 to 1e6; 0: none */
    const float *from; /* width * height * dim numbers of a mask of this space: the search rearranges them. NULL: a
                          random arrangement of new values */
    uint64_t done;     /* number of proposals that an earlier call with these options has made before it returned the
                          mask `from`: this call continues it, and `levels` has no effect. 0: the search begins */
    double first;      /* with done above 0: koksma_mask_result.first of that call. 0: the error of `from` */
    uint32_t
        *state; /* width * height numbers that a call writes at its end, and reads at its beginning if done is above
                          0: the state of the search, which the returned mask does not have if it is an earlier one or
                          has equal numbers. NULL: the mask is the state */
    double target; /* end once the error is at most this number; 0: never */
} koksma_mask_options;

typedef struct koksma_mask_result {
    double first, error; /* the error, below, of the first arrangement and of the last */
    uint64_t done;       /* number of proposals made, those of options.done included */
    bool finished;       /* false: the time limit ended the search */
} koksma_mask_result;

/* Arranges values such that the filter leaves as little as possible of them, whatever function of the value each pixel
   evaluates. It minimises

       error^2 = 1/n sum over pixels p, q of A(p - q) (h(v_p) + h(v_q) - |v_p - v_q| - mean of h) / 2

   where A is the autocorrelation of the filter, h(v) the mean distance of v from all values, and |.| the Euclidean
   distance. Of scalars, error^2 is the mean over all thresholds t of the variance over the pixels of the filtered image
   of (v < t); tent and gaussian are scalars whose value is mapped by the inverse of their distribution. Of vectors
   it is, up to a constant factor, the mean of that variance over all half-spaces {v: w.v < t} by their invariant
   measure (Crofton's formula), and so the generalised energy distance of Szekely & Rizzo (2013) after filtering.

   The search is simulated annealing by swaps of two pixels whose values are close. The error of the result is never above
   that of the first arrangement: `from` is returned if the state has a larger one. Equal options give equal bits
   on every machine. With 4,000 swaps a pixel it takes about 5 s for 128 x 128 scalars and a filter of 5 x 5 pixels; the
   time is proportional to the number of pixels and of the filter's pixels.
     run     its time limit ends the search; the mask then is as good as it was by then, and options.done, first and state
             continue it to the mask of one call. It uses one thread
     values  receives width * height * space->dim numbers: coordinate k of pixel (x, y) is
             values[(y * width + x) * dim + k]
     result  may be NULL
   Errors: ARGUMENT (the message names the option), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_optimise(const koksma_mask_options *options, const koksma_run *run,
                                              float *values, koksma_mask_result *result);

/* How much of a mask a filter leaves. */
typedef struct koksma_mask_quality {
    double
        error; /* on the torus: the root of the mean, over tests, of the variance over the pixels of the filtered image
                      of (v < t) */
    double white; /* the root of the expectation of its square for a random arrangement of the same values */
    double
        inside; /* the same as error over those pixels whose filter lies within the mask, about the mean of the whole;
                      NaN if there are none */
    double seam; /* over the other pixels, whose filter spans opposite sides; NaN if there are none */
} koksma_mask_quality;

/* Measures a mask. The tests of a space of one number are the thresholds (i + 1/2) / tests, of the value itself or, for
   tent and gaussian, of its rank as a share of the pixels, where equal values have their mean rank. In other spaces the
   tests are half-spaces v.w < t of fixed random directions w, with t uniform between the least and the largest v.w.
     space   NULL: scalar
     filter  need not be normalised
     tests   1 to 65536
     run     the number of threads does not change the result
   Errors: ARGUMENT, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_measure(int width, int height, const koksma_mask_space *space,
                                             const float *values, const koksma_mask_filter *filter, int tests,
                                             const koksma_run *run, koksma_mask_quality *out);

#ifdef __cplusplus
}
#endif

/* Returns the value of one pixel of a mask as a 32-bit fraction: a random position in the stratum of its rank.
     rank    rank of the pixel, from koksma_mask_void_and_cluster; less than `pixels`
     pixels  number of pixels of the mask: size * size
     random  a random word that differs for each pixel and mask; koksma_words(key, KOKSMA_FOR_SHIFT, pixel, 1, w)
             gives four */
KOKSMA_INLINE uint32_t koksma_mask_value(uint32_t rank, uint32_t pixels, uint32_t random)
{
    KOKSMA_ASSERT(rank < pixels);
    return (uint32_t)(((uint64_t)rank << 32 | random) / pixels);
}

/* Computes sample s of a pixel. The points equal those of the pattern `mask-offset`.
     sequence  koksma_sobol_of(domain), with the domain of the image or of one pair of its sample dimensions
     values    koksma_mask_value of this pixel in three masks with different seeds
     s, spp    index of the sample, 0 .. spp - 1; number of samples per pixel
     xy        receives the point, in [0,1)^2

   If 2^m is the largest power of two that divides spp, each aligned block of 2^m samples is a (0,m,2)-net in base 2.
   values[0] and values[1] shift (by XOR) the digits of x and y after the first m, which set the position of the
   samples within their strata. values[2] shifts the first m digits of y before they are scrambled, which pairs the
   strata in y with those in x. The error of a pixel thus depends only on the masks, and each part of the error that
   depends on one mask is as blue as that mask. */
KOKSMA_INLINE void koksma_mask_2d(const koksma_sobol *sequence, const uint32_t values[3], uint32_t s, uint32_t spp,
                                  double xy[2])
{
    const uint32_t i = koksma_shuffled(s, sequence->order);
    const uint32_t net = (spp & (0u - spp)) - 1; /* 2^m - 1 */
    const uint32_t pairing = koksma_mirror(values[2] ^ values[2] >> 1) & net;
    const uint32_t x = koksma_mirror(koksma_owen_hash(i, sequence->seeds[0]));
    const uint32_t y = koksma_mirror(koksma_owen_hash(koksma_pascal(i) ^ pairing, sequence->seeds[1]));
    uint32_t shifts[2], m;
    KOKSMA_ASSERT(s < spp);
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
