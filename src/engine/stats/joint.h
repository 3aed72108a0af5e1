/* SPDX-License-Identifier: Apache-2.0 */
/* The standard error of a slope over several sizes (koksma_joint_line). */
#ifndef KOKSMA_STATS_JOINT_H
#define KOKSMA_STATS_JOINT_H

#include <koksma/series.h>

#include "core/visibility.h"

/* Returns the standard error of the slope of log means[i] against log sizes[i] from the spread of two or more trials.
   log_errors: NULL, or the standard errors of the log means[i], whose correlations then come from the trials. Means
   that are not positive and finite are left out. */
KOKSMA__LAB double koksma__joint_error(const koksma_joint *joint, size_t n, const double *sizes, const double *means,
                                       const double *log_errors);

#endif
