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

/* A decoder of its own: bits into a number, then the number's shortest length. */
static bool is_line_of_utf8(const char *text)
{
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        const int more = *at < 0x80             ? 0
                         : (*at & 0xe0) == 0xc0 ? 1
                         : (*at & 0xf0) == 0xe0 ? 2
                         : (*at & 0xf8) == 0xf0 ? 3
                                                : -1;
        uint32_t value = more == 0 ? *at : *at & (0x3fu >> (unsigned)(more > 0 ? more : 1));
        if (more < 0) {
            return false;
        }
        at++;
        for (int i = 0; i < more; i++, at++) {
            if ((*at & 0xc0) != 0x80) {
                return false;
            }
            value = value << 6 | (*at & 0x3f);
        }
        static const uint32_t least[] = {0x20, 0xa0, 0x800, 0x10000};
        if (value < least[more] || value == 0x7f || (value >= 0xd800 && value < 0xe000) || value > 0x10ffff) {
            return false;
        }
    }
    return true;
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

TEST_CASE(test_any_bytes)
{
    uint64_t h = 1;
    for (int n = 0; n < 200000; n++) {
        char text[24], around[26];
        const size_t size = 1 + (size_t)n % sizeof text, length = (size_t)n / sizeof text % size;
        for (size_t i = 0; i < length; i++) {
            h = h * 6364136223846793005u + 1442695040888963407u;
            text[i] = (char)(h >> 60 & 1 ? 1 + (h >> 33) % 255 : 0x80 + (h >> 33) % 0x80); /* half of them high */
        }
        text[length] = '\0';
        memset(around, 'z', sizeof around);
        memcpy(around + 1, text, length + 1);
        koksma_text_escape(around + 1, size);
        assert_int_equal(around[0], 'z');
        assert_true(memchr(around + 1, 0, size) != NULL);
        assert_true(is_line_of_utf8(around + 1));
    }
}

/* An error names the object and the reason (koksma.h), also where the name alone is longer than the text: one character of
   three bytes more or less moves every byte of what is kept. */
TEST_CASE(test_long_names)
{
    static const char end[] = ".txt: can't be read: File name too long";
    for (size_t n = 300; n < 1300; n++) {
        char path[4096] = "";
        for (size_t i = 0; i < n; i++) {
            memcpy(path + 3 * i, "\xe2\x82\xac", 3);
        }
        strcpy(path + 3 * n, &"xx.txt"[n % 3]);
        koksma_points points;
        assert_int_not_equal(koksma_points_read(path, &points), KOKSMA_OK);
        const char *const text = koksma_error_text();
        const size_t length = strlen(text);
        assert_true(is_line_of_utf8(text));
        assert_memory_equal(text, path, 450);
        assert_string_equal(text + length - strlen(end), end);
        const size_t whole = strlen(path) + strlen(end) - strlen(".txt");
        assert_true(whole < 1024 ? length == whole : length > 1000 && length < 1024 && strstr(text, "..."));
    }
}
