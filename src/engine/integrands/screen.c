/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Errors over a screen: how much of the error of a pattern's pixels a filter over the screen leaves.
 *
 * An image of side x side pixels estimates one integral in each pixel by spp samples. Its errors e have the mean square
 * P; those after the filter with weights w, sum w = 1, the mean square B. Errors without correlation between pixels
 * (white noise) have B = P sum w^2. For each integrand the mean squares are averaged over T images with different
 * seeds, and over F integrands
 *
 *     blurred = sqrt(1/F sum B / (P sum w^2))        1 for white noise
 *     plain   = sqrt(1/F sum P spp / variance)       1 for random points
 *
 * without the integrands whose errors are all 0. B is a mean over the pixels whose window lies within the image, so that
 * an image has no seam. Standard errors are those of the jackknife over the images, because the pixels of an image
 * depend on each other.
 *
 * The integrands of k of the coordinates, which are random: FAMILIES families of EACH, with random parameters from a
 * fixed seed: steps and ramps max(0, c - a.x) along a random direction through a random point, indicators of boxes,
 * products of linear functions, and the six families of Genz (1984). Integrals and variances have closed forms; those of
 * steps and ramps are the volumes of simplices over the corners v of the cube (a > 0 after reflections):
 *
 *     integral (c - a.x)_+^p = p! / ((p + k)! prod a) sum_v (-1)^|v| (c - a.v)_+^(p + k)
 *
 * A pattern of fewer dimensions fills the coordinates group by group, each with another seed and, from the second on,
 * with the samples of each pixel in a random order, as a renderer combines them.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "integrands/integrands.h"
#include "patterns/masks/tile_size.h"

enum { FAMILIES = 10, EACH = 10, FUNCTIONS = FAMILIES * EACH, PIXELS = 64 };
enum { STEP, RAMP, BOX, PRODUCT, GENZ };

static const char *const genz[] = {"genz-oscillatory", "genz-product-peak", "genz-corner-peak",
                                   "genz-gaussian",    "genz-continuous",   "genz-discontinuous"};

/* ---- Integrands -------------------------------------------------------------------------------------------- */

typedef struct function {
    int family, k, axes[KOKSMA_SCREEN_MAX_DIM]; /* it depends on the coordinates axes[0] .. axes[k - 1] */
    double a[KOKSMA_SCREEN_MAX_DIM], c, mean, variance;
    koksma_integral *integral; /* of Genz; otherwise NULL */
} function;

static double value(const function *f, const double *x)
{
    double y[KOKSMA_SCREEN_MAX_DIM] = {0}, sum = -f->c, product = 1;
    for (int i = 0; i < f->k; i++) {
        y[i] = x[f->axes[i]];
        sum += f->a[i] * y[i];
    }
    switch (f->family) {
    case STEP:
        return sum < 0;
    case RAMP:
        return sum < 0 ? -sum : 0;
    case BOX:
        for (int i = 0; i < f->k; i++) {
            product *= y[i] < f->a[i];
        }
        return product;
    case PRODUCT:
        for (int i = 0; i < f->k; i++) {
            product *= 2 * y[i] - 1 + f->a[i];
        }
        return product;
    default:
        return f->integral->integrand->at(f->integral, y);
    }
}

/* The integral of (c - a.x)_+^p over the cube. */
static double simplex(const function *f, int p)
{
    double c = f->c, divisor = 1, sum = 0;
    for (int i = 0; i < f->k; i++) {
        c -= fmin(f->a[i], 0);
        divisor *= fabs(f->a[i]) * (p + i + 1);
    }
    for (int v = 0; v < 1 << f->k; v++) {
        double rest = c, term = 1;
        for (int i = 0; i < f->k; i++) {
            rest -= v >> i & 1 ? fabs(f->a[i]) : 0;
            term = v >> i & 1 ? -term : term;
        }
        for (int i = 0; i < p + f->k; i++) {
            term *= rest;
        }
        sum += rest > 0 ? term : 0;
    }
    return sum / divisor;
}

/* Draws a unit vector whose components are at least .05 in size, and a random point: c = a.point. */
static void draw_direction(function *f, uint64_t seed)
{
    double least = 0;
    for (uint32_t attempt = 0; least < 0.05; attempt++) {
        double square = 0;
        f->c = 0;
        for (int i = 0; i < f->k; i++) {
            double pair[2];
            koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, attempt, (uint32_t)i, pair);
            f->a[i] = sqrt(-2 * koksma__log(1 - pair[0])) *
                      koksma__cos(2 * 3.141592653589793 * pair[1]); /* a normal number */
            square += f->a[i] * f->a[i];
        }
        least = 1;
        for (int i = 0; i < f->k; i++) {
            double pair[2];
            koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, attempt, (uint32_t)(f->k + i), pair);
            f->a[i] /= sqrt(square);
            f->c += f->a[i] * pair[0];
            least = fmin(least, fabs(f->a[i]));
        }
    }
}

static koksma_status make_genz(function *f, uint64_t seed)
{
    char spec[64];
    koksma_integral_facts facts;
    snprintf(spec, sizeof spec, "%s:seed=%u", genz[f->family - GENZ], (unsigned)(seed >> 40));
    KOKSMA__TRY(koksma_integral_open(spec, f->k, &f->integral));
    koksma_integral_about(f->integral, &facts);
    f->mean = facts.value;
    f->variance = facts.variance;
    return KOKSMA_OK;
}

static koksma_status make_function(function *f, int number, int k, int dim)
{
    const uint64_t seed = koksma__random_seed(0x5c4ee, (uint64_t)(FUNCTIONS * k + number), (uint32_t)dim);
    double square = 1;
    *f = (function){.family = number % FAMILIES, .k = k, .mean = 1};
    int left = k, n = 0;
    for (int axis = 0; axis < dim; axis++) {
        double pair[2];
        koksma__random_pair(seed, KOKSMA__PURPOSE_SHUFFLE, (uint64_t)axis, 0, pair);
        if (pair[0] * (dim - axis) < left) {
            left--;
            f->a[n] = f->family == BOX ? 0.3 + 0.7 * pair[1] : 2 * pair[1] - 1;
            f->axes[n++] = axis;
        }
    }
    if (f->family >= GENZ) {
        return make_genz(f, seed);
    }
    if (f->family == STEP || f->family == RAMP) {
        draw_direction(f, seed);
        f->mean = simplex(f, f->family == RAMP);
        square = f->family == RAMP ? simplex(f, 2) : f->mean;
    } else {
        for (int i = 0; i < k; i++) {
            f->mean *= f->a[i];
            square *= f->family == BOX ? f->a[i] : 1 / 3.0 + f->a[i] * f->a[i];
        }
    }
    f->variance = square - f->mean * f->mean;
    return KOKSMA_OK;
}

/* ---- Samples ----------------------------------------------------------------------------------------------- */

typedef struct screen {
    const koksma_screen_options *options;
    koksma_spec pattern;
    size_t pixels, tile[2]; /* tile: of a pattern by masks; 0 x 0: none */
    bool whole;             /* one set of the pattern has all pixels */
    int given;              /* number of coordinates that a set gives */
    function *functions;
    double *xs, *estimates;  /* samples of an image; of each function, an image of errors */
    double *plain, *blurred; /* mean squares of each trial and function */
    double squares;          /* sum of the squares of the weights */
    uint64_t trial;
    koksma_points set; /* of all pixels, or of the tile */
    int first;         /* the coordinate that the set's first becomes */
} screen;

/* Copies samples of a pixel. From the second group of coordinates on they are in a random order. */
static void place(const screen *s, size_t pixel, const double *from, int dim)
{
    const size_t spp = s->options->spp;
    const int all = s->options->dim, n = all - s->first < s->given ? all - s->first : s->given;
    double *to = s->xs + pixel * spp * (size_t)all + s->first;
    for (size_t i = 0; i < spp; i++) {
        size_t from_sample = i;
        if (s->first) { /* inside-out shuffle: sample i goes to a random place among those so far */
            const koksma__words r = koksma__random(s->options->seed + s->trial, KOKSMA__PURPOSE_SHUFFLE,
                                                   pixel * spp + i, (uint32_t)s->first);
            from_sample = koksma__below(r.w[0], (uint32_t)i + 1);
            memcpy(to + i * (size_t)all, to + from_sample * (size_t)all, (size_t)n * sizeof *to);
        }
        memcpy(to + from_sample * (size_t)all, from + i * (size_t)dim, (size_t)n * sizeof *to);
    }
}

static koksma_status fill_pixels(void *context, size_t block)
{
    const screen *s = context;
    const size_t spp = s->options->spp, end = (block + 1) * PIXELS < s->pixels ? (block + 1) * PIXELS : s->pixels;
    const size_t side = (size_t)s->options->side;
    const koksma_run alone = {.threads = 1};
    koksma_points own = {0};
    koksma_status status = s->set.xs ? KOKSMA_OK : koksma_points_init(&own, spp, s->set.dim);
    for (size_t p = block * PIXELS; p < end && !status; p++) {
        const size_t x = p % side, y = p / side;
        if (s->set.xs) {
            const size_t at = s->tile[0] ? y % s->tile[1] * s->tile[0] + x % s->tile[0] : p;
            place(s, p, s->set.xs + at * spp * (size_t)s->set.dim, s->set.dim);
        } else {
            const uint64_t seed = koksma__random_seed(s->options->seed + s->trial, p, (uint32_t)s->first);
            status = koksma_generate(&s->pattern, seed, &alone, &own);
            if (!status) {
                place(s, p, own.xs, own.dim);
            }
        }
    }
    koksma_points_fini(&own);
    return status;
}

static koksma_status make_samples(screen *s, const koksma_run *run)
{
    const int least = s->pattern.pattern->min_dim, most = s->pattern.pattern->max_dim;
    const size_t cells = s->tile[0] ? s->tile[0] * s->tile[1] : s->whole ? s->pixels : 0;
    const uint64_t seed = s->options->seed + s->trial;
    koksma_status status = KOKSMA_OK;
    for (s->first = 0; s->first < s->options->dim && !status; s->first += s->given) {
        const int left = s->options->dim - s->first, wanted = left > most ? most : left;
        s->given = wanted;
        s->set = (koksma_points){.dim = wanted < least ? least : wanted};
        if (cells) {
            status = koksma_points_init(&s->set, cells * s->options->spp, s->set.dim);
            status = status ? status
                            : koksma_generate(&s->pattern,
                                              s->first ? koksma__random_seed(seed, 0, (uint32_t)s->first) : seed, run,
                                              &s->set);
        }
        status = status ? status : koksma__parallel(run, (s->pixels + PIXELS - 1) / PIXELS, fill_pixels, s);
        koksma_points_fini(&s->set);
    }
    return status;
}

/* ---- Errors ------------------------------------------------------------------------------------------------ */

/* The mean square of the filtered errors. */
static double filtered(const screen *s, const double *errors)
{
    const koksma_mask_filter *w = &s->options->filter;
    const int side = s->options->side, columns = side - w->width + 1, rows = side - w->height + 1;
    double sum = 0;
    for (int y = 0; y < rows; y++) {
        for (int x = 0; x < columns; x++) {
            double mean = 0;
            for (int v = 0; v < w->height; v++) {
                for (int u = 0; u < w->width; u++) {
                    mean += w->weights[v * w->width + u] * errors[(y + v) * side + x + u];
                }
            }
            sum += mean * mean;
        }
    }
    return sum / (rows * columns);
}

static koksma_status measure_function(void *context, size_t number)
{
    const screen *s = context;
    const function *f = &s->functions[number];
    const size_t spp = s->options->spp, all = (size_t)s->options->dim;
    const size_t place_of = s->trial * (size_t)s->options->dim * FUNCTIONS + number;
    double *errors = s->estimates + number * s->pixels, sum = 0;
    for (size_t p = 0; p < s->pixels; p++) {
        double total = 0;
        for (size_t i = 0; i < spp; i++) {
            total += value(f, s->xs + (p * spp + i) * all);
        }
        errors[p] = total / (double)spp - f->mean;
        sum += errors[p] * errors[p];
    }
    s->plain[place_of] = sum / (double)s->pixels;
    s->blurred[place_of] = filtered(s, errors);
    return KOKSMA_OK;
}

/* The two results for the functions of k coordinates without image `left_out`; trials: none is left out. */
static void results_without(const screen *s, int k, uint64_t left_out, double results[2])
{
    const size_t all = (size_t)s->options->dim * FUNCTIONS;
    double plain = 0, blurred = 0, counted = 0;
    for (size_t i = (size_t)(k - 1) * FUNCTIONS; i < (size_t)k * FUNCTIONS; i++) {
        double p = 0, b = 0, n = 0;
        for (uint64_t t = 0; t < s->options->trials; t++) {
            if (t != left_out) {
                p += s->plain[t * all + i];
                b += s->blurred[t * all + i];
                n++;
            }
        }
        plain += p / n * (double)s->options->spp / s->functions[i].variance / FUNCTIONS;
        blurred += p > 0 ? b / (p * s->squares) : 0;
        counted += p > 0;
    }
    results[0] = sqrt(plain);
    results[1] = sqrt(blurred / counted);
}

static void fill_row(const screen *s, int k, koksma_screen_row *row)
{
    const uint64_t trials = s->options->trials;
    double all[2], without[2], sum[2] = {0}, square[2] = {0};
    results_without(s, k, trials, all);
    for (uint64_t t = 0; t < trials && trials > 1; t++) {
        results_without(s, k, t, without);
        for (int i = 0; i < 2; i++) {
            sum[i] += without[i] - all[i];
            square[i] += (without[i] - all[i]) * (without[i] - all[i]);
        }
    }
    const double n = trials > 1 ? (double)trials : (double)NAN;
    *row = (koksma_screen_row){.coordinates = k,
                               .plain = all[0],
                               .plain_error = sqrt(fmax((n - 1) / n * (square[0] - sum[0] * sum[0] / n), 0 * n)),
                               .blurred = all[1],
                               .blurred_error = sqrt(fmax((n - 1) / n * (square[1] - sum[1] * sum[1] / n), 0 * n))};
}

static koksma_status measure(screen *s, const koksma_run *run, koksma_screen_row *rows)
{
    const int dim = s->options->dim;
    koksma__phases phases = {0};
    for (int i = 0; i < dim * FUNCTIONS; i++) {
        KOKSMA__TRY(make_function(&s->functions[i], i % FUNCTIONS, 1 + i / FUNCTIONS, dim));
    }
    for (s->trial = 0; s->trial < s->options->trials; s->trial++) {
        const double share = 0.5 / (double)s->options->trials;
        koksma_run phase = koksma__phase_run(&phases, run, share);
        KOKSMA__TRY(make_samples(s, &phase));
        phase = koksma__phase_run(&phases, run, share);
        KOKSMA__TRY(koksma__parallel(&phase, (size_t)dim * FUNCTIONS, measure_function, s));
    }
    for (int k = 1; k <= dim; k++) {
        fill_row(s, k, &rows[k - 1]);
    }
    return KOKSMA_OK;
}

/* Sets the parameter `width` of a pattern of images to the width of the screen. */
static koksma_status fit_pattern(screen *s, const koksma_spec *pattern)
{
    s->pattern = *pattern;
    KOKSMA__TRY(koksma__tile_size(pattern, s->tile));
    s->whole = koksma__fit_image(&s->pattern, s->options->side);
    return KOKSMA_OK;
}

static koksma_status check(const koksma_screen_options *o)
{
    KOKSMA__FAIL_IF(o->dim < 1 || o->dim > KOKSMA_SCREEN_MAX_DIM, KOKSMA_DIM,
                    "koksma_screen_options: dim = %d: it takes 1 to %d", o->dim, KOKSMA_SCREEN_MAX_DIM);
    KOKSMA__FAIL_IF(o->side < 2 || o->side > KOKSMA_SCREEN_MAX_SIDE, KOKSMA_ARGUMENT,
                    "koksma_screen_options: side = %d: it takes 2 to %d", o->side, KOKSMA_SCREEN_MAX_SIDE);
    KOKSMA__FAIL_IF(o->filter.width > o->side / 2 || o->filter.height > o->side / 2, KOKSMA_ARGUMENT,
                    "a filter of %d x %d pixels: an image of %d pixels a side takes those up to half its side",
                    o->filter.width, o->filter.height, o->side);
    KOKSMA__FAIL_IF(o->spp < 1 || o->spp > KOKSMA_SCREEN_MAX_SPP, KOKSMA_N,
                    "koksma_screen_options: spp = %zu samples a pixel: it takes 1 to %d", o->spp,
                    KOKSMA_SCREEN_MAX_SPP);
    KOKSMA__FAIL_IF(o->trials < 1 || o->trials > 4096, KOKSMA_ARGUMENT,
                    "koksma_screen_options: trials: it takes 1 to 4096");
    return KOKSMA_OK;
}

koksma_status koksma_screen_errors(const koksma_spec *pattern, const koksma_screen_options *options,
                                   const koksma_run *run, koksma_screen_row *rows)
{
    KOKSMA__REQUIRE(pattern);
    KOKSMA__REQUIRE(pattern->pattern);
    KOKSMA__REQUIRE(options);
    KOKSMA__REQUIRE(rows);
    KOKSMA__REQUIRE_RUN(run);
    koksma_screen_options scaled = *options;
    KOKSMA__TRY(koksma_mask_filter_check(&scaled.filter));
    KOKSMA__TRY(check(&scaled));
    screen s = {.options = &scaled, .pixels = (size_t)scaled.side * (size_t)scaled.side};
    KOKSMA__TRY(fit_pattern(&s, pattern));
    const size_t n = (size_t)scaled.dim * FUNCTIONS, numbers = s.pixels * scaled.spp * (size_t)scaled.dim;
    const size_t bytes = (numbers + n * s.pixels + 2 * n * scaled.trials) * sizeof(double);
    for (int i = 0; i < scaled.filter.width * scaled.filter.height; i++) {
        s.squares += scaled.filter.weights[i] * scaled.filter.weights[i];
    }
    s.functions = calloc(n, sizeof *s.functions);
    s.xs = malloc(bytes);
    koksma_status status = KOKSMA_OK;
    if (!s.functions || !s.xs) {
        status = koksma__fail(KOKSMA_MEMORY, "not enough memory for a screen: %zu bytes", bytes);
    } else {
        s.estimates = s.xs + numbers;
        s.plain = s.estimates + n * s.pixels;
        s.blurred = s.plain + n * scaled.trials;
        status = measure(&s, run, rows);
    }
    for (size_t i = 0; s.functions && i < n; i++) {
        koksma_integral_close(s.functions[i].integral);
    }
    free(s.xs);
    free(s.functions);
    return status;
}
