/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_L2_BOXES_H
#define KOKSMA_MEASURES_L2_BOXES_H

#include "measures/shared/l2.h"

/* The table row of a measure of l2_boxes.c; NULL for any other measure. */
const koksma__l2_row *koksma__l2_row_of(const koksma_measure *measure);

#endif
