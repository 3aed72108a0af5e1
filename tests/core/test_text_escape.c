/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_text_escape: what it must leave, what it must escape (RFC 3629, section 4: the table of well-formed UTF-8),
   and that no text of any bytes and no size leaves what is not a line of valid UTF-8. */
#include "test.h"

#include <stdint.h>
#include <string.h>

TEST_CASE(test_rows)
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
TEST_CASE(test_space)
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
