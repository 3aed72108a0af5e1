/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive methods against the best pattern without them, at equal numbers of rays, on five scenes; and their bias.
 *
 *     bench-adaptive [TRIALS [SCENE [METHOD,METHOD…]]]
 *
 * A row: samples a pixel, rays a pixel; mean |error| over pixels and trials with the half width of its 95 % interval;
 * the ratio to the error of the best pattern at as many rays, with its interval by the delta method; the
 * mean error with sign (bias of the image's mean) and its standard error; the root mean square bias of a pixel: the
 * square is the mean over pixels of (mean over trials - reference)^2 less the variances of both.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/adaptive.h>

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT, MAX_TRIALS = 200, REPLICATES = 8 };

typedef struct scene {
    const char *name, *integrator;
    int first, budget, reference_spp; /* first: a square */
    int levels;
} scene;

static const scene scenes[] = {
    {"checker", "distribution", 16, 64, 4096, 2}, {"ball", "distribution", 16, 64, 4096, 2},
    {"all", "distribution", 16, 64, 4096, 2},     {"glossy", "distribution", 16, 64, 4096, 2},
    {"mirror-block", "path", 400, 441, 4096, 1},
};

/* A method, and how its first samples are had: sets of first / parts samples. parts 0: all of them in strata, the
   scene's levels. budget: of the scene, or none. */
static const struct {
    const char *spec;
    int parts;
    bool budget;
} methods[] = {
    {"hierarchical", 0, false},
    {"hierarchical:pairing=shuffled", 0, false},
    {"hierarchical:pairing=shuffled", 0, true},
    {"selective", 0, false},
    {"selective", 0, true},
    {"contrast", 1, true},
    {"confidence:test=t", 1, true},
    {"confidence:test=chi2", 1, true},
};

static const char *const patterns[] = {"n-rooks", "sobol:scramble=owen", "pmj02", "correlated-multi-jittered"};

typedef struct pictures {
    double sum[PIXELS], squares[PIXELS];
    double errors[MAX_TRIALS], signs[MAX_TRIALS]; /* by trial: mean |error|, mean error */
    double samples, rays;                         /* a pixel */
    int n;
} pictures;

typedef struct reference {
    double mean[PIXELS], variance[PIXELS]; /* of the mean */
    double image_variance;
} reference;

static void die(void)
{
    fprintf(stderr, "bench-adaptive: %s\n", koksma_error_text());
    exit(1);
}

static void check(koksma_status status)
{
    if (status) {
        die();
    }
}

static void add(pictures *p, const koksma_layers *layers, const reference *against)
{
    double error = 0, sign = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double y = (double)layers->image.pixels[i];
        p->sum[i] += y;
        p->squares[i] += y * y;
        p->samples += (double)layers->samples.pixels[i] / PIXELS;
        if (against) {
            error += fabs(y - against->mean[i]) / PIXELS;
            sign += (y - against->mean[i]) / PIXELS;
        }
    }
    p->rays += (double)layers->rays / PIXELS;
    p->errors[p->n] = error;
    p->signs[p->n++] = sign;
}

/* Renders trials with other seeds than any other call: `family` is a number of its own. */
static void render(const koksma_scene *opened, koksma_render_options options, const koksma_adaptive_options *adaptive,
                   int trials, uint64_t family, const reference *against, pictures *out)
{
    memset(out, 0, sizeof *out);
    for (int t = 0; t < trials; t++) {
        koksma_layers layers;
        options.seed = family << 32 | (uint64_t)t;
        check(adaptive ? koksma_render_adaptive(opened, &options, adaptive, NULL, &layers, NULL)
                       : koksma_render_layers(opened, &options, NULL, &layers));
        if (layers.image.channels != 1) {
            fprintf(stderr, "bench-adaptive: a scene with colour\n");
            exit(1);
        }
        add(out, &layers, against);
        koksma_layers_fini(&layers);
    }
    out->samples /= trials;
    out->rays /= trials;
}

static double mean_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += x[i];
    }
    return sum / n;
}

/* Of the mean. */
static double standard_error(const double *x, int n)
{
    const double mean = mean_of(x, n);
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += (x[i] - mean) * (x[i] - mean);
    }
    return sqrt(sum / (n - 1) / n);
}

static void make_reference(const scene *s, const koksma_scene *opened, koksma_render_options options, reference *out)
{
    static pictures p;
    double means[REPLICATES] = {0};
    options.spp = s->reference_spp;
    check(koksma_pattern_spec("sobol:scramble=owen", &options.pattern));
    memset(out, 0, sizeof *out);
    for (int r = 0; r < REPLICATES; r++) {
        static pictures one;
        render(opened, options, NULL, 1, 1000 + (uint64_t)r, NULL, &one);
        for (int i = 0; i < PIXELS; i++) {
            p.sum[i] = r ? p.sum[i] + one.sum[i] : one.sum[i];
            p.squares[i] = r ? p.squares[i] + one.squares[i] : one.squares[i];
            means[r] += one.sum[i] / PIXELS;
        }
    }
    for (int i = 0; i < PIXELS; i++) {
        const double mean = p.sum[i] / REPLICATES;
        out->mean[i] = mean;
        out->variance[i] = fmax(p.squares[i] / REPLICATES - mean * mean, 0) / (REPLICATES - 1);
    }
    out->image_variance = pow(standard_error(means, REPLICATES), 2);
}

/* The best pattern's error with spp samples; its name too. */
static void best_pattern(const koksma_scene *opened, koksma_render_options options, int spp, int trials,
                         const reference *against, pictures *best, const char **name)
{
    static pictures p;
    *name = NULL;
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        check(koksma_pattern_spec(patterns[i], &options.pattern));
        options.spp = spp;
        render(opened, options, NULL, trials, 2 + i, against, &p);
        if (!*name || mean_of(p.errors, trials) < mean_of(best->errors, trials)) {
            *best = p;
            *name = patterns[i];
        }
    }
}

static double pixel_bias(const pictures *p, const reference *r)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double mean = p->sum[i] / p->n, off = mean - r->mean[i];
        const double variance = fmax(p->squares[i] / p->n - mean * mean, 0) / (p->n - 1);
        sum += (off * off - variance - r->variance[i]) / PIXELS;
    }
    return sum > 0 ? sqrt(sum) : 0;
}

static void put_row(const char *spec, const pictures *p, const pictures *best, const char *best_name,
                    const reference *r)
{
    const double error = mean_of(p->errors, p->n), width = 1.96 * standard_error(p->errors, p->n);
    const double bias = mean_of(p->signs, p->n);
    const double doubt = sqrt(pow(standard_error(p->signs, p->n), 2) + r->image_variance);
    printf("| `%s` | %.2f | %.1f | %.6f ± %.6f | ", spec, p->samples, p->rays, error, width);
    if (best) {
        const double base = mean_of(best->errors, best->n), ratio = error / base;
        const double relative =
            hypot(standard_error(p->errors, p->n) / error, standard_error(best->errors, best->n) / base);
        printf("%.3f ± %.3f of %s, %.1f rays | ", ratio, 1.96 * relative * ratio, best_name, best->rays);
    } else {
        printf("- | ");
    }
    printf("%+.6f ± %.6f | %.6f |\n", bias, doubt, pixel_bias(p, r));
    fflush(stdout);
}

/* only: names of methods, NULL for all. */
static void bench_scene(const scene *s, int trials, const char *only)
{
    static reference ref;
    static pictures one, best;
    koksma_scene *opened;
    koksma_render_options options;
    check(koksma_scene_open(s->name, &opened));
    koksma_render_options_init(&options, opened);
    options.width = WIDTH;
    options.height = HEIGHT;
    options.integrator = koksma_integrator_find(s->integrator);
    make_reference(s, opened, options, &ref);
    printf("\n### %s, %d samples at first, budget %d\n\n", s->name, s->first, s->budget);
    printf(
        "| method | samples | rays | mean abs. error | over the best pattern | bias of the mean | bias of a pixel |\n"
        "|---|---|---|---|---|---|---|\n");
    check(koksma_pattern_spec("sobol:scramble=owen", &options.pattern));
    options.spp = s->budget;
    render(opened, options, NULL, trials, 1, &ref, &one);
    put_row("sobol:scramble=owen", &one, NULL, NULL, &ref);
    const double rays_a_sample = one.rays / one.samples;
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        char spec[KOKSMA_MAX_SPEC];
        const char *name;
        koksma_adaptive_options adaptive;
        snprintf(spec, sizeof spec, "%s", methods[i].spec);
        if (!methods[i].parts && s->levels != 2) {
            snprintf(spec, sizeof spec, "%s%clevels=%d", methods[i].spec, strchr(methods[i].spec, ':') ? ',' : ':',
                     s->levels);
        }
        check(koksma_adaptive_parse(spec, &adaptive));
        if (only && !strstr(only, adaptive.method->name)) {
            continue;
        }
        adaptive.budget = methods[i].budget ? s->budget : 0;
        options.spp = methods[i].parts ? s->first / methods[i].parts : s->first;
        render(opened, options, &adaptive, trials, 100 + i, &ref, &one);
        best_pattern(opened, options, (int)lround(one.rays / rays_a_sample), trials, &ref, &best, &name);
        snprintf(spec + strlen(spec), sizeof spec - strlen(spec), "%s", methods[i].budget ? " (budget)" : "");
        put_row(spec, &one, &best, name, &ref);
    }
    koksma_scene_close(opened);
}

int main(int argc, char **argv)
{
    const int trials = argc > 1 ? atoi(argv[1]) : 20;
    if (trials < 2 || trials > MAX_TRIALS) {
        fprintf(stderr, "bench-adaptive: 2 to %d trials\n", MAX_TRIALS);
        return 2;
    }
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        if (argc < 3 || !strcmp(argv[2], scenes[i].name)) {
            bench_scene(&scenes[i], trials, argc > 3 ? argv[3] : NULL);
        }
    }
    return 0;
}
