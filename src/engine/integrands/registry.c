/* SPDX-License-Identifier: Apache-2.0 */
/* The table of integrands (integrands.def), with lookup by index and by name. */
#include "core/lookup.h"
#include "integrands/integrands.h"

static const koksma_integrand *const integrands[] = {
#define INTEGRAND(name) &koksma__integrand_##name,
#include "integrands/integrands.def"
#undef INTEGRAND
};

KOKSMA__LOOKUP(koksma_integrand, integrands)
