/* SPDX-License-Identifier: Apache-2.0 */
/* What a host program's locale may do to the library: the same files are made in the "C" locale and in one where
   a half is 0,5, and must be equal. */
#ifndef KOKSMA_TESTS_COMMA_H
#define KOKSMA_TESTS_COMMA_H

#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "test.h"

/* A folder of the test's own, below which the locale lies. */
static char test_folder[] = "/tmp/koksma-locale-XXXXXX";

static inline bool half_is(const char *text)
{
    char half[8];
    snprintf(half, sizeof half, "%.1f", 0.5);
    return !strcmp(half, text);
}

/* Compiles a locale with nothing but a comma: machines seldom have another one than "C". localedef warns about what
   it lacks, and says so by its exit code, too. */
static inline const char *make_comma_locale(void)
{
    char path[64], command[256];
    snprintf(path, sizeof path, "%s/source", test_folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n", file);
    fclose(file);
    snprintf(command, sizeof command, "localedef -c -i %s -f UTF-8 %s/comma >%s/talk 2>&1", path, test_folder,
             test_folder);
    (void)!system(command);
    setenv("LOCPATH", test_folder, 1);
    const bool made = setlocale(LC_ALL, "comma") && half_is("0,5"); /* musl takes any name */
    setlocale(LC_ALL, "C");
    return made ? "comma" : NULL;
}

/* The name of a locale with a decimal comma; NULL: there is none, and none can be made. */
static inline const char *comma_locale(void)
{
    static const char *const installed[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "es_ES.UTF-8", "ru_RU.UTF-8",
                                            "pt_BR.UTF-8"};
    for (size_t i = 0; i < sizeof installed / sizeof *installed; i++) {
        const bool comma = setlocale(LC_ALL, installed[i]) && half_is("0,5");
        setlocale(LC_ALL, "C");
        if (comma) {
            return installed[i];
        }
    }
    return make_comma_locale();
}

static inline int test_comma_begin(void **state)
{
    assert_non_null(mkdtemp(test_folder));
    *state = (void *)(uintptr_t)comma_locale();
    return 0;
}

static inline int test_comma_end(void **state)
{
    (void)state;
    char command[64];
    setlocale(LC_ALL, "C");
    snprintf(command, sizeof command, "rm -r %s", test_folder);
    return system(command);
}

/* Adds the bytes of a file that the library wrote. */
static inline void test_take_file(FILE *out, const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    for (int c = getc(file); c != EOF; c = getc(file)) {
        putc(c, out);
    }
    fclose(file);
}

/* Writes what the library makes of something: no number with a point by a printf of its own. */
typedef void test_maker(FILE *out);

static inline char *test_made_in(test_maker *make, const char *locale, const char *half, size_t *size)
{
    char *text;
    FILE *out = open_memstream(&text, size);
    assert_non_null(out);
    assert_non_null(setlocale(LC_ALL, locale));
    assert_true(half_is(half));
    make(out);
    assert_true(half_is(half)); /* the host keeps its locale */
    setlocale(LC_ALL, "C");
    fclose(out);
    return text;
}

/* Fails at the first byte that differs. */
static inline void test_same_with_comma(const char *locale, test_maker *make)
{
    if (!locale) {
        print_message("[  REASON  ] no locale here has a decimal comma, and localedef can make none\n");
        skip();
    }
    size_t size, commas;
    char *text = test_made_in(make, "C", "0.5", &size), *other = test_made_in(make, locale, "0,5", &commas);
    size_t at = 0;
    while (at < size && at < commas && text[at] == other[at]) {
        at++;
    }
    if (at < size || at < commas) {
        const size_t from = at > 40 ? at - 40 : 0;
        fail_msg("byte %zu differs:\n%.80s\n%.80s", at, text + from, other + from);
    }
    assert_true(size > 0);
    free(text);
    free(other);
}

#endif
