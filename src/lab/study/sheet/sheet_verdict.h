/* SPDX-License-Identifier: Apache-2.0 */
/* The section of a datasheet with the verdict. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_VERDICT_H
#define KOKSMA_STUDY_SHEET_SHEET_VERDICT_H

#include "study/sheet/sheet.h"

void koksma__sheet_verdict(koksma__sheet *sheet, koksma__document *d);

#endif
