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
    if (koksma_status_exit_code(status) != 3 || !strstr(koksma_error_text(), expected) ||
        strchr(koksma_error_text(), '\n')) {
        fail_msg("'%.*s' replaced by '%s': status %d, '%s', expected '%s'", (int)(to - from), from, bad, (int)status,
                 status ? koksma_error_text() : "", expected);
    }
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

#define XML(inner) "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" inner "</scene>"
#define BALL(inner) XML("<shape type=\"sphere\">" inner "</shape>")

#define MATRIX(row)                                                                                                  \
    BALL("<transform name=\"to_world\"><matrix value=\"1 0 0 0.5 0 1 0 0 0 0 1 0 " row "\"/></transform>")
#define GREY(inner) BALL("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" " inner "</bsdf>")
#define IRREGULAR(wavelengths, values)                                                                               \
    GREY("type=\"irregular\"><string name=\"wavelengths\" value=\"" wavelengths                                      \
         "\"/><string name=\"values\" value=\"" values "\"/></spectrum>")

TEST_CASE(odd_elements_of_mitsuba_are_refused)
{
    static const struct {
        const char *text, *reason;
    } cases[] = {
        {BALL("<string name=\"radius\" value=\"1\"/>"), "radius: <string> '1' is not a number"},
        {BALL("<boolean name=\"center\" value=\"true\"/>"), "center: <boolean> 'true' is not a point"},
        {BALL("<float name=\"flip_normals\" value=\"1\"/>"), "flip_normals: <float> '1' is not true or false"},
        {BALL("<float name=\"radius\"/>"), "radius: no 'value', which is a number"},
        {BALL("<point name=\"center\" x=\"1\"/>"), "center: no 'y'"},
        {BALL("<point name=\"center\" value=\"1 2\"/>"), "center: '1 2' is not one number or three"},
        {BALL("<ref id=\"nope\"/>"), "ref: no element has the id 'nope'"},
        {BALL("<ref/>"), "ref: no element has the id ''"},
        {BALL("<bsdf type=\"diffuse\"><string name=\"reflectance\" value=\"a\"/></bsdf>"),
         "<string> is not a colour"},
        {BALL("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1 2\"/></bsdf>"), "not one number or three"},
        {BALL("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"500:1 400:1\"/></bsdf>"),
         "must increase"},
        {BALL("<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"bk9\"/></bsdf>"),
         "int_ior: <string> 'bk9'"},
        {BALL("<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"q\"/></bsdf>"),
         "distribution: <string> 'q' is not a value that this property can have"},
        {BALL("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
              "value=\"a.png\"/><string name=\"filterType\" value=\"cubic\"/></texture></bsdf>"),
         "filterType: <string> 'cubic' is not a value that this property can have"},
        {BALL("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
              "value=\"a.png\"/><string name=\"wrap_mode\" value=\"two\"/></texture></bsdf>"),
         "wrap_mode: <string> 'two'"},
        {GREY("type=\"uniform\"/>"), "spectrum 'uniform': no 'value'"},
        {GREY("type=\"uniform\" value=\"1\"/>"), "a spectrum with a 'type' has its values inside"},
        {GREY("type=\"uniform\"><string name=\"value\" value=\"1\"/></spectrum>"),
         "value: <string> '1' is not a number"},
        {GREY("type=\"srgb\"/>"), "spectrum 'srgb': no 'color'"},
        {GREY("type=\"blackbody\"/>"), "spectrum 'blackbody': no 'temperature'"},
        {GREY("type=\"blackbody\"><float name=\"temperature\" value=\"0\"/></spectrum>"),
         "a temperature of 0 kelvins"},
        {GREY("type=\"regular\"><string name=\"values\" value=\"1 2\"/></spectrum>"),
         "spectrum 'regular': no 'wavelength_min'"},
        {GREY("type=\"irregular\"><string name=\"values\" value=\"1 2\"/></spectrum>"),
         "spectrum 'irregular': no 'wavelengths'"},
        {IRREGULAR("400 500", "1"), "values: '1' is not a list of two numbers or more"},
        {IRREGULAR("400 500", "1 2 3"), "3 values of a spectrum for 2 wavelengths"},
        {IRREGULAR("400 5x", "1 2"), "wavelengths: '400 5x' is not a list of numbers"},
        {IRREGULAR("400 500", "1 inf"), "values: '1 inf' is not a list of numbers"},
        {IRREGULAR("500 400", "1 2"), "wavelengths of a spectrum must increase"},
        {BALL("<float name=\"radius\" value=\"-Infinity\"/>"), "radius: '-Infinity' is not a finite number"},
        {BALL("<point name=\"center\" value=\"0 nan 0\"/>"),
         "center: '0 nan 0' is not a list of at most 3 finite numbers"},
        {GREY("value=\"400:1,500:inf\"/>"), "is not a spectrum: one finite number, or pairs"},
        {GREY("type=\"regular\"><string name=\"values\" value=\"1 2\"/><float name=\"lambda_min\" "
              "value=\"400\"/></spectrum>"),
         "spectrum 'regular': no 'wavelength_max'"},
        {GREY("type=\"srgb_d65\"/>"), "spectrum 'srgb_d65': no 'color'"},
        {BALL("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"0\"/></bsdf>"),
         "int_ior: <float> '0' is not an index of refraction; it must be above 0"},
        {GREY("type=\"d65\"><texture type=\"d65\"/><texture type=\"d65\"/></spectrum>"), "more than one texture"},
        {XML("<spectrum id=\"a\" type=\"d65\"><ref id=\"a\"/></spectrum><emitter type=\"point\"><ref "
             "name=\"intensity\" "
             "id=\"a\"/></emitter>"),
         "nested more than 16 deep"},
        {BALL("<bsdf/>"), "bsdf: no type"},
        {BALL("<transform name=\"to_world\"><rotate angle=\"9\"/></transform>"), "rotate: the axis has no direction"},
        {BALL("<transform name=\"to_world\"><rotate x=\"1\"/></transform>"), "rotate: no 'angle'"},
        {BALL("<transform name=\"to_world\"><lookat target=\"1,1,1\"/></transform>"), "lookat: no 'origin'"},
        {BALL("<transform name=\"to_world\"><matrix value=\"1 2 3\"/></transform>"),
         "matrix: 3 numbers; it has 16 or 9"},
        {MATRIX("0 0 0 2"), ":1: matrix: its last row is 0 0 0 2; it must be 0 0 0 1"},
        {MATRIX("0 0 0 0"), ":1: matrix: its last row is 0 0 0 0; it must be 0 0 0 1"},
        {MATRIX("0.5 0 0 1"), ":1: matrix: its last row is 0.5 0 0 1; it must be 0 0 0 1"},
        {MATRIX("0 -3 0.25 1"), ":1: matrix: its last row is 0 -3 0.25 1; it must be 0 0 0 1"},
        {XML("<shape type=\"obj\"/>"), "the name of a file (filename) is missing or empty"},
        {XML("<shape type=\"instance\"/>"), "an instance without a reference to a shape group"},
        {XML("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"),
         ":2: the id 'a' is given twice"},
        {XML("<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"a\"/>"), "alias: no element has the id"},
        {XML("<sensor type=\"perspective\"><float name=\"width\" value=\"a\"/></sensor>"), "width: 'a'"},
        {"<scene><sensor type=\"perspective\"><string name=\"focal_length\" value=\"50 cm\"/></sensor></scene>",
         "focal_length: <string> '50 cm' is not a length in mm"},
        {"<scene><sensor type=\"perspective\"><string name=\"fov_axis\" value=\"q\"/></sensor></scene>",
         "fov_axis: <string> 'q'"},
        {"<scene><sensor type=\"perspective\"><film type=\"f\"><float name=\"width\" "
         "value=\"8.5\"/></film></sensor></scene>",
         "a film of 8.5 x 576"}};
    if (open_bytes("probe.xml", "<scene version=\"3.0.0\"/>") == KOKSMA_UNSUPPORTED) {
        return;
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const koksma_status status = open_bytes("odd.xml", cases[i].text);
        if (koksma_status_exit_code(status) != 3 || !strstr(koksma_error_text(), cases[i].reason)) {
            fail_msg("%s: status %d, '%s', expected '%s'", cases[i].text, (int)status, koksma_error_text(),
                     cases[i].reason);
        }
    }
    assert_ok(open_bytes("good.xml", BALL("<float name=\"radius\" value=\" 1 \"/><boolean name=\"flip_normals\" "
                                          "value=\"True\"/><point name=\"center\" value=\" 1, 2 3,\"/>")));
    assert_ok(open_bytes("good.xml", MATRIX("-0 1e-17 0 1.0000001"))); /* a product of rounded matrices */
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

#define PBRT(inner) "Camera \"perspective\"\nWorldBegin\n" inner

TEST_CASE(odd_directives_of_pbrt_are_refused)
{
    static const struct {
        const char *text, *reason;
    } cases[] = {
        {PBRT("Rotate 90 0 0 0"), ":3: Rotate: the axis has no direction"},
        {PBRT("Rotate 90 0 x 0"), ":3: Rotate: 'x' is not a number"},
        {PBRT("Scale 1 1"), ":3: Scale: the file ends where a number belongs"},
        {PBRT("Translate [1 1 1 1]"), ":3: Translate: expected 3 numbers"},
        {PBRT("Shape \"sphere\" \"float radius\" [1 2]"), ":3: radius: a 'float' of 2 values; expected: one value"},
        {PBRT("Shape \"sphere\" \"string radius\" \"a\""),
         ":3: radius: a 'string' of 1 values; expected: float integer"},
        {PBRT("LightSource \"point\" \"point3 from\" [0 0 0 1 1 1]"), ":3: from: a 'point3' of 6 values"},
        {PBRT("LightSource \"point\" \"rgb I\" [1 1 1 2 2 2]"), ":3: I: more than one colour"},
        {PBRT("LightSource \"point\" \"string I\" \"a\""), ":3: I: a 'string' is not a colour"},
        {PBRT("LightSource \"point\" \"rgb I\" [1 1e999 1]"), ":3: I: '1e999' is not a finite number"},
        {PBRT("Translate 0 -1e39 0"), ":3: Translate: '-1e39' is not a finite number"},
        {PBRT("LightSource \"point\" \"blackbody I\" 0"), ":3: I: a temperature of 0 kelvins; it must be above 0"},
        {PBRT("LightSource \"point\" \"blackbody I\" -1"), ":3: I: a temperature of -1 kelvins; it must be above 0"},
        {PBRT("Shape \"plymesh\""), "the name of a file (filename) is missing or empty"},
        {PBRT("Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"\""), "(filename) is missing or empty"},
        {PBRT("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2 0]"),
         ":3: indices: 4 numbers, but each face has 3"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const koksma_status status = open_bytes("odd.pbrt", cases[i].text);
        if (koksma_status_exit_code(status) != 3 || !strstr(koksma_error_text(), cases[i].reason)) {
            fail_msg("%s: status %d, '%s', expected '%s'", cases[i].text, (int)status, koksma_error_text(),
                     cases[i].reason);
        }
    }
    /* of two parameters with one name pbrt takes the last */
    koksma_scene *scene =
        opened("two.pbrt", PBRT("") "Film \"rgb\" \"integer xresolution\" 8 \"integer xresolution\" 9");
    assert_int_equal(scene->width, 9);
    koksma_scene_close(scene);
}
