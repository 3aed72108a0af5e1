/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Modules are files koksma-NAME.so. Each contains the source file (for OpenEXR: two) that uses an external library
 * which takes long to load. A process loads a module when it first needs it
 * (docs/decisions.md, 29). A module is not linked with Koksma's libraries, so that programs
 * with static libraries can also load it. It calls Koksma through the struct `host` of function pointers.
 */
#ifndef KOKSMA_MODULES_MODULE_H
#define KOKSMA_MODULES_MODULE_H

#include <koksma/koksma.h>

#include "core/status.h"

typedef struct koksma__host {
    koksma_status (*fail)(koksma_status status, const char *format, ...) KOKSMA_PRINTF(2, 3);
    koksma_status (*fail_memory)(size_t bytes);
    /* further functions of Koksma that this module calls: a struct whose type is defined in a header that the module
       shares with its caller */
    const void *functions;
} koksma__host;

/* The symbol koksma__entry that a module exports. start stores the host and returns the module's functions. */
typedef struct koksma__module_entry {
    const char *release; /* KOKSMA_VERSION of the module; a module of another release than the library is rejected */
    const void *(*start)(const koksma__host *host);
} koksma__module_entry;

#define KOKSMA__MODULE_SYMBOL "koksma__entry"

typedef struct koksma__module {
    const char *name, *library; /* NAME in koksma-NAME.so; the name of the external library in messages */
    koksma__host host;
} koksma__module;

/* Returns the module's functions in *functions; the first call loads the module. Any thread may call this function, any
   number of times. Errors: UNSUPPORTED (the file does not exist), SYSTEM (it can't be loaded, or is of another
   release). */
koksma_status koksma__module_load(const koksma__module *module, const void **functions);

/* Returns whether the module's file exists where koksma__module_load looks for it. */
bool koksma__module_exists(const koksma__module *module);

/* Fails with UNSUPPORTED and a text on how to install the module. */
koksma_status koksma__module_missing(const koksma__module *module);

/* Finds the path of koksma-NAME.so; returns false if it does not exist. */
bool koksma__module_path(const char *name, char *path, size_t room);

#endif
