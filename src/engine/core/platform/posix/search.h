/* SPDX-License-Identifier: Apache-2.0 */
#include "core/platform/search_tree.h"
