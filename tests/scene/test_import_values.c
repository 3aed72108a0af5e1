/* SPDX-License-Identifier: Apache-2.0 */
/* Every value of the scenes fuzz/corpus/model/NAME.xml and .pbrt, which use all parameters that are read, is replaced by
   texts that are no such value, one at a time: each is refused with one line that names the file, the line and the
   property. Mitsuba 3 throws on all of them except for an empty number, nan and infinite ones; pbrt-v4 ends. */
#include <ctype.h>

#include "scene_files.h"

enum { MOST = 1 << 14 };

static char text[MOST];

/* Reads a seed without its first line, which is the ending of its name. */
static void read_seed(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/../fuzz/corpus/model/%s", KOKSMA_TESTS, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(text, sizeof text, file));
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    assert_true(feof(file));
    fclose(file);
}

static koksma_status open_bytes(const char *name, const char *bytes)
{
    koksma_scene *scene = NULL;
    const koksma_status status = open_as(name, bytes, &scene);
    koksma_scene_close(scene);
    return status;
}

/* Opens the scene with `bad` in place of the bytes from `from` to `to`, which has to fail with ":LINE: PROPERTY". */
static void damage(const char *name, const char *from, const char *to, const char *bad, const char *property,
                   size_t length)
{
    char damaged[MOST + 256], expected[128];
    unsigned line = 1;
    for (const char *c = text; c < from; c++) {
        line += *c == '\n';
    }
    snprintf(damaged, sizeof damaged, "%.*s%s%s", (int)(from - text), text, bad, to);
    snprintf(expected, sizeof expected, "%s:%u: %.*s", name, line, (int)length, property);
    const koksma_status status = open_bytes(name, damaged);
    assert_that(koksma_status_exit_code(status) == 3 && strstr(koksma_error_text(), expected) &&
                    !strchr(koksma_error_text(), '\n'),
                "'%.*s' replaced by '%s': status %d, '%s', expected '%s'", (int)(to - from), from, bad, (int)status,
                status ? koksma_error_text() : "", expected);
}

static bool is_word(const char *at, size_t length, const char *words)
{
    for (; *words; words += strspn(words, " ")) {
        const size_t word = strcspn(words, " ");
        if (word == length && !memcmp(words, at, length)) {
            return true;
        }
        words += word;
    }
    return false;
}

/* ---- Mitsuba ----------------------------------------------------------------------------------------------------- */

/* Damages the attributes of the element whose tag is at `tag`; returns how many. */
static size_t damage_element(const char *name, const char *tag)
{
    static const char *const bad[] = {"",      "a",   "1e",    "5x",    "0x10", "nan",   "inf",
                                      "1e999", "1 a", "1;2;3", "1,2,x", "400:", "400:x", "#12345"};
    static const char *const valued =
        "float integer boolean point vector rgb srgb spectrum blackbody translate scale "
        "rotate lookat lookAt matrix ref";
    const size_t length = strcspn(tag, " />");
    const char *end = strchr(tag, '>'), *property = tag;
    size_t property_length = length, n = 0;
    assert_non_null(end);
    if (!is_word(tag, length, valued)) {
        return 0;
    }
    for (const char *at = strchr(tag, '='); at && at < end; at = strchr(at, '=')) {
        const char *key = at, *from = at + 2, *to = strchr(from, '"');
        while (isalnum((unsigned char)key[-1]) || key[-1] == '_') {
            key--;
        }
        if (is_word(key, (size_t)(at - key), "name")) {
            property = from;
            property_length = (size_t)(to - from);
        } else if (!is_word(key, (size_t)(at - key), "type id") || is_word(tag, length, "ref")) {
            for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
                damage(name, from, to, bad[i], property, property_length);
            }
            n++;
        }
        at = to;
    }
    return n;
}

TEST_CASE(values_of_mitsuba_are_whole)
{
    static const char *const seeds[] = {"parameters.xml", "older.xml", "orthographic.xml", "spectra.xml"};
    size_t n = 0;
    if (open_bytes("probe.xml", "<scene version=\"3.0.0\"/>") == KOKSMA_UNSUPPORTED) {
        return; /* a build without expat */
    }
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        read_seed(seeds[i]);
        assert_ok(open_bytes(seeds[i], text));
        for (const char *at = strchr(text, '<'); at; at = strchr(at + 1, '<')) {
            n += damage_element(seeds[i], at + 1);
        }
    }
    assert_true(n > 90);
}

/* ---- pbrt -------------------------------------------------------------------------------------------------------- */

/* Damages the values of the parameter whose declaration is at `at`, and declares it as another type; `passed` says whether
   nothing reads it. Returns the end of its values. */
static const char *damage_parameter(const char *name, const char *at, bool passed)
{
    static const char *const
        numbers[] = {"\"a\"", "[]", "[0 \"a\"]", "true", "x", "nan", "1e", "0x10", "1e999", "[0 x]", NULL},
        *const wholes[] = {"\"a\"", "[]", "[0 \"a\"]", "true", "x", "1.5", "[0 1.5]", "1e999", NULL},
        *const triples[] = {"\"a\"", "[]", "[0 \"a\"]", "1", "[1 1 1 1]", "[1 1 nan]", "[1 -1e999 1]", NULL},
        *const spectra[] = {"[]", "x", "[400]", "[400 \"a\"]", "[\"a\" 400]", NULL},
        *const texts[] = {"1", "[]", "[\"a\" 1]", "true", NULL}, *const flags[] = {"1", "[]", "\"a\"", "maybe", NULL};
    const size_t length = strcspn(at, " ");
    const char *property = at + length + 1, *from = strchr(property, '"') + 2, *to;
    const size_t property_length = (size_t)(from - 2 - property);
    const char *const *bad = is_word(at, length, "float blackbody")  ? numbers
                             : is_word(at, length, "integer")        ? wholes
                             : is_word(at, length, "spectrum")       ? spectra
                             : is_word(at, length, "string texture") ? texts
                             : is_word(at, length, "bool")           ? flags
                                                                     : triples;
    to = *from == '['   ? strchr(from, ']') + 1
         : *from == '"' ? strchr(from + 1, '"') + 1
                        : from + strcspn(from, " \n");
    for (; *bad; bad++) {
        damage(name, from, to, *bad, property, property_length);
    }
    damage(name, at, at + length, "real", property, property_length);
    if (!passed) {
        char other[128];
        snprintf(other, sizeof other, "vector2 %.*s\" [1 1]", (int)property_length, property);
        damage(name, at, to, other, property, property_length);
    }
    return to;
}

TEST_CASE(values_of_pbrt_are_whole)
{
    static const char *const seeds[] = {"parameters.pbrt", "orthographic.pbrt"};
    static const char *const unread = "disablepixeljitter xradius yradius pixelsamples maxdepth amount iso k "
                                      "reflectance";
    size_t n = 0;
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        read_seed(seeds[i]);
        assert_ok(open_bytes(seeds[i], text));
        for (const char *at = strchr(text, '"'); at; at = strchr(at, '"')) {
            const size_t word = strcspn(++at, "\""), type = strcspn(at, " ");
            if (type < word) {
                at = damage_parameter(seeds[i], at, is_word(at + type + 1, word - type - 1, unread));
                n++;
            } else {
                at += word + 1;
            }
        }
    }
    assert_true(n > 80);
}

/* Of two parameters with one name pbrt takes the last. */
TEST_CASE(the_last_of_two_parameters_counts)
{
    koksma_scene *scene =
        opened("two.pbrt", "Camera \"perspective\" WorldBegin Film \"rgb\" \"integer xresolution\" 8 "
                           "\"integer xresolution\" 9");
    assert_int_equal(scene->width, 9);
    koksma_scene_close(scene);
}
