/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma rank --with`: the pictures of another renderer. After the first one a line says how long the pictures take on
   which the first rows wait, before most of that time is over. */
#include "studying.h"

#include <stdio.h>

#include <koksma/image.h>

#include "cli.h"

enum { REFERENCE_PICTURES = 16, FIRST_TRIALS = 8, LEAST_SAID_S = 5 };

koksma_status cli_render_outside(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                 koksma_image *image)
{
    cli_outside *o = context;
    const double start_s = cli_seconds();
    char one[CLI_NUMBER], all[CLI_NUMBER], more[CLI_NUMBER];
    const koksma_status status = koksma_rank_by_command((void *)o->command, picture, run, image);
    if (status || picture->spp < o->spp || atomic_exchange(&o->timed, true) || o->quiet) {
        return status;
    }
    const double s = cli_seconds() - start_s, reference_s = o->reference ? REFERENCE_PICTURES * s : 0;
    const double trials_s = s * FIRST_TRIALS * (double)o->patterns;
    if (reference_s + trials_s >= LEAST_SAID_S) {
        cli_say("rank", "a picture of %d samples took %s: %s%s%s the first %d of each of %zu samplers at most %s",
                picture->spp, cli_duration(s, one), o->reference ? "the reference's 16 take about " : "",
                o->reference ? cli_duration(reference_s, all) : "", o->reference ? ", and" : "", FIRST_TRIALS,
                o->patterns, cli_duration(trials_s, more));
    }
    return status;
}

koksma_status cli_blur(void *context, const koksma_image *image, const koksma_run *run, koksma_image *out)
{
    (void)run;
    return koksma_image_blur(image, *(const double *)context, out);
}

const char *cli_process_text(const koksma_rank_options *options, char text[CLI_PROCESS_TEXT])
{
    char number[CLI_NUMBER];
    if (options->process != cli_blur) {
        return options->process_context;
    }
    snprintf(text, CLI_PROCESS_TEXT, "blur:sd=%s", cli_number(*(const double *)options->process_context, number));
    return text;
}
