/* SPDX-License-Identifier: Apache-2.0 */
/*
 * power: the periodogram (1/n) |sum exp(-2 pi i k.x)|^2 of 2-dimensional points at every frequency k, as a mean over
 * trials. The rows cover half of the frequency plane, because k and -k have the same power. The picture leaves out
 * the power at frequency 0.
 */
#include <string.h>

#include <koksma/image.h>

#include "../curves.h"

static int compute(cli_curves *c, const char *source, cli_sink *sink)
{
    koksma_spectrum s;
    const int code = cli_curves_spectrum(c, source, 2, &s);
    sink->points = s.points;
    if (s.sets > 0 && c->output) {
        const koksma_status status = c->curve->print.write(c, &s);
        koksma_spectrum_fini(&s);
        return code ? code : status ? cli_fail(c->args, status) : CLI_YES;
    }
    for (int ky = 0; ky <= s.half && s.sets > 0; ky++) {
        for (int kx = -s.half; kx <= s.half; kx++) {
            sink->row(sink, (double[]){kx, ky, koksma_spectrum_power(&s, kx, ky)});
        }
    }
    koksma_spectrum_fini(&s);
    return code;
}

/* Writes the spectrum as an image; the top row has the largest ky. */
static koksma_status write_image(const char *path, const koksma_spectrum *s)
{
    const int side = 2 * s->half + 1;
    koksma_image image;
    koksma_status status = koksma_image_init(&image, side, side, 1);
    for (int row = 0; row < side && !status; row++) {
        for (int column = 0; column < side; column++) {
            image.pixels[(size_t)row * (size_t)side + (size_t)column] =
                (float)koksma_spectrum_power(s, column - s->half, s->half - row);
        }
    }
    if (!status) {
        status = koksma_image_write(path, &image, NULL);
        koksma_image_fini(&image);
    }
    return status;
}

/* Writes the spectrum as an image if the file's ending is that of an image format, else as text or an array of
   numbers. */
static koksma_status write(cli_curves *c, const koksma_spectrum *s)
{
    const char *dot = strrchr(c->output, '.');
    const char *name, *left_out;
    for (size_t i = 0; dot && (name = koksma_image_format(i, &left_out)); i++) {
        if (!strcmp(dot + 1, name)) {
            return write_image(c->output, s);
        }
    }
    return koksma_spectrum_write(c->output, s);
}

static int draw(cli_curves *c)
{
    const int n = c->args->n_operands;
    koksma_spectrum spectra[CLI_MAX_PANELS] = {{0}};
    koksma_panel panels[CLI_MAX_PANELS] = {{0}};
    char titles[CLI_MAX_PANELS][CLI_CHART_LABEL];
    double white;
    int code = cli_real(c->args, "white", 2, 1e-9, 1e9, &white) ? CLI_YES : CLI_USAGE;
    for (int i = 0; i < n && !code; i++) {
        const char *source = c->args->operands[i];
        code = cli_curves_spectrum(c, source, 2, &spectra[i]);
        panels[i] = (koksma_panel){.spectrum = &spectra[i], .white = white, .title = cli_title(source, titles[i])};
    }
    if (!code) {
        code = cli_draw_panels(c, n > 1 ? "Power spectra" : "Power spectrum", panels, (size_t)n);
    }
    for (int i = 0; i < n; i++) {
        koksma_spectrum_fini(&spectra[i]);
    }
    return code;
}

const cli_curve cli_curve_power = {
    .name = "power",
    .meaning =
        "the power spectrum (1/n)|sum exp(-2 pi i k.x)|^2 at every frequency k. Rows have ky >= 0 only, because k "
        "and -k have the same power; a file of koksma curve --output has all k. A picture leaves out k = 0",
    .cite = "ulichney1987",
    .compute = compute,
    .columns = {"kx", "ky", "value"},
    .print = {.options = "half exact output trials", .write = write},
    .plot = {.options = "half exact white trials", .draw = draw},
};
