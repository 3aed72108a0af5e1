/* SPDX-License-Identifier: Apache-2.0 */
#ifdef _WIN32
#ifndef KOKSMA_CORE_PLATFORM_POSIX_SYS_UTSNAME_H
#define KOKSMA_CORE_PLATFORM_POSIX_SYS_UTSNAME_H

#include <stdio.h>

struct utsname {
    char sysname[32], machine[32];
};

static inline int uname(struct utsname *system)
{
    snprintf(system->sysname, sizeof system->sysname, "Windows");
    snprintf(system->machine, sizeof system->machine, "%s", sizeof(void *) == 8 ? "x86_64" : "x86");
    return 0;
}

#endif
#else
#include_next <sys/utsname.h>
#endif
