/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_L2_BOXES_H
#define KOKSMA_MEASURES_L2_BOXES_H

#include "measures/l2/l2.h"

/* Returns the table row of a measure in l2_boxes.c, or NULL for any other measure. */
const koksma__l2_row *koksma__l2_row_of(const koksma_measure *measure);

#endif
