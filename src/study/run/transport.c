/* SPDX-License-Identifier: Apache-2.0 */
/* Finds and loads the module that talks to MPI. */
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <koksma/study.h>

#include "study/run/transport.h"

#define MODULE "koksma-mpi.so"

/* Where the module lies, from the folder of the object that this function is in: beside it in a build, in koksma/
   beside an installed library, and below the library folder of the program's prefix. */
static const char *const PLACES[] = {MODULE, "koksma/" MODULE, "../" KOKSMA_LIBDIR "/koksma/" MODULE};

static bool find(char *path, size_t room)
{
    static const char here = 0; /* an address in this object */
    Dl_info info;
    if (dladdr(&here, &info) && info.dli_fname) {
        /* A program's name may be what it was called by, without a folder. */
        char self[4096];
        const ssize_t length = strchr(info.dli_fname, '/') ? -1 : readlink("/proc/self/exe", self, sizeof self - 1);
        self[length > 0 ? length : 0] = 0;
        const char *object = length > 0 ? self : info.dli_fname, *slash = strrchr(object, '/');
        for (size_t i = 0; slash && i < sizeof PLACES / sizeof *PLACES; i++) {
            const int n = snprintf(path, room, "%.*s/%s", (int)(slash - object), object, PLACES[i]);
            if (n > 0 && (size_t)n < room && !access(path, R_OK)) {
                return true;
            }
        }
    }
    return (size_t)snprintf(path, room, "%s", KOKSMA_MODULE_DIR "/" MODULE) < room && !access(path, R_OK);
}

const char *koksma_study_mpi(void)
{
    static _Thread_local char path[4096];
    return find(path, sizeof path) ? path : NULL;
}

const koksma__transport *koksma__transport_load(const char **problem)
{
    static char text[4200];
    char path[4096];
    *problem = "this build has no MPI: its ranks would all do the same work";
    if (!find(path, sizeof path)) {
        return NULL;
    }
    /* RTLD_GLOBAL, because modules of Open MPI look up its symbols globally. The library is never unloaded. */
    void *module = dlopen(path, RTLD_NOW | RTLD_GLOBAL);
    const koksma__transport *transport = module ? dlsym(module, KOKSMA__TRANSPORT_SYMBOL) : NULL;
    if (!transport) {
        const char *reason = dlerror();
        snprintf(text, sizeof text, "MPI can't be loaded: %s", reason ? reason : "no reason given");
    } else if (transport->version != KOKSMA__TRANSPORT_VERSION) {
        snprintf(text, sizeof text, "%s belongs to another release", path);
        transport = NULL;
    }
    *problem = transport ? NULL : text;
    return transport;
}
