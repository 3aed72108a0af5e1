/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_SAMPLED_H
#define KOKSMA_MEASURES_SHARED_SAMPLED_H

#include <koksma/koksma.h>

/* What `count` sampled squares say: their mean, its root, and the root's standard error, that of the mean over twice
   the root; NaN for one sample. */
void koksma__sampled_root(const double *squares, size_t count, koksma_value *out);

#endif
