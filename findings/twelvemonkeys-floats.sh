#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: with TwelveMonkeys' readers, ImageIO.read gives a Radiance picture as linear floats: 8 is 8, and twice as
# bright is twice the number. A PFM gives its own floats.
# Seen: the raster of floats has been tone mapped: v / (v + 0.1) of each channel, .83 for a half and .988 for 8, so that
# no number is above 1 and hues move; read parameters with a NullToneMapper give the radiances. Those of the PFM are cut
# off at 1, but not at 0.
# Packages: com.twelvemonkeys.imageio:imageio-hdr and imageio-pnm 3.12.0, with what they need (Maven Central)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for jar in imageio:imageio-hdr imageio:imageio-pnm imageio:imageio-core imageio:imageio-metadata common:common-lang \
    common:common-io common:common-image; do
  mvn -q dependency:copy -Dartifact=com.twelvemonkeys.$jar:3.12.0 -DoutputDirectory=.
done
cat >Floats.java <<'END_OF_SOURCE'
import com.twelvemonkeys.imageio.plugins.hdr.HDRImageReadParam;
import com.twelvemonkeys.imageio.plugins.hdr.tonemap.NullToneMapper;
import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.Arrays;
import javax.imageio.ImageIO;
import javax.imageio.ImageReader;

class Floats {
    static float[] red(BufferedImage image) {
        return image.getRaster().getSamples(0, 0, image.getWidth(), 1, 0, (float[]) null);
    }

    static boolean near(float[] a, double... b) {
        boolean near = a.length >= b.length;
        for (int i = 0; near && i < b.length; i++) near = Math.abs(a[i] - b[i]) < .002 * (1 + Math.abs(b[i]));
        return near;
    }

    public static void main(String[] arguments) throws Exception {
        ByteArrayOutputStream hdr = new ByteArrayOutputStream();  // eight grey pixels: 1/16, 1/8, 1/4 ... 8
        hdr.write("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n".getBytes());
        hdr.write(new byte[] {2, 2, 0, 8});
        for (int channel = 0; channel < 4; channel++) {
            hdr.write(8);
            for (int i = 0; i < 8; i++) hdr.write(channel < 3 ? 128 : 125 + i);
        }
        float[] plain = red(ImageIO.read(new ByteArrayInputStream(hdr.toByteArray())));
        ImageReader reader = ImageIO.getImageReadersByFormatName("hdr").next();
        reader.setInput(ImageIO.createImageInputStream(new ByteArrayInputStream(hdr.toByteArray())));
        HDRImageReadParam parameters = (HDRImageReadParam) reader.getDefaultReadParam();
        parameters.setToneMapper(new NullToneMapper());
        float[] linear = red(reader.read(0, parameters));
        ByteBuffer pfm = ByteBuffer.allocate(24).order(ByteOrder.LITTLE_ENDIAN);
        pfm.put("Pf\n3 1\n-1.0\n".getBytes()).putFloat(.5f).putFloat(8).putFloat(-8);
        float[] other = red(ImageIO.read(new ByteArrayInputStream(pfm.array())));
        System.out.println("HDR: " + Arrays.toString(plain));
        System.out.println("with NullToneMapper: " + Arrays.toString(linear));
        System.out.println("PFM of .5, 8 and -8: " + Arrays.toString(other));
        double[] values = {.0625, .125, .25, .5, 1, 2, 4, 8};
        double[] mapped = Arrays.stream(values).map(v -> v / (v + .1)).toArray();
        System.exit(near(plain, mapped) && near(linear, values) && near(other, .5, 1, -8) ? 0 : 1);
    }
}
END_OF_SOURCE
java -cp '*' Floats.java
