/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sections that show the points: drawings of the first set of a few sizes, the properties that `koksma verify`
 * finds in it and, in more dimensions, projections on pairs of coordinates with the discrepancies in all
 * dimensions.
 */
#include "study/sheet/sheet.h"

#include <stdio.h>
#include <string.h>

#include <koksma/verify.h>

#include "core/status.h"

enum { DRAWN = 1024, WIDTH = 168, PROJECTION_WIDTH = 140, VERIFIED = 1024, MOST_DIM = 8, DEEP_POINTS = 1024 };

static void draw(koksma__document *d, const koksma_points *points, int a, int b, int width, const char *what,
                 const char *caption)
{
    static const double square[4] = {0, 0, 1, 1};
    koksma__doc_figure(d, width == WIDTH ? "set" : "projection");
    koksma__doc_drawing(d, width, square, what);
    koksma__doc_line(d, 0, 0, 1, 0);
    koksma__doc_line(d, 1, 0, 1, 1);
    koksma__doc_line(d, 1, 1, 0, 1);
    koksma__doc_line(d, 0, 1, 0, 0);
    for (size_t i = 0; i < points->n; i++) {
        const double *x = points->xs + i * (size_t)points->dim;
        koksma__doc_dot(d, x[a], x[b]);
    }
    koksma__doc_caption(d, "%s", caption);
}

static const koksma_run alone = {.threads = 1};

/* Draws a set. If `first`, the set belongs to the sampler that the sheet describes, and the caption does not repeat
   its name. */
static koksma_status draw_set(const koksma__sheet_sampler *sampler, size_t n, bool first, koksma__document *d)
{
    char what[KOKSMA_MAX_SPEC + 64];
    koksma_points points = {0};
    const koksma_status status = koksma__sheet_points(sampler, n, 2, 0, &alone, &points);
    if (!status) {
        snprintf(what, sizeof what, "%s, n = %zu", sampler->text, n);
        draw(d, &points, 0, 1, WIDTH, what, first ? strrchr(what, ',') + 2 : what);
    }
    koksma_points_fini(&points);
    return status;
}

koksma_status koksma__sheet_draw_points(koksma__sheet *sheet, koksma__document *d)
{
    const size_t common = koksma__sheet_size(sheet, DRAWN / 4);
    koksma_status status = KOKSMA_OK;
    koksma__doc_section(d, "points", "Points");
    for (size_t i = 0; i < sheet->n_sizes && !status; i++) {
        if (sheet->sizes[i] <= DRAWN) {
            status = draw_set(sheet->samplers[0], sheet->sizes[i], true, d);
        }
    }
    koksma__doc_paragraph(
        d, "Above: the sampler's first set of each size. Below: the first set of every other sampler.");
    for (size_t s = 1; s < sheet->n_samplers && !status; s++) {
        status = draw_set(sheet->samplers[s], common, false, d);
    }
    koksma__doc_commands(d);
    for (size_t i = 0; i < sheet->n_sizes; i++) {
        const size_t n = sheet->sizes[i];
        if (n <= DRAWN) {
            koksma__doc_command(d, "koksma plot %s --seed %llu -o points-%zu.svg",
                                koksma__sheet_source(sheet->samplers[0], n, 2).text,
                                (unsigned long long)sheet->samplers[0]->seed, n);
        }
    }
    koksma__doc_end(d);
    return status;
}

/* ---- Properties -------------------------------------------------------------------------------------------- */

/* Writes how many findings of a property hold: "yes", "no" or "2 of 3"; "–" if there are none. */
static void count_findings(const koksma_findings *findings, const char *property, char *out, size_t size)
{
    size_t n = 0, held = 0;
    for (size_t i = 0; i < findings->count; i++) {
        if (!strcmp(findings->items[i].property, property)) {
            n++;
            held += findings->items[i].holds;
        }
    }
    snprintf(out, size, "%zu of %zu", held, n);
    if (!n || held == n || !held) {
        snprintf(out, size, "%s", !n ? "–" : held ? "yes" : "no");
    }
}

static void put_matrix(const koksma__sheet *sheet, const koksma_findings *findings, koksma__document *d)
{
    const koksma_property *property;
    koksma__doc_table(d, "properties");
    koksma__doc_columns(d, "t property");
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma__doc_columns(d, "t %s", sheet->samplers[s]->text);
    }
    for (size_t p = 0; (property = koksma_property_at(p)) && !property->of_sets; p++) { /* those of sets come last */
        char text[48];
        koksma__doc_row(d, "t", property->name);
        for (size_t s = 0; s < sheet->n_samplers; s++) {
            count_findings(&findings[s], property->name, text, sizeof text);
            koksma__doc_cells(d, "t", text);
        }
    }
}

static void put_findings(const koksma_findings *findings, const char *name, koksma__document *d)
{
    koksma__doc_table(d, "%s", name);
    koksma__doc_columns(d, "tm property;t subject;t holds;n6 value;t detail");
    for (size_t i = 0; i < findings->count; i++) {
        const koksma_finding *f = &findings->items[i];
        koksma__doc_row(d, "tttnt", f->property, f->subject, f->holds ? "yes" : "no", f->value, f->detail);
    }
}

static void put_verify_commands(koksma__document *d, koksma__sheet_sampler *const *samplers, size_t count, size_t n,
                                int dim)
{
    koksma__doc_commands(d);
    for (size_t s = 0; s < count; s++) {
        koksma__doc_command(d, "koksma verify %s --seed %llu", koksma__sheet_source(samplers[s], n, dim).text,
                            (unsigned long long)samplers[s]->seed);
    }
}

koksma_status koksma__sheet_verify(koksma__sheet *sheet, koksma__document *d)
{
    const size_t n = koksma__sheet_size(sheet, VERIFIED);
    const koksma_run run = koksma__sheet_part(sheet, 0.02, 0.3), one_set = koksma__sheet_one_set(sheet);
    koksma_findings findings[KOKSMA__SHEET_SAMPLERS] = {{0}};
    koksma_status status = KOKSMA_OK;
    for (size_t s = 0; s < sheet->n_samplers && !status; s++) {
        koksma_points points = {0};
        status = koksma__sheet_points(sheet->samplers[s], n, 2, 0, &one_set, &points);
        status = status ? status : koksma_verify(&points, &run, &findings[s]);
        koksma_points_fini(&points);
    }
    if (!status) {
        koksma__doc_section(d, "properties", "Verified properties");
        koksma__doc_paragraph(d,
                              "These properties were found by checking the points of the first set of %zu; the "
                              "sampler's claims were not used.",
                              n);
        put_matrix(sheet, findings, d);
        koksma__doc_collapsed_section(d, "findings", "Every finding about %s", sheet->samplers[0]->text);
        put_findings(&findings[0], "findings", d);
        koksma__doc_end(d);
        put_verify_commands(d, sheet->samplers, sheet->n_samplers, n, 2);
        koksma__doc_end(d);
    }
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma_findings_fini(&findings[s]);
    }
    return status;
}

/* ---- More dimensions --------------------------------------------------------------------------------------- */

/* Draws projections on pairs of adjacent coordinates, and on the first and the last. */
static koksma_status draw_pairs(const koksma__sheet_sampler *sampler, size_t n, int dim, koksma__document *d)
{
    koksma_points points = {0};
    const koksma_status status = koksma__sheet_points(sampler, n, dim, 0, &alone, &points);
    for (int k = 0; k < dim && !status; k++) {
        char what[64];
        const int a = k + 1 < dim ? k : 0, b = k + 1 < dim ? k + 1 : dim - 1;
        snprintf(what, sizeof what, "coordinates %d and %d", a, b);
        draw(d, &points, a, b, PROJECTION_WIDTH, what, what);
    }
    koksma_points_fini(&points);
    return status;
}

/* Finds the samplers that have sets of n points in `dim` dimensions; returns false if samplers[0] has none. */
static bool choose_deep(koksma__sheet *sheet, size_t n, int dim, bool note, koksma__sheet_sampler **samplers,
                        size_t *count)
{
    *count = 0;
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma_points points = {0};
        const bool there = !koksma__sheet_points(sheet->samplers[s], n, dim, 0, &alone, &points);
        koksma_points_fini(&points);
        if (there) {
            samplers[(*count)++] = sheet->samplers[s];
        } else if (s == 0) {
            return false;
        } else if (note) {
            koksma__sheet_note_error(sheet, sheet->samplers[s]->text);
        }
    }
    return true;
}

koksma_status koksma__sheet_projections(koksma__sheet *sheet, koksma__document *d)
{
    static const char *const names[] = {"l2-star", "l2-centered", "l2-wraparound", "diaphony"};
    size_t n = koksma__sheet_size(sheet, DEEP_POINTS);
    koksma__sheet_sampler *samplers[KOKSMA__SHEET_SAMPLERS];
    koksma__sheet_values v = {
        .n_sizes = 1, .sizes = &n, .samplers = samplers, .n_measures = sizeof names / sizeof *names};
    koksma_findings findings = {0};
    koksma_points points = {0};
    const koksma_run run = koksma__sheet_part(sheet, 0.08, 0.7);
    v.dim = sheet->max_dim < MOST_DIM ? sheet->max_dim : MOST_DIM;
    while (v.dim > 2 && !choose_deep(sheet, n, v.dim, false, samplers, &v.n_samplers)) {
        v.dim--;
    }
    if (v.dim < 3) {
        return KOKSMA_OK;
    }
    choose_deep(sheet, n, v.dim, true, samplers, &v.n_samplers);
    for (size_t m = 0; m < v.n_measures; m++) {
        koksma_measure_spec(names[m], &v.measures[m].spec);
        snprintf(v.measures[m].name, sizeof v.measures[m].name, "%s", names[m]);
    }
    for (size_t s = 0; s < v.n_samplers; s++) {
        v.trials[s] = koksma__sheet_trials(samplers[s], sheet->trials);
    }
    koksma_status status = koksma__sheet_evaluate(sheet, &v, &run);
    status = status ? status : koksma__sheet_points(samplers[0], n, v.dim, 0, &alone, &points);
    status = status ? status : koksma_verify(&points, &run, &findings);
    if (!status) {
        koksma__doc_section(d, "projections", "More dimensions");
        koksma__doc_paragraph(d, "The first set of %zu points in %d dimensions, projected on pairs of coordinates.",
                              n, v.dim);
        status = draw_pairs(samplers[0], n, v.dim, d);
        koksma__doc_paragraph(d, "Discrepancies of the points in all %d dimensions:", v.dim);
        koksma__sheet_put_values(&v, "projections", d);
        koksma__doc_collapsed_section(d, "projection-findings", "Properties of projections of %s", samplers[0]->text);
        put_findings(&findings, "projection-findings", d);
        put_verify_commands(d, samplers, 1, n, v.dim);
        koksma__doc_end(d);
        koksma__doc_end(d);
    }
    koksma_points_fini(&points);
    koksma_findings_fini(&findings);
    koksma__sheet_values_fini(&v);
    return status;
}
