/* SPDX-License-Identifier: Apache-2.0 */
/* Fuzzes the reader of PFM files: bytes that it recognises give an image or an error. */
#include "image/formats.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    koksma_image image = {0};
    if (koksma__image_recognises(&koksma__format_pfm, bytes, size)) {
        fuzz_check_status(koksma__format_pfm.read(bytes, size, KOKSMA__IMAGE_COLOURS, &image));
        koksma_image_fini(&image);
    }
    return 0;
}
