/* SPDX-License-Identifier: Apache-2.0 */
/* Texts for others: JSON against RFC 8259 and RFC 3629, expected texts written out and numbers read back; fields of CSV
   with RFC 4180's quotes, none of which a spreadsheet runs as a formula (CWE-1236); lines of messages, with what must be
   left and what escaped (RFC 3629, section 4: the table of well-formed UTF-8). */
#include "test.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/json_writer.h"

/* ---- JSON ---------------------------------------------------------------------------------------------------- */

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

/* ---- CSV ----------------------------------------------------------------------------------------------------- */

TEST_CASE(csv_fields)
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

/* ---- Lines ---------------------------------------------------------------------------------------------------- */

TEST_CASE(escaped_texts)
{
    static const struct {
        const char *text, *escaped;
    } rows[] = {
        {"", ""},
        {"plain", "plain"},
        {"Grün \xe2\x82\xac \xf0\x9f\x98\x80", "Grün \xe2\x82\xac \xf0\x9f\x98\x80"},
        {"a\nb\tc\x7f", "a\\x0ab\\x09c\\x7f"},
        {"\x1b[2J", "\\x1b[2J"},
        {"\xc2\x9b", "\\xc2\\x9b"}, /* CSI in one character of Latin-1 */
        {"\xc2\xa0", "\xc2\xa0"},   /* the first that is none */
        {"\xff\xfe", "\\xff\\xfe"},
        {"\xc0\xaf", "\\xc0\\xaf"},                   /* overlong */
        {"\xe0\x9f\xbf", "\\xe0\\x9f\\xbf"},          /* overlong */
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},          /* a surrogate */
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"}, /* above U+10FFFF */
        {"cut \xe2\x82", "cut \\xe2\\x82"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[64];
        strcpy(text, rows[i].text);
        koksma_text_escape(text, sizeof text);
        assert_string_equal(text, rows[i].escaped);
    }
    koksma_text_escape(NULL, 8);
}

/* A text with as much space as it can take: the same bytes as when they are written one after the other. */
TEST_CASE(escapes_that_fit)
{
    static char text[4 * (1 << 20) + 1];
    const size_t n = 1 << 20;
    for (size_t i = 0; i < n; i++) {
        text[i] = i % 3 ? '\x1b' : 'a'; /* moved once for each of them, these would be 3e12 bytes */
    }
    text[n] = '\0';
    koksma_text_escape(text, sizeof text);
    for (size_t i = 0, at = 0; i < n; i++) {
        const char *const expected = i % 3 ? "\\x1b" : "a";
        assert_memory_equal(text + at, expected, strlen(expected));
        at += strlen(expected);
        assert_true(i + 1 < n || !text[at]);
    }
    strcpy(text, "a\n\xe2\x82\xac\xe2\x82");
    koksma_text_escape(text, 9); /* no half of a character or of an escape is left */
    assert_string_equal(text, "a\\x0a\xe2\x82\xac");
    strcpy(text, "a\n\xe2\x82\xac");
    koksma_text_escape(text, 8);
    assert_string_equal(text, "a\\x0a");
    strcpy(text, "ab\n");
    koksma_text_escape(text, 6);
    assert_string_equal(text, "ab");
}
