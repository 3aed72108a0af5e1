/* SPDX-License-Identifier: Apache-2.0 */
/* What is known of functions that are products of functions of one coordinate. */
#ifndef KOKSMA_INTEGRANDS_PRODUCT_H
#define KOKSMA_INTEGRANDS_PRODUCT_H

#include "integrands/integrands.h"

/* Takes memory for the factors of the axes. Errors: MEMORY. */
koksma_status koksma__integral_factors(koksma_integral *f);

/* Sets all that is known of a product from its factors. offset and scale must be set. */
void koksma__integral_of_product(koksma_integral *f);

/* prepare() of products whose factors, one for each axis, are the member's constants. */
koksma_status koksma__integral_of_rows(koksma_integral *f);

#endif
