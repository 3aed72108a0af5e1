/* SPDX-License-Identifier: Apache-2.0 */
/* Writes CSV (RFC 4180). A field gets quotes only if readers need them. */
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

size_t koksma__csv_whole(uint64_t number, char text[KOKSMA__CSV_NUMBER])
{
    char digits[KOKSMA__CSV_NUMBER];
    size_t first = sizeof digits;
    do {
        digits[--first] = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    memcpy(text, digits + first, sizeof digits - first);
    return sizeof digits - first;
}

size_t koksma__csv_number(double number, char text[KOKSMA__CSV_NUMBER])
{
    _Static_assert((int)KOKSMA__CSV_NUMBER >= (int)KOKSMA__DECIMAL_ROOM,
                   "koksma__decimal_write needs at most the capacity of a CSV number");
    const size_t length = isnan(number) ? 0 : koksma__decimal_write(number, text);
    return length || isnan(number) ? length : (size_t)koksma__snprintf(text, KOKSMA__CSV_NUMBER, "%.17g", number);
}
