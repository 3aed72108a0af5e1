/* SPDX-License-Identifier: Apache-2.0 */
#include_next <fcntl.h>
#ifdef _WIN32
#ifndef KOKSMA_CORE_PLATFORM_POSIX_FCNTL_H
#define KOKSMA_CORE_PLATFORM_POSIX_FCNTL_H

#include "core/platform/windows.h"

#define open koksma__open
enum { O_CLOEXEC = _O_NOINHERIT | _O_BINARY, O_NOCTTY = 0, O_NONBLOCK = 0 };

#endif
#endif
