/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_PARTS_SAMPLED_H
#define KOKSMA_MEASURES_PARTS_SAMPLED_H

#include <koksma/koksma.h>

/* The result of a sampled L2 measure from the squared deviations of count >= 2 random regions: their mean, its root,
   and the root's standard error by the delta method, which is that of the mean over twice the root. */
void koksma__sample_root(size_t count, const double *squares, koksma_value *out);

#endif
