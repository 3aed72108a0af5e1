/* SPDX-License-Identifier: Apache-2.0 */
/* The document model of reports: what each call writes, to the letter. */
#include <math.h>
#include <string.h>

#include "study/report/document.h"
#include "test.h"

static void assert_written(koksma__document *d, const char *expected)
{
    assert_int_equal(d->json.status, KOKSMA_OK);
    assert_string_equal(d->json.text, expected);
    koksma__json_writer_fini(&d->json);
}

static void words_numbers_and_styles(void **state)
{
    (void)state;
    koksma__document d = {0};
    koksma__doc_paragraph(&d, "%s *is* %d of %zu, %+.1f %% and %.3g: `%s`", "a*<b>", -3, (size_t)7, 0.25, 1e-9,
                          "x`y");
    assert_written(
        &d, "\n{\"kind\":\"paragraph\",\"text\":[\"a*\\u003cb\\u003e \",{\"style\":\"strong\",\"text\":\"is\"},"
            "\" \",{\"text\":\"-3\",\"value\":-3},\" of \",{\"text\":\"7\",\"value\":7},\", \","
            "{\"text\":\"+0.2\",\"value\":0.25},\" % and \",{\"text\":\"1e-09\",\"value\":1e-09},\": \","
            "{\"style\":\"code\",\"text\":\"x`y\"}]}");
    koksma__doc_paragraph(&d, "N^%.1f^ of %lld", -0.5, 1LL << 40);
    assert_written(&d,
                   "\n{\"kind\":\"paragraph\",\"text\":[\"N\",{\"style\":\"sup\",\"text\":\"-0.5\",\"value\":-0.5},"
                   "\" of \",{\"text\":\"1099511627776\",\"value\":1099511627776}]}");
}

/* Formats longer than the buffer of one piece: 1 + 300 characters of two bytes each. */
static void long_formats_keep_their_characters(void **state)
{
    (void)state;
    char format[700] = "a", expected[800];
    for (int i = 0; i < 300; i++) {
        strcat(format, "±");
    }
    koksma__document d = {0};
    koksma__doc_paragraph_begin(&d);
    koksma__doc_say(&d, format, 0);
    koksma__doc_paragraph_end(&d);
    snprintf(expected, sizeof expected, "\n{\"kind\":\"paragraph\",\"text\":[\"%s\"]}", format);
    assert_written(&d, expected);
}

static void sections_lists_and_parts(void **state)
{
    (void)state;
    koksma__document d = {0}, part = {0}, empty = {0};
    koksma__doc_section(&d, "id", "Heading");
    koksma__doc_list_begin(&part, NULL, true);
    koksma__doc_item(&part);
    koksma__doc_say(&part, "one");
    koksma__doc_item(&part);
    koksma__doc_say(&part, "%d", 2);
    koksma__doc_list_end(&part);
    koksma__doc_paragraph(&d, "p");
    assert_true(koksma__doc_is_empty(&empty) && !koksma__doc_is_empty(&part));
    koksma__doc_append(&d, &empty);
    koksma__doc_append(&d, &part);
    assert_true(koksma__doc_is_empty(&part));
    koksma__doc_end(&d);
    assert_written(&d,
                   "\n{\"kind\":\"section\",\"id\":\"id\",\"heading\":[\"Heading\"],\"content\":["
                   "\n{\"kind\":\"paragraph\",\"text\":[\"p\"]},"
                   "\n{\"kind\":\"list\",\"numbered\":true,\"items\":[[\"one\"],[{\"text\":\"2\",\"value\":2}]]}]}");
}

static void tables_with_cells_of_each_kind(void **state)
{
    (void)state;
    koksma__document d = {0};
    koksma__doc_table_begin(&d, "t");
    koksma__doc_head(&d, "a");
    koksma__doc_head_number(&d, "b", 3);
    koksma__doc_column(&d,
                       &(koksma__column){.name = "c", .title = "C", .type = KOKSMA__COLUMN_INTERVAL, .hidden = true});
    koksma__doc_row(&d);
    koksma__doc_text(&d, "x\"y");
    koksma__doc_number(&d, NAN);
    koksma__doc_interval(&d, (koksma__estimate){0.1, NAN, INFINITY});
    koksma__doc_row(&d);
    koksma__doc_text(&d, "z");
    koksma__doc_number(&d, 1.0 / 3);
    koksma__cell_data cell = koksma__cell_of(2);
    cell.sd = 0.5;
    cell.sets = 4;
    cell.note = 1;
    cell.verdict = "agrees";
    cell.z = -1;
    koksma__doc_cell(&d, &cell);
    koksma__doc_table_end(&d);
    assert_written(&d, "\n{\"kind\":\"table\",\"name\":\"t\",\"columns\":[{\"name\":\"a\",\"type\":\"text\"},"
                       "{\"name\":\"b\",\"type\":\"number\",\"digits\":3},"
                       "{\"name\":\"c\",\"type\":\"interval\",\"title\":\"C\",\"hidden\":true}],"
                       "\"rows\":[[\"x\\\"y\",null,[0.1,null,null]],[\"z\",0.3333333333333333,"
                       "{\"value\":2,\"sd\":0.5,\"z\":-1,\"sets\":4,\"note\":1,\"verdict\":\"agrees\"}]]}");
    koksma__doc_table_begin(&d, "none");
    koksma__doc_table_end(&d);
    assert_written(&d, "\n{\"kind\":\"table\",\"name\":\"none\",\"columns\":[],\"rows\":[]}");
}

/* 1 and -2 as floats: 3f800000 and c0000000, the lowest byte first. */
static void pictures_are_little_endian(void **state)
{
    (void)state;
    koksma_image image;
    koksma__document d = {0};
    assert_ok(koksma_image_init(&image, 2, 1, 1));
    image.pixels[0] = 1;
    image.pixels[1] = -2;
    koksma__doc_picture(&d, &image, "n");
    koksma_image_fini(&image);
    assert_written(&d, "{\"name\":\"n\",\"channels\":1,\"pixels\":\"AACAPwAAAMA=\"}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_numbers_and_styles),   cmocka_unit_test(long_formats_keep_their_characters),
        cmocka_unit_test(sections_lists_and_parts),   cmocka_unit_test(tables_with_cells_of_each_kind),
        cmocka_unit_test(pictures_are_little_endian),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
