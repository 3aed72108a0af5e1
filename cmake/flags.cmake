# What every compiler of the library is told, gcc, clang and emcc. One result whatever the instruction set: no fused
# multiply-add, no fast-math. The two -fno switches change no value; they let the compiler vectorise loops with comparisons
# and square roots.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_FLAGS_RELEASE "-O3")
set(CMAKE_C_FLAGS_DEBUG "-O1 -g")
add_compile_definitions(_XOPEN_SOURCE=700) # POSIX 2008 and M_PI
add_compile_options(-Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wpointer-arith -Wwrite-strings
                    $<$<C_COMPILER_ID:GNU>:-Wdouble-promotion> -Wvla -ffp-contract=off -fno-math-errno -fno-trapping-math)
