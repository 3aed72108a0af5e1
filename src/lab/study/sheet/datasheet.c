/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes datasheets: runs all parts in order and puts the sections together. What the first section, the verdict,
 * depends on is computed before any is written. The format is that of a report
 * (docs/report-format.md) with other members before the content, and the page that shows reports also shows
 * datasheets. Only the member "seconds" depends on the clock.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/status.h"
#include "study/sheet/sheet.h"

static koksma_status put_head(koksma__sheet *sheet, koksma__document *d)
{
    char title[KOKSMA_MAX_SPEC + 32];
    snprintf(title, sizeof title, "Datasheet of %s", sheet->samplers[0]->text);
    koksma__doc_head(d, "koksma-datasheet", title, "", NULL);
    koksma__json_begin_array(&d->json, "samplers");
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma__json_write_text(&d->json, NULL, sheet->samplers[s]->text);
    }
    koksma__json_end(&d->json);
    koksma__doc_content(d);
    return KOKSMA_OK;
}

/* Writes the last section: what was left out and why, and the version and seeds behind the numbers. */
static koksma_status put_origin(koksma__sheet *sheet, koksma__document *d)
{
    koksma__document notes = sheet->notes;
    sheet->notes = (koksma__document){0};
    koksma__doc_section(d, "origin", "How this was made");
    koksma__doc_paragraph(
        d,
        "koksma %s. The commands below each number compute it again. The %s of a command is the seed of the first "
        "set; each further set has the next seed. Sets of the sampler: up to %zu of each size; images: up to %zu.",
        koksma_version(), "--seed", koksma__sheet_trials(sheet->samplers[0], sheet->trials), sheet->max_trials);
    if (sheet->n_notes) {
        koksma__doc_paragraph(d, "Left out:");
        koksma__doc_append(d, &notes);
    }
    koksma__doc_end(d);
    return KOKSMA_OK;
}

/* What several sections need, and then the sections in their order. */
static koksma_status (*const parts[])(koksma__sheet *sheet, koksma__document *d) = {koksma__sheet_look_for_bias,
                                                                                    koksma__sheet_measure_plane,
                                                                                    koksma__sheet_rank,
                                                                                    put_head,
                                                                                    koksma__sheet_verdict,
                                                                                    koksma__sheet_draw_points,
                                                                                    koksma__sheet_put_rankings,
                                                                                    koksma__sheet_put_measures,
                                                                                    koksma__sheet_integrals,
                                                                                    koksma__sheet_spectra,
                                                                                    koksma__sheet_verify,
                                                                                    koksma__sheet_projections,
                                                                                    put_origin};

static koksma_status put_content(koksma__sheet *sheet, koksma__document *d)
{
    char folder[KOKSMA__FOLDER] = "";
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        KOKSMA__TRY(parts[i](sheet, d));
    }
    koksma__doc_close(d);
    for (size_t i = 0; i < sheet->n_samplers; i++) {
        koksma__folder_join(folder, sheet->samplers[i]->text);
    }
    for (size_t i = 0; sheet->options->scenes && i < sheet->options->n_scenes; i++) {
        koksma__folder_join(folder, sheet->options->scenes[i]);
    }
    koksma__doc_hide_folder(d, folder);
    return KOKSMA_OK;
}

static koksma_status check_options(const koksma_datasheet_options *o)
{
    KOKSMA__FAIL_IF(
        !o->sampler || !*o->sampler, KOKSMA_ARGUMENT,
        "sampler: it must be a pattern's spec, a file of points, or a family of files such as my_{n}_{seed}.npy");
    KOKSMA__FAIL_IF(o->beside && o->n_beside > KOKSMA_MAX_BESIDE, KOKSMA_ARGUMENT,
                    "n_beside: %zu samplers to compare with; the maximum is %d", o->n_beside, KOKSMA_MAX_BESIDE);
    KOKSMA__FAIL_IF(o->scenes && o->n_scenes > KOKSMA_MAX_SHEET_SCENES, KOKSMA_ARGUMENT,
                    "n_scenes: %zu scenes; the maximum is %d", o->n_scenes, KOKSMA_MAX_SHEET_SCENES);
    for (size_t i = 0; o->beside && i < o->n_beside; i++) {
        KOKSMA__FAIL_IF(!o->beside[i], KOKSMA_ARGUMENT, "beside[%zu] is NULL", i);
    }
    for (size_t i = 0; o->scenes && i < o->n_scenes; i++) {
        KOKSMA__FAIL_IF(!o->scenes[i], KOKSMA_ARGUMENT, "scenes[%zu] is NULL", i);
        for (size_t k = 0; k < i; k++) {
            KOKSMA__FAIL_IF(!strcmp(o->scenes[k], o->scenes[i]), KOKSMA_ARGUMENT, "scene '%s' is given twice",
                            o->scenes[i]);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma_datasheet(const koksma_datasheet_options *options, const koksma_run *run, char **json)
{
    KOKSMA__REQUIRE(options, json);
    KOKSMA__REQUIRE_RUN(run);
    const double start_s = koksma__now_s();
    koksma__sheet *sheet = calloc(1, sizeof *sheet);
    koksma__document d = {0};
    *json = NULL;
    koksma_status status = sheet ? check_options(options) : koksma__fail_memory(sizeof *sheet);
    if (!status) {
        size_t size;
        *sheet = (koksma__sheet){.options = options, .run = run};
        status = koksma__sheet_choose(sheet);
        status = status ? status : put_content(sheet, &d);
        if (!status) {
            koksma__json_break(&d.json);
            koksma__json_write_rounded(&d.json, "seconds", koksma__now_s() - start_s, 3);
            koksma__json_end(&d.json);
            status = koksma__json_finish(&d.json, json, &size);
        }
        koksma__json_writer_fini(&d.json);
        koksma__sheet_values_fini(&sheet->plane);
        koksma__json_writer_fini(&sheet->notes.json);
        free(sheet->rankings);
    }
    free(sheet);
    return status;
}

koksma_status koksma_datasheet_page(const char *json, char **page)
{
    KOKSMA__REQUIRE(json, page);
    *page = NULL;
    KOKSMA__FAIL_IF(strncmp(json, "{\"format\":\"koksma-datasheet\"", 27) != 0 || strstr(json, "</"), KOKSMA_ARGUMENT,
                    "json: it must be the text that koksma_datasheet returned");
    *page = koksma__page_text(json);
    KOKSMA__REQUIRE_MEMORY(*page, strlen(json));
    return KOKSMA_OK;
}
