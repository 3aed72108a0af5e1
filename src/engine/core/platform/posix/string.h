/* SPDX-License-Identifier: Apache-2.0 */
#include_next <string.h>

#include "core/platform/windows.h"
