/* SPDX-License-Identifier: Apache-2.0 */
/* The table of pipelines, and which of them renders a picture: of those that take it, the one of highest preference.
 */
#include "render/frame.h"

const koksma__pipeline *const koksma__pipelines[] = {
#define PIPELINE(name) &koksma__pipeline_##name,
#include "render/pipelines/pipelines.def"
#undef PIPELINE
    NULL};

const koksma__pipeline *koksma__pipeline_for(const koksma__frame *frame)
{
    const koksma__pipeline *best = NULL;
    for (size_t i = 0; koksma__pipelines[i]; i++) {
        const koksma__pipeline *p = koksma__pipelines[i];
        if (p->takes(frame) && (!best || p->preference > best->preference)) {
            best = p;
        }
    }
    return best;
}
