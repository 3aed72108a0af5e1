/* SPDX-License-Identifier: Apache-2.0 */
#include_next <stdio.h>

#include "core/platform/windows.h"
