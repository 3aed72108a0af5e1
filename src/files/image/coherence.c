/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The coherence of an image's error: the peak of the error's power spectrum divided by the spectrum's mean. Shirley
 * 1991 (5.5.6): "it is the regularity of the error, rather than its magnitude, that is objectionable"; Mitchell 1992
 * warns of the Moire patterns of the Zaremba points. The spectrum of white noise is flat, and that of good dithering
 * rises with the frequency (Ulichney 1987; Georgiev & Fajardo 2016 and Heitz & Belcour 2019 aim at such spectra of
 * rendering errors); the spectra of bands and Moire patterns have peaks. Fisher's test of 1929 (below)
 * decides whether a peak of a periodogram is significant; here it is applied to all frequencies of an image, or of
 * the mean spectrum of several images.
 *
 * How the peak becomes a fair test:
 * - The peak is that of a single frequency, without window or smoothing. Errors are large at edges and small
 *   elsewhere: they are noise whose variance differs between pixels. The power of such noise is still exponentially
 *   distributed at each frequency, but neighbouring frequencies are correlated, so that the distribution of a smoothed
 *   or windowed spectrum depends on the scene. The price is that a wave half-way between two frequencies in both
 *   directions keeps (2/pi)^4 = 0.16 of its peak; the mean over all waves is 0.6.
 * - Each image's power is divided by its own mean before the images are averaged, so that all images have the same
 *   weight.
 * - Blue noise is not coherent: the power P of a frequency is divided by the power of its ring where that is above 1.
 *   The rings have equal areas (16, or fewer so that each has 64 frequencies). The power of a ring is the mean of P in
 *   it, where a power above the largest that noise would have counts only as that largest power (found in ROUNDS
 *   rounds). These means are then made nondecreasing in frequency (isotonic regression by pooling adjacent violators,
 *   Ayer et al. 1955). The power of a ring is thus at most that of the next ring, and an excess at low frequencies
 *   counts as coherence: coarse errors, which the eye sees best, are never divided out.
 * - The share r of the error that T images have in common follows from z, the errors divided by their standard
 *   deviations and summed over the images: |sum z|^2 / n = T + T (T - 1) r.
 *
 * Sums are in index order. Errors whose standard deviation is below 1e-12 of the largest error count as 0, because
 * they are rounding.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/series.h>

#include "core/elementary.h"
#include "core/status.h"
#include "core/sum.h"
#include "image/coherence.h"
#include "image/fourier.h"
#include "image/image.h"
#include "stats/stats.h"

enum { MAX_RINGS = 16, RING_FREQUENCIES = 64, ROUNDS = 4 };

static size_t pixels_of(const koksma_coherence *c)
{
    return (size_t)c->width * (size_t)c->height;
}

static size_t powers_of(const koksma_coherence *c)
{
    return koksma__fourier_columns(c->width) * (size_t)c->height;
}

static koksma_status check_open(const koksma_coherence *c)
{
    return c->error && c->power && c->squares && !koksma__image_check_shape(c->width, c->height, 1)
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_ARGUMENT, "coherence: koksma_coherence_init comes first");
}

koksma_status koksma_coherence_init(koksma_coherence *coherence, int width, int height)
{
    KOKSMA__REQUIRE(coherence);
    *coherence = (koksma_coherence){0};
    KOKSMA__TRY(koksma__image_check_shape(width, height, 1));
    coherence->width = width;
    coherence->height = height;
    const size_t doubles = pixels_of(coherence) + 2 * powers_of(coherence);
    coherence->error = calloc(doubles, sizeof *coherence->error);
    if (!coherence->error) {
        *coherence = (koksma_coherence){0};
        return koksma__fail_memory(doubles * sizeof *coherence->error);
    }
    coherence->power = coherence->error + pixels_of(coherence);
    coherence->squares = coherence->power + powers_of(coherence);
    return KOKSMA_OK;
}

void koksma_coherence_fini(koksma_coherence *coherence)
{
    if (coherence) {
        free(coherence->error);
        *coherence = (koksma_coherence){0};
    }
}

/* ---- Frequencies --------------------------------------------------------------------------------------- */

/* The weight of frequency (u, v) in sums over the stored half of the spectrum. 0: the mean (0, 0), or a frequency
   whose mirror image has been counted before; 1: a frequency that is its own mirror image; 2: one that also counts
   for its mirror image. */
static int weight_of(const koksma_coherence *c, size_t u, size_t v)
{
    const size_t width = (size_t)c->width, height = (size_t)c->height;
    if (u > 0 && 2 * u < width) {
        return 2;
    }
    if (2 * v > height || (u == 0 && v == 0)) {
        return 0;
    }
    return v == 0 || 2 * v == height ? 1 : 2;
}

static double signed_frequency(size_t v, int height)
{
    return (2 * v > (size_t)height ? (double)v - height : (double)v) / height;
}

/* Returns the fraction of the area of the square of frequencies, [-1/2, 1/2]^2, that lies within distance f of 0. */
static double share_within(double f)
{
    const double square = f * f;
    if (f <= 0.5) {
        return M_PI * square;
    }
    return fmin(M_PI * square - 4 * (square * koksma__acos(0.5 / f) - 0.5 * sqrt(square - 0.25)), 1);
}

static size_t ring_of(const koksma_coherence *c, size_t u, size_t v, size_t rings)
{
    const double f = koksma__hypot((double)u / c->width, signed_frequency(v, c->height));
    const size_t ring = (size_t)((double)rings * share_within(fmin(f, 0.70710678118654752)));
    return ring < rings ? ring : rings - 1;
}

/* ---- Adding -------------------------------------------------------------------------------------------- */

/* Subtracts the mean of the errors and divides them by their standard deviation. *even is set if all errors are
   equal. */
static koksma_status standardise(const koksma_coherence *c, double *errors, bool *even)
{
    const size_t n = pixels_of(c);
    koksma__sum sum = {0}, squares = {0};
    double largest = 0;
    for (size_t i = 0; i < n; i++) {
        KOKSMA__FAIL_IF(!isfinite(errors[i]), KOKSMA_MALFORMED,
                        "pixel %zu,%zu of an image or its reference is not a finite number", i % (size_t)c->width,
                        i / (size_t)c->width);
        largest = fmax(largest, fabs(errors[i]));
    }
    const double scale = largest > 0 ? 1 / largest : 1; /* scaled so that squares neither overflow nor underflow */
    for (size_t i = 0; i < n; i++) {
        errors[i] *= scale;
        koksma__sum_add(&sum, errors[i]);
    }
    const double mean = koksma__sum_value(&sum) / (double)n;
    for (size_t i = 0; i < n; i++) {
        errors[i] -= mean;
        koksma__sum_add(&squares, errors[i] * errors[i]);
    }
    const double sd = sqrt(koksma__sum_value(&squares) / (double)n);
    *even = !(sd > 1e-12);
    for (size_t i = 0; !*even && i < n; i++) {
        errors[i] /= sd;
    }
    return KOKSMA_OK;
}

/* Adds a spectrum, scaled to mean power 1 over all frequencies but (0, 0). By Parseval's theorem the unscaled mean is
   n^2 / (n - 1), as the mean squared error is 1. The power at (0, 0) is only rounding, and is left out. */
static void add_power(koksma_coherence *c, const double *errors, const double *power)
{
    const size_t n = pixels_of(c), n_powers = powers_of(c);
    const double scale = ((double)n - 1) / ((double)n * (double)n), before = (double)c->images++;
    for (size_t i = 0; i < n; i++) {
        c->error[i] += errors[i];
    }
    for (size_t i = 0; i < n_powers; i++) {
        const double p = power[i] * scale;
        c->power[i] = (c->power[i] * before + p) / (before + 1);
        c->squares[i] = (c->squares[i] * before + p * p) / (before + 1);
    }
}

koksma_status koksma__coherence_add_errors(koksma_coherence *coherence, double *errors)
{
    double *power = malloc(powers_of(coherence) * sizeof *power);
    KOKSMA__REQUIRE_MEMORY(power, powers_of(coherence) * sizeof *power);
    bool even = false;
    koksma_status status = standardise(coherence, errors, &even);
    if (!status && !even) {
        status = koksma__fourier_power(coherence->width, coherence->height, errors, power);
        if (!status) {
            add_power(coherence, errors, power);
        }
    }
    free(power);
    return status;
}

koksma_status koksma_coherence_add(koksma_coherence *coherence, const koksma_image *image,
                                   const koksma_image *reference)
{
    KOKSMA__REQUIRE(coherence, image, reference);
    KOKSMA__TRY(check_open(coherence));
    const koksma_image *const both[] = {image, reference};
    for (int i = 0; i < 2; i++) {
        KOKSMA__TRY(koksma__image_usable(both[i]));
        KOKSMA__FAIL_IF(both[i]->width != coherence->width || both[i]->height != coherence->height, KOKSMA_ARGUMENT,
                        "%s of %d x %d pixels does not fit a coherence of %d x %d", i ? "a reference" : "an image",
                        both[i]->width, both[i]->height, coherence->width, coherence->height);
    }
    const size_t n = pixels_of(coherence);
    double *errors = malloc(n * sizeof *errors);
    KOKSMA__REQUIRE_MEMORY(errors, n * sizeof *errors);
    for (size_t i = 0; i < n; i++) {
        errors[i] = koksma__luminance(image, i) - koksma__luminance(reference, i);
    }
    const koksma_status status = koksma__coherence_add_errors(coherence, errors);
    free(errors);
    return status;
}

/* ---- The law --------------------------------------------------------------------------------------------- */

/*
 * The distribution of the peak of the spectrum of white noise: how large a peak arises by chance.
 *
 * One image: the spectrum of white noise of n pixels has n - 1 degrees of freedom: 2 at each frequency with a mirror
 * image ("wave"), and 1 at each of up to three frequencies that are their own mirror images (alternating columns,
 * rows or both). The power of a wave, divided by the mean power of all frequencies, exceeds x with probability
 * (Fisher 1929)
 *
 *     (1 - 2 x / (n - 1))^((n - 3) / 2),   nearly exp(-x).
 *
 * T images: the power is the mean of T powers. A share r of the squared error may be the same in all images, for
 * example where all use the same pattern; then the amplitudes of the T images have the covariance matrix (1 - r) I +
 * r 1 1', which has one eigenvalue 1 + (T - 1) r and T - 1 eigenvalues 1 - r; the mean power is
 *
 *     a X + b G,   a = (1 + (T - 1) r) / T,  b = (1 - r) / T,  X exponential, G gamma distributed with shape T - 1,
 *
 *     P(a X + b G > x) = Q(T - 1, x / b) + exp(-x / a) (1 - b / a)^(1 - T) P(T - 1, (x / b) (1 - b / a))
 *
 * with the regularised incomplete gamma functions P and Q = 1 - P. For r = 0 this is a gamma distribution of shape T;
 * for r = 1 it is the distribution of one image. The power of the few frequencies without a mirror image is
 * approximated by a gamma distribution of mean 1 and twice the variance of a wave's power, so of shape 1 / (2 a^2 + 2
 * (T - 1) b^2).
 *
 * The distribution of the largest power assumes that powers at different frequencies are independent, which holds for
 * Gaussian noise. If errors are independent but not Gaussian, or larger in some pixels than in others, the power has
 * the same distribution at each frequency (for large n), but powers at neighbouring frequencies are dependent. The
 * probability that the largest power exceeds x is then at most the sum over all frequencies of the probability that
 * the power there exceeds x. If the probability computed here is 0.05, the sum is larger by a factor of 1.026; for
 * smaller probabilities the factor is smaller.
 */
enum { TERMS = 1000000, HALVINGS = 200 };

/* The sum of x^j / ((k + 1) ... (k + j)) over j >= 0, for x up to about k + 1. */
static double series(double k, double x)
{
    double term = 1, sum = 1;
    for (int j = 1; j < TERMS && term > 1e-17 * sum; j++) {
        term *= x / (k + j);
        sum += term;
    }
    return sum;
}

/* The logarithm of P(k, x) for x up to about k + 1, by the series 6.5.29 of Abramowitz & Stegun 1964. */
static double log_series(double k, double x)
{
    return k * koksma__log(x) - x - koksma__log_gamma(k + 1) + koksma__log(series(k, x));
}

/* Q(k, x) for x above k + 1, by Lentz's method on the continued fraction 6.5.31 of Abramowitz & Stegun. */
static double upper_fraction(double k, double x)
{
    double b = x + 1 - k, c = 1e300, d = 1 / b, f = d;
    for (int j = 1; j < TERMS; j++) {
        const double a = -j * (j - k);
        b += 2;
        d = a * d + b;
        d = 1 / (fabs(d) < 1e-300 ? 1e-300 : d);
        c = b + a / c;
        c = fabs(c) < 1e-300 ? 1e-300 : c;
        f *= d * c;
        if (fabs(d * c - 1) < 1e-15) {
            break;
        }
    }
    return koksma__exp(k * koksma__log(x) - x - koksma__log_gamma(k)) * f;
}

static double upper_gamma(double k, double x)
{
    return x <= 0 ? 1 : x < k + 1 ? 0 - koksma__expm1(log_series(k, x)) : upper_fraction(k, x);
}

/* Returns the probability that the power at one frequency with a mirror image exceeds x. */
static double wave_tail(const koksma__coherence_law *law, double x)
{
    const double images = (double)law->images, free = 2 * (double)law->waves + (double)law->real;
    if (x <= 0) {
        return 1;
    }
    if (law->images == 1) {
        return 2 * x >= free ? 0 : koksma__exp((free / 2 - 1) * koksma__log1p(-2 * x / free));
    }
    const double a = (1 + (images - 1) * law->common) / images, b = (1 - law->common) / images;
    if (b < 1e-9 * a) {
        return koksma__exp(-x / a);
    }
    const double k = images - 1, z = x / b, rest = 1 - b / a, y = z * rest;
    if (y < k + 1) { /* (1 - b/a)^-k and y^k are multiplied as logarithms, as each may overflow alone */
        return upper_gamma(k, z) + series(k, y) * koksma__exp(k * koksma__log(z) - z - koksma__log_gamma(k + 1));
    }
    return upper_gamma(k, z) + koksma__exp(-x / a - k * koksma__log(rest)) * (1 - upper_fraction(k, y));
}

/* Returns the probability that the power at one frequency without a mirror image exceeds x. */
static double real_tail(const koksma__coherence_law *law, double x)
{
    const double images = (double)law->images;
    const double a = (1 + (images - 1) * law->common) / images, b = (1 - law->common) / images;
    const double shape = 0.5 / (a * a + (images - 1) * b * b);
    return upper_gamma(shape, shape * x);
}

double koksma__coherence_tail(const koksma__coherence_law *law, double x)
{
    double log_below = 0;
    if (law->waves) {
        log_below += (double)law->waves * koksma__log1p(-fmin(wave_tail(law, x), 1));
    }
    if (law->real) {
        log_below += (double)law->real * koksma__log1p(-fmin(real_tail(law, x), 1));
    }
    return 0 - koksma__expm1(log_below); /* not -0 */
}

double koksma__coherence_quantile(const koksma__coherence_law *law, double tail)
{
    double lo = 0, hi = 1;
    while (koksma__coherence_tail(law, hi) > tail && hi < 1e15) {
        lo = hi;
        hi *= 2;
    }
    for (int i = 0; i < HALVINGS && hi - lo > 1e-12 * hi; i++) {
        const double middle = 0.5 * (lo + hi);
        if (koksma__coherence_tail(law, middle) > tail) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return 0.5 * (lo + hi);
}

/* ---- The peak ------------------------------------------------------------------------------------------ */

/* The numbers of frequencies with and without a mirror image, and the power of each ring, nondecreasing and at
   least 1. */
typedef struct rings {
    size_t n, waves, real;
    double power[MAX_RINGS];
} rings;

/* Pool adjacent violators: merges neighbours that decrease, from the left, until none do. */
static void make_nondecreasing(size_t n, const double *sums, const double *counts, double *out)
{
    double sum[MAX_RINGS], count[MAX_RINGS];
    size_t members[MAX_RINGS], pools = 0;
    for (size_t r = 0; r < n; r++) {
        sum[pools] = sums[r];
        count[pools] = counts[r];
        members[pools++] = 1;
        while (pools > 1 && sum[pools - 2] * count[pools - 1] >= sum[pools - 1] * count[pools - 2]) {
            pools--;
            sum[pools - 1] += sum[pools];
            count[pools - 1] += count[pools];
            members[pools - 1] += members[pools];
        }
    }
    for (size_t p = 0, r = 0; p < pools; p++) {
        for (const size_t end = r + members[p]; r < end; r++) {
            out[r] = count[p] > 0 ? sum[p] / count[p] : 0;
        }
    }
}

static void count_frequencies(const koksma_coherence *c, rings *out)
{
    *out = (rings){0};
    for (size_t v = 0; v < (size_t)c->height; v++) {
        for (size_t u = 0; u < koksma__fourier_columns(c->width); u++) {
            const int weight = weight_of(c, u, v);
            out->waves += weight == 2;
            out->real += weight == 1;
        }
    }
    const size_t n = out->waves / RING_FREQUENCIES;
    out->n = n < 1 ? 1 : n < MAX_RINGS ? n : MAX_RINGS;
}

/* Computes the mean power of each ring in several rounds. A power above `most` times the mean of the previous round
   counts as `most` times that mean. */
static void find_rings(const koksma_coherence *c, double most, rings *out)
{
    const size_t columns = koksma__fourier_columns(c->width);
    double sums[MAX_RINGS], counts[MAX_RINGS], cap[MAX_RINGS];
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t r = 0; r < out->n; r++) {
            cap[r] = round && counts[r] > 0 ? most * sums[r] / counts[r] : (double)INFINITY;
        }
        memset(sums, 0, sizeof sums);
        memset(counts, 0, sizeof counts);
        for (size_t v = 0; v < (size_t)c->height; v++) {
            for (size_t u = 0; u < columns; u++) {
                const int weight = weight_of(c, u, v);
                if (weight) {
                    const size_t ring = ring_of(c, u, v, out->n);
                    sums[ring] += weight * fmin(c->power[v * columns + u], cap[ring]);
                    counts[ring] += weight;
                }
            }
        }
    }
    make_nondecreasing(out->n, sums, counts, out->power);
    for (size_t r = 0; r < out->n; r++) {
        out->power[r] = fmax(out->power[r], 1);
    }
}

/* Returns the share of the squared errors that is common to all images. */
static double find_common(const koksma_coherence *c)
{
    const double images = (double)c->images;
    koksma__sum sum = {0};
    for (size_t i = 0; i < pixels_of(c); i++) {
        koksma__sum_add(&sum, c->error[i] * c->error[i]);
    }
    const double share = (koksma__sum_value(&sum) / (double)pixels_of(c) - images) / (images * (images - 1));
    return fmin(fmax(share, 0), 1);
}

static void find_peak(const koksma_coherence *c, const rings *r, koksma_coherence_values *out)
{
    const size_t columns = koksma__fourier_columns(c->width);
    size_t peak = 0;
    double excused = 1;
    out->coherence = 0;
    for (size_t v = 0; v < (size_t)c->height; v++) {
        for (size_t u = 0; u < columns; u++) {
            const size_t i = v * columns + u;
            /* only a power above the maximum so far can raise the maximum, because each power is divided by that of
               its ring, which is 1 or more */
            if (weight_of(c, u, v) && c->power[i] > out->coherence) {
                const double ring = r->power[ring_of(c, u, v, r->n)];
                if (c->power[i] / ring > out->coherence) {
                    out->coherence = c->power[i] / ring;
                    excused = ring;
                    peak = i;
                }
            }
        }
    }
    const double y = signed_frequency(peak / columns, c->height);
    out->frequency_x = (double)(peak % columns) / c->width;
    out->frequency_y = peak % columns == 0 ? fabs(y) : y == 0 ? 0 : -y; /* -y, because rows are counted downwards */
    if (c->images > 1) {
        const double images = (double)c->images, mean = c->power[peak];
        const double variance = fmax(c->squares[peak] - mean * mean, 0) * images / (images - 1);
        const double half = koksma_student_975(c->images - 1) * sqrt(variance / images);
        out->low = fmax(mean - half, 0) / excused;
        out->high = (mean + half) / excused;
    }
}

void koksma_coherence_find(const koksma_coherence *coherence, koksma_coherence_values *out)
{
    KOKSMA__REQUIRE_OR(, coherence, out);
    *out = (koksma_coherence_values){0};
    out->coherence = out->low = out->high = out->frequency_x = out->frequency_y = NAN;
    out->common = out->noise_low = out->noise_high = out->p = NAN;
    rings r;
    if (coherence->images == 0 || check_open(coherence)) {
        return;
    }
    count_frequencies(coherence, &r);
    if (r.waves + r.real < 2) {
        return;
    }
    out->images = coherence->images;
    out->common = coherence->images > 1 ? find_common(coherence) : (double)NAN;
    const koksma__coherence_law law = {.images = coherence->images,
                                       .waves = r.waves,
                                       .real = r.real,
                                       .common = coherence->images > 1 ? out->common : 1};
    out->noise_low = koksma__coherence_quantile(&law, 0.975);
    out->noise_high = koksma__coherence_quantile(&law, 0.025);
    find_rings(coherence, out->noise_high, &r);
    find_peak(coherence, &r, out);
    out->p = koksma__coherence_tail(&law, out->coherence);
    out->coherent = out->p < KOKSMA_COHERENT_P && out->coherence >= KOKSMA_COHERENT_LEAST;
}
