/* SPDX-License-Identifier: Apache-2.0 */
/* The rankings of samplers in scenes, and the section of a datasheet with them. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_SCENES_H
#define KOKSMA_STUDY_SHEET_SHEET_SCENES_H

#include "study/sheet/sheet.h"

koksma_status koksma__sheet_rank(koksma__sheet *sheet);
void koksma__sheet_put_rankings(koksma__sheet *sheet, koksma__document *d);

#endif
