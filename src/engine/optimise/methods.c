/* SPDX-License-Identifier: Apache-2.0 */
/* The table of search methods (methods.def), with lookup by index and by name. */
#include "optimise/methods.h"
#include "core/lookup.h"

static const koksma_method *const methods[] = {
#define METHOD(name) &koksma__method_##name,
#include "optimise/methods.def"
#undef METHOD
};

KOKSMA__LOOKUP(koksma_method, methods)
