/* SPDX-License-Identifier: Apache-2.0 */
/* Which samplers a sheet compares, at which sizes, and their points. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_SAMPLERS_H
#define KOKSMA_STUDY_SHEET_SHEET_SAMPLERS_H

#include "study/sheet/sheet.h"

/* Chooses samplers, sizes, trials and numbers of samples. Errors: koksma_datasheet's of samplers. */
koksma_status koksma__sheet_choose(koksma__sheet *sheet);

/* The points of a trial. */
koksma_status koksma__sheet_points(const koksma__sheet_sampler *sampler, size_t n, int dim, size_t trial,
                                   koksma_points *out);

/* Sets of a sampler that are measured: no more than there are. */
size_t koksma__sheet_trials(const koksma__sheet_sampler *sampler, size_t wanted);

/* The largest size up to `most`, or the smallest that there is. */
size_t koksma__sheet_size(const koksma__sheet *sheet, size_t most);

#endif
