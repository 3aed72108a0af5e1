/* SPDX-License-Identifier: Apache-2.0 */
/* Masks against their definitions, and the pattern that is made of them against independent pixels: the error within
   a pixel is that of independently scrambled points, and neighbours' errors cancel. */
#include <koksma/mask.h>
#include <koksma/warp.h>

#include <stdlib.h>
#include <string.h>

#include "pattern_sets.h"

static uint32_t *mask_of(int size, uint64_t seed)
{
    uint32_t *ranks = malloc((size_t)(size * size) * sizeof *ranks);
    assert_non_null(ranks);
    assert_ok(koksma_mask_void_and_cluster(size, seed, NULL, ranks));
    return ranks;
}

/* The energy of each pixel: Gaussians of standard deviation 1.5 about the pixels with rank < below, the shortest way on the
   torus, up to `reach` pixels along each axis. */
static void energies_of(const uint32_t *ranks, const int sides[3], int reach, uint32_t below, double *energy)
{
    const int n = sides[0] * sides[1] * sides[2];
    for (int p = 0; p < n; p++) {
        energy[p] = 0;
        for (int q = 0; q < n; q++) {
            int square = 0, rest[2] = {p, q};
            bool near = ranks[q] < below;
            for (int k = 0; k < 3 && near; k++) {
                int d = abs(rest[0] % sides[k] - rest[1] % sides[k]);
                d = d < sides[k] - d ? d : sides[k] - d;
                near = d <= reach;
                square += d * d;
                rest[0] /= sides[k];
                rest[1] /= sides[k];
            }
            energy[p] += near ? exp(-square / 4.5) : 0;
        }
    }
}

/* Ulichney's three rules, to 1e-9, at every size that a window of 19 pixels treats in its own way; and in time, where the
   window has 9 voxels a side, two of them. */
TEST_CASE(masks_are_ulichneys)
{
    enum { MOST = 810 };
    static const int all[][3] = {{4, 4, 1},   {5, 5, 1},   {6, 6, 1},   {7, 7, 1},   {8, 8, 1},   {10, 10, 1},
                                 {12, 12, 1}, {16, 16, 1}, {17, 17, 1}, {18, 18, 1}, {19, 19, 1}, {20, 20, 1},
                                 {23, 23, 1}, {4, 4, 4},   {5, 5, 8},   {8, 8, 5},   {9, 9, 10}};
    for (size_t t = 0; t < sizeof all / sizeof *all; t++) {
        const int *sides = all[t], n = sides[0] * sides[1] * sides[2], reach = sides[2] > 1 ? 4 : 9;
        const uint32_t count = (uint32_t)(n / 10 ? n / 10 : 1), step = sides[2] > 1 ? 29 : 11;
        uint32_t ranks[MOST], at[MOST];
        double energy[MOST];
        assert_ok(sides[2] > 1 ? koksma_mask_void_and_cluster_3d(sides[0], sides[2], t, NULL, ranks)
                               : koksma_mask_void_and_cluster(sides[0], t, NULL, ranks));
        memset(at, 0xff, sizeof at);
        for (int p = 0; p < n; p++) {
            assert_true(ranks[p] < (uint32_t)n && at[ranks[p]] == UINT32_MAX);
            at[ranks[p]] = (uint32_t)p;
        }
        for (uint32_t r = 0; r<(uint32_t)n; r += n> 64 && (r > 2 * count || n > 529) ? step : 1) {
            /* rank r <  count: of the pixels to r, that of rank r is in the tightest cluster
               rank r >= count: of the others than those below r, that of rank r is in the largest void */
            const bool cluster = r < count;
            energies_of(ranks, sides, reach, cluster ? r + 1 : r, energy);
            for (int p = 0; p < n; p++) {
                if (cluster ? ranks[p] <= r && energy[p] > energy[at[r]] + 1e-9
                            : ranks[p] >= r && energy[p] < energy[at[r]] - 1e-9) {
                    fail_msg("%d x %d x %d: pixel %d, not %u, has rank %u", sides[0], sides[1], sides[2], p, at[r],
                             r);
                }
            }
        }
        /* the first pixels are stable: without the tightest, its own place is the largest void */
        energies_of(ranks, sides, reach, count - 1, energy);
        for (int p = 0; p < n && sides[2] == 1; p++) {
            assert_true(energy[p] >= energy[at[count - 1]] - 1e-9 || ranks[p] < count - 1);
        }
    }
    uint32_t none[64];
    assert_int_equal(koksma_mask_void_and_cluster(3, 3, NULL, none), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_mask_void_and_cluster(KOKSMA_MASK_MAX + 1, 3, NULL, none), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_mask_void_and_cluster_3d(3, 4, 3, NULL, none), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_mask_void_and_cluster_3d(4, KOKSMA_MASK_MAX_3D + 1, 3, NULL, none), KOKSMA_ARGUMENT);
}

/* The points of mask-offset with given masks. */
static koksma_points tile_of(uint32_t *const ranks[3], size_t pixels, size_t spp, uint64_t seed)
{
    koksma_points tile;
    assert_ok(koksma_points_init(&tile, pixels * spp, 2));
    const koksma_sobol sequence = koksma_sobol_of((koksma_domain){seed});
    for (size_t p = 0; p < pixels; p++) {
        uint32_t w[4], values[3];
        koksma_words(seed, KOKSMA_FOR_SHIFT, p, 1, w);
        for (int k = 0; k < 3; k++) {
            values[k] = koksma_mask_value(ranks[k][p], (uint32_t)pixels, w[k]);
        }
        for (size_t s = 0; s < spp; s++) {
            koksma_mask_2d(&sequence, values, (uint32_t)s, (uint32_t)spp, tile.xs + 2 * (p * spp + s));
        }
    }
    return tile;
}

TEST_CASE(the_header_has_the_patterns_points)
{
    static const struct {
        int width;
        size_t spp;
    } cases[] = {{4, 1}, {5, 3}, {8, 16}, {12, 40}, {4, 1000}, {64, 1}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char spec[40]; /* the default width is 64 */
        const uint64_t seed = 9 + c;
        const size_t pixels = (size_t)(cases[c].width * cases[c].width), spp = cases[c].spp;
        snprintf(spec, sizeof spec, cases[c].width == 64 ? "mask-offset" : "mask-offset:width=%d", cases[c].width);
        koksma_points points = test_points(spec, pixels * spp, 2, seed);
        uint32_t *ranks[3];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t w[4];
            koksma_words(seed, KOKSMA_FOR_DOMAIN, k, KOKSMA_FOR_SHIFT, w);
            ranks[k] = mask_of(cases[c].width, (uint64_t)w[1] << 32 | w[0]);
        }
        koksma_points expected = tile_of(ranks, pixels, spp, seed);
        assert_memory_equal(points.xs, expected.xs, 2 * points.n * sizeof *points.xs);
        for (int k = 0; k < 3; k++) {
            free(ranks[k]);
        }
        koksma_points_fini(&expected);
        koksma_points_fini(&points);
    }
    assert_int_equal(koksma_mask_value(0, 16, 0), 0);
    assert_int_equal(koksma_mask_value(15, 16, 0xffffffffu), 0xffffffffu);
    assert_int_equal(koksma_mask_value(5, 16, 0), 0x50000000u);
}

TEST_CASE(a_pixel_can_have_its_vector)
{
    double values[2 * 25];
    assert_ok(koksma_mask_vectors(5, 2, 8, NULL, values));
    koksma_points points = test_points("mask-offset:width=5,masks=vectors", 25, 2, 8);
    assert_memory_equal(points.xs, values, sizeof values);
    koksma_points_fini(&points);
    assert_int_equal(status_of("mask-offset:width=4,masks=vectors", 25, 2), KOKSMA_N);
    assert_int_equal(status_of("mask-offset:width=257,masks=vectors", 257 * 257, 2), KOKSMA_ARGUMENT);
}

TEST_CASE(pixels_have_nets)
{
    for (size_t spp = 1; spp <= 256; spp *= 2) {
        koksma_points tile = test_points("mask-offset:width=6", 36 * spp, 2, spp);
        for (size_t pixel = 0; pixel < 36; pixel++) {
            const koksma_points own = {spp, 2, tile.xs + 2 * spp * pixel};
            assert_true(is_net2_block(&own, 0, spp));
        }
        koksma_points_fini(&tile);
    }
}

/* errors[width^2 f + pixel] of a tile. */
static void errors_of(const koksma_points *tile, size_t pixels, double *errors)
{
    const size_t spp = tile->n / pixels;
    for (size_t p = 0; p < pixels; p++) {
        double f[INTEGRANDS] = {0};
        for (size_t s = 0; s < spp; s++) {
            add_integrands(tile->xs + 2 * (p * spp + s), f);
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            errors[(size_t)k * pixels + p] = f[k] / (double)spp - integrands[k].mean;
        }
    }
}

/* Over many tiles the mean square error in a pixel is that of independently scrambled pixels, within 3 standard
   errors of the mean over tiles, and the mean error is 0. A toroidal shift has 5 times as much for x with 4 samples.
 */
TEST_CASE(pixels_err_like_independent_ones)
{
    enum { WIDTH = 8, PIXELS = WIDTH * WIDTH, TILES = 200 };
    static const size_t spps[] = {1, 3, 4, 6, 16, 64};
    for (size_t t = 0; t < sizeof spps / sizeof *spps; t++) {
        double sum[2][INTEGRANDS] = {{0}}, square[2][INTEGRANDS] = {{0}}, bias[INTEGRANDS] = {0};
        double biases[INTEGRANDS] = {0};
        for (uint64_t seed = 0; seed < 2 * TILES; seed++) {
            double errors[INTEGRANDS * PIXELS];
            koksma_points tile;
            if (seed % 2) {
                tile = test_points("mask-offset:width=8", PIXELS * spps[t], 2, seed);
            } else {
                assert_ok(koksma_points_init(&tile, PIXELS * spps[t], 2));
                for (size_t i = 0; i < tile.n; i++) {
                    const koksma_domain pixel = koksma_domain_of_pixel(seed, (uint32_t)(i / spps[t]), 0);
                    koksma_sobol_2d(pixel, (uint32_t)(i % spps[t]), tile.xs + 2 * i);
                }
            }
            errors_of(&tile, PIXELS, errors);
            koksma_points_fini(&tile);
            for (int k = 0; k < INTEGRANDS; k++) {
                double mean = 0, error = 0;
                for (int p = 0; p < PIXELS; p++) {
                    mean += errors[k * PIXELS + p] * errors[k * PIXELS + p] / PIXELS;
                    error += errors[k * PIXELS + p] / PIXELS;
                }
                sum[seed % 2][k] += mean / TILES;
                square[seed % 2][k] += mean * mean / TILES;
                bias[k] += seed % 2 ? error / TILES : 0;
                biases[k] += seed % 2 ? error * error / TILES : 0;
            }
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            const double variance = square[0][k] - sum[0][k] * sum[0][k] + square[1][k] - sum[1][k] * sum[1][k];
            const double deviation = sqrt(fmax(variance, 0) / TILES);
            assert_that(sum[1][k] < sum[0][k] + 3 * deviation + 1e-12,
                        "%zu samples, %s: mean square error %.3g, independent pixels %.3g +- %.2g", spps[t],
                        integrands[k].name, sum[1][k], sum[0][k], deviation);
            assert_near(bias[k], 0, 4 * sqrt(biases[k] / TILES));
        }
    }
}

/* The variance of means over 8 x 8 pixels, times 64, in that of pixels: 1 for white noise. */
TEST_CASE(neighbours_errors_cancel)
{
    enum { WIDTH = 64, BLOCK = 8, PIXELS = WIDTH * WIDTH, TILES = 6, N_SPP = 8 };
    static const struct {
        size_t spp;
        double most[INTEGRANDS];
    } cases[N_SPP] = {{1, {.15, .35, .2, .6, .25, .25, .5}},  {2, {.15, .35, .25, .9, .25, .25, .9}},
                      {4, {.2, .35, .25, .6, .3, .3, .6}},    {16, {.15, .35, .25, .6, .4, .4, .6}},
                      {64, {.15, .5, .35, .6, .25, .25, .6}}, {3, {.2, .65, .35, 1, .3, .3, 1}},
                      {6, {.2, .55, .35, 1, .3, .3, 1}},      {12, {.25, .4, .35, .95, .4, .4, .95}}};
    static double errors[INTEGRANDS * PIXELS];
    uint32_t *ranks[TILES][3];
    for (size_t m = 0; m < TILES * 3; m++) {
        ranks[m / 3][m % 3] = mask_of(WIDTH, 100 + m);
    }
    for (size_t t = 0; t < N_SPP; t++) {
        double pixels[INTEGRANDS] = {0}, blocks[INTEGRANDS] = {0};
        for (uint64_t seed = 0; seed < TILES; seed++) {
            koksma_points tile = tile_of(ranks[seed], PIXELS, cases[t].spp, seed);
            errors_of(&tile, PIXELS, errors);
            koksma_points_fini(&tile);
            for (size_t k = 0; k < INTEGRANDS; k++) {
                double sums[WIDTH / BLOCK][WIDTH / BLOCK] = {{0}};
                for (size_t p = 0; p < PIXELS; p++) {
                    const double e = errors[k * PIXELS + p];
                    pixels[k] += e * e;
                    sums[p / WIDTH / BLOCK][p % WIDTH / BLOCK] += e;
                }
                for (size_t b = 0; b < (WIDTH / BLOCK) * (WIDTH / BLOCK); b++) {
                    blocks[k] += sums[b / (WIDTH / BLOCK)][b % (WIDTH / BLOCK)] *
                                 sums[b / (WIDTH / BLOCK)][b % (WIDTH / BLOCK)];
                }
            }
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            assert_that(blocks[k] < cases[t].most[k] * pixels[k],
                        "%zu samples, %s: the share of low frequencies is %.2f", cases[t].spp, integrands[k].name,
                        blocks[k] / pixels[k]);
        }
    }
    for (size_t m = 0; m < TILES * 3; m++) {
        free(ranks[m / 3][m % 3]);
    }
}

/* The pattern mask-file. A mask of one number gives the same points for any map that keeps the order of its numbers; each
   pixel's points are a net; other seeds give other points, and a mask of two numbers is shifted alone. */
TEST_CASE(masks_in_files_vary_the_pixels)
{
    enum { W = 6, H = 4, N = W * H, SPP = 16 };
    koksma_points numbers = {N, 1, (double[N]){0}}, squares = {N, 1, (double[N]){0}};
    for (int p = 0; p < N; p++) {
        numbers.xs[p] = (p * 7 % N + 0.5) / N;
        squares.xs[p] = numbers.xs[p] * numbers.xs[p];
    }
    static const char head[] =
        "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 6), }"; /* as others write them */
    write_npy("numbers.npy", head, numbers.xs, N * sizeof(double));
    write_npy("squares.npy", head, squares.xs, N * sizeof(double));
    koksma_points a = test_points("mask-file:numbers.npy", N * SPP, 2, 3);
    koksma_points b = test_points("mask-file:squares.npy", N * SPP, 2, 3);
    koksma_points c = test_points("mask-file:numbers.npy", N * SPP, 2, 4);
    assert_memory_equal(a.xs, b.xs, sizeof(double) * N * SPP * 2);
    assert_memory_not_equal(a.xs, c.xs, sizeof(double) * N * SPP * 2);
    for (int p = 0; p < N; p++) { /* one point in each of 4 x 4 cells, and in each of 16 columns and rows */
        unsigned cells = 0, columns = 0, rows = 0;
        for (int s = 0; s < SPP; s++) {
            const double *x = a.xs + 2 * (p * SPP + s);
            cells |= 1u << ((int)(4 * x[0]) + 4 * (int)(4 * x[1]));
            columns |= 1u << (int)(16 * x[0]);
            rows |= 1u << (int)(16 * x[1]);
        }
        assert_true(cells == 0xffff && columns == 0xffff && rows == 0xffff);
    }
    koksma_points_fini(&a);
    koksma_points_fini(&b);
    koksma_points_fini(&c);
}

/* The number of shifts of a tile for which numbers are those of the points, within `slack`. */
static int count_shifts(const koksma_points *points, const float *v, int width, int height, double slack)
{
    const int dim = points->dim, n = width * height;
    int shifts = 0;
    for (int shift = 0; shift < n; shift++) {
        bool equal = true;
        for (int i = 0; i < dim * n && equal; i++) {
            const int p = i / dim, y = (p / width + shift / width) % height, x = (p % width + shift % width) % width;
            equal = fabs(points->xs[i] - (double)v[dim * (y * width + x) + i % dim]) <= slack;
        }
        shifts += equal;
    }
    return shifts;
}

TEST_CASE(vectors_in_files_are_the_samples)
{
    enum { W = 5, H = 4, N = W * H };
    for (int dim = 2; dim <= 4; dim += 2) {
        float v[4 * N];
        char head[119];
        for (int i = 0; i < dim * N; i++) {
            v[i] = (float)((i * 11 % (dim * N) + 0.5) / (dim * N));
        }
        snprintf(head, sizeof head, "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 5, %d), }", dim);
        write_npy("vectors.npy", head, v, sizeof *v * (size_t)dim * N);
        for (uint64_t seed = 0; seed < 5; seed++) {
            koksma_points points = test_points("mask-file:vectors.npy", N, dim, seed);
            assert_int_equal(count_shifts(&points, v, W, H, 0), 1);
            koksma_points_fini(&points);
        }
        assert_int_equal(status_of("mask-file:vectors.npy", 2 * N, dim), KOKSMA_N);
        assert_int_equal(status_of("mask-file:vectors.npy", N, 6 - dim), KOKSMA_DIM);
    }
}

/* The uniform directions of a circle and of a sphere have no place in the square. */
TEST_CASE(directions_without_samples_are_refused)
{
    static const char *const spaces[] = {"circle", "sphere"};
    for (int s = 0; s < 2; s++) {
        const koksma_mask_space *space = koksma_mask_space_find(spaces[s]);
        koksma_mask_options options = {.width = 9, .height = 4, .space = space, .filter = {2, 1, {1, 1}}};
        float v[3 * 36];
        char head[119];
        assert_ok(koksma_mask_optimise(&options, NULL, v, NULL));
        snprintf(head, sizeof head, "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 9, %d), }", space->dim);
        write_npy("unit.npy", head, v, sizeof *v * (size_t)space->dim * 36);
        assert_int_equal(status_of("mask-file:unit.npy", 36, 2), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), spaces[s]));
    }
}

/* Masks of directions and of points of the disk give the points that the warp maps to their values, each once, in one
   shift of the tile. */
TEST_CASE(directions_in_files_are_the_samples)
{
    enum { W = 9, H = 4, N = W * H };
    static const char *const spaces[] = {"hemisphere", "disk"}, *const warps[] = {"cosine-hemisphere",
                                                                                  "concentric-disk"};
    for (int s = 0; s < 2; s++) {
        const koksma_mask_space *space = koksma_mask_space_find(spaces[s]);
        koksma_mask_options options = {.width = W, .height = H, .space = space, .filter = {2, 1, {1, 1}}};
        const size_t dim = (size_t)space->dim;
        float v[3 * N];
        assert_ok(koksma_mask_optimise(&options, NULL, v, NULL));
        v[0] = 0, v[1] = -1, v[dim - 1] = s ? -1 : 0; /* on the rim */
        char head[119];
        snprintf(head, sizeof head, "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 9, %d), }", space->dim);
        write_npy("round.npy", head, v, sizeof *v * dim * N);
        koksma_points points = test_points("mask-file:round.npy", N, 2, 5), mapped;
        assert_ok(koksma_warp_points(koksma_warp_find(warps[s]), &points, &mapped));
        /* z = sqrt(1 - x^2 - y^2) is rounded near the rim */
        assert_int_equal(count_shifts(&mapped, v, W, H, 1e-3), 1);
        koksma_points_fini(&points);
        koksma_points_fini(&mapped);
    }
}
