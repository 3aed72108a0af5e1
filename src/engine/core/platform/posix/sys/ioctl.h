/* SPDX-License-Identifier: Apache-2.0 */
#ifdef _WIN32
#ifndef KOKSMA_CORE_PLATFORM_POSIX_SYS_IOCTL_H
#define KOKSMA_CORE_PLATFORM_POSIX_SYS_IOCTL_H

/* The size of a console is not asked for. */
struct winsize {
    unsigned short ws_col;
};
enum { TIOCGWINSZ };

static inline int ioctl(int stream, int request, struct winsize *size)
{
    (void)stream, (void)request, (void)size;
    return -1;
}

#endif
#else
#include_next <sys/ioctl.h>
#endif
