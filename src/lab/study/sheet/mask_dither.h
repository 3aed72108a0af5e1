/* SPDX-License-Identifier: Apache-2.0 */
/* Dithering on a datasheet of masks. */
#ifndef KOKSMA_STUDY_SHEET_MASK_DITHER_H
#define KOKSMA_STUDY_SHEET_MASK_DITHER_H

#include <koksma/datasheet.h>
#include <koksma/maskfile.h>

#include "study/report/document.h"

/* What koksma_mask_datasheet was given; filters: those that filter_names means. */
typedef struct koksma__mask_sheet {
    const koksma_mask *masks;
    const char *const *names;
    size_t n;
    const char *const *filter_names;
    koksma_mask_filter *filters;
    size_t n_filters;
    const koksma_run *run;
} koksma__mask_sheet;

/* Writes the section on dithering, if a mask has one uniform number a pixel. Errors: MEMORY, INTERRUPTED, UNSUPPORTED (no
   PNG). */
koksma_status koksma__mask_sheet_dither(const koksma__mask_sheet *sheet, koksma__document *d);

#endif
