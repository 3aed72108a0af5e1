/* SPDX-License-Identifier: Apache-2.0 */
/* Colours of sampled spectra. */
#ifndef KOKSMA_SCENE_IMPORT_SPECTRA_H
#define KOKSMA_SCENE_IMPORT_SPECTRA_H

#include <stdbool.h>
#include <stddef.h>

/* Sets linear red, green and blue of a spectrum of n pairs of wavelength in nm and value, which rise in wavelength: of a
   light if `emits`, else of a surface, which is white where all values are 1. */
void koksma__import_spectrum(const double *pairs, size_t n, bool emits, double rgb[3]);

#endif
