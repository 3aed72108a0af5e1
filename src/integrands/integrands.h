/* SPDX-License-Identifier: Apache-2.0 */
/* The table of integrands, and what its members know of themselves. */
#ifndef KOKSMA_INTEGRANDS_INTEGRANDS_H
#define KOKSMA_INTEGRANDS_INTEGRANDS_H

#include <koksma/integrate.h>

#define INTEGRAND(name) extern const koksma_integrand koksma__integrand_##name;
#include "integrands/integrands.def"
#undef INTEGRAND

/* One coordinate's factor g of a product: over [0,1] its mean, the mean of its square, its variation, |g(1)|, and its
   range. */
typedef struct koksma__factor {
    double mean, square, variation, end, lowest, highest;
    double (*at)(double x); /* g; NULL: the member's factor() has it */
} koksma__factor;

struct koksma_integral {
    const koksma_integrand *integrand; /* NULL: the function of a caller */
    koksma_function function;          /* with a name of its own */
    int dim, axes;
    double params[KOKSMA_MAX_PARAMS];
    double value, variance, variation, lowest, highest;
    /* Var(E(f | x_u)), u being the axes that are held. NULL: no closed form. */
    double (*explained)(const koksma_integral *f, const bool *held);
    /* offset + scale * the product of the factors' functions, one factor for each axis */
    double offset, scale;
    koksma__factor *factors;                                        /* NULL: it is no product */
    double (*factor)(const koksma_integral *f, int axis, double x); /* g of an axis; NULL: factors[axis].at has it */
    double *a, *b;                                                  /* two numbers for each axis, of the member */
    /* Of an ANOVA component: the product, and whether each axis is in it (component.c). */
    koksma_integral *whole;
    bool *chosen;
};

#endif
