/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How measures and errors fall with n: slopes in log-log by weighted least squares over the larger half of the sizes,
 * with standard errors, beside what theory says is possible. A bound with a logarithm has no slope; the slope of the
 * bound itself over the same sizes stands in its place.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/answers.h"

/* No pattern falls faster than n^power (log n)^logs in the plane. */
static const struct {
    const char *measure, *who;
    double power, logs;
} bounds[] = {
    {"star", "Schmidt 1972", -1, 1},      {"l2-star", "Roth 1954", -1, 0.5},       {"extreme", "Schmidt 1972", -1, 1},
    {"edge", "Alexander 1990", -0.75, 0}, {"l2-edge", "Alexander 1990", -0.75, 0}, {"disk", "Beck 1987", -0.75, 0},
    {"l2-disk", "Beck 1987", -0.75, 0},
};

/* The means of one pattern over the sizes. */
typedef struct curve {
    size_t n;
    double x[KOKSMA__CHART_POINTS];
    koksma__summary y[KOKSMA__CHART_POINTS];
} curve;

/* What a curve is of. */
typedef struct subject {
    const koksma__discrepancy_block *discrepancy;
    const koksma__image_block *image;
    const char *measure, *warp, *scene, *variant;
} subject;

static const koksma__wholes *sizes(const subject *s)
{
    return s->image ? &s->image->spp : &s->discrepancy->n;
}

static const koksma__texts *patterns(const subject *s)
{
    return s->image ? &s->image->patterns : &s->discrepancy->patterns;
}

static koksma_status collect(koksma_study *study, const subject *s, const char *pattern, curve *out)
{
    koksma_status status = KOKSMA_OK;
    const koksma__wholes *n = sizes(s);
    out->n = 0;
    for (size_t i = 0; !status && i < n->n && out->n < KOKSMA__CHART_POINTS; i++) {
        koksma__summary mean;
        status = s->image ? koksma__image_mean(study, s->image, s->scene, s->variant, pattern, n->at[i], NULL, &mean)
                          : koksma__discrepancy_mean(study, s->discrepancy, s->warp, pattern, n->at[i], s->measure,
                                                     NULL, &mean);
        if (!status && mean.n && mean.mean > 0) {
            out->x[out->n] = (double)n->at[i];
            out->y[out->n++] = mean;
        }
    }
    return status;
}

/* Over the larger half, at least three sizes. */
static koksma__line fit(const curve *c)
{
    double x[KOKSMA__CHART_POINTS], y[KOKSMA__CHART_POINTS], sigma[KOKSMA__CHART_POINTS];
    size_t first = c->n / 2;
    first = c->n - first < 3 && c->n >= 3 ? c->n - 3 : first;
    for (size_t i = first; i < c->n; i++) {
        x[i - first] = log(c->x[i]);
        y[i - first] = log(c->y[i].mean);
        sigma[i - first] = c->y[i].n > 1 ? c->y[i].sd / sqrt((double)c->y[i].n) / c->y[i].mean : 0;
    }
    return koksma__fit_line(x, y, sigma, c->n - first);
}

static koksma__estimate slope_of(const curve *c)
{
    const koksma__line line = fit(c);
    const double half = isnan(line.slope_error) ? 0 : 1.959963984540054 * line.slope_error;
    return (koksma__estimate){line.slope, line.slope - half, line.slope + half};
}

/* The bound over the sizes of a curve, scaled to touch its first value. */
static bool bound_of(const subject *s, const curve *like, curve *out, const char **who)
{
    char measure[64];
    snprintf(measure, sizeof measure, "%.*s", (int)strcspn(s->measure ? s->measure : "", ":"),
             s->measure ? s->measure : "");
    for (size_t b = 0; b < sizeof bounds / sizeof *bounds; b++) {
        if (!s->image && !s->warp[0] && s->discrepancy->dim == 2 && !strcmp(bounds[b].measure, measure)) {
            *who = bounds[b].who;
            *out = *like;
            for (size_t i = 0; i < like->n; i++) {
                const double n = like->x[i];
                out->y[i] = (koksma__summary){.n = 1, .mean = pow(n, bounds[b].power) * pow(log(n), bounds[b].logs)};
            }
            return true;
        }
    }
    return false;
}

static void plot_curve(koksma__chart_series *to, const curve *c, const char *label, bool theory, double scale)
{
    to->line = true;
    to->theory = theory;
    to->n = c->n;
    snprintf(to->label, sizeof to->label, "%.95s", label);
    for (size_t i = 0; i < c->n; i++) {
        to->x[i] = c->x[i];
        to->y[i] = c->y[i].mean * scale;
        to->low[i] = theory ? to->y[i] : c->y[i].low;
        to->high[i] = theory ? to->y[i] : c->y[i].high;
    }
}

static void name_subject(const subject *s, char *text, size_t size)
{
    if (s->image) {
        koksma__case_name(s->scene, s->variant, text, size);
    } else {
        snprintf(text, size, "%s%s%s", s->measure, s->warp[0] ? " through " : "", s->warp);
    }
}

/* The sentence: who falls fastest, who is better than random's n^-1/2. */
static void add_sentence(koksma__html *h, const char *name, const char *const *labels, const koksma__estimate *slopes,
                         size_t n)
{
    size_t best = 0, faster = 0, counted = 0;
    for (size_t i = 0; i < n; i++) {
        if (!isnan(slopes[i].value)) {
            best = isnan(slopes[best].value) || slopes[i].value < slopes[best].value ? i : best;
            faster += slopes[i].high < -0.5;
            counted++;
        }
    }
    if (counted) {
        koksma__html_add(h, "<p><strong>");
        koksma__html_text(h, name);
        koksma__html_add(h, ":</strong> ");
        koksma__html_text(h, labels[best]);
        koksma__html_add(
            h,
            " falls fastest, as N<sup>%.3f</sup> (%.3f to %.3f); %zu of %zu patterns are surely faster than "
            "the N<sup>&#8722;1/2</sup> of random samples.</p>\n",
            slopes[best].value, slopes[best].low, slopes[best].high, faster, counted);
    }
}

static koksma_status add_subject(koksma_study *study, koksma__html *h, const char *id, size_t number,
                                 const subject *s)
{
    char name[KOKSMA__VARIANT_TEXT + 64], file[64], title[256];
    const size_t n = patterns(s)->n < KOKSMA__CHART_SERIES - 1 ? patterns(s)->n : KOKSMA__CHART_SERIES - 1;
    koksma__chart_series *series = calloc(KOKSMA__CHART_SERIES, sizeof *series);
    curve *curves = calloc(KOKSMA__CHART_SERIES + 1, sizeof *curves);
    koksma__estimate slopes[KOKSMA__CHART_SERIES];
    koksma_status status = series && curves ? KOKSMA_OK : koksma__fail_memory(sizeof *series * KOKSMA__CHART_SERIES);
    for (size_t p = 0; !status && p < n; p++) {
        status = collect(study, s, patterns(s)->at[p], &curves[p]);
        slopes[p] = slope_of(&curves[p]);
        plot_curve(&series[p], &curves[p], patterns(s)->at[p], false, 1);
    }
    if (!status && sizes(s)->n >= 2) {
        const char *who = NULL;
        curve *bound = &curves[KOKSMA__CHART_SERIES];
        size_t n_series = n;
        name_subject(s, name, sizeof name);
        add_sentence(h, name, (const char *const *)patterns(s)->at, slopes, n);
        koksma__estimate bound_slope = {NAN, NAN, NAN};
        if (n && curves[0].n && bound_of(s, &curves[0], bound, &who)) {
            snprintf(title, sizeof title, "lower bound (%s), scaled", who);
            plot_curve(&series[n_series++], bound, title, true, curves[0].y[0].mean / bound->y[0].mean / 4);
            bound_slope = slope_of(bound);
        }
        snprintf(file, sizeof file, "slopes-%.32s-%zu", id, number);
        koksma__grid grid;
        koksma__grid_open(&grid, h, file);
        koksma__grid_head(&grid, "pattern");
        koksma__grid_head_interval(&grid, "slope");
        for (size_t i = 0; i < sizes(s)->n; i++) {
            snprintf(title, sizeof title, "N = %lld", sizes(s)->at[i]);
            koksma__grid_head_interval(&grid, title);
        }
        for (size_t p = 0; p < n; p++) {
            koksma__grid_row(&grid);
            koksma__grid_text(&grid, patterns(s)->at[p]);
            koksma__grid_interval(&grid, slopes[p], 3);
            for (size_t i = 0; i < sizes(s)->n; i++) {
                koksma__estimate e = {NAN, NAN, NAN};
                for (size_t k = 0; k < curves[p].n; k++) {
                    e = curves[p].x[k] == (double)sizes(s)->at[i] ? koksma__estimate_of(&curves[p].y[k]) : e;
                }
                koksma__grid_interval(&grid, e, 3);
            }
        }
        if (who) {
            koksma__grid_row(&grid);
            snprintf(title, sizeof title, "none falls faster (%s)", who);
            koksma__grid_text(&grid, title);
            bound_slope.low = bound_slope.high = bound_slope.value;
            koksma__grid_interval(&grid, bound_slope, 3);
        }
        koksma__grid_close(&grid);
        snprintf(title, sizeof title, "%.200s against N", name);
        const koksma__chart chart = {title,
                                     s->image ? "samples a pixel" : "points",
                                     s->image ? "mean absolute error" : s->measure,
                                     true,
                                     true,
                                     n_series,
                                     series};
        koksma__html_chart(h, &chart);
    }
    free(series);
    free(curves);
    return status;
}

koksma_status koksma__answer_slopes(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        const size_t warps = d->warps.n ? d->warps.n : 1;
        for (size_t i = 0; !status && i < d->measures.n * warps; i++) {
            const subject s = {.discrepancy = d,
                               .measure = d->measures.at[i / warps],
                               .warp = d->warps.n ? d->warps.at[i % warps] : ""};
            status = add_subject(study, h, topic->id, ++number, &s);
        }
    }
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *image = topic->images[b];
        for (size_t i = 0; !status && i < image->scenes.n * image->variants.n; i++) {
            const subject s = {.image = image,
                               .scene = image->scenes.at[i / image->variants.n],
                               .variant = image->variants.at[i % image->variants.n]};
            status = add_subject(study, h, topic->id, ++number, &s);
        }
    }
    return status;
}
