/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Spectra of samplers: pictures of the power at every frequency, its radial mean, two numbers that measure blue
 * noise, and the pair correlation. `koksma curve` with its default numbers of frequencies and rings prints the
 * same numbers.
 */
#include "study/sheet/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <koksma/image.h>
#include <koksma/spectrum.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/run/run_control.h"

enum { POINTS = 1024, QUALITY_PER_ROOT = 7, RADIAL_PER_ROOT = 2, BINS = 100, WHITE = 2, SIDE = 200 };

/* The spectra of one sampler. */
typedef struct spectra {
    const koksma__sheet_sampler *sampler;
    size_t n, trials;
    /* radial: the power at frequencies up to 2 sqrt(n); wide: up to 7 sqrt(n), for the two numbers on blue noise */
    koksma_spectrum radial, wide;
    koksma_tally pairs[BINS];
    double r_max;
    const koksma__run_control *control; /* whose `job` asks within a set whether to go on, on any thread */
} spectra;

static koksma_status add_set(spectra *s, size_t t)
{
    double values[BINS];
    koksma_points points = {0};
    const koksma_run *alone = &s->control->job;
    koksma_status status = koksma__sheet_points(s->sampler, s->n, 2, t, alone, &points);
    status = status ? status : koksma_spectrum_add(&s->radial, &points, KOKSMA_SPECTRUM_FAST, alone);
    status = status ? status : koksma_spectrum_add(&s->wide, &points, KOKSMA_SPECTRUM_FAST, alone);
    status = status ? status : koksma_pair_correlation(&points, s->r_max, BINS, alone, values);
    for (size_t b = 0; b < BINS && !status; b++) {
        koksma_tally_add(&s->pairs[b], values[b]);
    }
    koksma_points_fini(&points);
    return status;
}

static koksma_status compute(void *context, size_t i)
{
    spectra *s = (spectra *)context + i;
    const double root = sqrt((double)s->n);
    s->r_max = fmin(4 / root, 0.5);
    koksma_status status = koksma_spectrum_init(&s->radial, (int)ceil(RADIAL_PER_ROOT * root));
    status = status ? status : koksma_spectrum_init(&s->wide, (int)ceil(QUALITY_PER_ROOT * root));
    for (size_t t = 0; t < s->trials && !status; t++) {
        status = add_set(s, t);
    }
    return status;
}

/* Draws the power on a grid of frequencies, enlarged to at least SIDE pixels, with the largest ky at the top. The
   frequency 0 is drawn with the power 0. */
static koksma_status put_picture(const spectra *s, koksma__document *d)
{
    const int half = s->radial.half, side = 2 * half + 1, scale = side >= SIDE ? 1 : (SIDE + side - 1) / side;
    char what[KOKSMA_MAX_SPEC + 64];
    koksma_image image;
    koksma_status status = koksma_image_init(&image, side, side, 1);
    for (int row = 0; row < side && !status; row++) {
        for (int column = 0; column < side; column++) {
            const double power = koksma_spectrum_power(&s->radial, column - half, half - row);
            image.pixels[(size_t)row * (size_t)side + (size_t)column] =
                row == half && column == half ? 0 : (float)(power / WHITE);
        }
    }
    snprintf(what, sizeof what, "%s, %zu set%s of %zu", s->sampler->text, s->trials, s->trials == 1 ? "" : "s", s->n);
    if (!status) {
        koksma__doc_figure(d, "spectrum");
        status = koksma__doc_image(d, &image, scale, what);
        koksma__doc_caption(d, "%s", what);
        koksma_image_fini(&image);
    }
    return status;
}

static void put_level(double from, double to, koksma__document *d)
{
    koksma__doc_series(d, "random points", NULL, KOKSMA__SERIES_THEORY);
    koksma__doc_point(d, from, 1, NAN, NAN);
    koksma__doc_point(d, to, 1, NAN, NAN);
}

static koksma_status put_radial(const spectra *all, size_t n, koksma__document *d)
{
    const int half = all->radial.half;
    koksma_ring *rings = malloc((size_t)half * sizeof *rings);
    koksma_status status = rings ? KOKSMA_OK : koksma__fail_memory((size_t)half * sizeof *rings);
    koksma__doc_chart(d,
                      &(koksma__chart){"Radial mean of the power", "frequency / sqrt(n)", "power", false, false, 0});
    for (size_t s = 0; s < n && !status; s++) {
        status = koksma_spectrum_rings(&all[s].radial, rings);
        koksma__doc_series(d, all[s].sampler->text, NULL, KOKSMA__SERIES_LINE);
        for (int r = 0; r < half && !status; r++) {
            koksma__doc_point(d, rings[r].frequency / sqrt((double)all[s].n), rings[r].power, NAN, NAN);
        }
    }
    put_level(0, half / sqrt((double)all->n), d);
    free(rings);
    return status;
}

static void put_pairs(const spectra *all, size_t n, koksma__document *d)
{
    koksma__doc_chart(d, &(koksma__chart){"Pair correlation", "distance on the torus × sqrt(n)",
                                          "pairs, relative to random points", false, false, 0});
    for (size_t s = 0; s < n; s++) {
        koksma__doc_series(d, all[s].sampler->text, NULL, KOKSMA__SERIES_LINE);
        for (size_t b = 0; b < BINS; b++) {
            koksma__doc_point(d, ((double)b + 0.5) * all[s].r_max / BINS * sqrt((double)all[s].n),
                              all[s].pairs[b].mean, NAN, NAN);
        }
    }
    put_level(0, all->r_max * sqrt((double)all->n), d);
}

static void put_quality(const spectra *all, size_t n, koksma__document *d)
{
    koksma__doc_table(d, "spectra");
    koksma__doc_columns(d, "t sampler;n4 effective Nyquist;n3 over sqrt(n)/2;n3 oscillation;n9 sets");
    for (size_t s = 0; s < n; s++) {
        koksma_spectrum_quality_values q;
        koksma_spectrum_quality(&all[s].wide, &q);
        koksma__doc_row(d, "tnnnn", all[s].sampler->text, q.effective_nyquist, q.relative_nyquist, q.oscillation,
                        (double)all[s].trials);
    }
}

static void put_commands(const spectra *all, size_t n, koksma__document *d)
{
    static const char *const curves[] = {"quality", "rings", "pairs"};
    koksma__doc_commands(d);
    for (size_t i = 0; i < 3 * n; i++) {
        const spectra *s = &all[i / 3];
        koksma__doc_command(d, "koksma curve %s %s --trials %zu --seed %llu", curves[i % 3],
                            koksma__sheet_source(s->sampler, s->n, 2).text, s->trials,
                            (unsigned long long)s->sampler->seed);
    }
}

static koksma_status put_section(koksma__sheet *sheet, const spectra *all, koksma__document *d)
{
    koksma_status status = KOKSMA_OK;
    koksma__doc_section(d, "spectra", "Spectra and distances");
    koksma__doc_paragraph(d,
                          "Power (1/n)|sum exp(-2 pi i k.x)|² at n = %zu: frequency 0 in the middle; random points "
                          "have 1 everywhere, mid-grey; dark in the middle is blue noise.",
                          all->n);
    for (size_t s = 0; s < sheet->n_samplers && !status; s++) {
        koksma__document picture = {0};
        status = put_picture(&all[s], &picture);
        if (status) {
            koksma__json_writer_fini(&picture.json);
        } else {
            koksma__doc_append(d, &picture);
        }
    }
    if (status == KOKSMA_UNSUPPORTED) { /* this build has no PNG */
        koksma__sheet_note_error(sheet, "pictures of spectra");
        status = KOKSMA_OK;
    }
    status = status ? status : put_radial(all, sheet->n_samplers, d);
    put_pairs(all, sheet->n_samplers, d);
    koksma__doc_paragraph(d, "Effective Nyquist frequency: signals up to it alias little. Oscillation: how far the "
                             "radial mean strays from 1 beyond that frequency (Heck, Schlömer & Deussen 2013).");
    put_quality(all, sheet->n_samplers, d);
    put_commands(all, sheet->n_samplers, d);
    koksma__doc_end(d);
    return status;
}

koksma_status koksma__sheet_spectra(koksma__sheet *sheet, koksma__document *d)
{
    spectra *all = calloc(KOKSMA__SHEET_SAMPLERS, sizeof *all);
    const koksma_run run = koksma__sheet_part(sheet, 0.08, 1);
    koksma__run_control control;
    koksma__run_control_begin(&run, 0, &control);
    koksma_status status = all ? KOKSMA_OK : koksma__fail_memory(KOKSMA__SHEET_SAMPLERS * sizeof *all);
    for (size_t s = 0; s < sheet->n_samplers && !status; s++) {
        all[s] = (spectra){.sampler = sheet->samplers[s],
                           .control = &control,
                           .n = koksma__sheet_size(sheet, POINTS),
                           .trials = koksma__sheet_trials(sheet->samplers[s], sheet->trials)};
    }
    status = status ? status : koksma__parallel(&control.run, sheet->n_samplers, compute, all);
    status = status ? status : put_section(sheet, all, d);
    for (size_t s = 0; all && s < sheet->n_samplers; s++) {
        koksma_spectrum_fini(&all[s].radial);
        koksma_spectrum_fini(&all[s].wide);
    }
    free(all);
    return status;
}
