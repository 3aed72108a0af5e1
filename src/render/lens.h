/* SPDX-License-Identifier: Apache-2.0 */
/* The points of a lens through which camera rays pass. */
#ifndef KOKSMA_RENDER_LENS_H
#define KOKSMA_RENDER_LENS_H

#include "render/description.h"
#include "render/pipelines/batch.h"

/* Maps n pairs of the unit square, n a multiple of KOKSMA__LANE_STEP, to points (x to the right, y down) on the
   camera's lens of radius 1: a disk, or a polygon if the camera has blades. */
void koksma__lens_points(const koksma__camera *camera, const koksma__batch_table *batch, const float *pairs, int n,
                         float *x, float *y);

#endif
