/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Datasheets: one page with all measurements of one sampler, compared with a few other samplers. Part of
 * libkoksma-lab.
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

/* The sampler that a datasheet describes, and what to compare it with. A sampler is the spec of a pattern, a file
   of points, or a template of file names with {n} and {seed}. With the template "my_{n}_{seed}.npy" the file
   my_256_3.npy has the 256 points of seed 3. */
typedef struct koksma_datasheet_options {
    const char *sampler;
    const char *const *beside; /* up to KOKSMA_MAX_BESIDE samplers to compare with; NULL: those of random, jittered
                                  and sobol:scramble=owen that differ from `sampler` */
    size_t n_beside;           /* length of `beside` if that is not NULL; may be 0 */
    const char *const *scenes; /* up to KOKSMA_MAX_SHEET_SCENES scenes, as for koksma_scene_open; NULL: three scenes
                                  of the library */
    size_t n_scenes;           /* length of `scenes` if that is not NULL; may be 0 */
    const char *metric;        /* metric of the image error, as for koksma_metric_parse (image.h) (NULL: mae) */
    bool quick;                /* true: use fewer point sets, numbers of points and images */
} koksma_datasheet_options;

/* Measures a sampler and writes all results as JSON (docs/report-format.md). A sampler made of files is measured with
   the numbers of points that the files have, a pattern with 16, 64, 256, ... points. Equal options and files give
   equal texts, except for the member "seconds" on the second-last line.
     json  receives a text that the caller frees with free()
   Errors: those of koksma_generate for the sampler (the message of MISSING names the files that were looked for;
   MALFORMED also: its file has points of 1 dimension),
   those of koksma_rank_patterns for a scene, ARGUMENT (too many samplers or scenes, or one given twice), MEMORY,
   INTERRUPTED. A compared sampler or a measure that does not accept one of the numbers of points is no error: the
   datasheet leaves it out and gives the reason. */
KOKSMA_API koksma_status koksma_datasheet(const koksma_datasheet_options *options, const koksma_run *run,
                                          char **json);

/* Makes the HTML page of a datasheet: one file that needs no network.
     page  receives a text that the caller frees with free()
   Errors: ARGUMENT (json is not a datasheet), MEMORY. */
KOKSMA_API koksma_status koksma_datasheet_page(const char *json, char **page);

#ifdef __cplusplus
}
#endif

#endif
