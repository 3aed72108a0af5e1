/* SPDX-License-Identifier: Apache-2.0 */
/* Finds and loads modules: beside the program or library that this is in, in koksma/ beside an installed library or in
   the library folder of a program's prefix, and where the build installs them; never by a search path or a variable. */
#define _GNU_SOURCE /* dladdr */
#include "modules/module.h"

#include <dlfcn.h>
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where modules are looked for, relative to the folder of the library or program that this code is in. The second is
   for programs in folders below the build's. */
static const char *const PLACES[] = {"", "../", "koksma/", "../" KOKSMA_LIBDIR "/koksma/"};

bool koksma__module_path(const char *name, char *path, size_t room)
{
    static const char here = 0; /* an address in this object */
    Dl_info info;
    if (dladdr(&here, &info) && info.dli_fname) {
        /* A program's name may be what it was called by: without a folder, or from one that it has left since. A link
           leads to the folder. */
        char *object = strchr(info.dli_fname, '/') ? realpath(info.dli_fname, NULL) : NULL;
        object = object ? object : realpath("/proc/self/exe", NULL);
        const char *slash = object ? strrchr(object, '/') : NULL;
        bool found = false;
        for (size_t i = 0; slash && !found && i < sizeof PLACES / sizeof *PLACES; i++) {
            const int n = snprintf(path, room, "%.*s/%skoksma-%s.so", (int)(slash - object), object, PLACES[i], name);
            found = n > 0 && (size_t)n < room && !access(path, R_OK);
        }
        free(object);
        if (found) {
            return true;
        }
    }
    return (size_t)snprintf(path, room, KOKSMA_MODULE_DIR "/koksma-%s.so", name) < room && !access(path, R_OK);
}

bool koksma__module_exists(const koksma__module *module)
{
    char path[4096];
    return koksma__module_path(module->name, path, sizeof path);
}

koksma_status koksma__module_missing(const koksma__module *module)
{
    return koksma__fail(KOKSMA_UNSUPPORTED,
                        "koksma-%s.so is missing: install the package koksma-modules, or build with %s", module->name,
                        module->library);
}

/* Loading twice is harmless: the loader counts, and a module keeps the same host. It is never unloaded. */
koksma_status koksma__module_load(const koksma__module *module, const void **functions)
{
    char path[4096];
    *functions = NULL;
    if (!koksma__module_path(module->name, path, sizeof path)) {
        return koksma__module_missing(module);
    }
    fenv_t mode; /* libraries may change it while they start */
    fegetenv(&mode);
    void *file = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    const koksma__module_entry *entry = file ? dlsym(file, KOKSMA__MODULE_SYMBOL) : NULL;
    fesetenv(&mode);
    if (!entry) {
        const char *reason = dlerror();
        return koksma__fail(KOKSMA_SYSTEM, "%s can't be loaded: %s", path, reason ? reason : "no reason given");
    }
    KOKSMA__FAIL_IF(strcmp(entry->release, KOKSMA_VERSION) != 0, KOKSMA_SYSTEM, "%s is of release %s, and this is %s",
                    path, entry->release, KOKSMA_VERSION);
    *functions = entry->start(&module->host);
    return KOKSMA_OK;
}
