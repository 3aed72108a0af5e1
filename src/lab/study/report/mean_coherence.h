/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether the images of a pattern have visible bands: the coherence of the mean spectrum of the errors of its first
 * trials (koksma_coherence), which is the one rule of a report, as of `koksma compare` and `koksma rank`. Averages show
 * weaker waves than single images do. The store has coherences of single images only, so the images are rendered again,
 * once for each report, as far as all of them have rows.
 */
#ifndef KOKSMA_STUDY_REPORT_MEAN_COHERENCE_H
#define KOKSMA_STUDY_REPORT_MEAN_COHERENCE_H

#include "study/report/document.h"
#include "study/report/means.h"
#include "study/run/study.h"
#include "study/run/tasks.h"

/* The number of trials over which spectra of the error are averaged. */
enum { KOKSMA__SPECTRUM_TRIALS = 8 };

/* Finds the coherence of images, against the block's last reference. out->images is 0 where it is not known: where rows
   or the reference are missing, and where a report would have to render more than 2^28 samples for coherences. Errors:
   those of renders, INTERRUPTED. */
koksma_status koksma__mean_coherence(koksma_study *study, const koksma__image_mean *of, koksma_coherence_values *out);

/* Frees what koksma__mean_coherence keeps; for the end of a report. */
void koksma__mean_coherence_forget(koksma_study *study);

/* Renders the picture of a trial of a task. */
koksma_status koksma__task_picture(const koksma__task *task, long long trial, const koksma_run *run,
                                   koksma_image *out);

/* Write the columns, and the cells of a row: the coherence, the upper end of noise, and whether there are bands. */
void koksma__bands_columns(koksma__document *d);
void koksma__bands_cells(koksma__document *d, const koksma_coherence_values *values);

#endif
