/* SPDX-License-Identifier: Apache-2.0 */
/* Sampled spectra of other renderers' scenes as linear red, green and blue. */
#ifndef KOKSMA_SCENE_IMPORT_SPECTRUM_H
#define KOKSMA_SCENE_IMPORT_SPECTRUM_H

#include <stdbool.h>
#include <stddef.h>

/* The time that a spectrum takes, as many steps of koksma__import_spend: its values at some hundred wavelengths are
   added. */
enum { KOKSMA__SPECTRUM_STEPS = 128 };

/* The sums of a spectrum whose samples are added one by one; zeroed at first. */
typedef struct koksma__sampled_spectrum {
    size_t n;
    double last[2];     /* wavelength and value of the last sample */
    double seen[3];     /* XYZ of the spectrum itself */
    double in_light[3]; /* XYZ of daylight (CIE D65) multiplied by the spectrum */
} koksma__sampled_spectrum;

/* Adds a sample; between samples the spectrum is linear, and 0 before the first and after the last one. A value is
   clamped to +-1e30, so that sums are finite. Returns false if the wavelength, in nm, is not above the one before. */
bool koksma__sampled_spectrum_add(koksma__sampled_spectrum *s, double wavelength, double value);

/* What the values of a spectrum are; pbrt names the same three. */
typedef enum koksma__spectrum_use {
    KOKSMA__REFLECTANCE, /* of daylight: 1 at all wavelengths is white; clamped to [0, 1] */
    KOKSMA__UNBOUNDED,   /* the same without the upper bound: refractive indices, coefficients, factors of daylight */
    KOKSMA__EMISSION     /* 1 at all wavelengths has luminance 1 and is reddish */
} koksma__spectrum_use;

/* The colour of a spectrum; negative channels are 0. */
void koksma__sampled_spectrum_colour(const koksma__sampled_spectrum *s, koksma__spectrum_use use, double rgb[3]);

#endif
