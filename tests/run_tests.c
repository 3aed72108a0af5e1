/* SPDX-License-Identifier: Apache-2.0 */
/* main of a test program: runs what TEST_CASE of test.h declared, in the order of its file. */
#include <stdlib.h>

#include "test.h"

enum { MOST = 256 };

static struct found {
    struct CMUnitTest run;
    int line;
} found[MOST];
static size_t n;
static CMFixtureFunction begin, end;

void test_add(const char *name, CMUnitTestFunction function, int line)
{
    if (n == MOST) {
        abort();
    }
    found[n].run = (struct CMUnitTest){.name = name, .test_func = function};
    found[n++].line = line;
}

void test_around(CMFixtureFunction first, CMFixtureFunction last)
{
    begin = first;
    end = last;
}

static int by_line(const void *a, const void *b)
{
    const struct found *x = a, *y = b;
    return (x->line > y->line) - (x->line < y->line);
}

int main(void)
{
    struct CMUnitTest tests[MOST];
    qsort(found, n, sizeof *found, by_line);
    for (size_t i = 0; i < n; i++) {
        tests[i] = found[i].run;
    }
    return n ? _cmocka_run_group_tests("tests", tests, n, begin, end) : 1;
}
