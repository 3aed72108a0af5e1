/* SPDX-License-Identifier: Apache-2.0 */
/* The coherence of errors: white noise of many kinds stays within its stated interval for 95 % of seeds, a wave has
   the power that theory gives it, blue noise is not coherent and bands are, for pictures of any size. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>

#include "core/random.h"
#include "image/coherence.h"
#include "test.h"

/* ---- Errors -------------------------------------------------------------------------------------------- */

/* A random number of the law: 0 Gaussian, 1 Laplace, 2 a rare large one (skewed), 3 signs. */
static double draw(int law, uint64_t seed, uint64_t index)
{
    double u[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, index, 0, u);
    switch (law) {
    case 0:
        return sqrt(-2 * log1p(-u[0])) * cos(2 * M_PI * u[1]);
    case 1:
        return (u[1] < 0.5 ? -1 : 1) * log1p(-u[0]);
    case 2:
        return u[0] < 0.05 ? 19 : -1;
    default:
        return u[0] < 0.5 ? -1 : 1;
    }
}

/* Noise, larger in some places: 0 everywhere alike, 1 on a slanted edge only, 2 in a checkerboard of large squares.
 */
static double place(int where, int x, int y)
{
    return where == 0 ? 1 : where == 1 ? exp(-0.5 * pow((x - 0.7 * y - 9) / 2.0, 2)) : (x / 8 + y / 8) % 2;
}

typedef struct pictures {
    koksma_image image, reference;
} pictures;

static pictures make(int width, int height)
{
    pictures p;
    assert_ok(koksma_image_init(&p.image, width, height, 1));
    assert_ok(koksma_image_init(&p.reference, width, height, 1));
    for (int i = 0; i < width * height; i++) {
        p.reference.pixels[i] = 0.5F;
    }
    return p;
}

static void release(pictures *p)
{
    koksma_image_fini(&p->image);
    koksma_image_fini(&p->reference);
}

static void fill_noise(pictures *p, int law, int where, uint64_t seed)
{
    for (int y = 0; y < p->image.height; y++) {
        for (int x = 0; x < p->image.width; x++) {
            const int i = y * p->image.width + x;
            p->image.pixels[i] = (float)(0.5 + 0.125 * place(where, x, y) * draw(law, seed, (uint64_t)i));
        }
    }
}

static void add_wave(pictures *p, double u, double v, double amplitude)
{
    const int width = p->image.width, height = p->image.height;
    for (int i = 0; i < width * height; i++) {
        const double turn = u * (i % width) / width + v * (i / width) / height;
        p->image.pixels[i] += (float)(amplitude * cos(2 * M_PI * turn));
    }
}

static koksma_coherence_values find(const koksma_coherence *c)
{
    koksma_coherence_values values;
    koksma_coherence_find(c, &values);
    return values;
}

/* ---- Noise --------------------------------------------------------------------------------------------- */

/* How many of `seeds` series of images are in the interval, below it, above it and coherent. */
typedef struct counts {
    int in, above, coherent;
} counts;

static counts count(int width, int height, int images, int law, int where, int seeds)
{
    counts out = {0};
    pictures p = make(width, height);
    for (int s = 0; s < seeds; s++) {
        koksma_coherence c;
        assert_ok(koksma_coherence_init(&c, width, height));
        for (int k = 0; k < images; k++) {
            fill_noise(&p, law, where, (uint64_t)(1000 * s + k));
            assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
        }
        const koksma_coherence_values v = find(&c);
        out.in += v.coherence >= v.noise_low && v.coherence <= v.noise_high;
        out.above += v.coherence > v.noise_high;
        out.coherent += v.coherent;
        koksma_coherence_fini(&c);
    }
    release(&p);
    return out;
}

/* Gaussian noise: the interval is as wide as it says: 95 % of 400 are 380, standard deviation 4.4. */
TEST_CASE(noise_is_within_its_interval)
{
    static const int sizes[][3] = {{32, 24, 1}, {31, 23, 1}, {24, 16, 4}, {1, 199, 1}, {97, 1, 3}, {7, 5, 1}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const counts c = count(sizes[s][0], sizes[s][1], sizes[s][2], 0, 0, 400);
        assert_that(c.in >= 366 && c.in <= 396 && c.coherent <= 8,
                    "%d x %d, %d images: %d of 400 within, %d above, %d coherent", sizes[s][0], sizes[s][1],
                    sizes[s][2], c.in, c.above, c.coherent);
    }
}

/* Other laws, and noise on edges only: large peaks are no more likely than stated. 2.5 % of 200 are 5, SD 2.2. */
TEST_CASE(uneven_noise_is_not_coherent)
{
    for (int law = 0; law < 4; law++) {
        for (int where = 0; where < 3; where++) {
            for (int images = 1; images <= 4; images += 3) {
                const counts c = count(48, 32, images, law, where, 100);
                assert_that(c.above <= 9 && c.coherent <= 5,
                            "law %d, place %d, %d images: %d of 100 above, %d coherent", law, where, images, c.above,
                            c.coherent);
            }
        }
    }
}

/* The same noise again and again is as noisy as it is once. */
TEST_CASE(repeated_noise_is_not_coherent)
{
    pictures p = make(40, 30);
    for (uint64_t seed = 0; seed < 20; seed++) {
        koksma_coherence once, often;
        assert_ok(koksma_coherence_init(&once, 40, 30));
        assert_ok(koksma_coherence_init(&often, 40, 30));
        fill_noise(&p, 0, 0, seed);
        assert_ok(koksma_coherence_add(&once, &p.image, &p.reference));
        for (int k = 0; k < 16; k++) {
            assert_ok(koksma_coherence_add(&often, &p.image, &p.reference));
        }
        const koksma_coherence_values a = find(&once), b = find(&often);
        assert_near(a.coherence, b.coherence, 1e-12 * a.coherence);
        assert_near(b.common, 1, 1e-12);
        assert_near(b.low, b.high, 1e-6);
        assert_true(isnan(a.low) && isnan(a.high) && isnan(a.common));
        assert_near(a.noise_high, b.noise_high, 0.02 * a.noise_high);
        assert_true(!a.coherent || a.coherence > a.noise_high);
        koksma_coherence_fini(&once);
        koksma_coherence_fini(&often);
    }
    release(&p);
}

/* ---- Waves --------------------------------------------------------------------------------------------- */

/* A wave of amplitude A among noise of standard deviation s: mean power s^2 + A^2 / 2 and W H A^2 / 4 + s^2 in the
   peak, where it is. */
TEST_CASE(a_wave_has_its_power)
{
    static const struct {
        int width, height, u, v;
    } waves[] = {{64, 48, 5, 3}, {61, 47, 7, 44}, {30, 45, 14, 1}, {128, 1, 40, 0}, {1, 97, 0, 13}, {64, 48, 0, 9}};
    for (size_t w = 0; w < sizeof waves / sizeof *waves; w++) {
        const int width = waves[w].width, height = waves[w].height, n = width * height;
        const double noise = 0.125, amplitude = noise * sqrt(4 * 40.0 / n); /* 41 times the noise's power */
        const double expected =
            (n * amplitude * amplitude / 4 + noise * noise) / (noise * noise + amplitude * amplitude / 2);
        enum { IMAGES = 64 };
        koksma_coherence c;
        pictures p = make(width, height);
        assert_ok(koksma_coherence_init(&c, width, height));
        for (uint64_t k = 0; k < IMAGES; k++) {
            fill_noise(&p, 0, 0, 77 + k);
            add_wave(&p, waves[w].u, waves[w].v, amplitude);
            assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
        }
        const koksma_coherence_values v = find(&c);
        /* The power of one image has the variance 2 x 40 + 1 of a noncentral chi-squared, and the mean power's. */
        assert_near(v.coherence, expected, 4.5 * (sqrt(81.0 / IMAGES) + expected * sqrt(2.0 / n / IMAGES)) + 0.05);
        assert_true(v.low < expected + 0.5 && v.high > expected - 0.5);
        assert_true(v.coherent && v.p < 1e-9 && v.coherence > v.noise_high);
        const int up = 2 * waves[w].v > height ? height - waves[w].v : -waves[w].v;
        assert_near(v.frequency_x, (double)waves[w].u / width, 1e-12);
        assert_near(v.frequency_y, waves[w].u ? (double)up / height : fabs((double)up / height), 1e-12);
        koksma_coherence_fini(&c);
        release(&p);
    }
}

/* Only a wave: all power is in it and its mirror image, (n - 1) / 2 times the mean, or n - 1 where it has none. */
TEST_CASE(a_wave_alone_has_all_power)
{
    static const struct {
        int width, height;
        double u, v, share;
    } waves[] = {
        {64, 48, 5, 3, 0.5}, {64, 48, 32, 24, 1}, {64, 48, 0, 24, 1}, {13, 11, 6, 10, 0.5}, {1, 64, 0, 32, 1}};
    for (size_t w = 0; w < sizeof waves / sizeof *waves; w++) {
        const int n = waves[w].width * waves[w].height;
        koksma_coherence c;
        pictures p = make(waves[w].width, waves[w].height);
        assert_ok(koksma_coherence_init(&c, waves[w].width, waves[w].height));
        memcpy(p.image.pixels, p.reference.pixels, (size_t)n * sizeof *p.image.pixels);
        add_wave(&p, waves[w].u, waves[w].v, 0.25);
        assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
        const koksma_coherence_values v = find(&c);
        assert_near(v.coherence / (n - 1), waves[w].share, 1e-3); /* floats */
        assert_true(v.coherent);
        koksma_coherence_fini(&c);
        release(&p);
    }
}

/* A wave between the frequencies keeps (2/pi)^4 of its peak at worst. */
TEST_CASE(a_wave_between_frequencies_is_seen)
{
    koksma_coherence c;
    pictures p = make(96, 80);
    assert_ok(koksma_coherence_init(&c, 96, 80));
    memcpy(p.image.pixels, p.reference.pixels, 96 * 80 * sizeof *p.image.pixels);
    add_wave(&p, 20.5, 17.5, 0.25);
    assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
    assert_near(find(&c).coherence / (96 * 80 / 2.0), pow(2 / M_PI, 4), 0.01);
    koksma_coherence_fini(&c);
    release(&p);
}

/* ---- Colours of noise ---------------------------------------------------------------------------------- */

/* Noise minus a share of a weighted mean of its eight neighbours, which is nearly isotropic (the nine-point
   Laplacian): blue where the share is positive, red where it is negative. Periodic, so that its spectrum is what the
   filter says. */
static void fill_coloured(pictures *p, double share, uint64_t seed)
{
    const int width = p->image.width, height = p->image.height;
    static const double weights[3][3] = {{1, 4, 1}, {4, -20, 4}, {1, 4, 1}};
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            double e = 0;
            for (int k = 0; k < 9; k++) {
                const int column = (x + k % 3 - 1 + width) % width, row = (y + k / 3 - 1 + height) % height;
                const double weight = weights[k / 3][k % 3];
                e += (k == 4 ? 1 : -share * weight / 20) * draw(0, seed, (uint64_t)(row * width + column));
            }
            p->image.pixels[y * width + x] = (float)(0.5 + 0.0625 * e);
        }
    }
}

static koksma_coherence_values coloured(double share, int images, double wave)
{
    koksma_coherence c;
    pictures p = make(96, 64);
    assert_ok(koksma_coherence_init(&c, 96, 64));
    for (int k = 0; k < images; k++) {
        fill_coloured(&p, share, (uint64_t)(31 + k));
        add_wave(&p, 3, 2, wave);
        assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
    }
    const koksma_coherence_values v = find(&c);
    koksma_coherence_fini(&c);
    release(&p);
    return v;
}

/* The power of blue noise is up to 3 times the mean at high frequencies, and no coherence; a wave in it is one.
   Coarse noise is coherent: the eye sees it as blotches. */
TEST_CASE(blue_noise_is_not_coherent)
{
    for (int images = 1; images <= 16; images *= 4) {
        const koksma_coherence_values blue = coloured(1, images, 0), red = coloured(-0.9, images, 0);
        assert_false(blue.coherent);
        assert_true(coloured(1, images, 0.01).coherent);
        assert_true(red.coherent && hypot(red.frequency_x, red.frequency_y) < 0.25);
    }
}

/* ---- The rest ------------------------------------------------------------------------------------------ */

/* Neither the size of the error nor its mean nor its sign changes anything. */
TEST_CASE(scale_does_not_matter)
{
    static const double scales[] = {1, -0.25, 0x1p-60, 0x1p100};
    koksma_coherence_values first = {0};
    for (int k = 0; k < 4; k++) {
        koksma_coherence c;
        pictures p = make(37, 29);
        fill_noise(&p, 1, 1, 3);
        for (int i = 0; i < 37 * 29; i++) { /* exact: a power of two */
            const double e = (double)p.image.pixels[i] - 0.5;
            p.image.pixels[i] = (float)(scales[k] * e);
            p.reference.pixels[i] = k == 1 ? 2.0F : 0;
        }
        assert_ok(koksma_coherence_init(&c, 37, 29));
        assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
        const koksma_coherence_values v = find(&c);
        first = k ? first : v;
        assert_near(v.coherence, first.coherence, 1e-6 * first.coherence);
        assert_near(v.p, first.p, 1e-5 * first.p);
        koksma_coherence_fini(&c);
        release(&p);
    }
}

TEST_CASE(errors_without_structure_have_none)
{
    koksma_coherence c = {0};
    pictures p = make(9, 8);
    assert_int_equal(koksma_coherence_add(&c, &p.image, &p.reference), KOKSMA_ARGUMENT); /* no init */
    assert_ok(koksma_coherence_init(&c, 9, 8));
    koksma_coherence_values v = find(&c);
    assert_true(v.images == 0 && isnan(v.coherence) && isnan(v.p) && !v.coherent);
    assert_ok(koksma_coherence_add(&c, &p.reference, &p.reference)); /* no error */
    assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));     /* the same everywhere */
    assert_int_equal(find(&c).images, 0);
    fill_noise(&p, 0, 0, 1);
    assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
    assert_int_equal(find(&c).images, 1);
    p.image.pixels[17] = NAN;
    assert_int_equal(koksma_coherence_add(&c, &p.image, &p.reference), KOKSMA_MALFORMED);
    assert_int_equal(find(&c).images, 1);
    pictures other = make(8, 9);
    assert_int_equal(koksma_coherence_add(&c, &other.image, &other.reference), KOKSMA_ARGUMENT);
    koksma_coherence_fini(&c);
    assert_int_equal(koksma_coherence_init(&c, 0, 9), KOKSMA_ARGUMENT);
    koksma_coherence_fini(&c); /* nothing to free */
    koksma_coherence_fini(NULL);
    release(&other);
    release(&p);
    static const int small[][3] = {{1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {2, 2, 1}, {4, 1, 1}, {1, 5, 1}};
    for (size_t s = 0; s < sizeof small / sizeof *small; s++) { /* whether two frequencies can be compared */
        koksma_coherence_fini(&c);
        assert_ok(koksma_coherence_init(&c, small[s][0], small[s][1]));
        p = make(small[s][0], small[s][1]);
        fill_noise(&p, 0, 0, 4);
        assert_ok(koksma_coherence_add(&c, &p.image, &p.reference));
        v = find(&c);
        assert_int_equal(v.images, small[s][2]);
        assert_true(small[s][2] ? v.coherence >= 1 && v.p > 0 : isnan(v.coherence));
        release(&p);
    }
    koksma_coherence_fini(&c);
}

/* How large the peak of a white error's spectrum is by chance, against tables and closed forms. */
TEST_CASE(tails_are_the_known_ones)
{
    /* Fisher's table of 1929 at 5 %; his waves share one power: taken for independent, g is up to 1 % smaller. */
    const koksma__coherence_law five = {1, 5, 0, 0}, fifty = {1, 50, 0, 0};
    assert_near(koksma__coherence_quantile(&five, 0.05) / 5, 0.68377, 0.003);
    assert_near(koksma__coherence_quantile(&fifty, 0.05) / 50, 0.13135, 0.0005);
    /* One wave of T images without anything in common: chi-squared of 2 T degrees over 2 T; 18.307 = chi2_10 at 5 %.
     */
    const koksma__coherence_law one = {5, 1, 0, 0}, same = {5, 1, 0, 1};
    assert_near(koksma__coherence_quantile(&one, 0.05), 18.307038 / 10, 1e-6);
    /* All power at one frequency is the most that there can be: it has the probability 0, and not -0. */
    assert_true(koksma__coherence_tail(&five, 5) == 0 && !signbit(koksma__coherence_tail(&five, 5)));
    /* All in common: exponential. */
    assert_near(koksma__coherence_tail(&same, 3), exp(-3), 1e-12);
    /* A frequency that is its own mirror image: chi-squared of 1 degree, 3.841459 at 5 %; of T images of T degrees.
     */
    const koksma__coherence_law own = {5, 0, 1, 1}, own_free = {10, 0, 1, 0};
    assert_near(koksma__coherence_quantile(&own, 0.05), 3.8414588, 1e-6);
    assert_near(koksma__coherence_quantile(&own_free, 0.05), 18.307038 / 10, 1e-6);
    /* Between: two images with r in common are 1 + r and 1 - r times an exponential each (their difference's law). */
    const double r = 0.3, a = (1 + r) / 2, b = (1 - r) / 2, x = 4;
    const koksma__coherence_law two = {2, 1, 0, r};
    assert_near(koksma__coherence_tail(&two, x), (a * exp(-x / a) - b * exp(-x / b)) / (a - b), 1e-12);
    /* Continuous in what is common, also for thousands of images, and falling in x. */
    for (size_t images = 2; images <= 5000; images = 7 * images + 3) {
        double before = 0;
        for (double common = 0; common <= 1; common = common == 0 ? 1e-12 : common < 0.5 ? 4 * common : 2 * common) {
            const koksma__coherence_law law = {images, 6000, 3, fmin(common, 1)};
            const double level = koksma__coherence_quantile(&law, 0.05);
            assert_true(isfinite(level) && level > before - 1e-9);
            assert_near(koksma__coherence_tail(&law, level), 0.05, 1e-7);
            before = level;
        }
    }
}
