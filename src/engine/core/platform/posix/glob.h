/* SPDX-License-Identifier: Apache-2.0 */
#ifdef _WIN32
#include "core/platform/windows.h"
#else
#include_next <glob.h>
#endif
