/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ANOVA components of products as integrands. The component that belongs to a set u of coordinates of the product
 * offset + scale prod g_i(x_i) is
 *
 *     scale prod_{i in u} (g_i(x_i) - m_i) prod_{i not in u} m_i,      m_i the mean of g_i,
 *
 * with integral 0 and variance scale^2 prod_u (q_i - m_i^2) prod_{not u} m_i^2. The components of all nonempty u add
 * up to the function minus its integral, and their integration errors add up to the function's error: they show which
 * projections of a pattern cause its error.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "integrands/integrands.h"

static double factor_at(const koksma_integral *f, int axis, double x)
{
    return f->factors[axis].at ? f->factors[axis].at(x) : f->factor(f, axis, x);
}

/* Returns the value of the component at x; context points to the component. */
static double at(const double *x, int dim, void *context)
{
    const koksma_integral *f = context, *whole = f->whole;
    double product = whole->scale;
    (void)dim;
    for (int i = 0; i < whole->axes; i++) {
        product *= f->chosen[i] ? factor_at(whole, i, x[i]) - whole->factors[i].mean : whole->factors[i].mean;
    }
    return product;
}

/* Opens a second copy of the integrand, which the component owns. */
static koksma_status open_whole(const koksma_integral *integral, koksma_integral **out)
{
    koksma_integral_facts facts;
    koksma_integral_about(integral, &facts);
    KOKSMA__FAIL_IF(!integral->factors, KOKSMA_UNSUPPORTED,
                    "%s: components are known only for products of functions of one coordinate", facts.text);
    return koksma_integral_open(facts.text, facts.dim, out);
}

koksma_status koksma_integral_component(const koksma_integral *integral, const int *axes, size_t n_axes,
                                        koksma_integral **out)
{
    KOKSMA__REQUIRE(integral, axes, out);
    char name[64] = "component";
    *out = NULL;
    KOKSMA__FAIL_IF(n_axes < 1 || n_axes > KOKSMA_MAX_ANOVA_AXES, KOKSMA_ARGUMENT,
                    "koksma_integral_component: n_axes: it takes 1 to %d axes", KOKSMA_MAX_ANOVA_AXES);
    koksma_integral *whole;
    KOKSMA__TRY(open_whole(integral, &whole));
    for (size_t k = 0; k < n_axes; k++) {
        const size_t used = strlen(name);
        snprintf(name + used, sizeof name - used, "%c%d", k ? ',' : ' ', axes[k]);
    }
    const koksma_function function = {name, whole->dim, whole->dim, at, NULL, 0};
    koksma_status status = koksma_integral_of_function(&function, whole->dim, out);
    if (status) {
        koksma_integral_close(whole);
        return status;
    }
    koksma_integral *f = *out;
    f->whole = whole; /* closed when the component is closed */
    f->function.context = f;
    f->chosen = calloc((size_t)whole->axes, sizeof *f->chosen);
    status = f->chosen ? KOKSMA_OK : koksma__fail_memory((size_t)whole->axes);
    for (size_t k = 0; k < n_axes && !status; k++) {
        if (axes[k] < 0 || axes[k] >= whole->axes || f->chosen[axes[k]]) {
            status = koksma__fail(KOKSMA_ARGUMENT,
                                  "koksma_integral_component: axes: %d: it takes different numbers from 0 to %d",
                                  axes[k], whole->axes - 1);
        } else {
            f->chosen[axes[k]] = true;
        }
    }
    f->variance = whole->scale * whole->scale;
    for (int i = 0; i < whole->axes && !status; i++) {
        const koksma__factor *g = &whole->factors[i];
        f->variance *= f->chosen[i] ? g->square - g->mean * g->mean : g->mean * g->mean;
    }
    if (status) {
        koksma_integral_close(f);
        *out = NULL;
    }
    return status;
}
