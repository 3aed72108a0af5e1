/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_SAMPLED_H
#define KOKSMA_MEASURES_SHARED_SAMPLED_H

#include <koksma/koksma.h>

/* Writes to out the mean of `count` sampled squares, its root, and the standard error of the root, which is the
   standard error of the mean divided by twice the root (NaN for one sample). */
void koksma__sampled_root(const double *squares, size_t count, koksma_value *out);

#endif
