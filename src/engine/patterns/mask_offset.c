/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mask-offset: the points of all pixels of a square tile, pixel after pixel. Each pixel has its own variant of one
 * hash-Owen-scrambled (0,2)-sequence; the values of three void-and-cluster masks at the pixel select the variant.
 *
 *     point s of pixel p = koksma_mask_2d(sequence, {value_0(p), value_1(p), value_2(p)}, s, spp),   n = width^2 spp
 *
 * koksma/mask.h explains how the values select the variant, and for which numbers of samples the errors are blue
 * noise. Taken alone, a pixel's points have the same distribution as sobol:scramble=hash-owen: for any spp the
 * pixel's error is as large as with independent scrambling.
 *
 * With masks=vectors a pixel has one sample, its vector in koksma_mask_vectors. The errors are then bluer if the
 * integrand depends on both coordinates together: for a disk their power at low frequencies is .13 times that of
 * white noise in place of .38 (docs/findings/screen-noise.md has all integrands).
 *
 * Sources: Georgiev & Fajardo 2016, who shift the points on the torus by two optimised masks; here the masks are
 * void-and-cluster masks (Ulichney 1993). Scrambling: Laine & Karras 2011, Burley 2020. New in this project are two
 * things: the two masks shift only the digits below those of the net, and a third mask decides which strata in y
 * are paired with those in x.
 */
#include <koksma/mask.h>

#include <stdlib.h>

#include "core/random.h"
#include "core/status.h"
#include "patterns/masks/mask_tile.h"
#include "patterns/patterns.h"

/* Fills the tile with one vector a pixel. */
static koksma_status fill_vectors(uint64_t seed, const koksma_args *args, size_t width, koksma_points *out)
{
    KOKSMA__FAIL_IF(width > KOKSMA_MASK_MAX_VECTORS, KOKSMA_ARGUMENT,
                    "mask-offset: width=%zu is above %d, the most with masks=vectors", width,
                    KOKSMA_MASK_MAX_VECTORS);
    KOKSMA__TRY(koksma__tile_check("mask-offset", width * width, true, out));
    return koksma_mask_vectors((int)width, 2, seed, args->run, out->xs);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t width = (size_t)args->params[0], pixels = width * width;
    if (args->params[1] != 0) {
        return fill_vectors(seed, args, width, out);
    }
    KOKSMA__TRY(koksma__tile_check("mask-offset", pixels, false, out));
    uint32_t *ranks = malloc(KOKSMA__TILE_MASKS * pixels * sizeof *ranks);
    KOKSMA__REQUIRE_MEMORY(ranks, KOKSMA__TILE_MASKS * pixels * sizeof *ranks);
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; k < KOKSMA__TILE_MASKS && !status; k++) {
        status = koksma_mask_void_and_cluster((int)width, koksma__random_seed(seed, k, KOKSMA__PURPOSE_SHIFT),
                                              args->run, ranks + k * pixels);
    }
    if (!status) {
        status = koksma__tile_fill(seed, args->run, pixels, ranks, out);
    }
    free(ranks);
    return status;
}

static const char *const masks[] = {"void-and-cluster", "vectors", NULL};

static const koksma_param params[] = {
    {"width", "width of the tile in pixels", 64, KOKSMA_MASK_MIN, KOKSMA_MASK_MAX, NULL, true},
    {"masks", "what varies the pixels: three void-and-cluster masks, or a vector mask (one sample a pixel)", 0, 0, 1,
     masks, true},
    {0},
};

const koksma_pattern koksma__pattern_mask_offset = {
    .name = "mask-offset",
    .title = "a (0,2)-sequence that blue-noise masks vary from pixel to pixel",
    .cite = "georgiev2016 ulichney1993 laine2011 burley2020",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .revision = 1,
    .generate = generate,
};
