/* SPDX-License-Identifier: Apache-2.0 */
/* JSON text against RFC 8259 and RFC 3629: expected texts are written out, and numbers are read back. */
#include "test.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/json_writer.h"

static void expect(koksma__json_writer *w, const char *expected)
{
    char *text;
    size_t size;
    assert_int_equal(koksma__json_finish(w, &text, &size), KOKSMA_OK);
    assert_string_equal(text, expected);
    assert_int_equal(size, strlen(expected));
    free(text);
}

TEST_CASE(values_have_commas_and_keys)
{
    koksma__json_writer w = {0};
    koksma__json_begin_object(&w, NULL);
    koksma__json_begin_array(&w, "none");
    koksma__json_end(&w);
    koksma__json_begin_array(&w, "all");
    koksma__json_write_text(&w, NULL, "a");
    koksma__json_write_text(&w, NULL, NULL);
    koksma__json_write_flag(&w, NULL, true);
    koksma__json_begin_object(&w, NULL);
    koksma__json_write_whole(&w, "least", INT64_MIN);
    koksma__json_write_rounded(&w, "pi", 3.14159265, 3);
    koksma__json_end(&w);
    koksma__json_write_json(&w, NULL, "[1]");
    koksma__json_end(&w);
    koksma__json_write_number(&w, "nan", NAN);
    koksma__json_write_number(&w, "infinite", -INFINITY);
    koksma__json_end(&w);
    expect(&w, "{\"none\":[],\"all\":[\"a\",null,true,{\"least\":-9223372036854775808,\"pi\":3.14},[1]],\"nan\":null,"
               "\"infinite\":null}");
}

/* RFC 8259, section 7; the bytes of RFC 3629, section 4: the first and last of each length, and what is no UTF-8. */
TEST_CASE(texts_are_valid)
{
    static const char *const pairs[][2] = {
        {"a\"b\\c/", "a\\\"b\\\\c/"},
        {"\x01\t\n\x1f\x7f", "\\u0001\\u0009\\u000a\\u001f\x7f"},
        {"\xc2\x80\xdf\xbf", "\xc2\x80\xdf\xbf"},
        {"\xe0\xa0\x80\xed\x9f\xbf\xee\x80\x80\xef\xbf\xbf", "\xe0\xa0\x80\xed\x9f\xbf\xee\x80\x80\xef\xbf\xbf"},
        {"\xf0\x90\x80\x80\xf4\x8f\xbf\xbf", "\xf0\x90\x80\x80\xf4\x8f\xbf\xbf"},
        {"\x80", "\xef\xbf\xbd"},                                 /* no first byte */
        {"\xc1\xbf", "\xef\xbf\xbd\xef\xbf\xbd"},                 /* overlong */
        {"\xe0\x9f\xbf", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"}, /* overlong */
        {"\xf0\x8f\xbf\xbf", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},
        {"\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},                 /* a surrogate */
        {"\xf4\x90\x80\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"}, /* above U+10FFFF */
        {"\xf5", "\xef\xbf\xbd"},
        {"\xe2\x82", "\xef\xbf\xbd\xef\xbf\xbd"}, /* cut off */
        {"\xe2\x82g", "\xef\xbf\xbd\xef\xbf\xbdg"},
        {"</script>&", "</script>&"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        koksma__json_writer w = {0};
        char expected[64];
        koksma__json_write_text(&w, NULL, pairs[i][0]);
        snprintf(expected, sizeof expected, "\"%s\"", pairs[i][1]);
        expect(&w, expected);
    }
    koksma__json_writer w = {.in_html = true};
    koksma__json_write_text(&w, NULL, "</script>&");
    expect(&w, "\"\\u003c/script\\u003e\\u0026\"");
}

TEST_CASE(numbers_read_back)
{
    static const double numbers[] = {
        0.1, 1.0 / 3, DBL_MAX, -DBL_MIN, 4.9406564584124654e-324, 0, 1, 123456789012345678.0};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        koksma__json_writer w = {0};
        char *text;
        size_t size;
        koksma__json_write_number(&w, NULL, numbers[i]);
        assert_int_equal(koksma__json_finish(&w, &text, &size), KOKSMA_OK);
        assert_true(strtod(text, NULL) == numbers[i]);
        free(text);
    }
}

TEST_CASE(lines_and_limits)
{
    koksma__json_writer w = {0};
    FILE *file = tmpfile();
    char line[64];
    for (int i = 0; i < 2; i++) {
        koksma__json_begin_object(&w, NULL);
        koksma__json_write_whole(&w, "i", i);
        koksma__json_end(&w);
        assert_int_equal(koksma__json_line(&w, file), KOKSMA_OK);
    }
    koksma__json_writer_fini(&w);
    rewind(file);
    assert_string_equal(fgets(line, sizeof line, file), "{\"i\":0}\n");
    assert_string_equal(fgets(line, sizeof line, file), "{\"i\":1}\n");
    fclose(file);

    char *text = NULL;
    size_t size;
    for (int i = 0; i <= KOKSMA__JSON_DEPTH; i++) {
        koksma__json_begin_array(&w, NULL);
    }
    assert_int_equal(koksma__json_finish(&w, &text, &size), KOKSMA_ARGUMENT);
    assert_null(text);
    expect(&w, "");
}
