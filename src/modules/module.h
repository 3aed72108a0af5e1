/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Modules: koksma-NAME.so, each with the one source file (of OpenEXR two) that includes an outside library that takes
 * long to load. A process loads one when it first needs it (docs/decisions/0029-modules-on-first-use.md). A module is
 * linked with none of our libraries, so that static ones can load it, too: what it calls of ours it gets as a host.
 */
#ifndef KOKSMA_MODULES_MODULE_H
#define KOKSMA_MODULES_MODULE_H

#include <koksma/koksma.h>

#include "core/status.h"

typedef struct koksma__host {
    koksma_status (*fail)(koksma_status status, const char *format, ...) KOKSMA_PRINTF(2, 3);
    koksma_status (*fail_memory)(size_t bytes);
    const void *functions; /* the others that this module calls: the header that it shares with its user has them */
} koksma__host;

/* What a module exports under the name koksma__entry. start keeps the host and returns the module's functions. */
typedef struct koksma__module_entry {
    const char *release; /* KOKSMA_VERSION: a module of another release is refused */
    const void *(*start)(const koksma__host *host);
} koksma__module_entry;

#define KOKSMA__MODULE_SYMBOL "koksma__entry"

typedef struct koksma__module {
    const char *name, *library; /* of the file, koksma-NAME.so, and of what it brings, for messages */
    koksma__host host;
} koksma__module;

/* The module's functions; the first call loads it. Any thread may call, any number of times. Errors: UNSUPPORTED (there is no such file),
   SYSTEM (it can't be loaded, or is of another release). */
koksma_status koksma__module_load(const koksma__module *module, const void **functions);

/* Whether its file lies where koksma__module_load would find it. */
bool koksma__module_exists(const koksma__module *module);

/* UNSUPPORTED, with what would help. */
koksma_status koksma__module_missing(const koksma__module *module);

/* Where koksma-NAME.so lies; false if nowhere. */
bool koksma__module_path(const char *name, char *path, size_t room);

#endif
