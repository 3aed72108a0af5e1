/* SPDX-License-Identifier: Apache-2.0 */
/* The one writer of CSV fields (RFC 4180). Numbers need no quotes: they go by core/c_locale.h. */
#ifndef KOKSMA_CORE_CSV_H
#define KOKSMA_CORE_CSV_H

#include <stdio.h>

#include "core/visibility.h"

/* Writes a field: in quotes, which are doubled inside, if it has a comma, a quote or the end of a line. */
KOKSMA__LAB void koksma__csv_put(FILE *stream, const char *text);

#endif
