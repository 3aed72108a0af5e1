/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of the line and the plane whose integral and variation are known. */
#ifndef KOKSMA_STUDY_REPORT_INTEGRANDS_H
#define KOKSMA_STUDY_REPORT_INTEGRANDS_H

#include <stddef.h>

#include "core/visibility.h"

/* variation: in the sense of Hardy and Krause, anchored at 1 as Koksma's inequality has it: of f(x) the total
   variation; of f(x, y) those of f(x, 1) and f(1, y) and that of Vitali. Infinite: no rectangles are small enough. */
typedef struct koksma__integrand {
    const char *name, *title;
    int dim; /* 1: x alone */
    double (*at)(const double *x);
    double integral, variation;
    double range; /* its largest value less its smallest: no error is larger */
} koksma__integrand;

/* Function i of the table, NULL past the end. */
KOKSMA__LAB const koksma__integrand *koksma__integrand_at(size_t i);

#endif
