/* SPDX-License-Identifier: Apache-2.0 */
/* Spectra and pair correlations: a section. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_SPECTRA_H
#define KOKSMA_STUDY_SHEET_SHEET_SPECTRA_H

#include "study/sheet/sheet.h"

koksma_status koksma__sheet_spectra(koksma__sheet *sheet, koksma__document *d);

#endif
