#!/bin/sh
# Numbers with a decimal point become text, and text becomes numbers, by src/engine/core/c_locale.c alone: libc's own functions
# follow the host program's locale, where 0.5 may be 0,5. Whole numbers and words may go by libc's.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lint/files.sh
files 'src/*.[ch]' | grep -vxF src/engine/core/c_locale.c | xargs perl -0777 -ne '
  my $string = qr/"(?:[^"\\]|\\.)*"/s;
  my $float = qr/%[-+ #0\x27]*[\d*]*(?:\.[\d*]*)?[lL]?[aefgAEFG]/;
  my $character = qr/\x27(?:[^\x27\\]|\\.)+\x27/;
  s{/\*.*?\*/|//[^\n]*|$character|($string)}{defined $1 ? $1 : "\n" x ($& =~ tr/\n//)}gse; # lines stay as they are
  while (/\b(?:strto(?:d|f|ld)|atof|v(?:f|s|sn|d|as)?printf|v?f?s?scanf|(?:f|s|sn|d|as)?printf)\s*(\((?:[^()"]++|$string|(?1))*\))/g) {
    my ($call, $arguments) = ($&, $1);
    my $line = 1 + (substr($_, 0, $-[0]) =~ tr/\n//);
    my $strings = join "", $arguments =~ /$string/g;
    print "$ARGV:$line: ", $call =~ /^([^\s(]*)/, " follows the locale: core/c_locale.h\n"
      if $call =~ /^(?:strto|atof|v)/ || $strings =~ s/%%//gr =~ $float;
  }' | { ! grep .; }
