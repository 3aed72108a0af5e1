/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Datasheets: everything that is known about one sampler beside a few others, as one page. Part of libkoksma-lab.
 *
 *     const koksma_datasheet_options options = {.sampler = "sobol:scramble=owen"};
 *     char *json, *page;
 *     if (!koksma_datasheet(&options, NULL, &json) && !koksma_datasheet_page(json, &page)) {
 *         fputs(page, stdout);
 *     }
 */
#ifndef KOKSMA_DATASHEET_H
#define KOKSMA_DATASHEET_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { KOKSMA_MAX_BESIDE = 7, KOKSMA_MAX_SHEET_SCENES = 16 };

/* What a datasheet is about. A sampler is the spec of a pattern, a file of points, or the name of a family of files
   with {n} and {seed} in it, such as "my_{n}_{seed}.npy": my_256_3.npy has the 256 points of seed 3. */
typedef struct koksma_datasheet_options {
    const char *sampler;
    const char *const *beside; /* up to KOKSMA_MAX_BESIDE samplers to compare with; NULL: random, jittered and
                                  sobol:scramble=owen, without the sampler itself */
    size_t n_beside;           /* with beside not NULL; may be 0 */
    const char *const *scenes; /* up to KOKSMA_MAX_SHEET_SCENES, as for koksma_scene_open; NULL: three that ship */
    size_t n_scenes;           /* with scenes not NULL; may be 0 */
    const char *metric;        /* of images, as for koksma_metric_parse (image.h); NULL: mae */
    bool quick;                /* fewer sets, sizes and images */
} koksma_datasheet_options;

/* Measures a sampler and writes all that was found as JSON (docs/report-format.md). Files decide the sizes; patterns
   have 16, 64, 256, ... points. All counts are fixed: the text depends on the options and on what the files hold, but
   for the member "seconds", which is the last line but one.
     json  receives a text that the caller frees with free()
   Errors: those of koksma_generate for the sampler (MISSING names the files that were looked for), of
   koksma_rank_patterns for a scene, ARGUMENT (too many samplers or scenes, one given twice), MEMORY, INTERRUPTED. A
   sampler beside it, or a measure, that cannot serve a size is left out, and the sheet says why. */
KOKSMA_API koksma_status koksma_datasheet(const koksma_datasheet_options *options, const koksma_run *run,
                                          char **json);

/* Puts a datasheet into the page that shows it, one HTML file that needs no network.
     page  receives a text that the caller frees with free()
   Errors: ARGUMENT (no datasheet), MEMORY. */
KOKSMA_API koksma_status koksma_datasheet_page(const char *json, char **page);

#ifdef __cplusplus
}
#endif

#endif
