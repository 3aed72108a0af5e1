/* SPDX-License-Identifier: Apache-2.0 */
/* Finds and loads modules. They are searched in five places: beside the program or library that contains this code,
   in the folder above it, in the folder koksma/ beside an installed library, in the library folder of the prefix of an
   installed program, and in the folder where the build installs them. No search path and no environment variable is
   used. */
#define _GNU_SOURCE /* for dladdr */
#include "modules/module.h"

#include <dlfcn.h>
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Folders with modules, relative to the folder of the library or program that contains this code. The second folder
   is for programs in subfolders of the build folder. */
static const char *const PLACES[] = {"", "../", "koksma/", "../" KOKSMA_LIBDIR "/koksma/"};

bool koksma__module_path(const char *name, char *path, size_t room)
{
#ifdef _WIN32
    char *object = koksma__this_file();
    {
#else
    static const char here = 0; /* any address in the program or library that contains this code */
    Dl_info info;
    if (dladdr(&here, &info) && info.dli_fname) {
        /* The name of the program may lack a folder, or be relative to a folder that the process has left. realpath
           also resolves symbolic links. */
        char *object = strchr(info.dli_fname, '/') ? realpath(info.dli_fname, NULL) : NULL;
        object = object ? object : realpath("/proc/self/exe", NULL);
#endif
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

/* The module that a static program has in itself, as it can load none. */
static const koksma__module_entry *linked(const char *name)
{
#ifdef KOKSMA_LINKED_JPEG
    extern const koksma__module_entry koksma__entry_jpeg;
    if (!strcmp(name, "jpeg")) {
        return &koksma__entry_jpeg;
    }
#endif
    (void)name;
    return NULL;
}

bool koksma__module_exists(const koksma__module *module)
{
    char path[4096];
    return linked(module->name) || koksma__module_path(module->name, path, sizeof path);
}

koksma_status koksma__module_missing(const koksma__module *module)
{
    return koksma__fail(KOKSMA_UNSUPPORTED,
                        "koksma-%s.so is missing: install the package koksma-modules, or build with %s", module->name,
                        module->library);
}

/* Loads a module, which is never unloaded. Loading a module again is harmless: the loader counts references, and the
   module stores the same host again. */
koksma_status koksma__module_load(const koksma__module *module, const void **functions)
{
    char path[4096];
    const koksma__module_entry *entry = linked(module->name);
    if (entry) {
        *functions = entry->start(&module->host);
        return KOKSMA_OK;
    }
    *functions = NULL;
    if (!koksma__module_path(module->name, path, sizeof path)) {
        return koksma__module_missing(module);
    }
    fenv_t mode; /* libraries may change the floating-point environment while they are loaded */
    fegetenv(&mode);
    void *file = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    entry = file ? dlsym(file, KOKSMA__MODULE_SYMBOL) : NULL;
    fesetenv(&mode);
    if (!entry) {
        const char *reason = dlerror();
        return koksma__fail(KOKSMA_SYSTEM, "%s can't be loaded: %s", path, reason ? reason : "no reason given");
    }
    KOKSMA__FAIL_IF(strcmp(entry->release, KOKSMA_VERSION) != 0, KOKSMA_SYSTEM,
                    "%s is of release %s, but this program is of release %s", path, entry->release, KOKSMA_VERSION);
    *functions = entry->start(&module->host);
    return KOKSMA_OK;
}
