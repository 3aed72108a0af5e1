/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 against the examples of FIPS 180-2 (appendix B) and of NIST's validation system, added in pieces of every
   size. */
#include "test.h"

#include <stdlib.h>
#include <string.h>

#include "core/hash.h"

static void expect(const char *bytes, size_t size, size_t piece, const char *expected)
{
    char text[KOKSMA__SHA256_TEXT];
    koksma__sha256 hash;
    koksma__sha256_init(&hash);
    for (size_t i = 0; i < size; i += piece) {
        koksma__sha256_add(&hash, bytes + i, size - i < piece ? size - i : piece);
    }
    koksma__sha256_finish(&hash, text);
    assert_string_equal(text, expected);
}

TEST_CASE(published_hashes_come_out)
{
    static const struct {
        const char *text, *hash;
    } cases[] = {
        {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
        {"abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrst"
         "nopqrstu",
         "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (size_t piece = 1; piece < 130; piece++) {
            expect(cases[i].text, strlen(cases[i].text), piece, cases[i].hash);
        }
    }
    char *many = malloc(1000000);
    assert_non_null(many);
    memset(many, 'a', 1000000);
    expect(many, 1000000, 4097, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    free(many);
}

/* FNV-1a and the finalizer of SplitMix64, of four strings at once, of any lengths and none. */
TEST_CASE(four_hashes_are_those_of_one_string_each)
{
    char bytes[200];
    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (char)(37 * i + 11);
    }
    for (size_t trial = 0; trial < 500; trial++) {
        const void *strings[4];
        size_t sizes[4];
        uint64_t found[4];
        for (size_t k = 0; k < 4; k++) {
            sizes[k] = trial * (2 * k + 3) % (k + 61) % (1 + trial % 53);
            strings[k] = sizes[k] ? bytes + (trial + 7 * k) % 100 : NULL;
        }
        koksma__hash_four(strings, sizes, found);
        for (size_t k = 0; k < 4; k++) {
            assert_true(found[k] == koksma__hash(strings[k], sizes[k]));
        }
    }
}
