/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Errors of integration of all samplers over the integrands of Christensen et al. (2018), which later papers on
 * sampling use as well: the RMSE against n with intervals, slopes, and the factor by which more random points are
 * needed for the same error. The numbers are those of `koksma integrate`.
 */
#include "study/sheet/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/integrate.h>

#include "core/status.h"

enum { N_INTEGRANDS = 5 };

static const char *const integrands[N_INTEGRANDS] = {"quarter-disk", "triangle", "step-pi", "quarter-gaussian",
                                                     "bilinear"};

/* Integrates all functions; results[i * n_samplers + s] belongs to integrand i and sampler s. */
static koksma_status compute(const koksma__sheet *sheet, const koksma_run *run, koksma_integration *results)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < N_INTEGRANDS && !status; i++) {
        koksma_integral *integral;
        KOKSMA__TRY(koksma_integral_open(integrands[i], 2, &integral));
        for (size_t s = 0; s < sheet->n_samplers && !status; s++) {
            const koksma__sheet_sampler *sampler = sheet->samplers[s];
            koksma_integration_options options = {.n_sizes = sheet->n_sizes,
                                                  .seed = sampler->seed,
                                                  .trials = koksma__sheet_trials(sampler, sheet->trials)};
            memcpy(options.sizes, sheet->sizes, sheet->n_sizes * sizeof *sheet->sizes);
            status = koksma_integration_errors(integral, &sampler->spec, &options, run,
                                               &results[i * sheet->n_samplers + s]);
        }
        koksma_integral_close(integral);
    }
    return status;
}

/* A sampler with one set has one error, without an interval. */
static koksma__estimate rmse_of(const koksma_integration_row *row, const koksma__sheet_sampler *sampler)
{
    return (koksma__estimate){row->rmse, sampler->same ? row->rmse : row->low, sampler->same ? row->rmse : row->high};
}

static void put_chart(const koksma__sheet *sheet, const char *name, const koksma_integration *results,
                      koksma__document *d)
{
    bool positive = true; /* a logarithmic axis cannot show 0, which is the error of an exact estimate */
    for (size_t k = 0; k < sheet->n_samplers * sheet->n_sizes; k++) {
        positive = positive && results[k / sheet->n_sizes].rows[k % sheet->n_sizes].rmse > 0;
    }
    koksma__doc_chart(d, &(koksma__chart){name, "points n", "RMSE", true, positive, -1});
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma__doc_series(d, sheet->samplers[s]->text, NULL, KOKSMA__SERIES_LINE);
        for (size_t i = 0; i < sheet->n_sizes; i++) {
            const koksma_integration_row *row = &results[s].rows[i];
            koksma__doc_point(d, (double)row->n, row->rmse, row->low, row->high);
        }
    }
}

static void put_table(const koksma__sheet *sheet, const koksma_integration *results, koksma__document *d)
{
    koksma__doc_table(d, "integrals");
    koksma__doc_columns(d, "tm integrand;t sampler;i3 RMSE;i2f slope;n3 gain;n9 sets");
    size_t approximate = 0;
    for (size_t k = 0; k < N_INTEGRANDS * sheet->n_samplers; k++) {
        const koksma_integration *r = &results[k];
        const koksma_integration_row *last = &r->rows[sheet->n_sizes - 1];
        const bool biased = sheet->bias.biased && k % sheet->n_samplers == 0;
        koksma__doc_row(d, "");
        const koksma__sheet_sampler *sampler = sheet->samplers[k % sheet->n_samplers];
        koksma__doc_cells(d, "ttiinn", integrands[k / sheet->n_samplers], sampler->text, rmse_of(last, sampler),
                          (koksma__estimate){r->slope.value, r->slope.low, r->slope.high},
                          biased ? (double)NAN : last->gain, (double)last->trials);
        approximate += last->approximate || r->slope.approximate;
    }
    if (approximate) {
        koksma__doc_paragraph(d,
                              "Intervals of %zu of the %zu rows are approximate and may hold in less than 93 %% of "
                              "cases: there are fewer than 16 sets, or their errors are much more skewed or "
                              "heavy-tailed than normal ones (`koksma integrate` marks each).",
                              approximate, (size_t)N_INTEGRANDS * sheet->n_samplers);
    }
}

static void put_commands(const koksma__sheet *sheet, koksma__document *d)
{
    char list[128] = "";
    for (size_t i = 0; i < N_INTEGRANDS; i++) {
        koksma__text_join(list, sizeof list, ",", integrands[i]);
    }
    koksma__doc_commands(d);
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        char sources[KOKSMA__DOC_COMMAND] = "";
        for (size_t i = 0; i < sheet->n_sizes; i++) {
            koksma__text_join(sources, sizeof sources, " ",
                              koksma__sheet_source(sheet->samplers[s], sheet->sizes[i], 2).text);
        }
        koksma__doc_command(d, "koksma integrate %s %s --trials %zu --seed %llu", list, sources,
                            koksma__sheet_trials(sheet->samplers[s], sheet->trials),
                            (unsigned long long)sheet->samplers[s]->seed);
    }
}

koksma_status koksma__sheet_integrals(koksma__sheet *sheet, koksma__document *d)
{
    const size_t count = N_INTEGRANDS * sheet->n_samplers;
    koksma_integration *results = calloc(count, sizeof *results);
    KOKSMA__REQUIRE_MEMORY(results, count * sizeof *results);
    const koksma_run run = koksma__sheet_part(sheet, 0.02, 0.1);
    const koksma_status status = compute(sheet, &run, results);
    if (!status) {
        koksma__doc_section(d, "integrals", "Errors of integration");
        koksma__doc_paragraph(d,
                              "Root mean square errors of the mean of five functions at n = %zu, slopes of log RMSE "
                              "over log n, with 95 %% intervals, which are approximate: simulated ones hold in 95 to "
                              "98 %% for nearly normal errors, in 76 to 99 %% for skewed or heavy-tailed ones. Gain: "
                              "the factor by which more random points are needed for the same error; a biased "
                              "sampler has none. For a sampler that has only one set, the error is that of this set.",
                              sheet->sizes[sheet->n_sizes - 1]);
        put_table(sheet, results, d);
        for (size_t i = 0; i < N_INTEGRANDS && sheet->n_sizes > 1; i++) {
            put_chart(sheet, integrands[i], results + i * sheet->n_samplers, d);
        }
        put_commands(sheet, d);
        koksma__doc_end(d);
    }
    free(results);
    return status;
}
