/* SPDX-License-Identifier: Apache-2.0 */
#include_next <stdlib.h>

#include "core/platform/windows.h"
