/* SPDX-License-Identifier: Apache-2.0 */
#include "core/lookup.h"
#include "render/integrators/integrators.h"

static const koksma_integrator *const table[] = {
#define INTEGRATOR(name) &koksma__integrator_##name,
#include "render/integrators/integrators.def"
#undef INTEGRATOR
};

KOKSMA__LOOKUP(koksma_integrator, table)
