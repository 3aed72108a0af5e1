/* SPDX-License-Identifier: Apache-2.0 */
/* koksma__csv_put: RFC 4180's quotes, and no field that a spreadsheet runs as a formula (CWE-1236). */
#include "core/c_locale.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>

TEST_CASE(fields)
{
    static const struct {
        const char *text, *field;
    } rows[] = {
        {"", ""},
        {"-", "-"},
        {"sobol:scramble=owen", "sobol:scramble=owen"},
        {"a,b", "\"a,b\""},
        {"a\"b", "\"a\"\"b\""},
        {"a\nb", "\"a\nb\""},
        {"=1+1", "\"'=1+1\""},
        {"+cmd", "\"'+cmd\""},
        {"@SUM(A1)", "\"'@SUM(A1)\""},
        {"-2+3", "\"'-2+3\""},
        {"\t=1", "\"'\t=1\""},
        {"=\"a\"", "\"'=\"\"a\"\"\""},
        {"a=1", "a=1"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char *text = NULL;
        size_t size = 0;
        FILE *stream = open_memstream(&text, &size);
        assert_non_null(stream);
        koksma__csv_put(stream, rows[i].text);
        fclose(stream);
        assert_string_equal(text, rows[i].field);
        free(text);
    }
}
