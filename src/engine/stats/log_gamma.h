/* SPDX-License-Identifier: Apache-2.0 */
/* The logarithm of the gamma function. */
#ifndef KOKSMA_STATS_LOG_GAMMA_H
#define KOKSMA_STATS_LOG_GAMMA_H

#include "core/visibility.h"

/* log gamma(x), x > 0. Several threads may call it at the same time, unlike lgamma. */
KOKSMA__LAB double koksma__log_gamma(double x);

#endif
