/* SPDX-License-Identifier: Apache-2.0 */
#include <string.h>

#include "render/integrators/integrators.h"

static const koksma_integrator *const table[] = {
#define INTEGRATOR(name) &koksma__integrator_##name,
#include "render/integrators/integrators.def"
#undef INTEGRATOR
};

const koksma_integrator *koksma_integrator_at(size_t i)
{
    return i < sizeof table / sizeof *table ? table[i] : NULL;
}

const koksma_integrator *koksma_integrator_find(const char *name)
{
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        if (!strcmp(table[i]->name, name)) {
            return table[i];
        }
    }
    return NULL;
}
