/* SPDX-License-Identifier: Apache-2.0 */
/* The sections of a datasheet with drawings, verified properties and projections of the points. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_POINTS_H
#define KOKSMA_STUDY_SHEET_SHEET_POINTS_H

#include "study/sheet/sheet.h"

koksma_status koksma__sheet_draw_points(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_verify(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_projections(koksma__sheet *sheet, koksma__document *d);

#endif
