/* SPDX-License-Identifier: Apache-2.0 */
/* The table of curves (curves.def), and their names. */
#include <string.h>

#include "curves.h"

static const cli_curve *const curves[] = {
#define CURVE(name) &cli_curve_##name,
#include "curves.def"
#undef CURVE
};

const cli_curve *cli_curve_at(size_t i)
{
    return i < sizeof curves / sizeof *curves ? curves[i] : NULL;
}

const char *cli_curve_options(const cli_curve *curve, cli_curve_list list)
{
    return list == CLI_PRINTED ? curve->print.options : curve->plot.options;
}

const cli_curve *cli_curve_find(cli_curve_list list, const char *name)
{
    const cli_curve *curve;
    for (size_t i = 0; (curve = cli_curve_at(i)); i++) {
        if (cli_curve_options(curve, list) && !strcmp(name, curve->name)) {
            return curve;
        }
    }
    return !strcmp(name, "radial")     ? cli_curve_find(list, "rings") /* what others call them */
           : !strcmp(name, "spectrum") ? cli_curve_find(list, "power")
                                       : NULL;
}
