/* SPDX-License-Identifier: Apache-2.0 */
/* Keys of scene files and plans in British and American spelling: both are read, errors name the key as it is written,
   and a field that stands in both spellings is an error. Other keys have one spelling. */
#include <string.h>

#include "test.h"
#include "json/json.h"

static const char *const keys[] = {"centre", "colour_scale", NULL};

TEST_CASE(both_spellings_are_read)
{
    static const char *const texts[] = {"{\"centre\": 7, \"colour_scale\": 2}",
                                        "{\"center\": 7, \"color_scale\": 2}"};
    for (size_t i = 0; i < 2; i++) {
        koksma__json *document;
        assert_ok(koksma__json_open("scene", "s", texts[i], strlen(texts[i]), &document));
        const koksma__json_node root = koksma__json_root(document);
        double value = 0;
        assert_ok(koksma__json_only(&root, keys));
        assert_true(koksma__json_has(&root, "centre"));
        assert_ok(koksma__json_get_number(&root, "centre", true, 0, 10, &value));
        assert_near(value, 7, 0);
        assert_ok(koksma__json_get_number(&root, "colour_scale", true, 0, 10, &value));
        assert_near(value, 2, 0);
        koksma__json_close(document);
    }
}

/* Opens the object with these members; its only() or its number must fail with this text. */
static void assert_wrong(const char *text, const char *message)
{
    koksma__json *document;
    assert_ok(koksma__json_open("scene", "s", text, strlen(text), &document));
    const koksma__json_node root = koksma__json_root(document);
    double value = 0;
    koksma_status status = koksma__json_only(&root, keys);
    status = status ? status : koksma__json_get_number(&root, "centre", true, 0, 10, &value);
    assert_int_equal(status, KOKSMA_MALFORMED);
    assert_that(strstr(koksma_error_text(), message), "'%s' has no '%s'", koksma_error_text(), message);
    koksma__json_close(document);
}

TEST_CASE(errors_name_the_key_as_written)
{
    assert_wrong("{\n\"center\": 70}", "line 2: center");
    assert_wrong("{\n\"centre\": 70}", "line 2: centre");
    assert_wrong("{\"centre\": 1,\n \"center\": 1}", "is the same field");
    assert_wrong("{\"centres\": 1}", "unknown field");
    assert_wrong("{\"couleur_scale\": 1}", "unknown field");
    assert_wrong("{\"colour_scale\": 1}", "'centre' is missing");
}
