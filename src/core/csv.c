/* SPDX-License-Identifier: Apache-2.0 */
/* CSV as in RFC 4180: a field has quotes only where a reader needs them, so that plain tables stay plain. */
#include "core/csv.h"

#include <math.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/decimal.h"

void koksma__csv_put(FILE *stream, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, stream);
        return;
    }
    putc_unlocked('"', stream);
    for (; *text; text++) {
        if (*text == '"') {
            putc_unlocked('"', stream);
        }
        putc_unlocked(*text, stream);
    }
    putc_unlocked('"', stream);
}

void koksma__csv_put_whole(FILE *stream, uint64_t number)
{
    char digits[24], *first = digits + sizeof digits;
    *--first = '\0';
    do {
        *--first = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    fputs(first, stream);
}

void koksma__csv_put_number(FILE *stream, double number)
{
    char text[KOKSMA__DECIMAL_ROOM];
    const size_t length = isnan(number) ? 0 : koksma__decimal_write(number, text);
    if (length) {
        fwrite(text, 1, length, stream);
    } else if (!isnan(number)) {
        koksma__fprintf(stream, "%.17g", number);
    }
}
