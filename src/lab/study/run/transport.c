/* SPDX-License-Identifier: Apache-2.0 */
/* Finds and loads the module that calls MPI. */
#include <dlfcn.h>
#include <stdio.h>

#include <koksma/study.h>

#include "modules/module.h"
#include "study/run/transport.h"

const char *koksma_study_mpi(void)
{
    static _Thread_local char path[4096];
    return koksma__module_path("mpi", path, sizeof path) ? path : NULL;
}

const koksma__transport *koksma__transport_load(const char **problem)
{
    static char text[4200];
    char path[4096];
    *problem = "this build has no MPI support, so that every rank would do the whole work";
    if (!koksma__module_path("mpi", path, sizeof path)) {
        return NULL;
    }
    /* RTLD_GLOBAL, because modules of Open MPI look up its symbols globally. The library is never unloaded. */
    void *module = dlopen(path, RTLD_NOW | RTLD_GLOBAL);
    const koksma__transport *transport = module ? dlsym(module, KOKSMA__TRANSPORT_SYMBOL) : NULL;
    if (!transport) {
        const char *reason = dlerror();
        snprintf(text, sizeof text, "MPI can't be loaded: %s", reason ? reason : "no reason given");
    } else if (transport->version != KOKSMA__TRANSPORT_VERSION) {
        snprintf(text, sizeof text, "%s belongs to another release of koksma", path);
        transport = NULL;
    }
    *problem = transport ? NULL : text;
    return transport;
}
