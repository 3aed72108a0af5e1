/* SPDX-License-Identifier: Apache-2.0 */
/* The sources of a module include this header after all others. It redirects calls of koksma__fail and
   koksma__fail_memory to the functions that the host passes to the module. One source of each module contains
   KOKSMA__MODULE(functions), with the struct of functions that the module offers. */
#ifndef KOKSMA_MODULES_MODULE_SIDE_H
#define KOKSMA_MODULES_MODULE_SIDE_H

#include "modules/module.h"

/* Each thread that loads the module stores the same pointer, possibly while other threads read it. */
extern const koksma__host *_Atomic koksma__own_host;

#define koksma__fail koksma__own_host->fail
#define koksma__fail_memory koksma__own_host->fail_memory

#define KOKSMA__MODULE(functions)                                                                                    \
    const koksma__host *_Atomic koksma__own_host;                                                                    \
    static const void *start_module(const koksma__host *host)                                                        \
    {                                                                                                                \
        koksma__own_host = host;                                                                                     \
        return &(functions);                                                                                         \
    }                                                                                                                \
    extern const koksma__module_entry koksma__entry;                                                                 \
    __attribute__((visibility("default"))) const koksma__module_entry koksma__entry = {KOKSMA_VERSION, start_module};

#endif
