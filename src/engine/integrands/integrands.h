/* SPDX-License-Identifier: Apache-2.0 */
/* The table of integrands, with their known properties: integral, variance, variation and range. */
#ifndef KOKSMA_INTEGRANDS_INTEGRANDS_H
#define KOKSMA_INTEGRANDS_INTEGRANDS_H

#include <koksma/integrate.h>

#define INTEGRAND(name) extern const koksma_integrand koksma__integrand_##name;
#include "integrands/integrands.def"
#undef INTEGRAND

/* The factor g of one coordinate in a product: its mean over [0,1], the mean of its square, its variation, |g(1)|,
   and its range. */
typedef struct koksma__factor {
    double mean, square, variation, end, lowest, highest;
} koksma__factor;

struct koksma_integral {
    const koksma_integrand *integrand; /* NULL: a function of the caller */
    koksma_function function;          /* the caller's function, if integrand is NULL */
    int dim, axes;
    double params[KOKSMA_MAX_PARAMS];
    double value, variance, variation, lowest, highest;
    /* a product is offset + scale * the product of the factors, one for each axis */
    double offset, scale;
    koksma__factor *factors; /* NULL: the function is not a product */
    /* two parameters for each axis, which the integrand defines */
    double *a, *b;
};

#endif
