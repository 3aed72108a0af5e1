/* SPDX-License-Identifier: Apache-2.0 */
/* CSV as RFC 4180 has it: quotes stand only where a reader needs them, so that plain tables stay plain. */
#include "core/csv.h"

#include <string.h>

void koksma__csv_put(FILE *stream, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, stream);
        return;
    }
    putc('"', stream);
    for (; *text; text++) {
        if (*text == '"') {
            putc('"', stream);
        }
        putc(*text, stream);
    }
    putc('"', stream);
}
