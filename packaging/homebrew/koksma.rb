# SPDX-License-Identifier: Apache-2.0
# For a tap of your own: copy it to Formula/, with the `url` and `sha256` of a released archive in place of this tree's (make dist
# makes and prints both), then `brew install --build-from-source TAP/koksma`. It has run on no Mac.
class Koksma < Formula
  desc "Sampling patterns, their discrepancies, and the error that they leave in pictures"
  url "file://#{File.expand_path("../../build/dist/koksma-0.1.0.tar.gz", __dir__)}"
  license "Apache-2.0"

  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "pkgconf" => :build
  depends_on "random123" => :build
  depends_on "cairo"
  depends_on "embree"
  depends_on "jansson"
  depends_on "jpeg-turbo"
  depends_on "libpng"
  depends_on "openexr"
  depends_on "sqlite"

  uses_from_macos "expat"
  uses_from_macos "zlib"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DBUILD_TESTING=OFF", "-DKOKSMA_MPI=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    assert_match "0.1.0", shell_output("#{bin}/koksma --version")
    system bin/"koksma", "generate", "sobol", "-n", "16", "-o", "points.txt"
    assert_match "0.171875", shell_output("#{bin}/koksma measure points.txt -m star --json")
  end
end
