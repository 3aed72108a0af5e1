/* SPDX-License-Identifier: Apache-2.0 */
/* The constants of functions that are products of functions of one coordinate each. */
#ifndef KOKSMA_INTEGRANDS_PRODUCT_H
#define KOKSMA_INTEGRANDS_PRODUCT_H

#include "integrands/integrands.h"

/* Allocates the factors of the axes. Errors: MEMORY. */
koksma_status koksma__integral_factors(koksma_integral *f);

/* Computes the integral, variances and variation of a product from its factors. offset and scale must be set. */
void koksma__integral_of_product(koksma_integral *f);

/* The function prepare() of products whose factors, one for each axis, are constants of the integrand. */
koksma_status koksma__integral_of_rows(koksma_integral *f);

#endif
