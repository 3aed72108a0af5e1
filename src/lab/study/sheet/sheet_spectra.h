/* SPDX-License-Identifier: Apache-2.0 */
/* The section of a datasheet with spectra and pair correlations. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_SPECTRA_H
#define KOKSMA_STUDY_SHEET_SHEET_SPECTRA_H

#include "study/sheet/sheet.h"

koksma_status koksma__sheet_spectra(koksma__sheet *sheet, koksma__document *d);

#endif
