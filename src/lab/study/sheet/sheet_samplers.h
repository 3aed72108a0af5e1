/* SPDX-License-Identifier: Apache-2.0 */
/* Chooses the samplers and sizes of a datasheet, and generates points. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_SAMPLERS_H
#define KOKSMA_STUDY_SHEET_SHEET_SAMPLERS_H

#include "study/sheet/sheet.h"

/* Chooses samplers, sizes, trials and samples per pixel. Errors: those of koksma_datasheet about samplers. */
koksma_status koksma__sheet_choose(koksma__sheet *sheet);

/* Generates the points of a trial; run: of one thread. */
koksma_status koksma__sheet_points(const koksma__sheet_sampler *sampler, size_t n, int dim, size_t trial,
                                   const koksma_run *run, koksma_points *out);

/* The number of sets to measure: `wanted`, or fewer if the sampler has fewer. */
size_t koksma__sheet_trials(const koksma__sheet_sampler *sampler, size_t wanted);

/* The largest of the sheet's sizes up to `most`, or the smallest if all are larger. */
size_t koksma__sheet_size(const koksma__sheet *sheet, size_t most);

#endif
