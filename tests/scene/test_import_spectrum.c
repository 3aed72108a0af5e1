/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of sampled spectra against those that Mitsuba 3.9.1 gives them (spectrum_list_to_srgb, xyz_to_srgb), which has
 * the tables of the CIE; the fit of the colour-matching functions is off by up to 1.2 % of the largest channel. The
 * spectra are those of Mitsuba's Cornell box, every 60 nm. White is white, and what is added in parts is added once.
 */
#include "scene/import.h"

#include <float.h>
#include <math.h>

#include "test.h"

static const struct {
    size_t n;
    double pairs[8][2];
    koksma__spectrum_use use;
    double rgb[3];
} cases[] = {
    {6,
     {{400, 0.343}, {460, 0.765}, {520, 0.725}, {580, 0.764}, {640, 0.712}, {700, 0.737}},
     KOKSMA__REFLECTANCE,
     {0.7280, 0.7522, 0.6663}},
    {6,
     {{400, 0.04}, {460, 0.062}, {520, 0.057}, {580, 0.099}, {640, 0.609}, {700, 0.642}},
     KOKSMA__REFLECTANCE,
     {0.4467, 0.0607, 0.0487}},
    {6,
     {{400, 0.092}, {460, 0.104}, {520, 0.472}, {580, 0.25}, {640, 0.114}, {700, 0.159}},
     KOKSMA__REFLECTANCE,
     {0.0946, 0.3924, 0.1138}},
    {4, {{400, 0.78}, {500, 0.78}, {600, 0.78}, {700, 0.78}}, KOKSMA__REFLECTANCE, {0.7764, 0.7798, 0.7760}},
    {4, {{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}}, KOKSMA__EMISSION, {20.7108, 10.8546, 2.7712}},
    {2, {{360, 5}, {830, 5}}, KOKSMA__EMISSION, {6.0240, 4.7415, 4.5446}},
    {4, {{400, 0}, {500, 0.3}, {600, 0.8}, {700, 1.1}}, KOKSMA__EMISSION, {1.127, 0.488, 0.088}},
    {4, {{400, 0}, {500, 0.3}, {600, 0.8}, {700, 1.1}}, KOKSMA__REFLECTANCE, {0.971, 0.51, 0.109}},
    {2, {{400, 0.78}, {700, 0.78}}, KOKSMA__REFLECTANCE, {0.776, 0.78, 0.776}},
    /* eta and k of a conductor: the samples of gold in tests/scene/test_imports.c, and 3 everywhere */
    {7,
     {{400, 1.66}, {450, 1.5}, {500, 0.916}, {550, 0.43}, {600, 0.25}, {650, 0.166}, {700, 0.16}},
     KOKSMA__UNBOUNDED,
     {0.0759351, 0.517804, 1.50785}},
    {7,
     {{400, 1.96}, {450, 1.88}, {500, 1.84}, {550, 2.455}, {600, 3.07}, {650, 3.66}, {700, 4.35}},
     KOKSMA__UNBOUNDED,
     {3.60454, 2.31725, 1.78986}},
    {2, {{360, 3}, {830, 3}}, KOKSMA__UNBOUNDED, {2.99696, 2.99662, 2.9964}},
};

TEST_CASE(colours_are_those_of_the_tables)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma__sampled_spectrum s = {0};
        double rgb[3];
        const double *want = cases[i].rgb, most = fmax(want[0], fmax(want[1], want[2]));
        for (size_t k = 0; k < cases[i].n; k++) {
            assert_true(koksma__sampled_spectrum_add(&s, cases[i].pairs[k][0], cases[i].pairs[k][1]));
        }
        koksma__sampled_spectrum_colour(&s, cases[i].use, rgb);
        for (int k = 0; k < 3; k++) {
            assert_near(rgb[k], want[k], 0.012 * most);
        }
    }
}

/* A perfect white is 1, however it is cut in pieces, between whole nanometres too; a line of 1 nm counts where it lies. */
TEST_CASE(sums_are_complete)
{
    koksma__sampled_spectrum two = {0}, many = {0}, narrow = {0};
    double rgb[3], other[3];
    assert_true(koksma__sampled_spectrum_add(&two, 300, 1) && koksma__sampled_spectrum_add(&two, 900, 1));
    for (double w = 300; w <= 900; w += 7.3) {
        assert_true(koksma__sampled_spectrum_add(&many, w, 1));
    }
    koksma__sampled_spectrum_colour(&two, KOKSMA__REFLECTANCE, rgb);
    koksma__sampled_spectrum_colour(&many, KOKSMA__REFLECTANCE, other);
    for (int k = 0; k < 3; k++) {
        assert_near(rgb[k], 1, 1e-12);
        assert_near(other[k], 1, 1e-12);
    }
    koksma__sampled_spectrum_colour(&two, KOKSMA__EMISSION, rgb); /* an emission of 1 everywhere has luminance 1 */
    assert_near(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2], 1, 1e-3);
    /* of luminance 1/107 where Y peaks, and none of it is blue */
    assert_true(koksma__sampled_spectrum_add(&narrow, 555, 0) && koksma__sampled_spectrum_add(&narrow, 556, 1) &&
                koksma__sampled_spectrum_add(&narrow, 557, 0));
    koksma__sampled_spectrum_colour(&narrow, KOKSMA__EMISSION, rgb);
    assert_near(rgb[2], 0, 1e-12);
    assert_true(rgb[1] > 1.0 / 107 && rgb[1] < 1.5 / 107);
    koksma__sampled_spectrum huge = {0};
    assert_true(koksma__sampled_spectrum_add(&huge, 360, DBL_MAX) &&
                koksma__sampled_spectrum_add(&huge, 830, DBL_MAX));
    koksma__sampled_spectrum_colour(&huge, KOKSMA__EMISSION,
                                    rgb); /* of the colour of an emission of 1, not 0 or NaN */
    koksma__sampled_spectrum_colour(&two, KOKSMA__EMISSION, other);
    for (int k = 0; k < 3; k++) {
        assert_true(isfinite(rgb[k]) && fabs(rgb[k] / rgb[1] - other[k] / other[1]) < 1e-9);
    }
    assert_false(koksma__sampled_spectrum_add(&narrow, 557, 1));
    assert_false(koksma__sampled_spectrum_add(&narrow, 500, 1));
    assert_false(koksma__sampled_spectrum_add(&narrow, 600, (double)NAN));
}
