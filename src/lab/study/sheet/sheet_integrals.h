/* SPDX-License-Identifier: Apache-2.0 */
/* The section of a datasheet on errors of integration. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_INTEGRALS_H
#define KOKSMA_STUDY_SHEET_SHEET_INTEGRALS_H

#include "study/sheet/sheet.h"

koksma_status koksma__sheet_integrals(koksma__sheet *sheet, koksma__document *d);

#endif
