/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The colours of plots. The style number of a curve is colour + KOKSMA__COLOURS * dash. palette.def gives each pattern
 * the colour of its family. koksma_plot_colours gives up to KOKSMA__COLOURS curves of a picture different colours:
 * the first curve of a family gets the family's colour, and each other curve the next colour that no curve has yet;
 * if there are more curves, they differ in dashes. A curve that belongs to no pattern gets the first free number.
 */
#include "plot/plot.h"

#include <string.h>

#include "core/status.h"

static const struct {
    unsigned light, dark;
    const char *patterns;
} colours[] = {
#define COLOUR(light, dark, patterns) {light, dark, patterns},
#include "plot/palette.def"
#undef COLOUR
};
_Static_assert(sizeof colours / sizeof *colours == KOKSMA__COLOURS, "plot.h has the number of colours");

const koksma__theme *koksma__theme_of(bool dark)
{
    static const koksma__theme themes[] = {{.paper = {1, 1, 1, 1},
                                            .ink = {0.1, 0.1, 0.12, 1},
                                            .frame = {0.35, 0.35, 0.4, 1},
                                            .grid = {0.88, 0.89, 0.92, 1},
                                            .guide = {0.45, 0.45, 0.5, 1},
                                            .cell = {0.5, 0.58, 0.74, 1},
                                            .mark = {0.85, 0.25, 0.1, 0.9},
                                            .wash = {0.95, 0.5, 0.3, 0.25}},
                                           {.paper = {0.09, 0.1, 0.12, 1},
                                            .ink = {0.9, 0.91, 0.93, 1},
                                            .frame = {0.6, 0.62, 0.67, 1},
                                            .grid = {0.2, 0.21, 0.24, 1},
                                            .guide = {0.62, 0.63, 0.68, 1},
                                            .cell = {0.32, 0.4, 0.56, 1},
                                            .mark = {1, 0.5, 0.3, 0.9},
                                            .wash = {1, 0.5, 0.25, 0.25},
                                            .dark = true}};
    return &themes[dark];
}

koksma__style koksma__curve_style(const koksma__theme *theme, size_t number, double thickness)
{
    const unsigned rgb =
        theme->dark ? colours[number % KOKSMA__COLOURS].dark : colours[number % KOKSMA__COLOURS].light;
    const koksma__colour colour = {(rgb >> 16) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, 1};
    return (koksma__style){thickness, colour, (koksma__dash)(number / KOKSMA__COLOURS % KOKSMA__DASH_GUIDE)};
}

/* Compares the text up to the first ':', '@' or blank with the names of patterns. */
size_t koksma__colour_of(const char *spec)
{
    const size_t length = strcspn(spec, ":@ ");
    for (size_t c = 0; c < KOKSMA__COLOURS && length; c++) {
        for (const char *at = colours[c].patterns; *at;) {
            const size_t word = strcspn(at, " ");
            if (word == length && !strncmp(at, spec, length)) {
                return c;
            }
            at += word + strspn(at + word, " ");
        }
    }
    return KOKSMA__COLOURS;
}

/* Takes the first free number, trying for each dash in turn the colours from `colour` on. Returns
   KOKSMA__CURVE_STYLES if none is free. */
static size_t next_free(size_t colour, bool *taken)
{
    for (size_t i = 0; i < KOKSMA__CURVE_STYLES; i++) {
        const size_t number = (colour + i) % KOKSMA__COLOURS + i / KOKSMA__COLOURS * KOKSMA__COLOURS;
        if (!taken[number]) {
            taken[number] = true;
            return number;
        }
    }
    return KOKSMA__CURVE_STYLES;
}

koksma_status koksma_plot_colours(const char *const *specs, size_t n, size_t *numbers)
{
    KOKSMA__REQUIRE(specs, numbers);
    const koksma_status status = koksma__array_check("specs", specs, n, sizeof *specs);
    bool taken[KOKSMA__CURVE_STYLES] = {false};
    for (size_t i = 0; i < n && !status; i++) { /* the first of each family gets the family's colour */
        KOKSMA__REQUIRE(specs[i]);
        const size_t colour = koksma__colour_of(specs[i]);
        numbers[i] = colour < KOKSMA__COLOURS && !taken[colour] ? colour : KOKSMA__CURVE_STYLES;
        taken[numbers[i] % KOKSMA__CURVE_STYLES] |= numbers[i] < KOKSMA__CURVE_STYLES;
    }
    for (size_t pass = 0; pass < 2 && !status; pass++) { /* then the other patterns, then texts that name none */
        for (size_t i = 0; i < n; i++) {
            const size_t colour = koksma__colour_of(specs[i]);
            if (numbers[i] == KOKSMA__CURVE_STYLES && (colour < KOKSMA__COLOURS) == (pass == 0)) {
                numbers[i] = next_free(colour % KOKSMA__COLOURS, taken);
                /* styles repeat when there are more curves than styles */
                numbers[i] = numbers[i] < KOKSMA__CURVE_STYLES ? numbers[i] : i % KOKSMA__CURVE_STYLES;
            }
        }
    }
    return status;
}
