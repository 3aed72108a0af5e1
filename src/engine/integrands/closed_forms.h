/* SPDX-License-Identifier: Apache-2.0 */
/* Functions with closed forms: products of functions of one coordinate each, and functions of the plane that are none. */
#ifndef KOKSMA_INTEGRANDS_CLOSED_FORMS_H
#define KOKSMA_INTEGRANDS_CLOSED_FORMS_H

#include "integrands/integrands.h"

/* Allocates the factors of the axes. Errors: MEMORY. */
koksma_status koksma__integral_factors(koksma_integral *f);

/* Computes the integral, variances and variation of a product from its factors. offset and scale must be set. */
void koksma__integral_of_product(koksma_integral *f);

/* The function prepare() of products whose factors, one for each axis, are constants of the integrand. */
koksma_status koksma__integral_of_rows(koksma_integral *f);

/* square: the integral of f^2. The function's range is [0,1], and its variation is infinite. */
typedef struct koksma__plane {
    double value, square;
} koksma__plane;

/* The function prepare() of integrands whose constants are a koksma__plane. */
koksma_status koksma__integral_of_plane(koksma_integral *f);

/* Defines an integrand of n_axes axes. The remaining arguments give its known properties: ROWS of factors, PLANE, or
   initialisers. */
#define KOKSMA__CLOSED_MEMBER(id, text, says, source, n_axes, function, ...)                                         \
    const koksma_integrand koksma__integrand_##id = {                                                                \
        .name = text,                                                                                                \
        .title = says,                                                                                               \
        .cite = source,                                                                                              \
        .revision = 1, /* own elementary functions */                                                                \
        .known = "closed form",                                                                                      \
        .min_dim = n_axes,                                                                                           \
        .max_dim = KOKSMA_MAX_DIM,                                                                                   \
        .axes = n_axes,                                                                                              \
        .at = function,                                                                                              \
        __VA_ARGS__,                                                                                                 \
    }
#define KOKSMA__ROWS(...)                                                                                            \
    .prepare = koksma__integral_of_rows, .constants = (const koksma__factor[])                                       \
    {                                                                                                                \
        __VA_ARGS__                                                                                                  \
    }
#define KOKSMA__PLANE(...)                                                                                           \
    .prepare = koksma__integral_of_plane, .constants = &(const koksma__plane)                                        \
    {                                                                                                                \
        __VA_ARGS__                                                                                                  \
    }

#endif
